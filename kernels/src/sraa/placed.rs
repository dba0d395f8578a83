//! Shading placed by geometry: still one sample a pixel, but not always at its centre.

use super::gbuffer::{GBuffer, surface};
use super::history::{History, jittered};
use super::metric::{FAR, Sample, distance};
use super::options::Sraa;
use super::pattern::{Place, Shading, neighbour};
use super::view::View;
use crate::prelude::*;

/// Inputs of the placement at a pixel.
struct Placing<'a> {
    gbuffer: &'a GBuffer,
    view: &'a View,
    history: &'a History,
    pixel: IVec2,
}

/// Shading sample of `pixel`: the index of a geometry sample, or the number of samples for the pixel's centre.
///
/// A surface that appears at some geometry sample but at no pixel centre around it has no colour for the filter to borrow. The
/// pixel is then shaded at that sample. The surface at its centre must also be at the centre of a neighbour that does not move.
/// Of a pixel and its four neighbours only one may move: the one whose x and y have an even sum. With earlier frames, a pixel's
/// centre is where this frame shades it, `jitter` aside.
pub fn sraa_place(cfg: &Sraa, gbuffer: &GBuffer, view: &View, history: &History, pixel: IVec2) -> u32 {
    cfg.check();
    let inputs = Placing {
        gbuffer,
        view,
        history,
        pixel,
    };
    let own = centre(cfg, &inputs, IVec2::ZERO);
    #[cfg_attr(false, branch)]
    let place = if (pixel.x + pixel.y) & 1 == 0 && varies(cfg, &inputs, &own) {
        first_unseen(cfg, &inputs, &own)
    } else {
        cfg.samples()
    };
    place as u32
}

/// Returns whether any geometry sample of the pixel is on a different surface than its centre.
fn varies(cfg: &Sraa, inputs: &Placing, own: &Sample) -> bool {
    let mut largest = 0.0f32;
    for sample in 0..cfg.samples() {
        let place = cfg.geometry_sample(IVec2::ZERO, sample);
        let seen = surface(cfg, inputs.gbuffer, inputs.view, inputs.pixel, place);
        largest = largest.max(distance(cfg, own, &seen, place.at));
    }
    largest > cfg.unseen
}

/// The first geometry sample whose surface is at no centre around, if the pixel may be shaded there; else its centre. Few
/// pixels reach this, with four samples as with sixteen, so its loops are left in the shader.
#[cfg_attr(false, unroll(none))]
fn first_unseen(cfg: &Sraa, inputs: &Placing, own: &Sample) -> usize {
    let mut nearest = FAR;
    for k in 0..4 {
        let at = neighbour(2 * k + 1, 3);
        nearest = nearest.min(from_centre(cfg, inputs, own, at));
    }
    if nearest > cfg.unseen {
        return cfg.samples();
    }
    for sample in 0..cfg.samples() {
        let place = cfg.geometry_sample(IVec2::ZERO, sample);
        let sampled = sample_at(cfg, inputs, place);
        let mut nearest = FAR;
        for k in 0..9 {
            nearest = nearest.min(from_centre(cfg, inputs, &sampled, neighbour(k, 3)));
        }
        if nearest > cfg.unseen {
            return sample;
        }
    }
    cfg.samples()
}

/// Difference between the surface at the centre of the pixel at `at` and that of a sample.
fn from_centre(cfg: &Sraa, inputs: &Placing, sample: &Sample, at: IVec2) -> f32 {
    let place = jittered(cfg, inputs.history, cfg.centre(at));
    let seen = surface(cfg, inputs.gbuffer, inputs.view, inputs.pixel, place);
    distance(cfg, sample, &seen, place.at)
}

/// Surface at the centre of the pixel at `at`.
fn centre(cfg: &Sraa, inputs: &Placing, at: IVec2) -> Sample {
    sample_at(cfg, inputs, jittered(cfg, inputs.history, cfg.centre(at)))
}

/// Surface at a position.
fn sample_at(cfg: &Sraa, inputs: &Placing, place: Place) -> Sample {
    let seen = surface(cfg, inputs.gbuffer, inputs.view, inputs.pixel, place);
    Sample::new(cfg, inputs.view, seen, inputs.pixel, place.at)
}

/// Position of the shading sample `tap`: from the image, if it moves the sample. The distance for its weight remains that of the
/// pixel's centre, so that moved samples reach as far as the others.
pub(super) fn shaded_place(cfg: &Sraa, place: &Frame<u32>, pixel: IVec2, tap: Place) -> Place {
    match cfg.shading {
        Shading::Placed if !tap.extra => {
            let samples = cfg.samples();
            let sample = place.load(pixel + tap.pixel).min(samples as u32) as usize;
            let centre = sample == samples;
            Place {
                pixel: tap.pixel,
                sample,
                centre,
                extra: false,
                at: if centre {
                    tap.at
                } else {
                    tap.pixel.as_vec2() + cfg.offset(sample)
                },
            }
        }
        Shading::Sample0 | Shading::Centre | Shading::Listed | Shading::Placed => tap,
    }
}
