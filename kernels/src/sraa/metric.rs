//! What tells two surfaces apart (paper §3.2, Table 1).

use super::gbuffer::{Depth, Normals, Surface};
use super::options::{Guards, Mask, Normalisation, Sraa, Turn};
use super::view::{Projection, View};
use crate::prelude::*;

/// What tells two surfaces apart, from the dearest to the cheapest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// The larger of the distance from the sample's plane and the difference in normal.
    PlanesNormals,
    /// The larger of the differences in depth and in normal.
    DepthNormals,
    /// The difference in normal alone: no depth is read.
    Normals,
    /// The difference in depth alone: no normals are read.
    Depth,
}

/// What a difference in depth counts as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// Itself, in scene units.
    Absolute,
    /// Its share of the sample's depth: a receding floor is as smooth far away as it is near.
    Relative,
}

/// From whose plane a distance is measured (paper §3.2, where it is that of the source: either reading).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// That of the geometry sample.
    Sample,
    /// That of the tap.
    Tap,
}

/// A geometry sample that taps are compared with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    surface: Surface,
    plane: Tilt,
    /// Ray through the centre of the pixel that is filtered, and what is added for each pixel to the right and down: to the ray, or of
    /// projection=parallel to where it begins.
    rays: [Vec3; 3],
    /// From the centre of the pixel that is filtered, in pixels, y down.
    at: Vec2,
    /// Square of the normal's length: 1, or 0 where nothing is drawn.
    square: f32,
    /// Of metric=planes-normals: whether a surface is drawn there.
    is_drawn: bool,
}

/// How a plane is tilted, as rays see it: how much of the way along a ray to depth 1 is along the normal.
#[derive(Clone, Copy, Debug)]
struct Tilt {
    /// Along the ray through the pixel's centre.
    along: f32,
    /// More for each pixel to the right.
    right: f32,
    /// More for each pixel down.
    down: f32,
}

impl Sample {
    /// The sample at which `surface` is seen, `at` from the centre of `pixel`.
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

/// Square of a normal's length below which it is none: renderers clear normals to 0.
const LEAST_SQUARE: f32 = 1.0 / 4096.0;

/// The same above which a normal that is stored as 0.5 + 0.5 n is none: of a texel of zeros it is 3.
const MOST_SQUARE: f32 = 2.0;

/// Linear depth, or share of the far plane's, from which on nothing is drawn.
const BACKDROP: f32 = 1.0e20;
const NEAR_FAR: f32 = 0.999;

/// Whether a surface is drawn there, of metric=planes-normals. Where none is, there is no plane to measure from, and depths are compared. Normals
/// that were cleared to anything else than 0 are told by depth: in world space such a sky would not be even.
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
    /// Of no plane: distances from it are differences in depth.
    const BY_DEPTH: Tilt = Tilt {
        along: 1.0,
        right: 0.0,
        down: 0.0,
    };

    /// Of the plane with a normal.
    fn new(rays: &[Vec3; 3], normal: Vec3) -> Tilt {
        Tilt {
            along: rays[0].dot(normal),
            right: rays[1].dot(normal),
            down: rays[2].dot(normal),
        }
    }
}

/// Differences from here on are alike: nothing that a weight could tell apart, whatever tau. The bound keeps a
/// difference exact enough to be shifted by the smallest one: of two that are a million apart, f32 would lose all that
/// the exponential needs. Without it, samples that no tap saw are off by up to 0.05.
pub(super) const FAR: f32 = 16.0;

/// From this tau on a difference of [`FAR`] weighs nothing: exp(-16 * 16) is less than half of the smallest number of 32 bits.
const STEEP: f32 = 16.0;

/// The least depth that another is divided by.
const NEAREST: f32 = 1.0e-30;

/// How different the surface at a tap is from that at a geometry sample: 0 for the same, 1 or more for unrelated ones, at
/// most [`FAR`]. Where that would weigh nothing, no bound is needed: weights that are not shifted are 0 beyond it too.
pub(super) fn distance(cfg: &Sraa, sample: &Sample, tap: &Surface, at: Vec2) -> f32 {
    let larger = match cfg.metric {
        Metric::PlanesNormals => {
            number(cfg, off_plane(cfg, sample, tap, at)).max(number(cfg, turned(cfg, sample, tap)))
        }
        // Depths are numbers, and so is how far they are apart.
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

/// Whether the weight of a difference of [`FAR`] is 0 as it is of all beyond.
fn weighs_nothing_far_away(cfg: &Sraa) -> bool {
    match cfg.normalisation {
        Normalisation::Shifted => false,
        Normalisation::Paper | Normalisation::Epsilon => cfg.tau >= STEEP && cfg.mask == Mask::None,
    }
}

/// A difference, or [`FAR`]: what is not a number, as of a normal that was divided by its length of zero, is of no surface at all.
/// `min` and `max` would leave to the device what becomes of it.
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

/// σp |(pₜ - pₛ)·nₛ|, or of nₜ. The points are their depths along their rays, so (pₜ - pₛ)·nₛ is
/// (zₜ - zₛ) rₜ·nₛ + zₛ (rₜ - rₛ)·nₛ, where rₜ - rₛ is exact: the points' own coordinates would cancel. From the tap's plane
/// it is the same with the two exchanged. Of a parallel projection rays are alike, and what they begin at is apart instead.
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

fn deeper(cfg: &Sraa, sample: &Sample, tap: &Surface) -> f32 {
    let step = (sample.surface.depth - tap.depth).abs();
    match cfg.difference {
        Difference::Absolute => cfg.depth_scale * step,
        Difference::Relative => cfg.depth_scale / sample.surface.depth.max(NEAREST) * step,
    }
}

/// 1 - a·b of two normals, as a·a - a·b: of a sample where nothing is drawn it is 0, and its depth alone counts. A tap with a normal of 0
/// differs by 1 from every surface.
fn turned(cfg: &Sraa, sample: &Sample, tap: &Surface) -> f32 {
    let (a, b) = (sample.surface.normal, tap.normal);
    let turn = a - b;
    match (cfg.normals, cfg.metric) {
        // Half as long, so that the square is a quarter.
        (Normals::Unorm, Metric::DepthNormals | Metric::Normals) if !cfg.renormalise => 2.0 * turn.dot(turn),
        (Normals::Unorm, _) if !cfg.renormalise => 0.5 * turn.dot(turn),
        (_, Metric::Normals) => 0.5 * turn.dot(turn),
        _ => match cfg.turn {
            Turn::Chord => 0.5 * turn.dot(turn),
            // Term by term, each of which a GPU fuses with the last.
            Turn::Cosine => sample.square - a.x * b.x - a.y * b.y - a.z * b.z,
        },
    }
}
