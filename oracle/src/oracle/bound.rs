//! Bounds on the error of a computation in fewer bits against the definition: an error analysis, pixel by pixel, of the inputs.
//!
//! Nothing here is fitted to what shaders were seen to do. With u the unit roundoff, every number that the filter computes
//! is followed with the most that it may be off: what is read, the difference of two surfaces, the exponent −τ m, the
//! weight, the mean. Rounding that depends on the order of additions or on whether a product and a sum are rounded once
//! or twice is counted for the worst order, so that the bound holds for whatever a driver's compiler makes of a shader;
//! functions are as inexact as WGSL's specification allows (*Accuracy of expressions*: a quotient 2.5 ULP, an inverse
//! square root 2 ULP, exp2 3 + 2 |x| ULP, in 16 bits 1 + 2 |x|). A number below the smallest normal one may be 0.
//!
//! A weighted mean r = Σ w c / Σ w whose weights are off by Δw is off by at most Σ Δw |c − r| / Σ w: taps of the mean's own
//! colour cannot move it, and nothing moves it out of the range of its colours. So where the bits do not suffice to distinguish
//! two surfaces, the bound is as large as their colours differ, and no larger.

use super::gbuffer::{DEEPEST, Point, Reading};
use super::{
    Definition, Difference, EPSILON, FAR_ALONG, Mask, Metric, NEAREST, NonFinite, Normalisation, OracleError, Plane,
    Projection, STRETCH, Search, SraaParams, Tap, clamp_difference, is_finite, normal_distance,
};
use rayon::prelude::*;
use straightline_scene::inputs::Inputs;

/// Rounding of a precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// Most that a rounded number is off, as a share of it: half the distance of neighbours.
    pub unit: f64,
    /// Maximum relative error of a number that is read: 0 if inputs have the same precision.
    pub read: f64,
    /// The smallest normal number; smaller ones may become 0.
    pub smallest: f64,
    /// The largest number; larger ones become infinite.
    pub largest: f64,
    /// ULP that exp2 may be off at 0.
    pub exponential: f64,
}

impl Rounding {
    /// `f32`, of inputs in `f32`.
    pub const SINGLE: Rounding = Rounding {
        unit: f32::EPSILON as f64 / 2.0,
        read: 0.0,
        smallest: f32::MIN_POSITIVE as f64,
        largest: f32::MAX as f64,
        exponential: 3.0,
    };
    /// `f16`, of inputs in `f32` that are rounded as they are read.
    pub const HALF: Rounding = Rounding {
        unit: 1.0 / 2048.0,
        read: 1.0 / 2048.0,
        smallest: 1.0 / 16384.0,
        largest: 65504.0,
        exponential: 1.0,
    };

    /// Most that exp2(−x) may be off as a share of it, x a product of a difference that is exact: x itself is off by four
    /// roundings (τ log₂ e, the subtraction of the smallest, the product), the function by ULPs of at most two units.
    pub fn of_exponential(&self, x: f64) -> f64 {
        self.unit * (4.0 * x * std::f64::consts::LN_2 + 2.0 * (self.exponential + 2.0 * x))
    }
}

/// Range of the possible results of a computation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    /// A difference of surfaces, 0 or more, that may be off by so much.
    fn around(value: f64, off: f64) -> Range {
        let far = clamp_difference(f64::INFINITY);
        match (value.is_nan(), off.is_nan()) {
            // The input is NaN, in any precision.
            (true, _) => Range { low: far, high: far },
            (false, true) => Range { low: 0.0, high: far },
            (false, false) => Range {
                low: clamp_difference((value - off).max(0.0)),
                high: clamp_difference(value + off),
            },
        }
    }

    fn max(self, other: Range) -> Range {
        Range {
            low: self.low.max(other.low),
            high: self.high.max(other.high),
        }
    }
}

/// A colour with its share in a mean: by definition, and with the maximum error of the share.
pub struct Share {
    /// Red, green, blue and alpha, by definition.
    pub color: [f64; 4],
    /// Weight, by definition: below 0 in a lobe of a filter.
    pub weight: f64,
    /// Most that the weight may be off.
    pub off: f64,
}

