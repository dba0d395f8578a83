//! Shading placed by geometry: still one sample a pixel, but not always at its centre.

use super::gbuffer::{GBuffer, surface};
use super::metric::{FAR, Sample, distance};
use super::options::Sraa;
use super::pattern::{Place, Shading, neighbour};
use super::view::View;
use crate::prelude::*;

/// Shading sample of `pixel`: the index of a geometry sample, or the number of samples for the pixel's centre.
///
/// A surface that appears at some geometry sample but at no pixel centre around it has no colour for the filter to borrow. The
/// pixel is then shaded at that sample. The surface at its centre must also be at the centre of a neighbour that does not move.
/// Of a pixel and its four neighbours only one may move: the one whose x and y have an even sum.
pub fn sraa_place(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2) -> u32 {
    cfg.check();
    let own = centre(cfg, gbuffer, view, pixel, IVec2::ZERO);
    #[cfg_attr(false, branch)]
    let place = if (pixel.x + pixel.y) & 1 == 0 && varies(cfg, gbuffer, view, pixel, &own) {
        first_unseen(cfg, gbuffer, view, pixel, &own)
    } else {
        cfg.samples()
    };
    place as u32
}

/// Returns whether any geometry sample of the pixel is on a different surface than its centre.
fn varies(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, own: &Sample) -> bool {
    let mut largest = 0.0f32;
    for sample in 0..cfg.samples() {
        let place = cfg.geometry_sample(IVec2::ZERO, sample);
        let seen = surface(cfg, gbuffer, view, pixel, place);
        largest = largest.max(distance(cfg, own, &seen, place.at));
    }
    largest > cfg.unseen
}

/// The first geometry sample whose surface is at no centre around, if the pixel may be shaded there; else its centre. Few
/// pixels reach this, with four samples as with sixteen, so its loops are left in the shader.
#[cfg_attr(false, unroll(none))]
fn first_unseen(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, own: &Sample) -> usize {
    let mut nearest = FAR;
    for k in 0..4 {
        let at = neighbour(2 * k + 1, 3);
        nearest = nearest.min(from_centre(cfg, gbuffer, view, pixel, own, at));
    }
    if nearest > cfg.unseen {
        return cfg.samples();
    }
    for sample in 0..cfg.samples() {
        let place = cfg.geometry_sample(IVec2::ZERO, sample);
        let seen = surface(cfg, gbuffer, view, pixel, place);
        let sampled = Sample::new(cfg, view, seen, pixel, place.at);
        let mut nearest = FAR;
        for k in 0..9 {
            nearest = nearest.min(from_centre(cfg, gbuffer, view, pixel, &sampled, neighbour(k, 3)));
        }
        if nearest > cfg.unseen {
            return sample;
        }
    }
    cfg.samples()
}

/// Difference between the surface at the centre of the pixel at `at` and that of a sample.
fn from_centre(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, sample: &Sample, at: IVec2) -> f32 {
    let place = cfg.centre(at);
    distance(cfg, sample, &surface(cfg, gbuffer, view, pixel, place), place.at)
}

/// Surface at the centre of the pixel at `at`.
fn centre(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, at: IVec2) -> Sample {
    let place = cfg.centre(at);
    Sample::new(cfg, view, surface(cfg, gbuffer, view, pixel, place), pixel, place.at)
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
