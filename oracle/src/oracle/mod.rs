//! Definition of SRAA, evaluated in double precision without regard to speed.
//!
//! Nothing here is shared with the kernel but the names of options and bindings. Where the kernel adds up weights over
//! all samples and applies them once, this reconstructs the colour of each geometry sample as a weighted mean of shading
//! samples, then takes the weighted mean of the samples:
//!
//! > C(p) = Σₛ rₛ C(s) / Σₛ rₛ,  C(s) = Σₜ wₛₜ · colour(t) / Σₜ wₛₜ,  wₛₜ = falloff(t − s) · exp(−τ · mₛₜ)
//!
//! over the shading samples t at most a radius from the geometry sample s on each axis, and the geometry samples with a
//! share rₛ in the pixel. mₛₜ is the difference of the two surfaces (paper §3.2). Beyond the border the nearest pixel's
//! surfaces and colours are repeated.
//!
//! A sample at which nothing is drawn, with a normal of 0 or as deep as the far plane, differs from others by its depth alone.
//!
//! Where some rₛ are below 0, C(p) is brought into the range of the colours that it is made of.
//!
//! Where shading is placed, the surface of a tap is that at the sample which an image names, and its distance on the screen
//! that of its pixel's centre. Where albedo is known at samples, colour(t) is light times the albedo at t, and what s takes of it the
//! same light times the albedo at s; where shadow is too, of the direct light the share at s instead of that at t. What of the colour does
//! not follow the albedo, if that is known, is taken as it is. The albedo at t is higher where it may be that of another surface. Where all taps of a sample differ from it by more than the search's threshold, its colour is the
//! mean of those shading samples of a larger square that do not, weighed by a Gaussian with a standard deviation of a pixel; if
//! there are any. Pixels that are shaded once more give such samples, within the square or the nine pixels around, that sample, too. With earlier frames, C(s) is the mean over the shading samples of all of them, each where it has moved to; of this
//! frame's the nearest weighs 2⁻⁴⁰ at least.
//!
//! With a guide, colours are differences from it, and its mean is added to C(p); no channel of the sum is below 0.

pub mod bound;
pub mod edge;
mod extra;
mod gbuffer;
mod guide;
mod history;
mod mask;
mod params;
mod pattern;
mod place;
pub mod quads;

use gbuffer::{DEEPEST, GBuffer, Light, Point};
use history::History;
use rayon::prelude::*;
use std::collections::BTreeMap;
use straightline_scene::inputs::Inputs;

pub use extra::extra_samples;
pub use guide::{guide, residual, scale};
pub use params::{
    Demodulate, Depth, Difference, Estimate, Falloff, Layout, Mask, Metric, NonFinite, Normalisation, Normals,
    OracleError, Pattern, Plane, Projection, Resolve, Search, Shading, SraaParams, Turn, Variation,
};
pub use place::{Placed, place_shading};

/// Result of the definition for a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolved {
    /// The colour.
    pub color: [f64; 4],
    /// True if 32 bits decide as 64 do. They need not where [`Normalisation::Paper`] has weights that 32 bits cannot hold, and
    /// where the mask's threshold is all but met.
    pub sure: bool,
}

/// The smallest normal `f32`, 2⁻¹²⁶: what is below is 0 on hardware that flushes subnormal numbers.
const SMALLEST_NORMAL: f64 = f32::MIN_POSITIVE as f64;

/// Differences from here on are alike, by definition of the filter: surfaces are unrelated from 1 on. So is one that is
/// not a number.
const FAR: f64 = 16.0;

/// Change of depth along a plane, as a share of the sample's depth, up to which a tap tells something of the sample, and increase of the
/// difference per unit of that share beyond it, by definition of the filter.
const FAR_ALONG: f64 = 0.5;
const STRETCH: f64 = 400.0;

/// Weights that sum to no more are none, by definition of the filter.
const EPSILON: f64 = 1.0e-30;

/// Of a tap's colour that is to count in the range of a pixel, so much at least is in its samples, by definition of the filter.
const LEAST_USED: f64 = 1.0e-6;

/// The least depth that another is divided by, by definition of the filter.
const NEAREST: f64 = 1.0e-30;

