//! Convolution with (2k+1)² weights from (k+1)² reads a pixel (§2.8).

use super::guards::Guards;
use super::surface::BRIGHTEST;
use crate::prelude::*;

options! {
    /// Options of the convolution.
    pub struct QuadConvolution {
        /// Radius in pixels: 1 for 3×3, 2 for 5×5, 3 for 7×7.
        pub radius: i32 [1..=8] = 1,
        /// Distribution of the reads.
        pub sharing: Sharing = Sharing::Quad,
        /// Pixels per read. Bilinear taps need `sharing=quad` and an odd radius.
        pub taps: Taps = Taps::Pixels,
        /// Weights of the pixels around.
        pub weights: Weights = Weights::Box,
        /// Weights of 7×7 pixels, row by row, for `weights=given`. A smaller radius uses those around the centre. They are not
        /// normalised: use weights that sum to 1 to preserve the image's brightness.
        pub given: [f32; 49] = [0.0; 49],
        /// Tests for pixels that are not finite.
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

/// Pixels per read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taps {
    /// A single pixel.
    Pixels,
    /// 2×2 pixels, placed so that the sampler's filter weights them: a quarter of the reads. The quad's (2k+2)² pixels are
    /// weighted around its middle, and its four results differ by the slope of the plane that fits the taps best (§2.9). This
    /// is an approximation.
    Bilinear,
}

/// Weights of the pixels around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// All equal, with a sum of 1.
    Box,
    /// A row of Pascal's triangle, which approximates a Gaussian, with a sum of 1.
    Binomial,
    /// The weights of the option `given`, for a radius of 3 at most.
    Given,
}

/// Colours of a quad, each convolved with the (2k+1)² pixels around it.
///
/// Each lane reads (k+1)² pixels, outwards from the quad's centre, and sums them four times: for itself, and for the
/// three other lanes with the weights that these lanes use. The chapter's 3×3 blur multiplies such messages again by
/// 4, 2, 2 and 1, but they are already sums. Reads beyond the border return the border's pixels. `image_sampler` must filter
/// linearly and clamp; only bilinear taps use it.
///
/// The result is finite for every image. A pixel with a component that is not finite, or so large that the sum could be infinite,
/// counts as 0 in all components, for itself and for every pixel around it; with bilinear taps, so do the 2×2 pixels together.
/// `guards=none` omits the test; it is a promise that the image is finite and below 1e37.
pub fn quad_convolution(
    cfg: &QuadConvolution,
    image: &Frame<Vec4>,
    image_sampler: &Sampler,
    pixel: Quad<IVec2>,
) -> Quad<Vec4> {
    if cfg.weights == Weights::Given {
        assert!(
            cfg.radius <= 3,
            "weights=given has 49 weights, of a radius of 3: set radius to 1, 2 or 3"
        );
        assert!(any(cfg.given), "weights=given needs weights in `given`: all 49 are 0");
    }
    if cfg.taps == Taps::Bilinear {
        assert!(
            cfg.sharing == Sharing::Quad && cfg.radius % 2 == 1,
            "taps=bilinear shares 2x2 pixels at a time: leave sharing at quad, and set an odd radius"
        );
        assert!(
            cfg.weights != Weights::Given,
            "taps=bilinear weighs pixels by their distance from the middle of the quad: set weights to box or binomial"
        );
    }
    match (cfg.sharing, cfg.taps) {
        (Sharing::Quad, Taps::Pixels) => shared(cfg, image, pixel),
        (Sharing::Quad, Taps::Bilinear) => fitted(cfg, image, image_sampler, pixel),
        (Sharing::Alone, _) => {
            let mut sum = Quad::splat(Vec4::ZERO);
            for y in -cfg.radius..=cfg.radius {
                for x in -cfg.radius..=cfg.radius {
                    sum += counted(cfg, image.load(pixel + ivec2(x, y))) * weight_at(cfg, x, y);
                }
            }
            sum
        }
    }
}

/// A pixel with its guards applied: zero in all components if one is not finite, or is too large for the sum.
fn counted(cfg: &QuadConvolution, seen: Quad<Vec4>) -> Quad<Vec4> {
    match cfg.guards {
        Guards::Inline => {
            let most = BRIGHTEST / heaviest(cfg);
            let first = seen.x().abs().lt(most) & seen.y().abs().lt(most);
            let finite = first & seen.z().abs().lt(most) & seen.w().abs().lt(most);
            finite.select(seen, Quad::splat(Vec4::ZERO))
        }
        Guards::None => seen,
    }
}

/// Upper bound on the sum of the absolute weights, at least 1.
fn heaviest(cfg: &QuadConvolution) -> f32 {
    let mut sum = 0.0;
    match (cfg.weights, cfg.taps) {
        (Weights::Given, _) => {
            for weight in cfg.given {
                sum += weight.abs();
            }
        }
        // The plane's slope adds to the weights of taps on one side as much as it subtracts on the other.
        (_, Taps::Bilinear) => sum = 4.0,
        _ => {}
    }
    sum.max(1.0)
}

