//! The mask: pixels that keep their own colour, because neither geometry nor shading varies there (paper §3.3).

use super::colors::{color, is_kept, own_color};
use super::history::own_tap;
use super::options::{Mask, Sraa, Variation};
use super::placed::shaded_place;
use super::{Inputs, difference, falloff, filtered, geometry_sample, least};
use crate::prelude::*;

/// Filters the pixel, or keeps its own colour where there is no geometric variation.
pub(super) fn masked<const TAPS: usize, const SIDE: usize>(cfg: &Sraa, inputs: &Inputs) -> Vec4 {
    match cfg.mask {
        Mask::None => filtered::<TAPS, SIDE>(cfg, inputs),
        Mask::Select => {
            let own = own_color(cfg, inputs);
            let around = neighbours(cfg, inputs, own);
            if is_even::<TAPS, SIDE>(cfg, inputs) && around.step <= cfg.mask_step && is_kept(cfg, own) {
                around.color
            } else {
                filtered::<TAPS, SIDE>(cfg, inputs)
            }
        }
        Mask::Branch => {
            let own = own_color(cfg, inputs);
            let around = neighbours_one_by_one(cfg, inputs, own);
            #[cfg_attr(false, branch)]
            if is_even::<TAPS, SIDE>(cfg, inputs) && around.step <= cfg.mask_step && is_kept(cfg, own) {
                around.color
            } else {
                filtered::<TAPS, SIDE>(cfg, inputs)
            }
        }
    }
}

/// Returns whether all surfaces that the mask compares are equal to those of their samples.
fn is_even<const TAPS: usize, const SIDE: usize>(cfg: &Sraa, inputs: &Inputs) -> bool {
    let largest = match cfg.variation {
        Variation::Around => variation_around::<TAPS, SIDE>(cfg, inputs),
        // Unrolled, all surfaces would stay in registers for the filter after the branch.
        Variation::Within if cfg.mask == Mask::Branch && cfg.samples() > 8 => variation_one_by_one(cfg, inputs),
        Variation::Within => variation_within(cfg, inputs),
    };
    largest <= cfg.mask_threshold
}

/// Largest difference between a geometry sample and a tap.
fn variation_around<const TAPS: usize, const SIDE: usize>(cfg: &Sraa, inputs: &Inputs) -> f32 {
    let mut largest = 0.0f32;
    for sample in 0..cfg.reconstructed() {
        if cfg.share(sample) != 0.0 {
            let place = cfg.place(sample);
            let centre = geometry_sample(cfg, inputs, place);
            for tap in 0..TAPS {
                let at = own_tap(cfg, inputs, tap, SIDE);
                if falloff(cfg, place, at) > least(cfg) {
                    largest = largest.max(difference(cfg, inputs, place, &centre, at));
                }
            }
        }
    }
    largest
}

/// Largest difference between the pixel's own geometry samples and its shading samples.
fn variation_within(cfg: &Sraa, inputs: &Inputs) -> f32 {
    let mut largest = 0.0f32;
    for sample in 0..cfg.samples() {
        let place = cfg.geometry_sample(IVec2::ZERO, sample);
        let seen = geometry_sample(cfg, inputs, place);
        for tap in 0..cfg.shading_samples() {
            largest = largest.max(difference(cfg, inputs, place, &seen, own_tap(cfg, inputs, tap, 1)));
        }
    }
    largest
}

/// [`variation_within`] in a loop.
#[cfg_attr(false, unroll(none))]
fn variation_one_by_one(cfg: &Sraa, inputs: &Inputs) -> f32 {
    variation_within(cfg, inputs)
}

/// Multiple of `mask_threshold` up to which a neighbour shows the same surface. A surface that curves evenly differs by the square
/// of the distance: where it stays within the threshold at a sample 3/8 of a pixel away, a neighbour differs by up to 64/9 of it.
const CURVED: f32 = 8.0;

/// Weight of each neighbour in a kept pixel: the second moment of their mean is then that of the pixel's own area.
const AREA: f32 = 1.0 / 24.0;

/// Shading of a pixel and of its four neighbours on its own surface.
struct Around {
    /// Largest step between the pixel's colour and that of a neighbour.
    step: f32,
    /// Mean over the pixel's own area.
    color: Vec4,
}

/// Compares a pixel's colour with its neighbours, and blends it with theirs. With `mask_step` of 1, colours are not compared, and
/// the pixel's remains as it is.
fn neighbours(cfg: &Sraa, inputs: &Inputs, mean: Vec4) -> Around {
    let mut largest = 0.0f32;
    let mut rest = 1.0;
    let mut others = Vec4::ZERO;
    if cfg.mask_step < 1.0 {
        let several = cfg.shading_samples();
        let centre = own_tap(cfg, inputs, 4 * several, 3);
        let place = shaded_place(cfg, &inputs.colors.place, inputs.pixel, centre);
        let seen = geometry_sample(cfg, inputs, place);
        let own = color(cfg, inputs, 4 * several, 3);
        for k in 0..4 {
            let tap = (2 * k + 1) * several;
            let there = color(cfg, inputs, tap, 3);
            let at = own_tap(cfg, inputs, tap, 3);
            if difference(cfg, inputs, place, &seen, at) <= CURVED * cfg.mask_threshold {
                largest = largest.max(step(own, there));
                if is_kept(cfg, there) {
                    rest -= AREA;
                    others += AREA * there;
                }
            }
        }
        Around {
            step: largest,
            color: rest * mean + others,
        }
    } else {
        Around {
            step: largest,
            color: mean,
        }
    }
}

/// [`neighbours`] in a loop: unrolled, their colours and surfaces would stay in registers for the filter after the branch.
#[cfg_attr(false, unroll(none))]
fn neighbours_one_by_one(cfg: &Sraa, inputs: &Inputs, mean: Vec4) -> Around {
    neighbours(cfg, inputs, mean)
}

/// Largest difference of two colours in a channel, as a display shows them.
fn step(a: Vec4, b: Vec4) -> f32 {
    let red = (displayed(a.x) - displayed(b.x)).abs();
    let green = (displayed(a.y) - displayed(b.y)).abs();
    let blue = (displayed(a.z) - displayed(b.z)).abs();
    red.max(green).max(blue)
}

/// Channel at a gamma of 2, from -1 to 1; NaN becomes 1.
fn displayed(channel: f32) -> f32 {
    let bright = if channel.abs() < 1.0 { channel.abs() } else { 1.0 };
    if channel < 0.0 { -bright.sqrt() } else { bright.sqrt() }
}
