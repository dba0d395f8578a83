//! Detects depth that is held in steps which a metric takes for edges.

use super::{choice_or_default, depth_encoding, depth_planes};
use crate::capture::Capture;
use crate::encode::{DepthEncoding, DepthStorage};
use crate::scene::SKY_DEPTH;
use glam::{UVec2, Vec2};
use straightline_kernels::OptionValues;

/// Depth in steps that count as differences of surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coarse {
    /// Share of the samples on even ground whose depth differs from its plane by more than `threshold`.
    pub share: f64,
    /// The smallest threshold of the options.
    pub threshold: f64,
    /// Name of the option that it is; `tau` is its reciprocal.
    pub option: &'static str,
    /// As what nine of ten of these samples count at most: thresholds should not be below.
    pub least: f64,
}

/// Least number of times that a depth occurs on average if depths lie in steps: of depths in whole floats nearly all are
/// different.
const REPEATED: usize = 2;

/// Ground is even where neighbours are no farther off than this share of the depth.
const EVEN: f64 = 0.05;

/// Share of the samples from which on it is worth a word: steps put about half of them off, edges between close surfaces a fifth.
const MANY: f64 = 0.35;

/// Detects depths that, as a shader with these options reads them, lie in steps which its metric takes for more than its
/// smallest threshold in many samples; `None` if there are none, and of a metric that reads no depth.
pub fn detect_coarse_depth(capture: &Capture, options: &OptionValues) -> Option<Coarse> {
    if choice_or_default(options, "metric", "depth-normals") == "normals" {
        return None;
    }
    let encoding = depth_encoding(options, depth_planes(capture, options).ok()?);
    let number = |name: &str, default: f64| options.number(name).unwrap_or(default);
    let scale = number("depth-scale", 1.0);
    let relative = choice_or_default(options, "difference", "absolute") == "relative";
    let (name, threshold) = smallest_threshold(options, number);
    let layers = read_depths(capture, encoding);
    if !in_steps(&layers) {
        return None;
    }
    let unit = |depth: f64| if relative { depth.abs().max(1.0e-30) } else { 1.0 };
    let off = off_planes(capture, &layers);
    let mut differences: Vec<f64> = off.into_iter().map(|(depth, off)| scale * off / unit(depth)).collect();
    differences.sort_by(f64::total_cmp);
    let within = differences.partition_point(|difference| *difference <= threshold);
    let share = 1.0 - within as f64 / differences.len().max(1) as f64;
    let least = *differences.get(differences.len() * 9 / 10)?;
    (share > MANY).then_some(Coarse {
        share,
        threshold,
        option: name,
        least,
    })
}

/// Returns whether depths repeat as often as they do in steps.
fn in_steps(layers: &[Vec<f64>]) -> bool {
    let drawn = layers.iter().flatten().filter(|depth| depth.is_finite());
    let mut depths: Vec<u64> = drawn.map(|depth| depth.to_bits()).collect();
    let all = depths.len();
    depths.sort_unstable();
    depths.dedup();
    all >= REPEATED * depths.len()
}

/// Depths of samples on even ground, and by how much they are off the plane through their pixel and its neighbours.
fn off_planes(capture: &Capture, layers: &[Vec<f64>]) -> Vec<(f64, f64)> {
    let Some(layer) = capture.shaded_layers().first().copied() else {
        return Vec::new();
    };
    let origin = capture.samples.get(layer).copied().unwrap_or(Vec2::ZERO);
    let parallel = capture.camera.is_some_and(|camera| camera.parallel_height.is_some());
    let value = |depth: f64| if parallel { depth } else { 1.0 / depth };
    let UVec2 { x: width, y: height } = capture.size;
    let own = &layers[layer];
    let mut off = Vec::new();
    for y in 1..height.saturating_sub(1) {
        for x in 1..width.saturating_sub(1) {
            let at = (y * width + x) as usize;
            let depth = own[at];
            let near = |other: f64| (other - depth).abs() <= EVEN * depth.abs();
            let [left, right] = [own[at - 1], own[at + 1]];
            let [above, below] = [own[at - width as usize], own[at + width as usize]];
            if ![left, right, above, below].into_iter().all(near) {
                continue;
            }
            let slope = [0.5 * (value(right) - value(left)), 0.5 * (value(below) - value(above))];
            for (sample, offset) in capture
                .samples
                .iter()
                .enumerate()
                .filter(|(sample, _)| *sample != layer)
            {
                let away = *offset - origin;
                let plane = value(value(depth) + f64::from(away.x) * slope[0] + f64::from(away.y) * slope[1]);
                let found = layers[sample][at];
                if near(found) {
                    off.push((depth, (found - plane).abs()));
                }
            }
        }
    }
    off
}

/// Returns the smallest difference that changes a filter's decision, and its option.
fn smallest_threshold(options: &OptionValues, number: impl Fn(&str, f64) -> f64) -> (&'static str, f64) {
    let mut all = vec![("tau", 1.0 / number("tau", 500.0).max(1.0e-30))];
    if choice_or_default(options, "mask", "none") != "none" {
        all.push(("mask-threshold", number("mask-threshold", 0.002)));
    }
    if choice_or_default(options, "search", "none") != "none" {
        all.push(("search-threshold", number("search-threshold", 0.05)));
    }
    let smallest = all.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    smallest.unwrap_or(("tau", f64::INFINITY))
}

/// Linear depths of every layer, as a shader reads them; not a number where nothing is drawn.
fn read_depths(capture: &Capture, encoding: DepthEncoding) -> Vec<Vec<f64>> {
    let stored = |depth: f32| match depth.is_finite() && depth < SKY_DEPTH {
        true => encoding.decode(DepthStorage::Float32.round(encoding.encode(f64::from(depth)))),
        false => f64::NAN,
    };
    let layers = capture.depth.layers().iter();
    layers
        .map(|layer| layer.texels().iter().map(|depth| stored(*depth)).collect())
        .collect()
}
