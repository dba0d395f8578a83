//! Tests of `budget` from the user's side: the paper's table 2 of a user's own scene, and sums that are right.

use crate::common;

use common::{fails, finishes, scratch, write};
use serde_json::Value;
use std::path::Path;

/// Tiny, with the fewest rounds.
const SMALL: [&str; 4] = ["--size", "32x18", "--rounds", "3"];

fn budget(arguments: &[&str]) -> Value {
    let words = [&["budget", "--json"][..], &SMALL, arguments].concat();
    serde_json::from_str(&finishes(&words)).expect("JSON")
}

fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name]
        .as_array()
        .unwrap_or_else(|| panic!("no list {name} in {value}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Median of a part of a frame; 0 of a part that there is not.
fn median(part: &Value) -> f64 {
    match part {
        Value::Null => 0.0,
        part => number(&part["median"]),
    }
}

/// Raw rounds of the pass of a name with so many samples.
fn rounds(record: &Value, name: &str, samples: u64) -> Vec<f64> {
    let passes = list(record, "passes").iter();
    let found: Vec<_> = passes
        .filter(|pass| pass["name"] == name && pass["samples"] == samples)
        .collect();
    assert_eq!(found.len(), 1, "{name} with {samples} samples");
    list(found[0], "rounds_ms").iter().map(number).collect()
}

/// The filter with the default metric.
fn filter<'a>(record: &'a Value, pattern: &str, shading: &str) -> &'a Value {
    let mut filters = list(record, "filters").iter();
    let wanted = [("metric", "depth-normals"), ("pattern", pattern), ("shading", shading)];
    let found = filters.find(|filter| wanted.iter().all(|(name, value)| filter[*name] == **value));
    found.expect("a filter")
}

fn middle(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of[of.len() / 2]
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1.0e-9 * a.abs().max(b.abs()).max(1.0)
}

#[test]
fn the_table_is_whole_and_adds_up() {
    let record = budget(&[]);
    assert_eq!(record["scene"], "roof");
    let frames = list(&record, "frames");
    let methods: Vec<_> = frames
        .iter()
        .map(|frame| frame["method"].as_str().expect("a name"))
        .collect();
    assert_eq!(
        methods,
        [
            "1x",
            "SRAA 4, sample0",
            "SRAA 4",
            "SRAA 4, MSAA pass",
            "SRAA 16",
            "4x shading",
            "16x shading",
            "MSAA 4"
        ]
    );
    for frame in frames {
        // Of three rounds an interval is the range, so the net's lies between the sums of its parts' ends.
        let sum = |end: &str| -> f64 {
            let parts = ["geometry_ms", "shading_ms", "filter_ms"].iter();
            parts.filter_map(|part| frame[part][end].as_f64()).sum()
        };
        let [low, middle, high] = ["low", "median", "high"].map(|end| number(&frame["net_ms"][end]));
        assert!(0.0 < low && low <= middle && middle <= high, "{frame}");
        assert!(
            sum("low") <= low * 1.000_001 && high <= sum("high") * 1.000_001,
            "{frame}"
        );
        let forward = frame["method"] == "MSAA 4";
        assert_eq!(frame["geometry_ms"].is_null(), forward, "{frame}");
        assert_eq!(
            frame["filter_ms"].is_null(),
            forward || frame["method"] == "1x",
            "{frame}"
        );
    }
    for part in ["passes", "filters"] {
        for timed in list(&record, part) {
            let rounds: Vec<f64> = list(timed, "rounds_ms").iter().map(number).collect();
            assert_eq!(rounds.len(), 3, "{timed}");
            assert!(rounds.iter().all(|ms| *ms > 0.0), "{timed}");
            assert!(near(middle(rounds), median(&timed["ms"])), "{timed}");
        }
    }
    assert_eq!(list(&record, "filters").len(), 9);
    let bytes: Vec<_> = list(&record, "costs")
        .iter()
        .map(|cost| &cost["gbuffer_bytes"][0])
        .collect();
    assert_eq!(bytes[1], 32 * 18 * 4 * 6);
}

#[test]
fn break_even_and_speedup_follow_from_the_rounds() {
    let record = budget(&["--scene", "railings"]);
    assert_eq!(record["scene"], "railings");
    let comparisons = list(&record, "comparisons");
    assert_eq!(comparisons.len(), 4 * 4);
    let of = |method: &str, over: &str| {
        let found = comparisons.iter().find(|c| c["method"] == method && c["over"] == over);
        found.expect("a comparison").clone()
    };
    for (method, samples, drawn, shading) in [
        ("SRAA 4", 4, 4, "centre"),
        ("SRAA 4, sample0", 4, 3, "sample0"),
        ("SRAA 16", 16, 16, "centre"),
    ] {
        let filter = filter(&record, &format!("latin{samples}"), shading);
        let filtering: Vec<f64> = list(filter, "rounds_ms").iter().map(number).collect();
        let main = rounds(&record, "main G-buffer", 1);
        let further = rounds(&record, "depth and normals", drawn);
        let once = rounds(&record, "deferred shading", 1);
        let geometry = rounds(&record, "main G-buffer", samples);
        let all = rounds(&record, "deferred shading", samples);
        let mean = rounds(&record, "box filter", samples);
        let (mut evens, mut speedups) = (Vec::new(), Vec::new());
        for k in 0..3 {
            let (own, other) = (main[k] + further[k] + filtering[k], geometry[k] + mean[k]);
            evens.push((own - other) / (samples as f64 - 1.0));
            speedups.push((other + all[k]) / (own + once[k]));
        }
        let found = of(method, &format!("{samples}x shading"));
        assert!(near(median(&found["break_even_ms"]), middle(evens)), "{found}");
        assert!(near(median(&found["speedup"]), middle(speedups)), "{found}");
        assert_eq!(filter["break_even_ms"], found["break_even_ms"]);
    }
    assert!(of("SRAA 4", "MSAA 4")["break_even_ms"].is_null());
    assert!(of("SRAA 4", "1x")["break_even_ms"].is_null());
}

