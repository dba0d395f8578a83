//! Differences between surfaces (paper §3.2, Table 1).

use super::gbuffer::{Depth, Normals, Surface};
use super::options::{Guards, Mask, Normalisation, Sraa, Turn};
use super::view::{Projection, View};
use crate::prelude::*;

/// Measure of the difference between two surfaces, from the most to the least expensive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// The larger of the distance from a plane and the difference in normal.
    PlanesNormals,
    /// The larger of the differences in depth and in normal.
    DepthNormals,
    /// The difference in normal alone: no depth is read.
    Normals,
    /// The difference in depth alone: no normals are read.
    Depth,
}

/// Unit of differences in depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// Scene units.
    Absolute,
    /// Share of the sample's depth: a receding floor is as smooth far away as nearby. With metric=planes-normals, a tap that is
    /// farther or nearer by half of the depth is unrelated even on the sample's plane, as at the horizon.
    Relative,
}

/// Plane from which distances are measured (paper §3.2: that of the source, which permits both readings).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Plane of the geometry sample.
    Sample,
    /// Plane of the tap.
    Tap,
}

/// A geometry sample to compare taps with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    surface: Surface,
    plane: Tilt,
    /// Ray through the centre of the filtered pixel, and its change per pixel to the right and down; with
    /// projection=parallel, the change of the ray's origin.
    rays: [Vec3; 3],
    /// Position relative to the centre of the filtered pixel, in pixels, y down.
    at: Vec2,
    /// Square of the normal's length: 1, or 0 where nothing is drawn.
    square: f32,
    /// With metric=planes-normals: `true` if a surface is drawn there.
    is_drawn: bool,
}

/// Tilt of a plane relative to the rays: the component along the normal of a ray that ends at depth 1.
#[derive(Clone, Copy, Debug)]
struct Tilt {
    /// Value for the ray through the pixel's centre.
    along: f32,
    /// Increase per pixel to the right.
    right: f32,
    /// Increase per pixel down.
    down: f32,
}

impl Sample {
    /// The sample that shows `surface`, at the offset `at` from the centre of `pixel`.
    pub(super) fn new(cfg: &Sraa, view: &View, surface: Surface, pixel: IVec2, at: Vec2) -> Sample {
        let ray = match cfg.projection {
            Projection::Perspective => view.ray(pixel),
            Projection::Parallel => view.ray_forward,
        };
        let rays = [ray, view.ray_right, view.ray_down];
        let n = surface.normal;
        let square = n.x * n.x + n.y * n.y + n.z * n.z;
        let is_drawn = is_drawn(cfg, view, &surface, square);
        let plane = Tilt::new(&rays, n);
        Sample {
            surface,
            plane: if is_drawn { plane } else { Tilt::BY_DEPTH },
            rays,
            at,
            square,
            is_drawn,
        }
    }
}

/// Square of a normal's length below which there is no normal: renderers clear normals to 0.
const LEAST_SQUARE: f32 = 1.0 / 4096.0;

/// Square of a normal's length above which one stored as 0.5 + 0.5 n is no normal: for a texel of zeros the square is 3.
const MOST_SQUARE: f32 = 2.0;

/// Linear depth, or share of the far plane's depth, from which on nothing is drawn.
const BACKDROP: f32 = 1.0e20;
const NEAR_FAR: f32 = 0.999;

/// Returns whether a surface is drawn there, with metric=planes-normals. Without one there is no plane, so depths are compared.
/// If normals are cleared to a value other than 0, depth decides: in world space such a sky would not be uniform.
pub(super) fn is_drawn(cfg: &Sraa, view: &View, surface: &Surface, square: f32) -> bool {
    match cfg.metric {
        Metric::PlanesNormals => {
            let deepest = match cfg.depth {
                Depth::Linear | Depth::ReversedInfinite => BACKDROP,
                Depth::Perspective | Depth::Reversed => match cfg.projection {
                    Projection::Perspective => NEAR_FAR * view.far,
                    Projection::Parallel => view.near + NEAR_FAR * (view.far - view.near),
                },
            };
            let has_normal = match cfg.normals {
                Normals::Float => square >= LEAST_SQUARE,
                Normals::Unorm if cfg.renormalise => true,
                Normals::Unorm => square >= LEAST_SQUARE && square <= MOST_SQUARE,
                Normals::Octahedral | Normals::Packed => true,
            };
            surface.depth < deepest && has_normal
        }
        Metric::DepthNormals | Metric::Normals | Metric::Depth => true,
    }
}

impl Tilt {
    /// Tilt where there is no plane: distances are differences in depth.
    const BY_DEPTH: Tilt = Tilt {
        along: 1.0,
        right: 0.0,
        down: 0.0,
    };

    /// Tilt of the plane with the given normal.
    fn new(rays: &[Vec3; 3], normal: Vec3) -> Tilt {
        Tilt {
            along: rays[0].dot(normal),
            right: rays[1].dot(normal),
            down: rays[2].dot(normal),
        }
    }
}

/// Upper bound on differences: no weight distinguishes larger ones, whatever tau. The bound keeps a difference exact
/// enough to be shifted by the smallest one: of two differences near a million, f32 would lose all the digits that
/// the exponential needs. Without it, samples whose surface no tap shows are off by up to 0.05.
pub(super) const FAR: f32 = 16.0;

/// With at least this tau, the weight of a difference of [`FAR`] is 0: exp(-16 * 16) is less than half the smallest f32.
const STEEP: f32 = 16.0;

/// Lower bound on a depth before dividing by it.
const NEAREST: f32 = 1.0e-30;

