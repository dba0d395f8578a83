//! A single bounce of light, gathered on the screen by pixel quads. The chapter's §2.10 lists global illumination as an
//! application (Penner 2011).

use straightline_kernels::prelude::*;

options! {
    /// Options of the gathering.
    pub struct Bounce {
        /// Output of the kernel.
        pub gives: Gives = Gives::Picture,
        /// Taps of each lane; a pixel uses the sum of four times as many.
        pub taps: i32 [1..=16] = 4,
        /// Distance within which light is gathered, in the unit of depth.
        pub radius: f32 [1.0e-3..=1.0e4] = 1.0,
        /// Factor on the gathered light.
        pub strength: f32 [0.0..=100.0] = 4.0,
        /// Width of a pixel at depth 1.
        pub pixel_angle: f32 [1.0e-6..=1.0] = 0.005,
        /// Difference in depth, relative to the radius, at which the weight of another lane's light has fallen to exp(-1/2).
        pub depth_sigma: f32 [1.0e-3..=1.0e3] = 0.2,
    }
}

/// Output of the kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// Only the light, to be multiplied by the surface's reflectance.
    Light,
    /// The picture, with its own colours as the reflectance.
    Picture,
}

/// Longest distance of a tap on the screen, in pixels. Keeps reads close together.
const LONGEST: f32 = 64.0;

/// Lower bound on the depth of a surface. No device flushes it to 0.
const NEAREST: f32 = 1.0e-30;

/// Upper bound on the depth of a surface. All values computed from it are finite.
const DEEPEST: f32 = 1.0e30;

/// Upper bound on light.
const BRIGHTEST: f32 = 1.0e30;

/// Angle between consecutive taps: the golden angle, which spreads any number of them evenly.
const TURN: f32 = 2.399_963_2;

/// Gathers the light that reaches each pixel, after one reflection, from visible surfaces around it.
///
/// Tap `k` of all lies on a spiral; lane `l` takes those with `k % 4 == l`, and sends its result to the others. They weight it by
/// a Gaussian of the difference in depth.
///
/// `depth` is along the view. `normal` is of unit length, in the axes of captures: x right, y up, z towards the eye. `color` is
/// the light that surfaces send to the eye, and equally in all other directions.
///
/// The result is finite for every input. A depth that is not above 1e-30 and below 1e30, such as an infinite sky's, is no
/// surface: it neither receives nor sends light. A tap whose normal or colour is not finite sends none, and light is limited to
/// 1e30. A pixel's own colour that is not finite becomes black.
pub fn bounce(
    cfg: &Bounce,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    color: &Frame<Vec4>,
    resolution: UVec2,
    pixel: Quad<IVec2>,
) -> Quad<Vec4> {
    let middle = resolution.as_vec2() * 0.5;
    let seen = depth.load(pixel);
    let is_surface = seen.gt(NEAREST) & seen.lt(DEEPEST);
    // A pixel without a surface is far away, and sends a depth of 0, which no transport rounds.
    let z = is_surface.select(seen, Quad::splat(DEEPEST));
    let told = is_surface.select(seen, Quad::splat(0.0));
    let here = position(cfg, pixel, middle, z);
    let facing = normal.load(pixel);
    let reach = (cfg.radius / (cfg.pixel_angle * z)).min(LONGEST);
    let mut found = Quad::splat(Vec3::ZERO);
    for k in 0..cfg.taps {
        let way = Quad::new([
            spiral(cfg, 4 * k),
            spiral(cfg, 4 * k + 1),
            spiral(cfg, 4 * k + 2),
            spiral(cfg, 4 * k + 3),
        ]);
        let tap = pixel + (way * reach + 0.5).floor().as_ivec2();
        let to = position(cfg, tap, middle, depth.load(tap)) - here;
        let squared = to.length_squared();
        let along = to * inverse_sqrt(squared.max(1.0e-12));
        // Product of the cosines at the sender and at the receiver. Nothing arrives from beyond the radius.
        let arrives = along.dot(facing).max(0.0);
        let leaves = (along.dot(normal.load(tap)) * -1.0).max(0.0);
        let near = (1.0 - squared / (cfg.radius * cfg.radius)).max(0.0);
        let light = color.load(tap).truncate() * (arrives * leaves * near);
        // An infinite distance, or a NaN normal or colour, sends no light.
        let sends = squared.lt(cfg.radius * cfg.radius) & is_finite(light);
        found += sends.select(light, Quad::splat(Vec3::ZERO));
    }
    let messages = (found / cfg.taps as f32).extend(told).gather();
    let mut sum = messages[0].truncate();
    let mut total = Quad::splat(1.0);
    for k in 1..4 {
        let away = (messages[k].w() - told) / (cfg.depth_sigma * cfg.radius);
        let near = (away * away * (-0.5 * std::f32::consts::LOG2_E)).exp2();
        let weight = messages[k].w().min(told).gt(0.0).select(near, Quad::splat(0.0));
        sum += messages[k].truncate() * weight;
        total += weight;
    }
    let light = sum * (cfg.strength / total);
    match cfg.gives {
        Gives::Light => light.extend(Quad::splat(1.0)),
        Gives::Picture => {
            let own = color.load(pixel);
            let lit = own.truncate() * (light + Vec3::ONE);
            let shown = is_finite(lit).select(lit, Quad::splat(Vec3::ZERO));
            shown.extend(own.w().abs().lt(BRIGHTEST).select(own.w(), Quad::splat(1.0)))
        }
    }
}

/// Returns whether light is finite, and small enough for its sums to be finite.
fn is_finite(light: Quad<Vec3>) -> Quad<bool> {
    light.x().abs().lt(BRIGHTEST) & light.y().abs().lt(BRIGHTEST) & light.z().abs().lt(BRIGHTEST)
}

/// Position of a pixel in view space at depth `z`.
fn position(cfg: &Bounce, pixel: Quad<IVec2>, middle: Vec2, z: Quad<f32>) -> Quad<Vec3> {
    let across = (pixel.as_vec2() + 0.5 - middle) * vec2(cfg.pixel_angle, -cfg.pixel_angle);
    (across * z).extend(z * -1.0)
}

/// Tap `k` of all on a disc of radius 1.
fn spiral(cfg: &Bounce, k: i32) -> Vec2 {
    let distance = (k as f32 + 0.5) / (4 * cfg.taps) as f32;
    let angle = k as f32 * TURN;
    vec2(distance * angle.cos(), distance * angle.sin())
}