/// Antialiased colour of every pixel, row by row from the top, of what a shader with these options would read.
///
/// # Errors
///
/// [`OracleError::Input`] if an image or a number that the filter needs is missing or does not fit.
pub fn resolve_sraa(inputs: &Inputs, params: &SraaParams) -> Result<Vec<Resolved>, OracleError> {
    let definition = Definition::new(inputs, params)?;
    let (width, height) = (inputs.size.x as i32, inputs.size.y as i32);
    let pixels = (0..height).into_par_iter();
    Ok(pixels
        .flat_map_iter(|y| (0..width).map(move |x| [x, y]))
        .map(|pixel| guide::guided(&definition.gbuffer, pixel, definition.resolve_pixel(pixel)))
        .collect())
}

/// A shading sample within reach of a geometry sample.
struct Tap {
    /// Pixel of the tap, relative to the one that is filtered, and the geometry sample at which it is shaded.
    at: ([i32; 2], usize),
    /// Weight by distance on the screen, above 0.
    falloff: f64,
    /// Difference of the two surfaces, 0 or more.
    difference: f64,
    color: [f64; 4],
    /// True if the tap was shaded in an earlier frame.
    is_earlier: bool,
}

struct Definition<'a> {
    params: &'a SraaParams,
    gbuffer: GBuffer<'a>,
    history: History<'a>,
    samples: Vec<[f64; 2]>,
    shaded: Vec<usize>,
}

impl<'a> Definition<'a> {
    fn new(inputs: &'a Inputs, params: &'a SraaParams) -> Result<Self, OracleError> {
        Ok(Definition {
            params,
            gbuffer: GBuffer::new(inputs, params)?,
            history: History::new(inputs, params)?,
            samples: params.sample_offsets(),
            shaded: params.shaded_samples(),
        })
    }

    fn resolve_pixel(&self, pixel: [i32; 2]) -> Resolved {
        let (mut color, mut shares, mut sure, mut largest) = ([0.0; 4], 0.0, true, 0.0f64);
        for (at, share) in self.sample_shares() {
            let taps = self.taps(pixel, at);
            let looked_at = taps.iter().filter(|tap| self.is_looked_at(at, tap));
            largest = looked_at.map(|tap| tap.difference).fold(largest, f64::max);
            let (taps, is_decided) = self.search_taps(pixel, at, taps);
            let (reconstructed, is_sure) = self.reconstruct(&taps);
            add(&mut color, reconstructed, share);
            shares += share;
            sure &= is_sure && is_decided;
        }
        // In one mean over all taps, a bad one's share goes to the taps of all samples: leave it out of the whole.
        let color = match self.params.non_finite {
            NonFinite::Spread => color.map(|axis| axis / shares),
            NonFinite::Skip => self.without_bad(pixel),
        };
        let (color, is_sure) = self.within_range(pixel, color);
        sure &= is_sure;
        if self.params.mask != Mask::None {
            let own = self.own_color(pixel);
            let threshold = self.params.mask_threshold;
            let is_kept = self.params.non_finite == NonFinite::Spread || is_finite(&own);
            sure &= (largest - threshold).abs() > 1.0e-3 * threshold.max(1.0e-3) || !is_kept || largest == threshold;
            let shading = self.shading(pixel, own);
            sure &= shading.is_decided || largest > threshold;
            if largest <= threshold && is_kept && shading.step <= self.params.mask_step {
                return Resolved {
                    color: shading.color,
                    sure,
                };
            }
        }
        Resolved { color, sure }
    }

    /// Returns whether the mask compares a tap with a geometry sample: one of this frame.
    fn is_looked_at(&self, (pixel, _): ([i32; 2], usize), tap: &Tap) -> bool {
        let is_near = match self.params.variation {
            Variation::Around => true,
            Variation::Within => pixel == [0, 0] && tap.at.0 == [0, 0],
        };
        is_near && !tap.is_earlier
    }

