//! A bilateral blur at full resolution, its reads shared over the quad (§2.7).

use super::guards::Guards;
use super::surface::{bounded, is_bright_color, no_surface};
use crate::prelude::*;

options! {
    /// How an image is blurred.
    pub struct QuadBilateral {
        /// Pixels on each side that count.
        pub radius: i32 [1..=6] = 2,
        /// Who reads them.
        pub sharing: Sharing = Sharing::Quad,
        /// Distance on the screen, in pixels, at which a weight has fallen to exp(-1/2).
        pub sigma: f32 [0.1..=100.0] = 2.0,
        /// Difference of depths, in their unit, at which a weight has fallen to exp(-1/2).
        pub depth_sigma: f32 [1.0e-6..=1.0e6] = 0.1,
        /// Tests of colours and depths that are not finite.
        pub guards: Guards = Guards::Inline,
    }
}

/// Who reads the pixels around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Each lane a quarter of those around the quad.
    Quad,
    /// Each pixel its own.
    Alone,
}

/// Colours of a quad, each the mean of the (2k+1)² pixels around it, weighted by how near they are on the screen and in
/// depth. The fourth component of `image` is the depth; so is that of the result.
///
/// Each lane reads (k+1)² pixels, outwards from the quad's centre, and passes each of them on as it is: weights depend on
/// who asks.
///
/// The result is finite whatever the image holds. A pixel with a colour that is not finite, or of 1.5e38 and more, is black and of no
/// surface: no other takes it. A depth that is not a number, or of 1e30 and more, counts and comes out as 1e30. Where the sum over bright
/// colours is too large a pixel keeps its own. `guards=none` leaves these tests out, as a promise that colours are finite and below 1e36, and
/// depths finite and below 1e18.
pub fn quad_bilateral(cfg: &QuadBilateral, image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let outwards = quad_vector().as_ivec2();
    let own = image.load(pixel);
    let centre = surface(cfg, own);
    let mut sum = Quad::splat(Vec4::ZERO);
    match cfg.sharing {
        Sharing::Quad => {
            for j in 0..=cfg.radius {
                for i in 0..=cfg.radius {
                    let tap = surface(cfg, image.load(pixel + outwards * ivec2(i, j)));
                    let taps = tap.gather();
                    for k in 0..4 {
                        // Seen from the other lane it lies one pixel farther out.
                        let (x, y) = (i + k as i32 % 2, j + k as i32 / 2);
                        if x <= cfg.radius && y <= cfg.radius {
                            sum += weighed(cfg, taps[k], centre, x * x + y * y);
                        }
                    }
                }
            }
        }
        Sharing::Alone => {
            for y in -cfg.radius..=cfg.radius {
                for x in -cfg.radius..=cfg.radius {
                    let tap = surface(cfg, image.load(pixel + ivec2(x, y)));
                    sum += weighed(cfg, tap, centre, x * x + y * y);
                }
            }
        }
    }
    let color = centre.truncate() + sum.truncate() / sum.w();
    match cfg.guards {
        Guards::Inline => is_bright_color(color)
            .select(color, centre.truncate())
            .extend(bounded(own.w())),
        Guards::None => color.extend(own.w()),
    }
}

/// A pixel as it counts: one whose colour is not finite is black, and of no surface that any other lies on.
fn surface(cfg: &QuadBilateral, seen: Quad<Vec4>) -> Quad<Vec4> {
    match cfg.guards {
        Guards::Inline => {
            let depth = bounded(seen.w());
            is_bright_color(seen.truncate()).select(seen.truncate().extend(depth), no_surface())
        }
        Guards::None => seen,
    }
}

/// What a pixel adds: its difference from the centre, and 1, times its weight. Of pixels all alike nothing is left
/// but the centre.
fn weighed(cfg: &QuadBilateral, tap: Quad<Vec4>, centre: Quad<Vec4>, squared: i32) -> Quad<Vec4> {
    if squared == 0 {
        // The centre itself.
        return Quad::splat(Vec4::W);
    }
    let z = (tap.w() - centre.w()) / cfg.depth_sigma;
    let near = squared as f32 / (cfg.sigma * cfg.sigma);
    let weight = tally("weight_evaluations", ((z * z + near) * HALF_LOG2_E).exp2());
    (tap.truncate() - centre.truncate()).extend(1.0) * weight
}

/// exp(-x / 2) is exp2(x times this).
const HALF_LOG2_E: f32 = -0.5 * std::f32::consts::LOG2_E;
