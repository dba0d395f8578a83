//! Filters of samples with negative lobes. Beside a very bright sample they would overshoot, far below zero.

use super::Inputs;
use super::colors::color;
use super::demodulate::{Demodulate, may_count};
use super::options::{Resolve, Sraa};
use crate::prelude::*;

/// A tap with a smaller share in the samples does not count among their colours.
const LEAST_USED: f32 = 1.0e-6;

/// Larger than any colour.
const BEYOND: f32 = 3.0e38;

/// Clamps each component of `found` to the range of the taps' colours that have a share in the samples. Repainted light may be
/// brighter than any tap; there, only negative components become zero.
pub(super) fn within_range<const TAPS: usize>(
    cfg: &Sraa,
    inputs: &Inputs,
    used: &[f32; TAPS],
    side: usize,
    found: Vec4,
) -> Vec4 {
    if !cfg.has_lobes() {
        found
    } else if cfg.demodulate != Demodulate::None {
        let none = Vec4::ZERO;
        let most = Vec4::splat(BEYOND);
        clamped(found, none, most)
    } else {
        let mut least = Vec4::splat(BEYOND);
        let mut most = Vec4::splat(-BEYOND);
        for tap in 0..TAPS {
            let shaded = color(cfg, inputs, tap, side);
            if used[tap] > LEAST_USED && may_count(cfg, inputs, cfg.tap(tap, side), shaded) && shaded.is_finite() {
                least = least.min(shaded);
                most = most.max(shaded);
            }
        }
        // If no tap counts, or the pixel is not finite, the pixel is unchanged.
        if found.is_finite() && least.x <= most.x {
            clamped(found, least, most)
        } else {
            found
        }
    }
}

/// Clamps each component to `least` and `most`; a NaN stays a NaN.
fn clamped(found: Vec4, least: Vec4, most: Vec4) -> Vec4 {
    vec4(
        kept_within(found.x, least.x, most.x),
        kept_within(found.y, least.y, most.y),
        kept_within(found.z, least.z, most.z),
        kept_within(found.w, least.w, most.w),
    )
}

fn kept_within(found: f32, least: f32, most: f32) -> f32 {
    if found < least {
        least
    } else if found > most {
        most
    } else {
        found
    }
}

impl Sraa {
    /// Returns whether some samples have a negative weight.
    pub(super) fn has_lobes(&self) -> bool {
        match self.resolve {
            Resolve::Mitchell | Resolve::Lanczos => true,
            Resolve::Box | Resolve::Tent | Resolve::Gaussian => false,
        }
    }
}
