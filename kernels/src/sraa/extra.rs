//! Extra shading for a few pixels, at a geometry sample whose surface no shading sample around it shows.

use super::Inputs;
use super::gbuffer::{GBuffer, surface};
use super::metric::{FAR, Sample, distance};
use super::options::{Normalisation, Resolve, Sraa};
use super::pattern::{Place, Shading, neighbour};
use super::placed::shaded_place;
use super::view::View;
use crate::prelude::*;

/// Inputs of the kernel.
struct Seen<'a> {
    gbuffer: &'a GBuffer,
    view: &'a View,
    /// Read with shading=placed only.
    place: &'a Frame<u32>,
    pixel: IVec2,
}

/// Extra shading sample of `pixel`: the index of a geometry sample, or the number of samples if there is none. The output is the
/// image `extra` of the filter.
///
/// A pixel is listed with its first sample that differs by more than `search_threshold` from all shading samples of the nine
/// pixels around it. Where x + y is odd, the samples requested by neighbours with an even sum count as shaded, so that no surface
/// is shaded twice. Beyond the border the nearest pixel is repeated.
///
/// `extra_list` holds for each listed pixel its coordinates, as x + 65536 y, and the index of its sample. Its length is the
/// budget: pixels beyond it are not listed. If it is too short, the order of the pixels determines which ones are listed.
/// `extra_counts` are four numbers, initially 0, 1, 1, 0: the number of workgroups of 64 to dispatch for the list in x, y and z,
/// then the number of pixels that requested a sample.
pub fn sraa_extra(
    cfg: &Sraa,
    gbuffer: &GBuffer,
    view: &View,
    place: &Frame<u32>,
    extra_counts: &AtomicBuffer<u32>,
    extra_list: &StorageBuffer<UVec2>,
    pixel: IVec2,
) -> u32 {
    cfg.check();
    cfg.check_shaded_once();
    let seen = Seen {
        gbuffer,
        view,
        place,
        pixel,
    };
    let mut given = cfg.samples();
    #[cfg_attr(false, branch)]
    if differs(cfg, &seen) {
        let wanted = wanted(cfg, &seen);
        if wanted < cfg.samples() {
            let entry = extra_counts.add(3, 1);
            if entry < extra_list.len() as u32 {
                let at = pixel.as_uvec2();
                extra_list.store(entry as usize, uvec2(at.x + 65536 * at.y, wanted as u32));
                if entry.is_multiple_of(64) {
                    extra_counts.add(0, 1);
                }
                given = wanted;
            }
        }
    }
    given as u32
}

/// Returns whether any geometry sample of the pixel differs from its own shading sample.
fn differs(cfg: &Sraa, seen: &Seen) -> bool {
    let own = shading_sample(cfg, seen, IVec2::ZERO);
    let mut largest = 0.0f32;
    for sample in 0..cfg.samples() {
        let at = cfg.geometry_sample(IVec2::ZERO, sample);
        largest = largest.max(apart(cfg, seen, &sampled(cfg, seen, at), own));
    }
    largest > cfg.search_threshold
}

/// Sample that the pixel requests, or the number of samples. Few pixels reach this, so its loops are left in the shader.
#[cfg_attr(false, unroll(none))]
fn wanted(cfg: &Sraa, seen: &Seen) -> usize {
    let first = first_hidden(cfg, seen, IVec2::ZERO);
    let even = (seen.pixel.x + seen.pixel.y) & 1 == 0;
    if even || first == cfg.samples() {
        return first;
    }
    // Samples requested by the four adjacent pixels, whose x + y are even.
    let mut beside = [0; 4];
    for k in 0..4 {
        beside[k] = first_hidden(cfg, seen, neighbour(2 * k + 1, 3));
    }
    for sample in 0..cfg.samples() {
        let at = cfg.geometry_sample(IVec2::ZERO, sample);
        if is_unseen(cfg, seen, at) && !is_beside(cfg, seen, &sampled(cfg, seen, at), &beside) {
            return sample;
        }
    }
    cfg.samples()
}