/// Most that the mean of `shares` may be off in any component. The weights' sum need not be 1; `normalised` says whether the
/// mean is divided by it. Where so little weight is left that it counts for none, black is possible too.
pub fn of_mean(shares: &[Share], normalised: bool, rounding: &Rounding) -> f64 {
    let total: f64 = shares.iter().map(|s| s.weight).sum();
    // A weight of 0 or more stays so however it is rounded.
    let low = |s: &Share| {
        if s.weight < 0.0 {
            s.weight - s.off
        } else {
            (s.weight - s.off).max(0.0)
        }
    };
    let least: f64 = shares.iter().map(low).sum();
    let most: f64 = shares.iter().map(|s| s.weight + s.off).sum();
    let rest = if normalised { total } else { 1.0 };
    let mean = match normalised && total <= EPSILON {
        true => [0.0; 4],
        false => [0, 1, 2, 3].map(|k| shares.iter().map(|s| s.weight * s.color[k]).sum::<f64>() / rest),
    };
    if normalised && most <= EPSILON {
        return 0.0;
    }
    let apart = |a: &[f64; 4], b: &[f64; 4]| (0..4).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    let size = |a: &[f64; 4]| apart(a, &[0.0; 4]);
    let count = shares.len() as f64;
    let possible = shares.iter().filter(|s| s.weight.abs() + s.off > 0.0);
    let brightest = possible.clone().map(|s| size(&s.color)).fold(0.0, f64::max);
    let mut range = possible.map(|s| apart(&s.color, &mean)).fold(0.0, f64::max);
    // In few bits the sum that counts for none is the smallest number that there is.
    let none = EPSILON.max(rounding.smallest);
    let divisor = if normalised { least } else { 1.0 };
    let mut by_weights = match divisor > none {
        true => shares.iter().map(|s| s.off * apart(&s.color, &mean)).sum::<f64>() / divisor,
        false => f64::INFINITY,
    };
    if !normalised {
        by_weights += size(&mean) * (most - least).max(0.0);
        range = f64::INFINITY;
    } else if least <= none {
        range = range.max(size(&mean));
    }
    if shares.iter().any(|s| s.weight < 0.0) {
        // Such a mean may lie beyond all colours.
        range = f64::INFINITY;
    }
    // Products, their sum in any order, the sum of weights, a quotient; and colours as they are read.
    let arithmetic = (2.0 * count + 12.0) * rounding.unit + rounding.read;
    // A sum beyond the largest number is infinite; a value that cannot even be read is left out of a mean.
    if brightest * (1.0 + arithmetic) > rounding.largest && (rounding.read == 0.0 || !normalised) {
        return f64::INFINITY;
    }
    let added: f64 = shares.iter().map(|s| (s.weight.abs() + s.off) * size(&s.color)).sum();
    let lost = (2.0 * count + 2.0) * rounding.smallest;
    let rounded = match divisor > none {
        true => (arithmetic * added + lost) / divisor.min(1.0),
        false => arithmetic * brightest,
    };
    by_weights.min(range) + rounded
}

/// Most that any component of every pixel may be off, row by row, in whatever a shader with these options makes of these
/// inputs; see [`resolve_sraa`](super::resolve_sraa). Of [`Normalisation::Paper`] nothing is promised where no weight is
/// left, nor where a quotient may overflow: infinity.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the filter needs is missing or does not fit;
/// [`OracleError::BadValue`] with earlier frames.
pub fn bound_sraa(inputs: &Inputs, params: &SraaParams, rounding: &Rounding) -> Result<Vec<f64>, OracleError> {
    if params.history > 0 {
        return Err(OracleError::BadValue {
            option: "history".to_owned(),
            value: params.history.to_string(),
            expected: "0, as no error analysis covers earlier frames".to_owned(),
        });
    }
    let definition = Definition::new(inputs, params)?;
    let (width, height) = (inputs.size.x as i32, inputs.size.y as i32);
    let pixels = (0..height).into_par_iter();
    Ok(pixels
        .flat_map_iter(|y| (0..width).map(move |x| [x, y]))
        .map(|pixel| definition.most_off(pixel, rounding))
        .collect())
}

