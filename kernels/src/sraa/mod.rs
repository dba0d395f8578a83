//! Subpixel Reconstruction Antialiasing (Chajdas, McGuire and Luebke 2011).
//!
//! Shading is known once a pixel, geometry at several samples in it. Each geometry sample borrows its colour
//! from the shading samples of the 3×3 pixels around it, most from those on the same surface; the pixel is the
//! mean of its geometry samples. The paper's listing, with its slips mended.

mod metric;
mod pattern;

use crate::prelude::*;
use metric::{FAR, distance};

pub use metric::{GBuffer, Metric, Surface};
pub use pattern::{Pattern, Shading};

options! {
    /// What an SRAA filter is made of.
    pub struct Sraa {
        /// Where in a pixel geometry is sampled.
        pub pattern: Pattern = Pattern::Latin4,
        /// Where in a pixel shading is sampled.
        pub shading: Shading = Shading::Centre,
        /// What tells two surfaces apart.
        pub metric: Metric = Metric::DepthNormals,
        /// How a tap's weight falls with its distance on the screen.
        pub falloff: Falloff = Falloff::Tent,
        /// How the weights of a sample are made to sum to one.
        pub normalisation: Normalisation = Normalisation::Shifted,
        /// How sharply a weight falls as surfaces differ: exp(-tau * difference).
        pub tau: f32 [0.0..=1.0e6] = 500.0,
        /// Difference per unit of depth: large enough that a step between two surfaces counts as 1 or more.
        pub depth_scale: f32 [0.0..=1.0e6] = 1.0,
    }
}

/// How a tap's weight falls with its distance on the screen (paper §3.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all within one pixel on each axis, as the listing has it.
    None,
    /// Linearly to zero at one pixel on each axis: sharper, and with fewer taps.
    Tent,
}

/// How the weights of a sample are made to sum to one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalisation {
    /// w / Σw as the listing has it: 0/0 where no tap lies on the sample's surface.
    Paper,
    /// The same with the smallest difference subtracted first, which cancels in w / Σw: the nearest surface
    /// always has weight 1, so Σw is never 0.
    Shifted,
}

/// Shading samples that a geometry sample can borrow from: those of the 3×3 pixels around it.
const TAPS: usize = 9;

/// Antialiased colour of `pixel`: each geometry sample takes its colour from the shading samples around it,
/// weighted by how close their surfaces are.
pub fn sraa(cfg: &Sraa, gbuffer: &GBuffer, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let samples = cfg.pattern.samples();
    let share = 1.0 / samples as f32;
    let steepness = cfg.tau * std::f32::consts::LOG2_E;
    let mut weights = [0.0; TAPS];
    for sample in 0..samples {
        let centre = gbuffer.surface(pixel, sample);
        let mut distances = [0.0; TAPS];
        let mut nearest = FAR;
        for tap in 0..TAPS {
            if falloff(cfg, sample, tap) > 0.0 {
                let d = if is_itself(cfg, sample, tap) {
                    0.0
                } else {
                    let shaded = gbuffer.surface(pixel + offset(tap), cfg.shaded_layer());
                    distance(cfg, &centre, &shaded)
                };
                distances[tap] = d;
                nearest = nearest.min(d);
            }
        }
        let origin = match cfg.normalisation {
            Normalisation::Paper => 0.0,
            Normalisation::Shifted => nearest,
        };
        let mut tap_weights = [0.0; TAPS];
        let mut sum = 0.0;
        for tap in 0..TAPS {
            if falloff(cfg, sample, tap) > 0.0 {
                let w = falloff(cfg, sample, tap) * (-steepness * (distances[tap] - origin)).exp2();
                tap_weights[tap] = w;
                sum += w;
            }
        }
        let scale = share / sum;
        for tap in 0..TAPS {
            if falloff(cfg, sample, tap) > 0.0 {
                weights[tap] += tap_weights[tap] * scale;
            }
        }
    }
    let mut result = Vec4::ZERO;
    for tap in 0..TAPS {
        // A tap that no sample wants must not be read: 0 times an infinite colour is not 0.
        if weights[tap] != 0.0 {
            let shaded = color.load(pixel + offset(tap));
            result += weights[tap] * shaded;
        }
    }
    result
}

/// Pixel of `tap` relative to the centre pixel, row by row from (-1, -1) to (1, 1).
fn offset(tap: usize) -> IVec2 {
    ivec2(tap as i32 % 3 - 1, tap as i32 / 3 - 1)
}

/// Weight of `tap` for `sample` by screen distance alone; 0 outside the filter's support of one pixel.
fn falloff(cfg: &Sraa, sample: usize, tap: usize) -> f32 {
    let away = (offset(tap).as_vec2() + cfg.shaded_offset() - cfg.pattern.offset(sample)).abs();
    match cfg.falloff {
        Falloff::None => {
            if away.x <= 1.0 && away.y <= 1.0 {
                1.0
            } else {
                0.0
            }
        }
        Falloff::Tent => (1.0 - away.x).max(0.0) * (1.0 - away.y).max(0.0),
    }
}

/// Whether `tap` is the very sample that it would be compared with.
fn is_itself(cfg: &Sraa, sample: usize, tap: usize) -> bool {
    tap == TAPS / 2 && sample == cfg.shaded_layer()
}
