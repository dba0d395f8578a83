//! Shading samples of earlier frames as additional taps, weighted by surface and by distance like those of this frame.
//!
//! A motion image states the earlier position of each pixel's surface. The shading samples around that position are carried
//! along: each is a tap at its own position near the pixel, with the surface that it showed and its colour. If frames are
//! shaded at different positions in their pixels, together they approach supersampling. A tap on another surface than the
//! sample's has no weight, so that surfaces that were hidden, or have moved away, leave no trace.

use super::demodulate::{Demodulate, Paint};
use super::gbuffer::{DEEPEST, Depth, Normals, Surface};
use super::metric::{FAR, Metric, Sample, distance};
use super::options::{Guards, Normalisation, Resolve, Sraa};
use super::pattern::{Place, Shading};
use super::search::Sum;
use super::{Inputs, falloff, steepness};
use crate::prelude::*;

/// Earlier frames: as many layers as the option `history`, in any order. Where nothing is known, such as outside of the picture,
/// a layer's motion may be NaN; the layer is then ignored.
pub struct History {
    /// Colours of the shading samples of each frame, one a pixel, encoded like `color`. With demodulate=albedo: light, which
    /// is the colour without `rest`, divided by an albedo of at least `albedo_floor`.
    pub history_color: FrameLayers<Vec4>,
    /// With demodulate and rest=true: `rest` of each frame.
    pub history_rest: FrameLayers<Vec4>,
    /// Surface at each shading sample: the unit normal, and in the fourth component linear depth, infinite where there is no
    /// geometry.
    pub history_surface: FrameLayers<Vec4>,
    /// Position, in the earlier frame's raster, of the surface at each pixel's shading sample, minus its current position,
    /// in pixels, y down. The earlier raster has its pixel centres at the shading samples; the current one excludes `jitter`.
    /// The third component is by how much larger linear depth was. For a static camera: the earlier frame's `jitter`, negated.
    pub history_motion: FrameLayers<Vec4>,
    /// With shading=placed and metric=planes-normals: in x and y, position of each shading sample from where its frame shades
    /// pixels that `place` does not move, in pixels, y down; 0 for those pixels.
    pub history_place: FrameLayers<Vec4>,
    /// Position of this frame's shading samples from the pixel centre, in pixels, y down; each axis in -0.5..=0.5. The geometry
    /// there is that of the centre.
    pub jitter: Vec2,
}

impl History {
    /// No frames: single texels of zero, to be replaced by the inputs that the option needs.
    pub fn unread() -> History {
        let layers = || FrameLayers::new(vec![Frame::new(UVec2::ONE, vec![Vec4::ZERO])]);
        History {
            history_color: layers(),
            history_rest: layers(),
            history_surface: layers(),
            history_motion: layers(),
            history_place: layers(),
            jitter: Vec2::ZERO,
        }
    }
}

/// Lower bound on the weight of this frame's most similar tap, as a binary logarithm: smaller than the weight of any tap on the
/// sample's own surface, and larger than that of any tap on another.
const FAINTEST: f32 = -40.0;

/// Upper bound on a surface's motion between frames, in pixels.
const FARTHEST: f32 = 16384.0;

/// Shift of the differences of this frame's taps before they are weighted. `nearest` is the smallest difference. With earlier
/// frames, the shift is only as large as needed for some tap to count where no frame has shown the surface.
pub(super) fn shift(cfg: &Sraa, nearest: f32) -> f32 {
    if cfg.history == 0 {
        nearest
    } else {
        (nearest + FAINTEST / steepness(cfg).max(1.0e-3)).max(0.0)
    }
}

/// Position of tap `tap` of this frame, in a square of `side` × `side` pixels.
pub(super) fn own_tap(cfg: &Sraa, inputs: &Inputs, tap: usize, side: usize) -> Place {
    jittered(cfg, inputs.history, cfg.tap(tap, side))
}

/// Position of a shading sample that geometry does not move. With earlier frames, it is `jitter` aside.
pub(super) fn jittered(cfg: &Sraa, history: &History, place: Place) -> Place {
    if cfg.history == 0 {
        place
    } else {
        Place {
            at: place.at + history.jitter,
            ..place
        }
    }
}