/// A tap with the range of its difference.
struct Reach {
    falloff: f64,
    /// Most that the falloff is off, as a share of it.
    falloff_off: f64,
    difference: f64,
    range: Range,
    color: [f64; 4],
}

impl Definition<'_> {
    fn most_off(&self, pixel: [i32; 2], rounding: &Rounding) -> f64 {
        let reconstructed = self.sample_shares();
        let total: f64 = reconstructed.iter().map(|(_, share)| share).sum();
        let mut shares = Vec::new();
        let mut largest = Range { low: 0.0, high: 0.0 };
        let mut undecided = 0.0;
        for (at, share) in reconstructed {
            let taps = self.taps(pixel, at);
            let looked_at: Vec<bool> = taps.iter().map(|tap| self.is_looked_at(at, tap)).collect();
            let near = self.tap_reaches(pixel, at, taps, 0.0, rounding);
            let compared = near.iter().zip(looked_at).filter(|(_, is_looked_at)| *is_looked_at);
            largest = compared.fold(largest, |most, (tap, _)| most.max(tap.range));
            let (reach, most) = self.searched_reach(pixel, at, near, rounding);
            undecided += most * (share / total).abs();
            match self.shares(&reach, share / total, rounding) {
                Some(own) => shares.extend(own),
                None => return f64::INFINITY,
            }
        }
        let skip = self.params.non_finite == NonFinite::Skip;
        if skip {
            shares.retain(|s| is_finite(&s.color));
        }
        let filtered = of_mean(&shares, skip, rounding) + undecided;
        // Within a range that is known a colour is off by no more than it is out of it.
        if self.params.has_lobes() && !self.is_range_decided(pixel) {
            return f64::INFINITY;
        }
        let own = self.own_color(pixel);
        if self.params.mask == Mask::None || (skip && !is_finite(&own)) {
            return filtered;
        }
        // The mask's own threshold is rounded, too.
        let threshold = self.params.mask_threshold;
        let close = threshold * 2.0 * (rounding.read + rounding.unit);
        let kept = rounding.read * own.iter().fold(0.0f64, |most, lane| most.max(lane.abs())) + rounding.smallest;
        if largest.high <= threshold - close || largest.high == 0.0 {
            return kept;
        }
        if largest.low > threshold + close {
            return filtered;
        }
        let apart = shares.iter().flat_map(|s| (0..4).map(|k| (s.color[k] - own[k]).abs()));
        filtered + kept + apart.fold(0.0, f64::max)
    }

    /// Returns whether rounding cannot change the colours into whose range a pixel is brought.
    fn is_range_decided(&self, pixel: [i32; 2]) -> bool {
        self.within_range(pixel, [0.0; 4]).1
    }

    fn tap_reaches(
        &self,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        taps: Vec<Tap>,
        falloff_off: f64,
        rounding: &Rounding,
    ) -> Vec<Reach> {
        let reached = taps.into_iter().map(|tap| {
            let range = match tap.at == at {
                true => Range { low: 0.0, high: 0.0 },
                false => self.difference_range(pixel, at, tap.at, rounding),
            };
            Reach {
                falloff: tap.falloff,
                falloff_off,
                difference: tap.difference,
                range,
                color: tap.color,
            }
        });
        reached.collect()
    }

    /// Returns the taps that a sample takes its colour from, `near` or those that a search finds, and how far apart colours may
    /// be where that choice is not decided.
    fn searched_reach(
        &self,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        near: Vec<Reach>,
        rounding: &Rounding,
    ) -> (Vec<Reach>, f64) {
        if self.params.search == Search::None {
            return (near, 0.0);
        }
        let most = self.params.search_threshold;
        let close = most * 2.0 * (rounding.read + rounding.unit);
        let is_decided =
            |range: Range| range.high <= most - close || range.low > most + close || range.low == range.high;
        let nearest = |of: fn(&Reach) -> f64| near.iter().map(of).fold(f64::INFINITY, f64::min);
        let here = Range {
            low: nearest(|tap| tap.range.low),
            high: nearest(|tap| tap.range.high),
        };
        // exp of at most the square of four pixels and a half.
        let falloff_off =
            2.0 * rounding.unit * (rounding.exponential + 2.0 * 21.0 * std::f64::consts::LOG2_E) + 21.0 * rounding.unit;
        let mut around = self.tap_reaches(pixel, at, self.taps_around(pixel, at), falloff_off, rounding);
        let is_seen = nearest(|tap| tap.difference) <= most;
        let decided = is_decided(here) && (is_seen || around.iter().all(|tap| is_decided(tap.range)));
        let apart = match decided {
            true => 0.0,
            false => {
                let all = || near.iter().chain(&around).filter(|tap| is_finite(&tap.color));
                let lane = |k: usize| {
                    let most = all().map(|tap| tap.color[k]).fold(f64::NEG_INFINITY, f64::max);
                    let least = all().map(|tap| tap.color[k]).fold(f64::INFINITY, f64::min);
                    // If some colours do not count, the rest is divided by less: the remaining one may be all or none of it.
                    let kept = near.iter().chain(&around).all(|tap| is_finite(&tap.color));
                    if kept {
                        (most - least).max(0.0)
                    } else {
                        2.0 * most.abs().max(least.abs())
                    }
                };
                (0..4).map(lane).fold(0.0, f64::max)
            }
        };
        around.retain(|tap| tap.difference <= most);
        for tap in &mut around {
            (tap.difference, tap.range) = (0.0, Range { low: 0.0, high: 0.0 });
        }
        match is_seen || around.is_empty() {
            true => (near, apart),
            false => (around, apart),
        }
    }

    /// Returns the range in which the computed difference of two surfaces lies.
    fn difference_range(
        &self,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        tap: ([i32; 2], usize),
        rounding: &Rounding,
    ) -> Range {
        let u = rounding.unit;
        let reading = |(away, sample): ([i32; 2], usize)| {
            let there = [pixel[0] + away[0], pixel[1] + away[1]];
            self.gbuffer.reading(there, sample, rounding)
        };
        let (s, t) = (self.point(pixel, at), self.point(pixel, tap));
        let (rs, rt) = (reading(at), reading(tap));
        let two = matches!(self.params.metric, Metric::PlanesNormals | Metric::DepthNormals);
        let is_nan = |point: &Point, read: &Reading| read.is_nan || point.normal.iter().any(|axis| axis.is_nan());
        // `max` of the two differences may drop what is not a number, and `min` of a depth and the sky's keeps what is far
        // below 0.
        let may_be_dropped = two && (is_nan(&s, &rs) || is_nan(&t, &rt));
        if self.params.escapes && (may_be_dropped || rs.is_below || rt.is_below) {
            return Range {
                low: 0.0,
                high: clamp_difference(f64::INFINITY),
            };
        }
        let step = s.depth - t.depth;
        let beyond = |depth: f64| depth.abs() > rounding.largest && depth < DEEPEST;
        let same_depth = rs.stored == rt.stored || (s.depth == DEEPEST && t.depth == DEEPEST);
        let step_off = if same_depth {
            0.0
        } else if beyond(s.depth) || beyond(t.depth) || s.depth.max(t.depth) == DEEPEST && rounding.largest < 1.0e6 {
            // The sky is as deep as the largest number, and so may be what is far.
            match s.depth.min(t.depth).abs() < rounding.largest / 2.0 {
                true => 0.0,
                false => f64::INFINITY,
            }
        } else {
            rs.depth * s.depth.abs() + rt.depth * t.depth.abs() + u * step.abs() + rounding.smallest
        };
        let (per_depth, scale_off) = match self.params.difference {
            Difference::Absolute => (1.0, 2.0 * u + rounding.read),
            Difference::Relative => (1.0 / s.depth.max(NEAREST), rs.depth + 8.0 * u + rounding.read),
        };
        let scale = self.params.depth_scale * per_depth;
        let scaled = |value: f64, off: f64| {
            let value = scale * value.abs();
            Range::around(value, scale * off + value * scale_off + 4.0 * rounding.smallest)
        };
        let by_depth = || match (s.depth == DEEPEST, t.depth == DEEPEST) {
            // In f32 the sky less a surface is the sky, to the bit.
            (true, false) | (false, true) if s.depth.min(t.depth).abs() < DEEPEST * u / 4.0 => {
                let value = clamp_difference(scale * DEEPEST);
                match rounding.largest < DEEPEST && s.depth == DEEPEST {
                    // In f16 it is less than that.
                    true => Range { low: 0.0, high: value },
                    false => Range {
                        low: value,
                        high: value,
                    },
                }
            }
            _ => scaled(step, step_off),
        };
        let drawn = self.gbuffer.is_drawn(&s);
        let by_normal = || {
            let each = rs.normal + rt.normal;
            if self.params.by_cosine() {
                let products: f64 = (0..3).map(|axis| (s.normal[axis] * t.normal[axis]).abs()).sum();
                let sizes: f64 = (0..3).map(|axis| s.normal[axis].abs() + t.normal[axis].abs()).sum();
                let (square, size) = s.normal.iter().fold((0.0, 0.0), |(square, size), axis| {
                    (square + axis * axis, size + axis.abs())
                });
                let reading = each * sizes + 2.0 * rs.normal * size + 6.0 * each * each;
                let off = reading + 6.0 * u * (square + products) + 4.0 * rounding.smallest;
                return Range::around(normal_distance(self.params, s.normal, t.normal), off);
            }
            let turn = [0, 1, 2].map(|axis| s.normal[axis] - t.normal[axis]);
            let value = normal_distance(self.params, s.normal, t.normal);
            if (0..4).all(|lane| rs.texel[lane].to_bits() == rt.texel[lane].to_bits()) {
                return Range::around(value, 0.0);
            }
            let across: f64 = turn.iter().map(|axis| axis.abs()).sum();
            let off = across * each + 1.5 * each * each + 8.0 * u * value + 4.0 * rounding.smallest;
            Range::around(value, off)
        };
        let by_plane = || {
            if !drawn {
                return by_depth();
            }
            let (s, t, rs, step) = match self.params.plane {
                Plane::Sample => (&s, &t, &rs, step),
                Plane::Tap => (&t, &s, &rt, -step),
            };
            let ray = |axis: usize| t.ray[axis].abs() + s.ray[axis].abs();
            let along: f64 = (0..3).map(|axis| t.ray[axis] * s.normal[axis]).sum();
            let aside: f64 = (0..3)
                .map(|axis| (t.base[axis] - s.base[axis] + t.ray[axis] - s.ray[axis]) * s.normal[axis])
                .sum();
            // In a parallel projection it is the same at any depth.
            let (far, far_off) = match self.params.projection {
                Projection::Perspective => (s.depth.abs(), rs.depth * s.depth.abs()),
                Projection::Parallel => (1.0, 0.0),
            };
            let sizes: f64 = (0..3).map(|axis| ray(axis) * s.normal[axis].abs()).sum();
            let [_, right, down] = self.gbuffer.rays().unwrap_or_default();
            let away = [0, 1].map(|axis| (self.sample_position(tap)[axis] - self.sample_position(at)[axis]).abs());
            let spans: f64 = (0..3)
                .map(|axis| (away[0] * right[axis].abs() + away[1] * down[axis].abs()) * s.normal[axis].abs())
                .sum();
            let reach: f64 = (0..3).map(ray).sum();
            let tilt = rs.normal * reach;
            let (along_off, aside_off) = (
                (12.0 * u + 2.0 * rounding.read) * sizes + tilt,
                (8.0 * u + 2.0 * rounding.read) * spans
                    + rs.normal * (right.iter().chain(&down).map(|v| v.abs()).sum::<f64>()),
            );
            let off = step.abs() * along_off
                + step_off * (along.abs() + along_off)
                + far * aside_off
                + far_off * (aside.abs() + aside_off)
                + 4.0 * u * ((step * along).abs() + (far * aside).abs());
            // The definition takes the difference of two points; it is this sum.
            let far = match self.params.projection {
                Projection::Perspective => s.depth,
                Projection::Parallel => 1.0,
            };
            scaled(-step * along + far * aside, off)
        };
        let stretched = || match (self.params.projection, self.params.difference) {
            (Projection::Perspective, Difference::Relative) => {
                let share = step.abs() * per_depth;
                let off = step_off * per_depth + share * scale_off + 2.0 * u * (share + FAR_ALONG) + rounding.smallest;
                Range::around(STRETCH * (share - FAR_ALONG), STRETCH * off)
            }
            _ => Range::around(0.0, 0.0),
        };
        match self.params.metric {
            Metric::PlanesNormals => by_plane().max(stretched()).max(by_normal()),
            Metric::DepthNormals => by_depth().max(by_normal()),
            Metric::Normals => by_normal(),
            Metric::Depth => by_depth(),
        }
    }

    /// The share of each tap in a sample that has `share` in the pixel; `None` where nothing is promised.
    fn shares(&self, reach: &[Reach], share: f64, rounding: &Rounding) -> Option<Vec<Share>> {
        let nearest = |of: fn(&Reach) -> f64| reach.iter().map(of).fold(f64::INFINITY, f64::min);
        let (origin, least) = match self.params.normalisation {
            Normalisation::Shifted => (nearest(|tap| tap.difference), nearest(|tap| tap.range.low)),
            Normalisation::Paper | Normalisation::Epsilon => (0.0, 0.0),
        };
        // All weights may be multiplied by one number: origins differ, shares do not.
        let tau = self.params.steepness();
        let ends = reach.iter().map(|tap| {
            let steep = tau * std::f64::consts::LOG2_E * (tap.range.high - least);
            let rounded = rounding.of_exponential(steep) + 4.0 * rounding.unit + tap.falloff_off;
            let high = tap.falloff * (rounded - tau * (tap.range.low - least)).min(rounded.min(1.0)).exp();
            let low = tap.falloff * (-rounded - tau * (tap.range.high - least)).exp();
            // Weights too small are lost; rounding never brings back a number smaller than half of the smallest of all.
            let step = 2.0 * rounding.unit * rounding.smallest;
            let high = if high < 0.5 * step { 0.0 } else { high + step };
            ((low - rounding.smallest).max(0.0), high)
        });
        let ends: Vec<(f64, f64)> = ends.collect();
        let weight = |tap: &Reach| tap.falloff * (-tau * (tap.difference - origin)).exp();
        let total: f64 = reach.iter().map(weight).sum();
        let (lows, highs) = ends.iter().fold((0.0, 0.0), |(l, h), (low, high)| (l + low, h + high));
        if self.params.normalisation == Normalisation::Paper && lows < 100.0 * rounding.smallest {
            return None;
        }
        let epsilon = match self.params.normalisation {
            Normalisation::Epsilon => EPSILON,
            Normalisation::Paper | Normalisation::Shifted => 0.0,
        };
        // Shifted weights: the tap that is the nearest as computed is at no distance from itself, and weighs its whole falloff.
        let nearest_weighs = match self.params.normalisation {
            Normalisation::Shifted => nearest(|tap| tap.falloff),
            Normalisation::Paper | Normalisation::Epsilon => 0.0,
        };
        // Divided by too little, a share is infinite.
        let step = 2.0 * rounding.unit * rounding.smallest;
        if share.abs() / lows.max(nearest_weighs).max(epsilon.max(step)) > rounding.largest {
            return None;
        }
        let summed = (reach.len() as f64 + 8.0) * rounding.unit;
        let own = reach.iter().zip(ends).map(|(tap, (low, high))| {
            let exact = weight(tap) / total.max(epsilon);
            let most = ratio_or_one(high, (lows - low + high).max(epsilon)).min(1.0);
            // In few bits the divisor is bounded by the smallest number that there is.
            let least = epsilon.max(if epsilon > 0.0 {
                rounding.smallest
            } else {
                f64::MIN_POSITIVE
            });
            let fewest = low / (highs - high + low).max(least);
            let bright = tap
                .color
                .iter()
                .any(|lane| lane.abs() >= rounding.largest * (1.0 - rounding.read));
            // A colour that these bits cannot hold may be left out.
            let fewest = if bright && rounding.read > 0.0 { 0.0 } else { fewest };
            let off = (most - exact).max(exact - fewest).max(0.0);
            Share {
                color: tap.color,
                weight: share * exact,
                off: share.abs() * (off + summed * (exact + off)) + 2.0 * rounding.smallest,
            }
        });
        Some(own.collect())
    }
}

fn ratio_or_one(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 1.0 }
}
