//! What SRAA should give: the definition, evaluated in double precision without regard to speed.
//!
//! Nothing here is shared with the kernel but the containers that texels are read from. Where the kernel adds up
//! nine weights over all samples and applies them once, this reconstructs the colour of each geometry sample as a
//! weighted mean of shading samples, then takes the mean of the samples:
//!
//! > C(p) = 1/n Σₛ ( Σₜ wₛₜ · colour(p + t) / Σₜ wₛₜ ),  wₛₜ = falloff(t + shade − centreₛ) · exp(−τ · mₛₜ)
//!
//! over the 3×3 pixels t around p whose shading samples are at most one pixel from the geometry sample on each
//! axis. mₛₜ is the difference of the two surfaces: the larger of `depth_scale·|Δdepth|` and 1 − a·b of their
//! normals. Beyond the border the nearest pixel's surface and colour are repeated.

pub mod edge;
mod params;
mod pattern;

use rayon::prelude::*;
use straightline_kernels::prelude::{Frame, FrameLayers, Vec3, Vec4};

pub use params::{Falloff, Metric, Normalisation, OracleError, Pattern, Shading, SraaParams};

/// A G-buffer and the shading to be antialiased, all of one size. Layer `s` is geometry sample `s` of the
/// pattern; with shading at the pixel's centre the geometry there is one more layer, the last.
#[derive(Clone, Copy, Debug)]
pub struct SraaInputs<'a> {
    /// One shading sample a pixel, linear.
    pub color: &'a Frame<Vec4>,
    /// Linear depth. An infinite depth is as far as any other infinite depth.
    pub depth: &'a FrameLayers<f32>,
    /// Unit normals. Not needed by [`Metric::Depth`].
    pub normal: Option<&'a FrameLayers<Vec3>>,
}

/// The smallest normal `f32`, 2⁻¹²⁶: what is below is 0 on hardware that flushes subnormal numbers.
const SMALLEST_NORMAL: f64 = f32::MIN_POSITIVE as f64;

/// Antialiased colour of every pixel, row by row from the top.
///
/// With [`Normalisation::Paper`] a pixel is NaN only where the weights vanish in double precision too, so fewer are
/// than in the listing's `f32`: [`all_weights_underflow`] tells where that has none.
///
/// Panics unless all images have one size and there are at least as many layers as `params` needs, and if the
/// metric needs normals and there are none.
pub fn sraa(inputs: &SraaInputs, params: &SraaParams) -> Vec<[f64; 4]> {
    let definition = Definition::new(inputs, params);
    definition.each_pixel(|pixel| definition.color(pixel))
}

/// For every pixel whether the paper's listing, in `f32` with subnormal numbers flushed to zero, gives 0/0 there:
/// whether at least one of its samples has every weight below the smallest normal `f32`. What `params` says of
/// normalisation does not matter. Panics as [`sraa`].
pub fn all_weights_underflow(inputs: &SraaInputs, params: &SraaParams) -> Vec<bool> {
    let definition = Definition::new(inputs, params);
    definition.each_pixel(|pixel| {
        (0..definition.samples.len()).any(|sample| {
            definition
                .taps(pixel, sample)
                .iter()
                .all(|tap| tap.listed_weight(params) < SMALLEST_NORMAL)
        })
    })
}

/// A shading sample within reach of a geometry sample.
struct Tap {
    /// Weight by distance on the screen, above 0.
    falloff: f64,
    /// Difference of the two surfaces, 0 or more, possibly infinite.
    difference: f64,
    color: [f64; 4],
}

impl Tap {
    /// The weight that the paper's listing computes.
    fn listed_weight(&self, params: &SraaParams) -> f64 {
        self.falloff * decay(params.tau, self.difference)
    }
}

struct Definition<'a> {
    inputs: SraaInputs<'a>,
    params: SraaParams,
    /// In sixteenths of a pixel from the pixel's centre.
    samples: &'static [[i32; 2]],
    shaded: [i32; 2],
    shaded_layer: usize,
    width: i32,
    height: i32,
}

impl<'a> Definition<'a> {
    fn new(inputs: &SraaInputs<'a>, params: &SraaParams) -> Self {
        let samples = pattern::samples(params.pattern);
        let (shaded_layer, needed) = match params.shading {
            Shading::Sample0 => (0, samples.len()),
            Shading::Centre => (samples.len(), samples.len() + 1),
        };
        let size = inputs.color.size();
        let fits = |layers: usize, frame_size| layers >= needed && frame_size == size;
        let depth = inputs.depth.layers();
        assert!(
            fits(depth.len(), depth[0].size()),
            "depth: {needed} layers of the colour's size"
        );
        if params.metric == Metric::DepthNormals {
            let normal = inputs.normal.expect("the metric needs normals").layers();
            assert!(
                fits(normal.len(), normal[0].size()),
                "normal: {needed} layers of the colour's size"
            );
        }
        Definition {
            inputs: *inputs,
            params: *params,
            samples,
            shaded: pattern::shaded(params.pattern, params.shading),
            shaded_layer,
            width: size.x as i32,
            height: size.y as i32,
        }
    }