/// Contribution of earlier frames to a geometry sample.
pub(super) struct Past {
    /// Sum of the colours of their shading samples.
    pub(super) sum: Sum,
    /// Difference of the most similar shading sample within reach.
    pub(super) nearest: f32,
}

/// Sums the shading samples of earlier frames for a geometry sample with the paint `own`.
pub(super) fn remembered(cfg: &Sraa, inputs: &Inputs, place: Place, centre: &Sample, own: &Paint) -> Past {
    let mut past = Past {
        sum: Sum::NOTHING,
        nearest: FAR,
    };
    for frame in 0..cfg.history as usize {
        for k in 0..SIDE * SIDE {
            let tap = earlier_tap(cfg, inputs, place, frame, k, SIDE);
            // Normals that are not of length 1 can yield a negative difference. No tap may weigh more than 1.
            let apart = distance(cfg, centre, &tap.seen, tap.seen_at).max(0.0);
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
    /// Pixel in the earlier frame.
    there: IVec2,
    /// Position in this frame, for its weight by distance: that of a sample that geometry does not move.
    pub(super) place: Place,
    /// Surface at the sample.
    pub(super) seen: Surface,
    /// Position of that surface, from the centre of the pixel.
    pub(super) seen_at: Vec2,
    /// `true` if there is such a sample.
    pub(super) is_there: bool,
}

/// Shading sample `k` of the `side` × `side` ones around the earlier position of the pixel's surface.
pub(super) fn earlier_tap(cfg: &Sraa, inputs: &Inputs, place: Place, frame: usize, k: usize, side: usize) -> Earlier {
    let moved = inputs.history.history_motion.load(inputs.pixel, frame);
    let known = moved.x.abs() < FARTHEST && moved.y.abs() < FARTHEST;
    let motion = if known { moved.xy() } else { Vec2::ZERO };
    // The shading sample to the upper left of the earlier position, or as much farther out as the square needs.
    let first = motion.floor();
    let aside = 1 - (side / 2) as i32;
    let step = ivec2((k % side) as i32 + aside, (k / side) as i32 + aside);
    let there = inputs.pixel + first.as_ivec2() + step;
    let inside = is_inside(there, inputs.history.history_color.size().as_ivec2());
    let at = first - motion + step.as_vec2();
    Earlier {
        there,
        place: Place { at, ..place },
        seen: seen(cfg, inputs, inputs.history.history_surface.load(there, frame), moved.z),
        seen_at: match (cfg.shading, cfg.metric) {
            (Shading::Placed, Metric::PlanesNormals) => at + inputs.history.history_place.load(there, frame).xy(),
            _ => at,
        },
        is_there: known && inside,
    }
}

/// Colour of a shading sample of an earlier frame, with the paint of a geometry sample.
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

/// Number of shading samples of a frame on each axis: those around the pixel.
const SIDE: usize = 2;

fn is_inside(pixel: IVec2, size: IVec2) -> bool {
    pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y
}

/// Surface in a texel of an earlier frame, comparable with those of this one. `deeper` is by how much larger its depth was then.
fn seen(cfg: &Sraa, inputs: &Inputs, texel: Vec4, deeper: f32) -> Surface {
    let depth = match cfg.depth {
        Depth::Linear | Depth::ReversedInfinite => texel.w - deeper,
        // The sky, infinite in the texel, has the depth of the far plane in this frame.
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

/// The smaller of the two; the second if the first is NaN.
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
    /// Panics if the options do not permit earlier frames.
    pub(super) fn check_history(&self) {
        if self.history != 0 {
            assert!(
                self.shading == Shading::Centre || self.shading == Shading::Placed,
                "history takes frames that are shaded once a pixel, at one place of every pixel, which the uniform `jitter` says, or \
                 where `place` does: set shading=centre or shading=placed"
            );
            assert!(
                self.normalisation == Normalisation::Shifted && self.resolve == Resolve::Box,
                "history needs normalisation=shifted and resolve=box"
            );
            assert!(
                self.demodulate != Demodulate::AlbedoShadow,
                "history keeps no direct light of earlier frames apart: set demodulate=albedo or demodulate=none"
            );
        }
    }
}