    /// The mean over all finite colours, each by its weight in the whole pixel.
    fn without_bad(&self, pixel: [i32; 2]) -> [f64; 4] {
        let (mut color, mut sum) = ([0.0; 4], 0.0);
        for (at, share) in self.sample_shares() {
            let (taps, _) = self.search_taps(pixel, at, self.taps(pixel, at));
            let weights = self.weights(&taps);
            let total = self.total(&weights);
            for (tap, weight) in taps.iter().zip(weights) {
                if is_finite(&tap.color) && weight > 0.0 {
                    add(&mut color, tap.color, share * weight / total);
                    sum += share * weight / total;
                }
            }
        }
        if sum > EPSILON {
            color.map(|axis| axis / sum)
        } else {
            [0.0; 4]
        }
    }

    /// `color`, where samples may count less than nothing, with each component within the range of the finite colours that some of is in
    /// the samples: a millionth at least. Where light is painted anew, with none below 0. And whether 32 bits decide so too.
    fn within_range(&self, pixel: [i32; 2], color: [f64; 4]) -> ([f64; 4], bool) {
        if !self.params.has_lobes() {
            return (color, true);
        }
        if self.params.demodulate != Demodulate::None {
            return (color.map(|axis| if axis < 0.0 { 0.0 } else { axis }), true);
        }
        let total: f64 = self.sample_shares().iter().map(|(_, share)| share).sum();
        let mut used: BTreeMap<([i32; 2], usize), (f64, [f64; 4])> = BTreeMap::new();
        for (at, share) in self.sample_shares() {
            let taps = self.taps(pixel, at);
            let weights = self.weights(&taps);
            let sum = self.total(&weights);
            for (tap, weight) in taps.iter().zip(weights) {
                let entry = used.entry(tap.at).or_insert((0.0, tap.color));
                entry.0 += (share / total * weight / sum).abs();
            }
        }
        let sure = used
            .values()
            .all(|(used, _)| (used - LEAST_USED).abs() > 0.05 * LEAST_USED);
        let counts = |(used, color): &&(f64, [f64; 4])| *used > LEAST_USED && is_finite(color);
        let counted: Vec<[f64; 4]> = used.values().filter(counts).map(|(_, color)| *color).collect();
        if counted.is_empty() || !is_finite(&color) {
            return (color, sure);
        }
        let within = |axis: usize| {
            let least = counted.iter().map(|color| color[axis]).fold(f64::INFINITY, f64::min);
            let most = counted
                .iter()
                .map(|color| color[axis])
                .fold(f64::NEG_INFINITY, f64::max);
            color[axis].clamp(least, most)
        };
        ([0, 1, 2, 3].map(within), sure)
    }

