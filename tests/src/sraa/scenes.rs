//! SRAA on the testbed's scenes: how far a shader is off the definition in f64, and how far it may be.

use super::options::options;
use super::{Options, compiled};
use glam::{UVec2, uvec2};
use std::collections::BTreeMap;
use straightline_bench::execute::Bench;
use straightline_codegen::{Stage, Unroll};
use straightline_oracle::oracle::bound::{self, Rounding};
use straightline_oracle::oracle::{self, SraaParams};
use straightline_scene::capture::ShadingSample;
use straightline_scene::gbuffer;
use straightline_scene::render::{self, CpuRenderer};
use straightline_scene::scene::{NAMES, Scene};

/// Width and height of the pictures.
const SIZE: UVec2 = uvec2(192, 108);

/// A filter on a scene.
#[derive(Clone, Debug)]
pub struct Row {
    /// The scene's name.
    pub scene: String,
    /// Options that are not the default.
    pub options: Options,
    /// Largest difference of any component to f64.
    pub largest: f64,
    /// The most that the error analysis allows any pixel.
    pub bound: f64,
    /// Pixels that are further off than it allows them, or that are not finite.
    pub beyond: usize,
}

impl Row {
    /// For the record.
    pub fn json(&self) -> serde_json::Value {
        let options: BTreeMap<&String, &String> = self.options.iter().map(|(name, value)| (name, value)).collect();
        serde_json::json!({
            "scene": self.scene, "options": options, "largest_difference_to_f64": self.largest,
            "largest_bound": self.bound, "pixels_beyond_their_bound": self.beyond,
        })
    }
}

/// Every metric, with 4 and 16 samples, depths absolute and relative, on every scene.
///
/// # Errors
///
/// In words, if something cannot be drawn or run.
pub fn rows(bench: &Bench) -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (scene, _) in NAMES {
        for pattern in ["latin4", "latin16"] {
            let metrics = ["planes-normals", "depth-normals", "normals", "depth"];
            let sets = metrics.iter().flat_map(|metric| {
                let relative = [("difference", "relative"), ("depth-scale", "3")];
                let absolute = vec![("pattern", pattern), ("metric", *metric)];
                let scaled = [&absolute[..], &relative].concat();
                let reads_depth = *metric != "normals";
                [Some(absolute), reads_depth.then_some(scaled)].into_iter().flatten()
            });
            let sets: Vec<Options> = sets.map(|set| options(&set)).collect();
            rows.extend(of_scene(bench, scene, pattern, &sets)?);
        }
    }
    Ok(rows)
}

/// Sets of options with one pattern on a scene, by a compute shader.
///
/// # Errors
///
/// In words, if something cannot be drawn or run.
pub fn of_scene(bench: &Bench, scene: &str, pattern: &str, sets: &[Options]) -> Result<Vec<Row>, String> {
    let words = |error: &dyn std::fmt::Display| format!("{scene}: {error}");
    let world = Scene::from_name(scene).map_err(|e| words(&e))?;
    let renderer = CpuRenderer::new(&world, SIZE).map_err(|e| words(&e))?;
    let samples = gbuffer::pattern_offsets(pattern).ok_or_else(|| words(&pattern))?;
    let capture = render::capture_scene(&renderer, &samples, ShadingSample::Centre).map_err(|e| words(&e))?;
    let mut rows = Vec::new();
    for options in sets {
        let compiled = compiled(options, Unroll::Full).map_err(|e| words(&e))?;
        let inputs = gbuffer::sraa_inputs(&capture, &compiled.options).map_err(|e| words(&e))?;
        let found = bench.run(&compiled, Stage::Compute, &inputs).map_err(|e| words(&e))?;
        let params = SraaParams::from_options(&compiled.options).map_err(|e| words(&e))?;
        let expected = oracle::resolve_sraa(&inputs, &params).map_err(|e| words(&e))?;
        let bounds = bound::bound_sraa(&inputs, &params, &Rounding::SINGLE).map_err(|e| words(&e))?;
        let mut row = Row {
            scene: scene.to_owned(),
            options: options.clone(),
            largest: 0.0,
            bound: 0.0,
            beyond: 0,
        };
        for ((found, expected), bound) in found.texels().iter().zip(&expected).zip(bounds) {
            let pairs = found.to_array().into_iter().zip(expected.color);
            let off = pairs.map(|(a, b)| (f64::from(a) - b).abs());
            // A NaN is further off than any bound.
            let off = off.fold(0.0, |most, off| if off > most || off.is_nan() { off } else { most });
            row.beyond += usize::from(off.is_nan() || off > bound);
            row.largest = row.largest.max(off);
            row.bound = row.bound.max(bound);
        }
        rows.push(row);
    }
    Ok(rows)
}

/// Prints the worst row of each scene, and of all scenes by metric.
pub fn print(rows: &[Row]) {
    let of = |row: &Row, name: &str| super::options::value(&row.options, name, "absolute").to_owned();
    let mut worst: BTreeMap<String, (f64, f64, usize)> = BTreeMap::new();
    for row in rows {
        let metric = format!("{}, {}", of(row, "metric"), of(row, "difference"));
        for key in [format!("scene {}", row.scene), metric] {
            let entry = worst.entry(key).or_default();
            *entry = (entry.0.max(row.largest), entry.1.max(row.bound), entry.2 + row.beyond);
        }
    }
    for (key, (largest, bound, beyond)) in worst {
        println!("{key:<32} {largest:.1e}, bound {bound:.1e}, {beyond} pixels beyond theirs");
    }
}
