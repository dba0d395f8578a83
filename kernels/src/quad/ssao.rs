//! Screen-space ambient occlusion, with taps shared over the quad (the chapter's §2.10 names it).

use super::guards::Guards;
use super::surface::{DEEPEST, NEAREST};
use crate::prelude::*;

options! {
    /// Options of the occlusion.
    pub struct QuadSsao {
        /// Taps of each lane; a pixel is estimated from four times as many.
        pub taps: i32 [1..=16] = 4,
        /// Distribution of the taps.
        pub sharing: Sharing = Sharing::Quad,
        /// Distance within which surfaces occlude, in the unit of depth.
        pub radius: f32 [1.0e-3..=1.0e4] = 0.5,
        /// Cosine to the normal below which nothing occludes. Hides the quantisation of depth.
        pub bias: f32 [0.0..=1.0] = 0.05,
        /// Factor on the occlusion.
        pub strength: f32 [0.0..=10.0] = 2.0,
        /// Width of a pixel at depth 1.
        pub pixel_angle: f32 [1.0e-6..=1.0] = 0.005,
        /// Difference in depth, relative to the radius, at which the weight of another lane's taps has fallen to exp(-1/2).
        pub depth_sigma: f32 [1.0e-3..=1.0e3] = 0.2,
        /// Tests for depths and normals that are not finite.
        pub guards: Guards = Guards::Inline,
    }
}

/// Distribution of the taps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Shared: those of all lanes with a nearby surface.
    Quad,
    /// Not shared: each pixel takes all taps itself.
    Alone,
}

/// Longest distance of a tap on the screen, in pixels. Keeps reads close together.
const LONGEST: f32 = 48.0;

/// Angle between consecutive taps: the golden angle, which spreads any number of them evenly.
const TURN: f32 = 2.399_963_2;

/// Ambient light on each pixel of a quad, 0 to 1, in every component.
///
/// Tap `k` of all lies on a spiral around the pixel; lane `l` takes those with `k % 4 == l`. A lane sends its result to
/// the others, which weight it by a Gaussian of the difference in depth: nothing crosses from one surface to another.
///
/// `depth` is along the view. `normal` is of unit length in the view's frame: x right, y down, z away.
///
/// The light is a number from 0 to 1 for every input. A depth that is not above 1e-30 and below 1e30, such as the infinite depth
/// of a sky, is no surface: it neither occludes nor is occluded. Taps that are not finite do not occlude, and a pixel whose
/// normal is not finite is not occluded; the quad's other lanes treat them alike. A lane sends at most 1. `guards=none` omits
/// these tests; it is a promise that depths and normals are finite and depths positive.
pub fn quad_ssao(
    cfg: &QuadSsao,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    resolution: UVec2,
    pixel: Quad<IVec2>,
) -> Quad<Vec4> {
    let seen = depth.load(pixel);
    let is_surface = seen.gt(NEAREST) & seen.lt(DEEPEST);
    // A pixel without a surface is far away, and sends a depth of 0, which no transport rounds.
    let (z, told) = match cfg.guards {
        Guards::Inline => (
            is_surface.select(seen, Quad::splat(DEEPEST)),
            is_surface.select(seen, Quad::splat(0.0)),
        ),
        Guards::None => (seen, seen),
    };
    let place = Place {
        pixel,
        middle: resolution.as_vec2() * 0.5,
        from: position(cfg, pixel, resolution.as_vec2() * 0.5, z),
        normal: normal.load(pixel),
        reach: (cfg.radius / (cfg.pixel_angle * z)).min(LONGEST),
    };
    let occluded = match cfg.sharing {
        Sharing::Quad => {
            let mut own = Quad::splat(0.0);
            for k in 0..cfg.taps {
                let [x0, y0] = spiral(cfg, 4 * k);
                let [x1, y1] = spiral(cfg, 4 * k + 1);
                let [x2, y2] = spiral(cfg, 4 * k + 2);
                let [x3, y3] = spiral(cfg, 4 * k + 3);
                let way = Quad::new([vec2(x0, y0), vec2(x1, y1), vec2(x2, y2), vec2(x3, y3)]);
                own += occlusion(cfg, depth, &place, way);
            }
            let messages = Quad::from_xy(share(cfg, own / cfg.taps as f32), told).gather();
            let mut sum = messages[0].x();
            let mut total = Quad::splat(1.0);
            for k in 1..4 {
                let away = (messages[k].y() - told) / (cfg.depth_sigma * cfg.radius);
                let weight = near(cfg, messages[k].y().min(told), away);
                sum += messages[k].x() * weight;
                total += weight;
            }
            sum / total
        }
        Sharing::Alone => {
            let mut sum = Quad::splat(0.0);
            for k in 0..4 * cfg.taps {
                let [x, y] = spiral(cfg, k);
                sum += occlusion(cfg, depth, &place, Quad::splat(vec2(x, y)));
            }
            share(cfg, sum / (4 * cfg.taps) as f32)
        }
    };
    Vec4::ONE * saturate(1.0 - occluded * cfg.strength)
}