    /// Geometry samples that have a share in the pixel: relative pixel and number, and the share.
    fn sample_shares(&self) -> Vec<(([i32; 2], usize), f64)> {
        let own = (0..self.samples.len()).map(|sample| (([0, 0], sample), 1.0));
        match self.params.resolve {
            Resolve::Box => own.collect(),
            _ => {
                let share = |away: [f64; 2]| match self.params.resolve {
                    Resolve::Mitchell => away.iter().map(|away| mitchell(2.0 * away.abs())).product(),
                    Resolve::Lanczos => {
                        away.iter().map(|away| sinc(2.0 * away) * sinc(*away)).product::<f64>()
                            * f64::from(u8::from(away.iter().all(|away| away.abs() < 1.0)))
                    }
                    Resolve::Gaussian if away.iter().all(|away| away.abs() < 1.0) => {
                        (-2.0 * (away[0] * away[0] + away[1] * away[1])).exp()
                    }
                    Resolve::Gaussian => 0.0,
                    _ => tent(away[0]) * tent(away[1]),
                };
                let pixels = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y]));
                let all = pixels.flat_map(|pixel| (0..self.samples.len()).map(move |sample| (pixel, sample)));
                all.map(|at| {
                    (
                        at,
                        share(self.sample_position(at).map(|away| away / self.params.resolve_radius)),
                    )
                })
                .filter(|(_, share)| *share != 0.0)
                .collect()
            }
        }
    }

    /// From the centre of the pixel that is filtered, in pixels.
    fn sample_position(&self, (pixel, sample): ([i32; 2], usize)) -> [f64; 2] {
        let offset = self.samples.get(sample).copied().unwrap_or(self.history.jitter);
        [0, 1].map(|axis| f64::from(pixel[axis]) + offset[axis])
    }

    /// Weight of each tap by screen and surface.
    fn weights(&self, taps: &[Tap]) -> Vec<f64> {
        let own = taps.iter().filter(|tap| !tap.is_earlier);
        let nearest = own.map(|tap| tap.difference).fold(f64::INFINITY, f64::min);
        let origin = match self.params.normalisation {
            Normalisation::Shifted if self.params.history > 0 => {
                let faintest = 40.0 * std::f64::consts::LN_2 / self.params.steepness();
                (nearest - faintest).max(0.0)
            }
            Normalisation::Shifted => nearest,
            Normalisation::Paper | Normalisation::Epsilon => 0.0,
        };
        let weight = |tap: &Tap| {
            let origin = if tap.is_earlier { 0.0 } else { origin };
            tap.falloff * (-self.params.steepness() * (tap.difference - origin)).exp()
        };
        taps.iter().map(weight).collect()
    }

    fn total(&self, weights: &[f64]) -> f64 {
        let sum: f64 = weights.iter().sum();
        match self.params.normalisation {
            Normalisation::Epsilon => sum.max(EPSILON),
            Normalisation::Paper | Normalisation::Shifted => sum,
        }
    }

    /// Colour at one geometry sample: the weighted mean of the shading samples around it.
    fn reconstruct(&self, taps: &[Tap]) -> ([f64; 4], bool) {
        let weights = self.weights(taps);
        let total = self.total(&weights);
        let mut color = [0.0; 4];
        for (tap, weight) in taps.iter().zip(&weights) {
            // A bad colour spoils nothing that gives it no weight.
            if *weight > 0.0 {
                add(&mut color, tap.color, *weight);
            }
        }
        // 0/0 if no weight is left.
        let color = color.map(|axis| axis / total);
        let lost = self.params.normalisation == Normalisation::Paper && weights.iter().all(|w| *w < SMALLEST_NORMAL);
        (color, !lost)
    }

    /// The shading samples within reach of a geometry sample.
    fn taps(&self, pixel: [i32; 2], at: ([i32; 2], usize)) -> Vec<Tap> {
        let mut taps = self.taps_within(pixel, at, 3, |away| self.falloff(away));
        taps.extend(self.earlier_taps(pixel, at, 1.0, |away| self.falloff(away)));
        taps
    }

    /// The shading samples that a search looks at.
    fn taps_around(&self, pixel: [i32; 2], at: ([i32; 2], usize)) -> Vec<Tap> {
        let spread = |away: [f64; 2]| (-away.iter().map(|axis| axis * axis).sum::<f64>() / 2.0).exp();
        let radius = self.params.search_radius();
        let mut taps = self.taps_within(pixel, at, radius, spread);
        taps.extend(self.earlier_taps(pixel, at, f64::from(radius), spread));
        taps
    }

    fn taps_within(
        &self,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        radius: i32,
        falloff: impl Fn([f64; 2]) -> f64,
    ) -> Vec<Tap> {
        let mut taps = Vec::new();
        let centre = self.point(pixel, at);
        for y in at.0[1] - radius..=at.0[1] + radius {
            for x in at.0[0] - radius..=at.0[0] + radius {
                let there = [pixel[0] + x, pixel[1] + y];
                for (k, sample) in self.shaded.iter().enumerate() {
                    let away = [0, 1]
                        .map(|axis| self.sample_position(([x, y], *sample))[axis] - self.sample_position(at)[axis]);
                    let falloff = falloff(away);
                    if falloff > 0.0 {
                        let tap = ([x, y], self.gbuffer.shaded_at(there, *sample));
                        let difference = match tap == at {
                            true => 0.0,
                            false => self.difference(&centre, &self.point(pixel, tap)),
                        };
                        taps.push(Tap {
                            at: tap,
                            falloff,
                            difference,
                            color: self.repaint_tap(pixel, at, tap, self.gbuffer.light(there, k), true),
                            is_earlier: false,
                        });
                    }
                }
            }
        }
        taps
    }

    /// The colour of a tap with the light that falls on it, on the surface at a geometry sample: of its direct light the share that
    /// arrives there, and of both what that surface reflects; and what is no such light. If the tap's surface may be another
    /// than the sample's, its light is that of a lighter one.
    fn repaint_tap(
        &self,
        pixel: [i32; 2],
        at: ([i32; 2], usize),
        tap: ([i32; 2], usize),
        light: Light,
        is_own: bool,
    ) -> [f64; 4] {
        let there = |(away, sample): ([i32; 2], usize)| ([pixel[0] + away[0], pixel[1] + away[1]], sample);
        let paint = |at| {
            let (pixel, sample) = there(at);
            self.gbuffer.surface_paint(pixel, sample)
        };
        let (Some((onto, arrives)), Some((from, arrived))) = (paint(at), paint(tap)) else {
            return light.color;
        };
        let from = match is_own {
            true => from,
            false => from.map(|channel| channel.max(self.params.unseen_floor)),
        };
        let Light { color, direct, rest } = light;
        let light = |axis: usize| (color[axis] - rest[axis] + (arrives - arrived) * direct[axis]) / from[axis];
        let onto = |axis: usize| onto[axis] * light(axis) + rest[axis];
        [onto(0), onto(1), onto(2), color[3]]
    }

    /// Returns the taps that a geometry sample takes its colour from: `near`, or those that a search finds; and whether 32 bits
    /// decide so too.
    fn search_taps(&self, pixel: [i32; 2], at: ([i32; 2], usize), near: Vec<Tap>) -> (Vec<Tap>, bool) {
        if self.params.search == Search::None && !self.params.extra && !self.takes_less_by_other_surfaces() {
            return (near, true);
        }
        let most = self.params.search_threshold;
        let decided = |difference: f64| (difference - most).abs() > 1.0e-3 * most.max(1.0e-3) || difference == most;
        let nearest = near.iter().map(|tap| tap.difference).fold(f64::INFINITY, f64::min);
        if nearest <= most {
            return (near, decided(nearest));
        }
        let mut around = match self.params.search {
            Search::None => Vec::new(),
            Search::Five | Search::Seven => self.taps_around(pixel, at),
        };
        around.extend(self.further_taps(pixel, at));
        let is_decided = decided(nearest) && around.iter().all(|tap| decided(tap.difference));
        around.retain(|tap| tap.difference <= most);
        // They count alike.
        around.iter_mut().for_each(|tap| tap.difference = 0.0);
        match around.is_empty() {
            true => (self.by_other_surfaces(pixel, at, near), is_decided),
            false => (around, is_decided),
        }
    }

    /// Returns whether the filter knows which samples no tap shows.
    fn takes_less_by_other_surfaces(&self) -> bool {
        let params = self.params;
        params.demodulate != Demodulate::None
            && params.resolve == Resolve::Box
            && params.normalisation == Normalisation::Shifted
            && self.shaded.len() == 1
            && self.samples.len() <= 32
    }

    /// Taps of a geometry sample whose surface none of them shows: those of this frame.
    fn by_other_surfaces(&self, pixel: [i32; 2], at: ([i32; 2], usize), mut near: Vec<Tap>) -> Vec<Tap> {
        near.retain(|tap| !tap.is_earlier);
        for tap in &mut near {
            let light = self.gbuffer.light([0, 1].map(|axis| pixel[axis] + tap.at.0[axis]), 0);
            tap.color = self.repaint_tap(pixel, at, tap.at, light, false);
        }
        near
    }

    fn point(&self, pixel: [i32; 2], at: ([i32; 2], usize)) -> Point {
        let place = self.sample_position(at);
        let ray_at = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 + place[axis]);
        self.gbuffer
            .point([pixel[0] + at.0[0], pixel[1] + at.0[1]], at.1, ray_at)
    }

    fn own_color(&self, pixel: [i32; 2]) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for k in 0..self.shaded.len() {
            add(&mut sum, self.gbuffer.color(pixel, k), 1.0 / self.shaded.len() as f64);
        }
        sum
    }

    /// Weight of a tap that is `away` pixels from a sample.
    fn falloff(&self, away: [f64; 2]) -> f64 {
        let radius = self.params.radius;
        if away.iter().any(|axis| axis.abs() > radius) {
            return 0.0;
        }
        match self.params.falloff {
            Falloff::None => 1.0,
            Falloff::Tent => Some(tent(away[0] / radius) * tent(away[1] / radius))
                .filter(|weight| *weight > LEAST || self.params.history > 0)
                .unwrap_or(0.0)
                .powf(self.params.sharpness),
            Falloff::Gaussian => {
                let square: f64 = away.iter().map(|axis| axis * axis).sum();
                (-square / (2.0 * self.params.sigma.powi(2))).exp()
            }
        }
    }

    /// Returns the difference of the surface at a tap from that at a geometry sample.
    fn difference(&self, sample: &Point, tap: &Point) -> f64 {
        let per_depth = match self.params.difference {
            Difference::Absolute => 1.0,
            Difference::Relative => 1.0 / sample.depth.max(NEAREST),
        };
        let scale = self.params.depth_scale * per_depth;
        // Two skies are equally deep, and one is as far from any surface as from any other.
        let step = match (sample.depth == DEEPEST, tap.depth == DEEPEST) {
            (true, false) | (false, true) => DEEPEST,
            _ => sample.depth - tap.depth,
        };
        let depths = || scale * step.abs();
        let is_drawn = self.gbuffer.is_drawn(sample);
        let normal = match self.params.plane {
            Plane::Sample => sample.normal,
            Plane::Tap => tap.normal,
        };
        let plane = || {
            if !is_drawn {
                return depths();
            }
            let apart: f64 = (0..3)
                .map(|axis| (tap.axis(axis) - sample.axis(axis)) * normal[axis])
                .sum();
            scale * apart.abs()
        };
        // Far along the plane, as at the horizon, a tap tells nothing of a sample.
        let stretched = || match (self.params.projection, self.params.difference) {
            (Projection::Perspective, Difference::Relative) => STRETCH * (step.abs() * per_depth - FAR_ALONG),
            _ => 0.0,
        };
        let turned = || normal_distance(self.params, sample.normal, tap.normal);
        match self.params.metric {
            Metric::PlanesNormals => [plane(), stretched(), turned()]
                .map(clamp_difference)
                .into_iter()
                .fold(0.0, f64::max),
            Metric::DepthNormals => clamp_difference(depths()).max(clamp_difference(turned())),
            Metric::Normals => clamp_difference(turned()),
            Metric::Depth => clamp_difference(depths()),
        }
    }
}

