//! Screen-space ambient occlusion, its taps split over the quad (the chapter's §2.10 names it).

use super::guards::Guards;
use super::surface::{DEEPEST, NEAREST};
use crate::prelude::*;

options! {
    /// How occlusion is estimated.
    pub struct QuadSsao {
        /// Taps that each lane takes; a pixel is judged by four times as many.
        pub taps: i32 [1..=16] = 4,
        /// Whose taps count.
        pub sharing: Sharing = Sharing::Quad,
        /// How far away what occludes may be, in the unit of depth.
        pub radius: f32 [1.0e-3..=1.0e4] = 0.5,
        /// Cosine to the normal below which nothing occludes: hides the steps of depth.
        pub bias: f32 [0.0..=1.0] = 0.05,
        /// How much darker than measured.
        pub strength: f32 [0.0..=10.0] = 2.0,
        /// Width of a pixel at depth 1.
        pub pixel_angle: f32 [1.0e-6..=1.0] = 0.005,
        /// Difference of depths, over the radius, at which another lane's taps count for exp(-1/2).
        pub depth_sigma: f32 [1.0e-3..=1.0e3] = 0.2,
        /// Tests of depths and normals that are not finite.
        pub guards: Guards = Guards::Inline,
    }
}

/// Whose taps count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Those of all lanes whose surface is near.
    Quad,
    /// Each pixel's own alone: all of them.
    Alone,
}

/// The longest way of a tap on the screen, in pixels: keeps reads near each other.
const LONGEST: f32 = 48.0;

/// Angle from tap to tap: the golden one, which spreads any number of them.
const TURN: f32 = 2.399_963_2;

/// How much light comes to each pixel of a quad from around, 0 to 1, in every component.
///
/// Tap `k` of all lies on a spiral around the pixel; lane `l` takes those with `k % 4 == l`. What a lane finds is told to
/// the others, which take it at the weight of a Gaussian of their distance in depth: nothing goes from one surface to another.
///
/// `depth` is along the view; `normal` is of unit length in the view's frame: x right, y down, z away.
///
/// The light is a number from 0 to 1 whatever the inputs are. A depth that is not above 1e-30 and below 1e30, the infinite one of a sky among
/// them, is of no surface: nothing occludes that pixel, nor does it occlude others. Taps that are not finite occlude nothing, and a pixel
/// whose normal is not finite is not occluded; both count as such for the quad's other lanes. A lane tells at most 1. `guards=none` leaves
/// these tests out, as a promise that depths and normals are finite and depths positive.
pub fn quad_ssao(
    cfg: &QuadSsao,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    resolution: UVec2,
    pixel: Quad<IVec2>,
) -> Quad<Vec4> {
    let seen = depth.load(pixel);
    let is_surface = seen.gt(NEAREST) & seen.lt(DEEPEST);
    // What is no surface lies far away, and tells a depth of 0, which no transport rounds.
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

/// Weight of another lane's occlusion, of the smaller depth and of the distance in units of its sigma.
fn near(cfg: &QuadSsao, smaller: Quad<f32>, away: Quad<f32>) -> Quad<f32> {
    let weight = (away * away * (-0.5 * std::f32::consts::LOG2_E)).exp2();
    match cfg.guards {
        Guards::Inline => smaller.gt(0.0).select(weight, Quad::splat(0.0)),
        Guards::None => weight,
    }
}

/// Occlusion that is told, from 0 to 1.
fn share(cfg: &QuadSsao, occluded: Quad<f32>) -> Quad<f32> {
    match cfg.guards {
        // Of a normal that is no number nothing is told.
        Guards::Inline => occluded.gt(0.0).select(occluded.min(1.0), Quad::splat(0.0)),
        Guards::None => occluded,
    }
}

/// What a pixel's taps start from.
struct Place {
    pixel: Quad<IVec2>,
    middle: Vec2,
    from: Quad<Vec3>,
    normal: Quad<Vec3>,
    /// The radius on the screen, in pixels.
    reach: Quad<f32>,
}

/// Where in the view a pixel lies at a depth.
fn position(cfg: &QuadSsao, pixel: Quad<IVec2>, middle: Vec2, z: Quad<f32>) -> Quad<Vec3> {
    ((pixel.as_vec2() + 0.5 - middle) * (z * cfg.pixel_angle)).extend(z)
}

/// Tap `k` of all on a disc of radius 1.
fn spiral(cfg: &QuadSsao, k: i32) -> [f32; 2] {
    let distance = (k as f32 + 0.5) / (4 * cfg.taps) as f32;
    let angle = k as f32 * TURN;
    [distance * angle.cos(), distance * angle.sin()]
}

/// How much the surface at the end of a way hides, 0 to 1.
fn occlusion(cfg: &QuadSsao, depth: &Frame<f32>, place: &Place, way: Quad<Vec2>) -> Quad<f32> {
    let tap = place.pixel + (way * place.reach + 0.5).floor().as_ivec2();
    let to = position(cfg, tap, place.middle, depth.load(tap)) - place.from;
    let squared = to.length_squared();
    let cosine = to.dot(place.normal) * inverse_sqrt(squared.max(1.0e-12));
    let near = 1.0 - squared / (cfg.radius * cfg.radius);
    let facing = cosine - cfg.bias;
    match cfg.guards {
        // Of an infinite way and of a normal that is no number nothing is known: both comparisons fail.
        Guards::Inline => {
            let occludes = squared.lt(cfg.radius * cfg.radius) & facing.gt(0.0);
            occludes.select(facing * near, Quad::splat(0.0))
        }
        Guards::None => facing.max(0.0) * near.max(0.0),
    }
}