/// Difference between the surface at a tap and that at a geometry sample: 0 for the same, 1 or more for unrelated ones, at
/// most [`FAR`]. The bound is omitted if the weight at [`FAR`] is 0: weights that are not shifted are 0 beyond it too.
pub(super) fn distance(cfg: &Sraa, sample: &Sample, tap: &Surface, at: Vec2) -> f32 {
    let larger = match cfg.metric {
        Metric::PlanesNormals => {
            let apart = number(cfg, off_plane(cfg, sample, tap, at)).max(number(cfg, turned(cfg, sample, tap)));
            match (cfg.projection, cfg.difference) {
                (Projection::Perspective, Difference::Relative) => apart.max(stretched(sample, tap)),
                _ => apart,
            }
        }
        // Depths are never NaN, and neither are their differences.
        Metric::DepthNormals => deeper(cfg, sample, tap).max(number(cfg, turned(cfg, sample, tap))),
        Metric::Normals => number(cfg, turned(cfg, sample, tap)),
        Metric::Depth => deeper(cfg, sample, tap),
    };
    tally(
        "weight_evaluations",
        if weighs_nothing_far_away(cfg) {
            larger
        } else {
            larger.min(FAR)
        },
    )
}

/// Returns whether the weight is 0 for all differences of at least [`FAR`].
fn weighs_nothing_far_away(cfg: &Sraa) -> bool {
    match cfg.normalisation {
        Normalisation::Shifted => false,
        Normalisation::Paper | Normalisation::Epsilon => cfg.tau >= STEEP && cfg.mask == Mask::None,
    }
}

/// Replaces NaN by [`FAR`]: a normal that was divided by a length of zero belongs to no surface. The result of `min` and
/// `max` for NaN depends on the device.
fn number(cfg: &Sraa, apart: f32) -> f32 {
    match cfg.guards {
        Guards::Fallback | Guards::None => apart,
        Guards::Inline => {
            if apart < FAR {
                apart
            } else {
                FAR
            }
        }
    }
}

/// σp |(pₜ - pₛ)·nₛ|, or with nₜ. Points are depths along their rays, so (pₜ - pₛ)·nₛ is
/// (zₜ - zₛ) rₜ·nₛ + zₛ (rₜ - rₛ)·nₛ, where rₜ - rₛ is exact; the points' coordinates would cancel. For the tap's plane, the
/// two points are exchanged. In a parallel projection all rays are equal and their origins differ.
fn off_plane(cfg: &Sraa, sample: &Sample, tap: &Surface, at: Vec2) -> f32 {
    let away = at - sample.at;
    let deeper = tap.depth - sample.surface.depth;
    let nearest = sample.surface.depth.max(NEAREST);
    let off = match cfg.plane {
        Plane::Sample => {
            let plane = &sample.plane;
            let along = plane.along + at.x * plane.right + at.y * plane.down;
            let aside = away.x * plane.right + away.y * plane.down;
            match (cfg.projection, cfg.difference) {
                (Projection::Parallel, _) => deeper * plane.along + aside,
                (_, Difference::Absolute) => deeper * along + sample.surface.depth * aside,
                (_, Difference::Relative) => deeper / nearest * along + aside,
            }
        }
        Plane::Tap => {
            let plane = Tilt::new(&sample.rays, tap.normal);
            let along = plane.along + sample.at.x * plane.right + sample.at.y * plane.down;
            let aside = away.x * plane.right + away.y * plane.down;
            let off = match cfg.projection {
                Projection::Parallel => deeper * plane.along + aside,
                Projection::Perspective => deeper * along + tap.depth * aside,
            };
            let off = if sample.is_drawn { off } else { deeper };
            match cfg.difference {
                Difference::Absolute => off,
                Difference::Relative => off / nearest,
            }
        }
    };
    cfg.depth_scale * off.abs()
}

/// Change of depth along a plane, as a share of the sample's depth, up to which a tap may show what the sample shows.
const FAR_ALONG: f32 = 0.5;

/// Increase of the difference per unit of that share beyond it: [`FAR`] is soon reached.
const STRETCH: f32 = 400.0;

/// Difference of a tap that lies far along the sample's plane. A pixel at the horizon spans hundreds of units of a floor, over
/// which haze and detail change as between surfaces.
fn stretched(sample: &Sample, tap: &Surface) -> f32 {
    let deeper = tap.depth - sample.surface.depth;
    let share = (deeper / sample.surface.depth.max(NEAREST)).abs();
    STRETCH * share - STRETCH * FAR_ALONG
}

fn deeper(cfg: &Sraa, sample: &Sample, tap: &Surface) -> f32 {
    let step = (sample.surface.depth - tap.depth).abs();
    match cfg.difference {
        Difference::Absolute => cfg.depth_scale * step,
        Difference::Relative => cfg.depth_scale / sample.surface.depth.max(NEAREST) * step,
    }
}

/// 1 - a·b of two normals, as a·a - a·b: 0 for a sample where nothing is drawn, so that only its depth counts. A tap with a
/// normal of 0 differs by 1 from every surface.
fn turned(cfg: &Sraa, sample: &Sample, tap: &Surface) -> f32 {
    let (a, b) = (sample.surface.normal, tap.normal);
    let turn = a - b;
    match (cfg.normals, cfg.metric) {
        // Stored normals are half as long, so the square is a quarter.
        (Normals::Unorm, Metric::DepthNormals | Metric::Normals) if !cfg.renormalise => 2.0 * turn.dot(turn),
        (Normals::Unorm, _) if !cfg.renormalise => 0.5 * turn.dot(turn),
        (_, Metric::Normals) => 0.5 * turn.dot(turn),
        _ => match cfg.turn {
            Turn::Chord => 0.5 * turn.dot(turn),
            // Subtracted term by term, so that a GPU fuses each with the last.
            Turn::Cosine => sample.square - a.x * b.x - a.y * b.y - a.z * b.z,
        },
    }
}