/// Returns whether one of the four adjacent pixels requests the surface of `sample`.
fn is_beside(cfg: &Sraa, seen: &Seen, sample: &Sample, wanted: &[usize; 4]) -> bool {
    let mut beside = false;
    for k in 0..4 {
        let pixel = neighbour(2 * k + 1, 3);
        let there = cfg.geometry_sample(pixel, cfg.own(wanted[k]));
        if wanted[k] < cfg.samples() && apart(cfg, seen, sample, there) <= cfg.search_threshold {
            beside = true;
        }
    }
    beside
}

/// Index of the pixel's first geometry sample whose surface no shading sample around it shows, or the number of
/// samples.
fn first_hidden(cfg: &Sraa, seen: &Seen, pixel: IVec2) -> usize {
    for sample in 0..cfg.samples() {
        if is_unseen(cfg, seen, cfg.geometry_sample(pixel, sample)) {
            return sample;
        }
    }
    cfg.samples()
}

/// Returns whether a geometry sample's surface is missing from the shading samples of the nine pixels around it.
fn is_unseen(cfg: &Sraa, seen: &Seen, at: Place) -> bool {
    let sample = sampled(cfg, seen, at);
    let mut nearest = FAR;
    for k in 0..9 {
        let tap = shading_sample(cfg, seen, at.pixel + neighbour(k, 3));
        nearest = nearest.min(apart(cfg, seen, &sample, tap));
    }
    nearest > cfg.search_threshold
}

/// Position of the shading sample of the pixel at `pixel`.
fn shading_sample(cfg: &Sraa, seen: &Seen, pixel: IVec2) -> Place {
    let tap = match cfg.shading {
        Shading::Centre | Shading::Placed => cfg.centre(pixel),
        Shading::Sample0 | Shading::Listed => cfg.geometry_sample(pixel, cfg.shaded_sample(0)),
    };
    shaded_place(cfg, seen.place, seen.pixel, tap)
}

/// Surface at a geometry sample.
fn sampled(cfg: &Sraa, seen: &Seen, at: Place) -> Sample {
    let surface = surface(cfg, seen.gbuffer, seen.view, seen.pixel, at);
    Sample::new(cfg, seen.view, surface, seen.pixel, at.at)
}

/// Difference between the surface at a tap and that of a sample.
fn apart(cfg: &Sraa, seen: &Seen, sample: &Sample, tap: Place) -> f32 {
    distance(
        cfg,
        sample,
        &surface(cfg, seen.gbuffer, seen.view, seen.pixel, tap),
        tap.at,
    )
}

/// Extra shading sample of a pixel.
pub(super) struct Further {
    pub(super) place: Place,
    /// `true` if the pixel has one.
    pub(super) is_there: bool,
}

/// Extra shading sample of the pixel at `pixel`.
pub(super) fn extra_tap(cfg: &Sraa, inputs: &Inputs, pixel: IVec2) -> Further {
    let samples = cfg.samples() as u32;
    let sample = inputs.colors.extra.load(inputs.pixel + pixel);
    Further {
        place: Place {
            extra: true,
            ..cfg.geometry_sample(pixel, sample.min(samples - 1) as usize)
        },
        is_there: sample < samples,
    }
}

impl Sraa {
    /// Panics if the options do not permit extra shading samples.
    pub(super) fn check_extra(&self) {
        if self.extra {
            self.check_shaded_once();
            assert!(
                self.resolve == Resolve::Box && self.normalisation == Normalisation::Shifted,
                "extra needs resolve=box and normalisation=shifted"
            );
        }
    }

    fn check_shaded_once(&self) {
        assert!(
            self.samples() <= 32,
            "extra needs a pattern of 32 samples at most: a bit for each says which are unseen"
        );
        assert!(
            self.shading_samples() == 1,
            "further shading samples are of a picture that is shaded once a pixel: set shading=centre, sample0 or placed"
        );
    }
}
