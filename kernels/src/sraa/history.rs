//! Shading samples of earlier frames as further taps: weighed by surface and by distance as those of this frame are.
//!
//! An image of motion says where in an earlier frame the surface of a pixel was. The shading samples around that place come along with
//! it: each is a tap at a place of its own near the pixel, with the surface that was seen there and its colour. If frames are shaded
//! at different places of their pixels, together they have seen what supersampling would. A tap whose surface is not the sample's weighs
//! nothing, so that what was hidden, or has moved away, leaves no trace.

use super::demodulate::{Demodulate, Paint};
use super::gbuffer::{DEEPEST, Depth, Normals, Surface};
use super::metric::{FAR, Metric, Sample, distance};
use super::options::{Guards, Mask, Normalisation, Resolve, Sraa};
use super::pattern::{Place, Shading};
use super::search::Sum;
use super::{Inputs, falloff, steepness};
use crate::prelude::*;

/// Frames gone by, of as many layers as the option `history` says, in any order. Where nothing is known, as outside the picture, a
/// layer's motion may be not a number: then nothing is taken of it.
pub struct History {
    /// Colours of the shading samples of each frame, one a pixel, as `color` has them; of demodulate=albedo light: what is left of the
    /// colour without `rest`, divided by an albedo of at least `albedo_floor`.
    pub history_color: FrameLayers<Vec4>,
    /// Of demodulate with rest=true: `rest` of each frame.
    pub history_rest: FrameLayers<Vec4>,
    /// What was seen where each was shaded: the unit normal, and in the fourth component linear depth, infinite where there is no
    /// geometry.
    pub history_surface: FrameLayers<Vec4>,
    /// Where what a pixel shows at its shading sample lay in the raster of the earlier frame, in which pixels have their centres where
    /// they were shaded, less where it lies now, in the raster without `jitter`: in pixels, y down. In the third component by how
    /// much linear depth was more than now. Of a camera that stands still, the `jitter` of the earlier frame with the opposite sign.
    pub history_motion: FrameLayers<Vec4>,
    /// Where in its pixel this frame is shaded, from the centre, in pixels, y down; each axis in -0.5..=0.5. Its geometry there is that
    /// of the centre.
    pub jitter: Vec2,
}

impl History {
    /// No frames: single texels of zero, to be replaced by what the option needs.
    pub fn unread() -> History {
        let layers = || FrameLayers::new(vec![Frame::new(UVec2::ONE, vec![Vec4::ZERO])]);
        History {
            history_color: layers(),
            history_rest: layers(),
            history_surface: layers(),
            history_motion: layers(),
            jitter: Vec2::ZERO,
        }
    }
}

/// What this frame's most similar tap weighs at least, as a binary logarithm: less than any tap of the sample's own surface, and more
/// than any of another's.
const FAINTEST: f32 = -40.0;

/// No surface moves farther between frames, in pixels.
const FARTHEST: f32 = 16384.0;

/// How much the differences of this frame's taps are shifted by before they are weighed, of which `nearest` is the smallest: with
/// earlier frames only so far that some tap counts where nobody has seen the surface.
pub(super) fn shift(cfg: &Sraa, nearest: f32) -> f32 {
    if cfg.history == 0 {
        nearest
    } else {
        (nearest + FAINTEST / steepness(cfg).max(1.0e-3)).max(0.0)
    }
}

/// Where tap `tap` of this frame is shaded, of a square of `side` × `side` pixels.
pub(super) fn own_tap(cfg: &Sraa, inputs: &Inputs, tap: usize, side: usize) -> Place {
    let tap = cfg.tap(tap, side);
    if cfg.history == 0 {
        tap
    } else {
        Place {
            at: tap.at + inputs.history.jitter,
            ..tap
        }
    }
}

/// What earlier frames give a geometry sample.
pub(super) struct Past {
    /// Of the colours of their shading samples.
    pub(super) sum: Sum,
    /// Difference of the most similar one within reach.
    pub(super) nearest: f32,
}

/// The shading samples of earlier frames for a geometry sample with a paint of its `own`.
pub(super) fn remembered(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, own: &Paint) -> Past {
    let mut past = Past {
        sum: Sum::NOTHING,
        nearest: FAR,
    };
    for frame in 0..cfg.history as usize {
        for k in 0..SIDE * SIDE {
            let tap = earlier_tap(cfg, inputs, place, frame, k, SIDE);
            // Normals that are not of length 1 may be nearer than the same: nothing weighs more than 1.
            let apart = distance(cfg, centre, &tap.seen, tap.place.at).max(0.0);
            let near = falloff(cfg, place, tap.place);
            let w = near * (-steepness(cfg) * apart).exp2();
            let w = if tap.is_there { w } else { 0.0 };
            past.sum.add(cfg, remembered_color(cfg, inputs, own, &tap, frame), w);
            if tap.is_there && near > 0.0 {
                past.nearest = past.nearest.min(apart);
            }
        }
    }
    past
}