/// Returns the distance of the normal `b` from that of a sample, `a`; by cosine no more than 0 from a sample of which the
/// normal is 0, as where nothing is drawn.
fn normal_distance(params: &SraaParams, a: [f64; 3], b: [f64; 3]) -> f64 {
    if params.by_cosine() {
        (0..3).map(|axis| a[axis] * (a[axis] - b[axis])).sum()
    } else {
        (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>() / 2.0
    }
}

/// Limits a difference to [`FAR`], which also stands for one that is not a number.
fn clamp_difference(difference: f64) -> f64 {
    if difference < FAR { difference } else { FAR }
}

/// Greatest weight of a tent that counts as nothing, where it is known beforehand.
const LEAST: f64 = 1.0e-6;

fn mitchell(x: f64) -> f64 {
    let cubic = match x {
        x if x < 1.0 => 7.0 * x.powi(3) - 12.0 * x.powi(2) + 16.0 / 3.0,
        x if x < 2.0 => -7.0 / 3.0 * x.powi(3) + 12.0 * x.powi(2) - 20.0 * x + 32.0 / 3.0,
        _ => 0.0,
    };
    cubic / 6.0
}

fn sinc(x: f64) -> f64 {
    let angle = std::f64::consts::PI * x;
    if angle == 0.0 { 1.0 } else { angle.sin() / angle }
}

fn tent(away: f64) -> f64 {
    (1.0 - away.abs()).max(0.0)
}

fn is_finite(color: &[f64; 4]) -> bool {
    color.iter().all(|axis| axis.is_finite())
}

fn add(sum: &mut [f64; 4], color: [f64; 4], weight: f64) {
    for (sum, axis) in sum.iter_mut().zip(color) {
        *sum += weight * axis;
    }
}
