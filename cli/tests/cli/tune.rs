//! `tune` on the command line: what it writes, and what it refuses.

use crate::common;

use common::{fails, finishes, scratch, straightline};
use std::path::Path;
use straightline_manifest::Manifest;
use straightline_study::record::{Candidate, TuneRecord};

/// Options that leave little to search, so that a test is short.
const SMALL: [&str; 10] = [
    "--set",
    "pattern=latin4",
    "--set",
    "falloff=tent",
    "--set",
    "difference=absolute",
    "--set",
    "non-finite=skip",
    "--rounds",
    "1",
];

#[test]
fn bad_use_is_refused_before_anything_is_drawn() {
    let folder = scratch("tune-refused");
    let out = folder.join("out");
    let out = out.to_str().unwrap();
    let tune = |more: &[&str], status: i32, says: &[&str]| {
        let words = [&["tune", "--out", out], more].concat();
        fails(&words, status, says);
        assert!(!Path::new(out).exists());
    };
    tune(
        &["--scene", "rooof", "--max-error", "1"],
        2,
        &["no scene `rooof`", "roof, grooves"],
    );
    tune(&["--max-error", "1"], 2, &["--scene"]);
    tune(
        &["--scene", "roof", "--capture", "x", "--max-error", "1"],
        2,
        &["--capture"],
    );
    tune(&["--capture", "x", "--size", "8x8", "--max-error", "1"], 2, &["--size"]);
    for budget in ["-1", "NaN", "inf", "much"] {
        tune(
            &["--scene", "roof", "--max-error", budget],
            2,
            &[budget, "not negative"],
        );
    }
    tune(&["--scene", "roof"], 2, &["--max-error"]);
    tune(
        &["--scene", "roof", "--max-error", "1", "--metric", "mse"],
        2,
        &["no metric `mse`", "psnr or flip"],
    );
    tune(
        &["--scene", "roof", "--max-error", "1", "--set", "pattrn=latin4"],
        2,
        &["no option `pattrn`"],
    );
    tune(
        &["--scene", "roof", "--max-error", "1", "--set", "tau=uniform"],
        2,
        &["tau=uniform", "give a number"],
    );
    tune(
        &["--scene", "roof", "--max-error", "1", "--adapter", "no such adapter"],
        2,
        &["no such adapter"],
    );
    tune(&["--capture", "nowhere", "--max-error", "1"], 1, &["nowhere"]);
    tune(&["--mesh", "nowhere.obj", "--max-error", "1"], 1, &["nowhere.obj"]);
}

/// A compiler stands in for a GPU that is not at hand: the same cycles every time, of which the least within the budget is
/// chosen.
#[test]
fn variants_are_compared_by_the_cycles_of_a_compiler() {
    let run = |name: &str| {
        let out = scratch(name);
        let words = ["--cost", "isa:amd:navi21", "--out", out.to_str().unwrap(), "--json"];
        let scene = ["tune", "--scene", "floor", "--size", "64x36", "--max-error", "1"];
        let text = finishes(&[&scene[..], &SMALL, &words].concat());
        let manifest = std::fs::read_to_string(out.join("sraa-floor.json")).expect("a manifest");
        let manifest = Manifest::from_json(&manifest).expect("it is one");
        (serde_json::from_str::<TuneRecord>(&text).expect("a record"), manifest)
    };
    let (record, manifest) = run("tune-isa");
    let gpu = record.compiled_for.clone().expect("a GPU");
    assert!(gpu.to_lowercase().contains("navi21"), "{gpu}");
    assert_eq!(record.cost, "isa:amd:navi21");
    assert!(manifest.tuned.is_some_and(|tuned| tuned.adapter.starts_with(&gpu)));
    let chosen = &record.candidates[record.chosen.expect("a choice")];
    let cycles = |c: &Candidate| {
        c.cycles
            .filter(|_| c.non_finite == 0 && record.best - c.error <= record.max_error)
    };
    let least = record
        .candidates
        .iter()
        .filter_map(cycles)
        .fold(f64::INFINITY, f64::min);
    assert_eq!(chosen.cycles, Some(least));
    assert!(record.candidates.iter().all(|c| c.time.is_none()), "nothing is timed");
    let general = record.candidates[record.general].cycles.expect("cycles");
    assert_eq!(chosen.ratio.map(|ratio| ratio.median), Some(general / least));
    assert!(general > least, "{general} {least}");
    let (again, _) = run("tune-isa-again");
    assert_eq!(again.candidates, record.candidates);
}