/// Weight of another lane's occlusion. `smaller` is the smaller of both depths; `away` is their difference in sigmas.
fn near(cfg: &QuadSsao, smaller: Quad<f32>, away: Quad<f32>) -> Quad<f32> {
    let weight = (away * away * (-0.5 * std::f32::consts::LOG2_E)).exp2();
    match cfg.guards {
        Guards::Inline => smaller.gt(0.0).select(weight, Quad::splat(0.0)),
        Guards::None => weight,
    }
}

/// Occlusion to send, from 0 to 1.
fn share(cfg: &QuadSsao, occluded: Quad<f32>) -> Quad<f32> {
    match cfg.guards {
        // A NaN normal sends 0.
        Guards::Inline => occluded.gt(0.0).select(occluded.min(1.0), Quad::splat(0.0)),
        Guards::None => occluded,
    }
}

/// Starting point of a pixel's taps.
struct Place {
    pixel: Quad<IVec2>,
    middle: Vec2,
    from: Quad<Vec3>,
    normal: Quad<Vec3>,
    /// Radius on the screen, in pixels.
    reach: Quad<f32>,
}

/// Position of a pixel in view space at depth `z`.
fn position(cfg: &QuadSsao, pixel: Quad<IVec2>, middle: Vec2, z: Quad<f32>) -> Quad<Vec3> {
    ((pixel.as_vec2() + 0.5 - middle) * (z * cfg.pixel_angle)).extend(z)
}

/// Tap `k` of all on a disc of radius 1.
fn spiral(cfg: &QuadSsao, k: i32) -> [f32; 2] {
    let distance = (k as f32 + 0.5) / (4 * cfg.taps) as f32;
    let angle = k as f32 * TURN;
    [distance * angle.cos(), distance * angle.sin()]
}

/// Occlusion by the surface at the end of `way`, 0 to 1.
fn occlusion(cfg: &QuadSsao, depth: &Frame<f32>, place: &Place, way: Quad<Vec2>) -> Quad<f32> {
    let tap = place.pixel + (way * place.reach + 0.5).floor().as_ivec2();
    let to = position(cfg, tap, place.middle, depth.load(tap)) - place.from;
    let squared = to.length_squared();
    let cosine = to.dot(place.normal) * inverse_sqrt(squared.max(1.0e-12));
    let near = 1.0 - squared / (cfg.radius * cfg.radius);
    let facing = cosine - cfg.bias;
    match cfg.guards {
        // Both comparisons are false for an infinite way and for a NaN normal, so that nothing occludes.
        Guards::Inline => {
            let occludes = squared.lt(cfg.radius * cfg.radius) & facing.gt(0.0);
            occludes.select(facing * near, Quad::splat(0.0))
        }
        Guards::None => facing.max(0.0) * near.max(0.0),
    }
}
