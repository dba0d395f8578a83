//! Ambient occlusion.

use super::{DEEPEST, Picture};
use crate::oracle::bound::{Rounding, Share, of_mean};

/// Parameters of ambient occlusion; see the kernel's options of the same names.
#[allow(missing_docs)]
pub struct Ao {
    pub taps: usize,
    pub radius: f64,
    pub bias: f64,
    pub strength: f64,
    pub pixel_angle: f64,
    pub depth_sigma: f64,
}

/// Depths of surfaces are larger, by definition of the filter.
const NEAREST: f64 = 1.0e-30_f32 as f64;

/// A depth as it counts for the pixel itself.
fn of_surface(z: f64) -> f64 {
    if z > NEAREST && z < DEEPEST { z } else { DEEPEST }
}

/// A number by definition, and the least and the most that roundings to 32 bits make of it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Light {
    /// By definition.
    pub value: f64,
    /// Least.
    pub low: f64,
    /// Most.
    pub high: f64,
}

impl Light {
    fn map_bounds(self, f: impl Fn(f64) -> f64) -> Light {
        Light {
            value: f(self.value),
            low: f(self.low),
            high: f(self.high),
        }
    }
}

fn view_position(ao: &Ao, size: [i64; 2], [x, y]: [i64; 2], z: f64) -> [f64; 3] {
    let across = (x as f64 + 0.5 - size[0] as f64 / 2.0) * ao.pixel_angle * z;
    let down = (y as f64 + 0.5 - size[1] as f64 / 2.0) * ao.pixel_angle * z;
    [across, down, z]
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Returns the occlusion of `from` by the surface at `there`.
fn tap_occlusion(ao: &Ao, from: [f64; 3], there: [f64; 3], n: [f64; 4]) -> Light {
    let unit = Rounding::SINGLE.unit;
    let way = [0, 1, 2].map(|k| there[k] - from[k]);
    let far = length(way);
    let near = 1.0 - far * far / (ao.radius * ao.radius);
    let distance = far.max(1.0e-6);
    let facing = (0..3).map(|k| way[k] * n[k]).sum::<f64>() / distance - ao.bias;
    let steep = length([n[0], n[1], n[2]]);
    // Places are off by three roundings, and so is the way between them.
    let way_off = 4.0 * unit * (length(from) + length(there));
    let near_off = (2.0 * far + way_off) * way_off / (ao.radius * ao.radius) + 8.0 * unit * (1.0 + near.abs());
    let facing_off = steep * (2.0 * way_off / distance + 16.0 * unit) + 2.0 * unit * ao.bias;
    let is_near = near > -near_off;
    if !is_near || facing.is_nan() {
        return Light::default();
    }
    if !steep.is_finite() || steep * (length(from) + length(there)) > f64::from(f32::MAX) {
        // In 32 bits its products are infinite, and their sum may be no number.
        let value = if facing > 0.0 && near > 0.0 { facing * near } else { 0.0 };
        return Light {
            value,
            low: 0.0,
            high: f64::INFINITY,
        };
    }
    let of = |facing: f64, near: f64| facing.max(0.0) * near.max(0.0);
    Light {
        value: of(facing, near),
        low: of(facing - facing_off, near - near_off),
        high: of(facing + facing_off, near + near_off) * (1.0 + 4.0 * unit),
    }
}

/// The mean occlusion that a pixel finds by some of the taps of its spiral, 0 to 1.
fn mean_occlusion(
    ao: &Ao,
    depth: &Picture,
    normal: &Picture,
    [x, y]: [i64; 2],
    which: impl Iterator<Item = usize>,
) -> Light {
    let z = of_surface(depth.texel_at(x, y)[0]);
    let from = view_position(ao, depth.size, [x, y], z);
    let n = normal.texel_at(x, y);
    let reach = (ao.radius / (ao.pixel_angle * z)).min(48.0);
    let at = |[i, j]: [i64; 2]| {
        let tap = [x + i, y + j];
        let there = view_position(ao, depth.size, tap, depth.texel_at(tap[0], tap[1])[0]);
        match there.iter().all(|c| c.is_finite()) {
            true => tap_occlusion(ao, from, there, n),
            false => Light::default(),
        }
    };
    let (mut sum, mut count) = (Light::default(), 0.0);
    for k in which {
        let distance = (k as f64 + 0.5) / (4 * ao.taps) as f64;
        let angle = k as f64 * 2.399_963_2;
        let way = [distance * angle.cos() * reach, distance * angle.sin() * reach];
        // A place that rounding may move to the next pixel.
        let off = 32.0 * Rounding::SINGLE.unit * (1.0 + reach);
        let places = way.map(|w| [w + 0.5, w + 0.5 - off, w + 0.5 + off].map(|w| w.floor() as i64));
        let tap = at([places[0][0], places[1][0]]);
        let (mut low, mut high) = (tap.low, tap.high);
        for i in &places[0][1..] {
            for j in &places[1][1..] {
                let other = at([*i, *j]);
                (low, high) = (low.min(other.low), high.max(other.high));
            }
        }
        sum.value += tap.value;
        sum.low += low;
        sum.high += high;
        count += 1.0;
    }
    let rounded = 16.0 * Rounding::SINGLE.unit;
    Light {
        value: sum.value,
        low: sum.low * (1.0 - rounded),
        high: sum.high * (1.0 + rounded),
    }
    .map_bounds(|sum| if sum > 0.0 { (sum / count).min(1.0) } else { 0.0 })
}

/// Light that comes to a pixel: by all of its own taps, or, with `quad`, by a quarter of its own and by what the three
/// pixels of the same 2×2 block found by theirs, at the weight of a Gaussian in depth.
pub fn ssao(ao: &Ao, depth: &Picture, normal: &Picture, quad: bool, at: [i64; 2]) -> f64 {
    ssao_between(ao, depth, normal, quad, at).value
}

/// Returns the occlusion of [`ssao`] with the least and the most that roundings make of it.
pub fn ssao_between(ao: &Ao, depth: &Picture, normal: &Picture, quad: bool, [x, y]: [i64; 2]) -> Light {
    let unit = Rounding::SINGLE.unit;
    let occluded = if quad {
        let z = of_surface(depth.texel_at(x, y)[0]);
        let (mut sum, mut total, mut by_taps) = (0.0, 0.0, [0.0; 2]);
        let mut shares = Vec::new();
        for number in 0..4 {
            let at = [x / 2 * 2 + number % 2, y / 2 * 2 + number / 2];
            let away = (of_surface(depth.texel_at(at[0], at[1])[0]) - z) / (ao.depth_sigma * ao.radius);
            let exponent = 0.5 * away * away;
            let weight = (-exponent).exp();
            let which = (0..ao.taps).map(|k| 4 * k + number as usize);
            let found = mean_occlusion(ao, depth, normal, at, which);
            let share = Rounding::SINGLE.of_exponential(exponent) + 16.0 * unit * (1.0 + exponent);
            shares.push(Share {
                color: [found.value, 0.0, 0.0, 0.0],
                weight,
                off: (weight * share.min(700.0).exp_m1()).min(1.0) + 2.0 * Rounding::SINGLE.smallest,
            });
            sum += weight * found.value;
            total += weight;
            by_taps[0] += weight * (found.value - found.low);
            by_taps[1] += weight * (found.high - found.value);
        }
        let off = of_mean(&shares, true, &Rounding::SINGLE) + 16.0 * unit;
        let value = sum / total;
        Light {
            value,
            low: value - 1.001 * by_taps[0] / total - off,
            high: value + 1.001 * by_taps[1] / total + off,
        }
    } else {
        mean_occlusion(ao, depth, normal, [x, y], 0..4 * ao.taps)
    };
    let rounded = 4.0 * unit * (1.0 + ao.strength);
    let light = occluded.map_bounds(|share| 1.0 - ao.strength * share);
    Light {
        value: light.value.clamp(0.0, 1.0),
        low: (light.high - rounded).clamp(0.0, 1.0),
        high: (light.low + rounded).clamp(0.0, 1.0),
    }
}