/// A picture that is placed cannot be had without the shader that says where.
#[test]
fn a_placed_variant_comes_with_the_shader_that_places() {
    let out = scratch("tune-placed");
    let scene = ["tune", "--scene", "railings", "--size", "64x36", "--max-error", "1"];
    let set = [
        "--set",
        "shading=placed",
        "--set",
        "demodulate=none",
        "--set",
        "layout=superresolution",
        "--set",
        "normals=octahedral",
    ];
    let words = ["--target", "wgsl,glsl450", "--out", out.to_str().unwrap()];
    let said = finishes(&[&scene[..], &SMALL, &set, &words].concat());
    for text in [
        "shading: it was set to placed",
        "demodulate: it was set to none",
        "not searched ",
        "sraa-place-railings.wgsl",
    ] {
        assert!(said.contains(text), "no `{text}` in:\n{said}");
    }
    let manifest = |name: &str| {
        let text = std::fs::read_to_string(out.join(name)).expect("a manifest");
        Manifest::from_json(&text).expect("it is one")
    };
    let (filter, place) = (manifest("sraa-railings.json"), manifest("sraa-place-railings.json"));
    assert_eq!((filter.kernel.as_str(), place.kernel.as_str()), ("sraa", "sraa_place"));
    assert_eq!(filter.options["shading"], "placed");
    assert_eq!(place.options["pattern"], filter.options["pattern"]);
    // As the scene was placed, whatever the filter compares.
    assert_eq!(
        (place.options["metric"].as_str(), place.options["depth-scale"].as_str()),
        ("planes-normals", "10")
    );
    for manifest in [&filter, &place] {
        assert_eq!(manifest.files.len(), 2);
        assert!(
            manifest.files.values().all(|file| out.join(file).is_file()),
            "{:?}",
            manifest.files
        );
    }
    let record = std::fs::read_to_string(out.join("tune-railings.json")).expect("a record");
    let record: TuneRecord = serde_json::from_str(&record).expect("it is one");
    let told = record
        .left_out
        .iter()
        .chain(&record.needed)
        .map(|out| out.term.as_str());
    assert_eq!(told.filter(|term| *term == "search").count(), 1);
}

/// Options that are not searched may be set for all, and no block of pixels then goes the same way.
#[test]
fn what_takes_a_branch_leaves_blocks_aside() {
    let out = scratch("tune-branch");
    let scene = ["tune", "--scene", "railings", "--size", "64x36", "--max-error", "1"];
    let set = [
        "--set",
        "search=seven",
        "--set",
        "demodulate=albedo",
        "--set",
        "shading=centre",
    ];
    let said = finishes(&[&scene[..], &SMALL, &set, &["--out", out.to_str().unwrap()]].concat());
    for text in ["search: it was set to seven", "blocks: ", "mask: it would leave paint"] {
        assert!(said.contains(text), "no `{text}` in:\n{said}");
    }
    let manifest = std::fs::read_to_string(out.join("sraa-railings.json")).expect("a manifest");
    let options = Manifest::from_json(&manifest).expect("it is one").options;
    assert_eq!(
        (options["search"].as_str(), options["demodulate"].as_str()),
        ("seven", "albedo")
    );
    assert!(!out.join("sraa-place-railings.json").exists());
}

#[test]
fn a_cost_that_there_is_not_is_refused() {
    let words = [
        "tune",
        "--scene",
        "floor",
        "--max-error",
        "1",
        "--out",
        "nowhere",
        "--cost",
    ];
    fails(
        &[&words[..], &["isa:navi99"]].concat(),
        2,
        &["no such GPU", "amd:gfx1201"],
    );
    fails(
        &[&words[..], &["cycles"]].concat(),
        2,
        &["use `time`, or `isa:VENDOR:GPU`"],
    );
}

#[test]
fn a_capture_is_tuned_and_a_broken_one_refused() {
    let folder = scratch("tune-capture");
    let frame = folder.join("frame");
    let frame_text = frame.to_str().unwrap();
    let made = straightline(&["capture", "--scene", "tubes", "--size", "64x36", "--out", frame_text]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let out = folder.join("out");
    let out_text = out.to_str().unwrap();
    let words = [
        "tune",
        "--capture",
        frame_text,
        "--max-error",
        "0.01",
        "--metric",
        "flip",
        "--out",
        out_text,
    ];
    let finished = straightline(&[&words[..], &SMALL, &["--target", "wgsl,glsl450"]].concat());
    let said = String::from_utf8_lossy(&finished.stdout).into_owned();
    assert!(
        finished.status.success(),
        "{said}{}",
        String::from_utf8_lossy(&finished.stderr)
    );
    for text in [
        "most general",
        "chosen:",
        "not searched",
        "the capture has no reference",
    ] {
        assert!(said.contains(text), "no `{text}` in:\n{said}");
    }
    let manifest = std::fs::read_to_string(out.join("sraa-frame.json")).expect("a manifest");
    let manifest = Manifest::from_json(&manifest).expect("it is one");
    assert_eq!(manifest.files["wgsl"], "sraa-frame.wgsl");
    assert!(manifest.files.values().all(|file| out.join(file).is_file()));
    assert!(manifest.tuned.is_some_and(|tuned| tuned.error <= 0.01));
    let record = std::fs::read_to_string(out.join("tune-frame.json")).expect("a record");
    assert!(
        record.contains("\"complete\": true") && !record.contains("null,\n  \"general\""),
        "{record}"
    );
    assert!(out.join("tune-frame.csv").is_file());

    let depth = frame.join("depth.exr");
    let bytes = std::fs::read(&depth).expect("depths");
    std::fs::write(&depth, &bytes[..bytes.len() / 2]).expect("cut");
    let elsewhere = folder.join("elsewhere");
    fails(
        &[
            "tune",
            "--capture",
            frame_text,
            "--max-error",
            "1",
            "--out",
            elsewhere.to_str().unwrap(),
        ],
        1,
        &["depth.exr"],
    );
    assert!(!elsewhere.exists());
}