    fn each_pixel<T: Send>(&self, value: impl Fn([i32; 2]) -> T + Sync) -> Vec<T> {
        let value = &value;
        (0..self.height)
            .into_par_iter()
            .flat_map_iter(|y| (0..self.width).map(move |x| value([x, y])))
            .collect()
    }

    /// The mean of the pixel's samples.
    fn color(&self, pixel: [i32; 2]) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for sample in 0..self.samples.len() {
            add(&mut sum, self.reconstruct(pixel, sample));
        }
        sum.map(|axis| axis / self.samples.len() as f64)
    }

    /// Colour at one geometry sample: the weighted mean of the shading samples around it.
    fn reconstruct(&self, pixel: [i32; 2], sample: usize) -> [f64; 4] {
        let taps = self.taps(pixel, sample);
        let nearest = taps.iter().map(|tap| tap.difference).fold(f64::INFINITY, f64::min);
        let weight = |tap: &Tap| match self.params.normalisation {
            Normalisation::Paper => tap.listed_weight(&self.params),
            // Two infinite differences are equal, and their difference is 0.
            Normalisation::Shifted if tap.difference == nearest => tap.falloff,
            Normalisation::Shifted => tap.falloff * decay(self.params.tau, tap.difference - nearest),
        };
        let mut color = [0.0; 4];
        let mut sum = 0.0;
        for tap in &taps {
            let weight = weight(tap);
            // A bad colour spoils nothing that gives it no weight.
            if weight > 0.0 {
                sum += weight;
                add(&mut color, tap.color.map(|axis| weight * axis));
            }
        }
        color.map(|axis| axis / sum)
    }

    /// The shading samples within reach of a geometry sample.
    fn taps(&self, pixel: [i32; 2], sample: usize) -> Vec<Tap> {
        let centre = self.samples[sample];
        let at = self.index(pixel);
        let mut taps = Vec::with_capacity(9);
        for dy in -1..=1 {
            for dx in -1..=1 {
                let falloff = self.falloff(dx * 16 + self.shaded[0] - centre[0])
                    * self.falloff(dy * 16 + self.shaded[1] - centre[1]);
                if falloff > 0.0 {
                    let tap = self.index([pixel[0] + dx, pixel[1] + dy]);
                    taps.push(Tap {
                        falloff,
                        difference: self.difference((at, sample), (tap, self.shaded_layer)),
                        color: self.inputs.color.texels()[tap].to_array().map(f64::from),
                    });
                }
            }
        }
        taps
    }

    /// Weight on one axis of a tap that is `sixteenths` of a pixel away.
    fn falloff(&self, sixteenths: i32) -> f64 {
        let away = f64::from(sixteenths.abs()) / 16.0;
        match self.params.falloff {
            Falloff::None if away <= 1.0 => 1.0,
            Falloff::Tent if away < 1.0 => 1.0 - away,
            _ => 0.0,
        }
    }

    /// How different the surfaces at two samples are, each given by texel and layer.
    fn difference(&self, a: (usize, usize), b: (usize, usize)) -> f64 {
        let depth = |(texel, layer): (usize, usize)| f64::from(self.inputs.depth.layers()[layer].texels()[texel]);
        let depths = apart(depth(a), depth(b), self.params.depth_scale);
        match (self.params.metric, self.inputs.normal) {
            (Metric::DepthNormals, Some(normals)) => {
                let normal =
                    |(texel, layer): (usize, usize)| normals.layers()[layer].texels()[texel].to_array().map(f64::from);
                depths.max(half_squared_distance(normal(a), normal(b))).min(FAR)
            }
            _ => depths.min(FAR),
        }
    }

    /// Index of the texel at `pixel`, or of the nearest one inside.
    fn index(&self, pixel: [i32; 2]) -> usize {
        let (x, y) = (pixel[0].clamp(0, self.width - 1), pixel[1].clamp(0, self.height - 1));
        y as usize * self.width as usize + x as usize
    }
}

fn add(sum: &mut [f64; 4], color: [f64; 4]) {
    for (sum, axis) in sum.iter_mut().zip(color) {
        *sum += axis;
    }
}

/// `scale·|a − b|`, where an infinity equals itself and a scale of 0 makes all equal.
fn apart(a: f64, b: f64, scale: f64) -> f64 {
    if a == b || scale == 0.0 {
        0.0
    } else {
        scale * (a - b).abs()
    }
}

/// Beyond it all differences are alike, by definition of the filter: surfaces are unrelated from 1 on.
const FAR: f64 = 16.0;

/// `exp(−rate·distance)`, where a rate or a distance of 0 gives 1 whatever the other is.
fn decay(rate: f64, distance: f64) -> f64 {
    if rate == 0.0 || distance == 0.0 {
        1.0
    } else {
        (-rate * distance).exp()
    }
}

/// ½|a − b|², which for unit vectors is 1 − a·b without the cancellation.
fn half_squared_distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>() / 2.0
}