/// Returns whether any weight is not 0.
fn any(weights: [f32; 49]) -> bool {
    for weight in weights {
        if weight != 0.0 {
            return true;
        }
    }
    false
}

/// Partial sums of each lane, for itself and for the other lanes.
struct Sums {
    own: Quad<Vec4>,
    beside: Quad<Vec4>,
    below: Quad<Vec4>,
    across: Quad<Vec4>,
}

impl Sums {
    fn none() -> Sums {
        let none = Quad::splat(Vec4::ZERO);
        Sums {
            own: none,
            beside: none,
            below: none,
            across: none,
        }
    }

    /// Sends horizontal and vertical messages separately (§2.8). The sum for the diagonal lane is first sent sideways, and from
    /// there down, in one message with the sum for the lane below.
    fn exchanged(self) -> Quad<Vec4> {
        let down = self.below + self.across.swap_horizontal();
        self.own + self.beside.swap_horizontal() + down.swap_vertical()
    }
}

fn shared(cfg: &QuadConvolution, image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let outwards = quad_vector().as_ivec2();
    let mut sums = Sums::none();
    for j in 0..=cfg.radius {
        for i in 0..=cfg.radius {
            let tap = counted(cfg, image.load(pixel + outwards * ivec2(i, j)));
            sums.own += tap * weight(cfg, i, j);
            // For the other lane this pixel lies one pixel farther out.
            if i < cfg.radius {
                sums.beside += tap * weight(cfg, i + 1, j);
            }
            if j < cfg.radius {
                sums.below += tap * weight(cfg, i, j + 1);
            }
            if i < cfg.radius && j < cfg.radius {
                sums.across += tap * weight(cfg, i + 1, j + 1);
            }
        }
    }
    sums.exchanged()
}

/// Each lane takes its quarter of the taps and sums them for every lane. The weight of a tap is that of the plane through all
/// taps, evaluated at that lane's position.
fn fitted(cfg: &QuadConvolution, image: &Frame<Vec4>, image_sampler: &Sampler, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let own = pixel.as_vec2() + 0.5;
    let size = image.size().as_vec2();
    let mut square = 0.0;
    for i in 0..=cfg.radius / 2 {
        let (place, weight) = pair(cfg, i);
        square += 2.0 * weight * place * place;
    }
    let mut sums = Sums::none();
    for j in 0..=cfg.radius / 2 {
        for i in 0..=cfg.radius / 2 {
            let ((x, weight_x), (y, weight_y)) = (pair(cfg, i), pair(cfg, j));
            // The lane lies half a pixel from the quad's middle.
            let outwards = quad_vector() * (vec2(x, y) - 0.5);
            let seen = counted(cfg, image.sample(image_sampler, (own + outwards) / size));
            let tap = seen * (weight_x * weight_y);
            let (right, down) = (0.5 * x / square, 0.5 * y / square);
            sums.own += tap * (1.0 + right + down);
            sums.beside += tap * (1.0 - right + down);
            sums.below += tap * (1.0 + right - down);
            sums.across += tap * (1.0 - right - down);
        }
    }
    sums.exchanged()
}

/// Position and weight of the `k`th pair of adjacent columns, or rows, outwards from the quad's middle. The sampler weights
/// the pair at that position as the filter does; the weight is the sum of both.
fn pair(cfg: &QuadConvolution, k: i32) -> (f32, f32) {
    let (near, far) = (outwards(cfg, 2 * k), outwards(cfg, 2 * k + 1));
    let weight = near + far;
    (2.0 * k as f32 + 0.5 + far / weight, weight)
}

/// Weight of the `k`th column, or row, of pixels outwards from the middle of the quad.
fn outwards(cfg: &QuadConvolution, k: i32) -> f32 {
    let n = 2 * cfg.radius + 1;
    match cfg.weights {
        Weights::Box => 1.0 / (n + 1) as f32,
        _ => pascal(n, cfg.radius + 1 + k),
    }
}

/// Weight of the pixel that lies `i` and `j` outwards, for each lane.
fn weight(cfg: &QuadConvolution, i: i32, j: i32) -> Quad<f32> {
    Quad::new([
        weight_at(cfg, -i, -j),
        weight_at(cfg, i, -j),
        weight_at(cfg, -i, j),
        weight_at(cfg, i, j),
    ])
}

/// Weight of the pixel at an offset.
fn weight_at(cfg: &QuadConvolution, x: i32, y: i32) -> f32 {
    match cfg.weights {
        Weights::Box => {
            let width = (2 * cfg.radius + 1) as f32;
            1.0 / (width * width)
        }
        Weights::Binomial => pascal(2 * cfg.radius, cfg.radius + x) * pascal(2 * cfg.radius, cfg.radius + y),
        Weights::Given => cfg.given[((y + 3) * 7 + x + 3) as usize],
    }
}

/// Number `k` of row `n` of Pascal's triangle, divided by the row's sum.
fn pascal(n: i32, k: i32) -> f32 {
    let mut share = 1.0;
    for step in 0..n {
        share *= 0.5;
        if step < k {
            share *= (n - step) as f32 / (step + 1) as f32;
        }
    }
    share
}
