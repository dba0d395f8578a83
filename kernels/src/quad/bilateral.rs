//! A bilateral blur at full resolution, with reads shared over the quad (§2.7).

use super::guards::Guards;
use super::surface::{bounded, is_bright_color, no_surface};
use crate::prelude::*;

options! {
    /// Options of the bilateral blur.
    pub struct QuadBilateral {
        /// Radius in pixels.
        pub radius: i32 [1..=6] = 2,
        /// Distribution of the reads.
        pub sharing: Sharing = Sharing::Quad,
        /// Distance on the screen, in pixels, at which a weight has fallen to exp(-1/2).
        pub sigma: f32 [0.1..=100.0] = 2.0,
        /// Difference in depth, in the unit of depth, at which a weight has fallen to exp(-1/2).
        pub depth_sigma: f32 [1.0e-6..=1.0e6] = 0.1,
        /// Tests for colours and depths that are not finite.
        pub guards: Guards = Guards::Inline,
    }
}

/// Distribution of the reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Shared: each lane reads a quarter of the pixels around the quad.
    Quad,
    /// Not shared: each pixel reads its own neighbours.
    Alone,
}

/// Colours of a quad, each the mean of the (2k+1)² pixels around it, weighted by nearness on the screen and in
/// depth. The fourth component of `image` is the depth, and so is that of the result.
///
/// Each lane reads (k+1)² pixels, outwards from the quad's centre, and passes each of them on unweighted: weights depend on
/// the receiving lane.
///
/// The result is finite for every image. A pixel with a colour that is not finite, or is 1.5e38 or more, is black and belongs to
/// no surface: no other pixel uses it. A depth that is NaN, or is 1e30 or more, counts as 1e30 and is returned as such. A pixel
/// keeps its own colour where the sum over bright colours is too large. `guards=none` omits these tests; it is a promise that
/// colours are finite and below 1e36, and depths finite and below 1e18.
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
                        // For the other lane this pixel lies one pixel farther out.
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

/// A pixel with its guards applied: a colour that is not finite becomes black, with a depth that no other surface has.
fn surface(cfg: &QuadBilateral, seen: Quad<Vec4>) -> Quad<Vec4> {
    match cfg.guards {
        Guards::Inline => {
            let depth = bounded(seen.w());
            is_bright_color(seen.truncate()).select(seen.truncate().extend(depth), no_surface())
        }
        Guards::None => seen,
    }
}

/// Contribution of a pixel: its difference from the centre, and 1, times its weight. For equal pixels only the centre
/// remains.
fn weighed(cfg: &QuadBilateral, tap: Quad<Vec4>, centre: Quad<Vec4>, squared: i32) -> Quad<Vec4> {
    if squared == 0 {
        // The centre pixel.
        return Quad::splat(Vec4::W);
    }
    let z = (tap.w() - centre.w()) / cfg.depth_sigma;
    let near = squared as f32 / (cfg.sigma * cfg.sigma);
    let weight = tally("weight_evaluations", ((z * z + near) * HALF_LOG2_E).exp2());
    (tap.truncate() - centre.truncate()).extend(1.0) * weight
}

/// Factor such that exp(-x / 2) is exp2(x * factor).
const HALF_LOG2_E: f32 = -0.5 * std::f32::consts::LOG2_E;