/// A shading sample of an earlier frame.
pub(super) struct Earlier {
    /// Its pixel then.
    there: IVec2,
    /// Where it is now.
    pub(super) place: Place,
    /// What it shows.
    pub(super) seen: Surface,
    /// Whether there is one.
    pub(super) is_there: bool,
}

/// Shading sample `k` of the `side` × `side` ones around where the pixel's surface was in an earlier frame.
pub(super) fn earlier_tap(cfg: &Sraa, inputs: &Inputs, place: Place, frame: usize, k: usize, side: usize) -> Earlier {
    let moved = inputs.history.history_motion.load(inputs.pixel, frame);
    let known = moved.x.abs() < FARTHEST && moved.y.abs() < FARTHEST;
    let motion = if known { moved.xy() } else { Vec2::ZERO };
    // The shading sample to the upper left of where the surface was, or as many farther as the square needs.
    let first = motion.floor();
    let aside = 1 - (side / 2) as i32;
    let step = ivec2((k % side) as i32 + aside, (k / side) as i32 + aside);
    let there = inputs.pixel + first.as_ivec2() + step;
    let inside = is_inside(there, inputs.history.history_color.size().as_ivec2());
    Earlier {
        there,
        place: Place {
            at: first - motion + step.as_vec2(),
            ..place
        },
        seen: seen(cfg, inputs, inputs.history.history_surface.load(there, frame), moved.z),
        is_there: known && inside,
    }
}

/// The colour of a shading sample of an earlier frame, on the paint of a geometry sample.
pub(super) fn remembered_color(cfg: &Sraa, inputs: &Inputs, own: &Paint, tap: &Earlier, frame: usize) -> Vec4 {
    let color = inputs.history.history_color.load(tap.there, frame);
    match cfg.demodulate {
        Demodulate::None => color,
        Demodulate::Albedo | Demodulate::AlbedoShadow => {
            let painted = own.albedo * color.xyz();
            if cfg.rest {
                (painted + inputs.history.history_rest.load(tap.there, frame).xyz()).extend(color.w)
            } else {
                painted.extend(color.w)
            }
        }
    }
}

/// Shading samples of a frame on each axis: those around the pixel.
const SIDE: usize = 2;

fn is_inside(pixel: IVec2, size: IVec2) -> bool {
    pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y
}

/// The surface in a texel of an earlier frame, as it is compared with those of this one; `deeper` is by how much it was deeper then.
fn seen(cfg: &Sraa, inputs: &Inputs, texel: Vec4, deeper: f32) -> Surface {
    let depth = match cfg.depth {
        Depth::Linear | Depth::ReversedInfinite => texel.w - deeper,
        // The sky, infinite there, is as deep as the far plane in this frame.
        Depth::Perspective | Depth::Reversed => nearer(cfg, texel.w - deeper, inputs.view.far),
    };
    Surface {
        depth: match cfg.guards {
            Guards::Fallback | Guards::None => depth.min(DEEPEST),
            Guards::Inline => {
                if depth.abs() < DEEPEST {
                    depth
                } else {
                    DEEPEST
                }
            }
        },
        normal: match (cfg.normals, cfg.metric) {
            (Normals::Unorm, Metric::DepthNormals | Metric::Normals) if !cfg.renormalise => 0.5 * texel.xyz() + 0.5,
            _ => texel.xyz(),
        },
    }
}

/// The smaller of the two; if the first is not a number, the second.
fn nearer(cfg: &Sraa, depth: f32, far: f32) -> f32 {
    match cfg.guards {
        Guards::Fallback | Guards::None => depth.min(far),
        Guards::Inline => {
            if depth < far {
                depth
            } else {
                far
            }
        }
    }
}

impl Sraa {
    /// Refuses what earlier frames have no part in.
    pub(super) fn check_history(&self) {
        if self.history != 0 {
            assert!(
                self.shading == Shading::Centre || self.shading == Shading::Placed,
                "history takes frames that are shaded once a pixel, at one place of every pixel, which the uniform `jitter` says, or \
                 where `place` does: set shading=centre or shading=placed"
            );
            assert!(
                self.shading == Shading::Centre || self.metric != Metric::PlanesNormals,
                "where in its pixel an earlier frame was shaded that is placed, nothing says, and planes need it: set \
                 metric=depth-normals or shading=centre"
            );
            assert!(
                self.normalisation == Normalisation::Shifted && self.resolve == Resolve::Box,
                "history needs normalisation=shifted and resolve=box"
            );
            assert!(
                self.demodulate != Demodulate::AlbedoShadow,
                "history keeps no direct light of earlier frames apart: set demodulate=albedo or demodulate=none"
            );
            assert!(
                self.mask == Mask::None,
                "history adds taps to the filter, and mask leaves pixels out of it: set mask=none"
            );
        }
    }
}
