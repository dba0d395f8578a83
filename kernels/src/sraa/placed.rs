//! Shading where geometry asks for it: one sample a pixel still, but not always at its centre.

use super::gbuffer::{GBuffer, surface};
use super::metric::{FAR, Sample, distance};
use super::options::Sraa;
use super::pattern::{Place, Shading, neighbour};
use super::view::View;
use crate::prelude::*;

/// Where `pixel` is to be shaded: the number of a geometry sample, or the number of samples for the pixel's centre.
///
/// A surface that lies at some geometry sample but at no pixel's centre around it has no colour that a filter could borrow.
/// There the pixel is shaded at that sample. Its centre's surface must lie at the centre of a neighbour that stays, and of a
/// pixel and its four neighbours only one may move: those whose x and y have an even sum.
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

/// Whether a geometry sample of the pixel lies on another surface than its centre.
fn varies(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, own: &Sample) -> bool {
    let mut largest = 0.0f32;
    for sample in 0..cfg.samples() {
        let place = cfg.geometry_sample(IVec2::ZERO, sample);
        let seen = surface(cfg, gbuffer, view, pixel, place);
        largest = largest.max(distance(cfg, own, &seen, place.at));
    }
    largest > cfg.unseen
}

/// The first geometry sample whose surface lies at no centre around, if the pixel may be shaded there; else its centre. Few
/// pixels come here, and one of four samples as well as one of sixteen: its loops stay loops.
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

/// How different the surface at the centre of the pixel at `at` is from a sample's.
fn from_centre(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, sample: &Sample, at: IVec2) -> f32 {
    let place = cfg.centre(at);
    distance(cfg, sample, &surface(cfg, gbuffer, view, pixel, place), place.at)
}

/// What is seen at the centre of the pixel at `at`.
fn centre(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, at: IVec2) -> Sample {
    let place = cfg.centre(at);
    Sample::new(cfg, view, surface(cfg, gbuffer, view, pixel, place), pixel, place.at)
}

/// Where the shading sample `tap` lies: where the image says, if it does. Its weight by distance is that of its pixel's centre
/// all the same: those that are moved are to reach as far as the others.
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