#[test]
fn people_get_tables_with_the_papers_figures() {
    let said = finishes(&[&["budget", "--shading-cost", "2"][..], &SMALL].concat());
    for text in [
        "roof, 32x18 on ",
        "medians of 3 rounds",
        "SRAA 4, MSAA pass",
        "\nnet, high ",
        "\npaper, net ",
        "11.1",
        "14.4",
        "167.0",
        "2 evaluations of the shading for each sample",
        "pays from",
    ] {
        assert!(said.contains(text), "no `{text}` in:\n{said}");
    }
    let width = said.lines().skip(1).map(|line| line.chars().count()).max();
    assert!(width <= Some(140), "{width:?}:\n{said}");
}

#[test]
fn what_there_is_not_is_refused() {
    fails(
        &["budget", "--scene", "nowhere"],
        2,
        &["there is no scene `nowhere`", "roof", "railings"],
    );
    fails(&["budget", "--rounds", "1"], 2, &["3..=1000"]);
    fails(&["budget", "--shading-cost", "0"], 2, &["1..=1000"]);
    fails(
        &["budget", "--mesh", "nowhere.glb"],
        1,
        &["nowhere.glb", "cannot be read"],
    );
    fails(&["budget", "--geometry-ms", "1"], 2, &["--geometry-ms"]);
}

#[test]
fn models_are_timed_from_where_they_are_seen() {
    let folder = scratch("budget-model");
    let model = folder.join("stair.glb");
    std::fs::write(&model, stair()).expect("the model is written");
    let model = model.to_str().expect("a path");
    let record = budget(&["--mesh", model, "--eye", "9,7,9", "--target", "0,3,0"]);
    assert_eq!(record["scene"], "stair.glb");
    assert_eq!(record["triangles"], 120 * 12);
    assert_eq!(list(&record, "frames").len(), 8);
    let text = write(&folder, "text.glb", "no model");
    fails(&["budget", "--mesh", &text], 1, &["text.glb"]);
    assert!(!Path::new("budget.json").exists());
}

/// A spiral stair of 120 steps as a binary glTF.
fn stair() -> Vec<u8> {
    let (mut positions, mut indices) = (Vec::<[f32; 3]>::new(), Vec::<u32>::new());
    for step in 0..120_u32 {
        let turn = step as f32 * 0.2;
        let (along, across) = ([turn.cos(), turn.sin()], [-turn.sin(), turn.cos()]);
        for side in [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ] {
            let first = positions.len() as u32;
            for corner in side {
                let bit = |k: u32| if corner >> k & 1 == 1 { 1.0 } else { 0.0 };
                let (out, wide) = (0.5 + 2.0 * bit(0), 0.25 * (bit(2) - 0.5) * (1.0 + 2.0 * bit(0)));
                positions.push([
                    along[0] * out + across[0] * wide,
                    step as f32 * 0.05 + 0.04 * bit(1),
                    along[1] * out + across[1] * wide,
                ]);
            }
            indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
        }
    }
    let mut data: Vec<u8> = positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let split = data.len();
    data.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
    let bound = |pick: fn(f32, f32) -> f32| {
        [0, 1, 2].map(|axis| positions.iter().map(|p| p[axis]).reduce(pick).expect("a corner"))
    };
    let mut json = serde_json::json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "buffers": [{ "byteLength": data.len() }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": split },
            { "buffer": 0, "byteOffset": split, "byteLength": data.len() - split }
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": positions.len(), "type": "VEC3",
              "min": bound(f32::min), "max": bound(f32::max) },
            { "bufferView": 1, "componentType": 5125, "count": indices.len(), "type": "SCALAR" }
        ]
    })
    .to_string();
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let mut file = b"glTF".to_vec();
    let word = |file: &mut Vec<u8>, number: usize| file.extend((number as u32).to_le_bytes());
    word(&mut file, 2);
    word(&mut file, 12 + 8 + json.len() + 8 + data.len());
    word(&mut file, json.len());
    file.extend(b"JSON");
    file.extend(json.as_bytes());
    word(&mut file, data.len());
    file.extend(b"BIN\0");
    file.extend(&data);
    file
}
