//! Convolution with (2k+1)² weights from (k+1)² reads a pixel (§2.8).

use super::guards::Guards;
use super::surface::BRIGHTEST;
use crate::prelude::*;

options! {
    /// What an image is convolved with.
    pub struct QuadConvolution {
        /// Pixels on each side that count: 1 for 3×3, 2 for 5×5, 3 for 7×7.
        pub radius: i32 [1..=8] = 1,
        /// Who reads them.
        pub sharing: Sharing = Sharing::Quad,
        /// What a read gives; bilinear taps are of `quad` and odd radii alone.
        pub taps: Taps = Taps::Pixels,
        /// How the pixels around are weighed.
        pub weights: Weights = Weights::Box,
        /// Weights of 7×7 pixels, row by row, for `given`; with a smaller radius those around the centre. They are taken as
        /// they are: give weights that sum to 1 for an image that keeps its brightness.
        pub given: [f32; 49] = [0.0; 49],
        /// Tests of pixels that are not finite.
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

/// What a read gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taps {
    /// A pixel.
    Pixels,
    /// 2×2 pixels, placed so that the sampler's filter weighs them: a quarter of the reads. The quad's (2k+2)² pixels are
    /// weighed around its middle, and its pixels told apart by the slope of the plane that fits the taps best (§2.9): an
    /// approximation.
    Bilinear,
}

/// How the pixels around are weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// All alike, to the sum of 1.
    Box,
    /// By the row of Pascal's triangle, which nears a Gaussian, to the sum of 1.
    Binomial,
    /// As the option `given` says, which has a radius of 3 at most.
    Given,
}

/// Colours of a quad, each convolved with the (2k+1)² pixels around it.
///
/// Each lane reads (k+1)² pixels, outwards from the quad's centre, and sums them up four times: for itself, and for the
/// three others with the weights that they give these pixels. The chapter's 3×3 blur weighs such messages once more by
/// 4, 2, 2 and 1; they are sums already. Reads beyond the border give the border's pixels. `image_sampler` must filter
/// linearly and clamp; bilinear taps alone use it.
///
/// The result is finite whatever the image holds: a pixel of which a component is not finite, or so large that the sum could be infinite,
/// counts as 0 in all components, for every pixel around it and for itself; of bilinear taps the 2×2 pixels together. `guards=none` leaves
/// the test out, as a promise that the image is finite and below 1e37.
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

/// A pixel as it counts: black and transparent if a component is not finite, or too large for the sum of all.
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

/// Bound of the sum of all weights' sizes, at least 1.
fn heaviest(cfg: &QuadConvolution) -> f32 {
    let mut sum = 0.0;
    match (cfg.weights, cfg.taps) {
        (Weights::Given, _) => {
            for weight in cfg.given {
                sum += weight.abs();
            }
        }
        // The plane's slope adds to the weights of taps on one side what it takes from those on the other.
        (_, Taps::Bilinear) => sum = 4.0,
        _ => {}
    }
    sum.max(1.0)
}

/// Whether a weight is not 0.
fn any(weights: [f32; 49]) -> bool {
    for weight in weights {
        if weight != 0.0 {
            return true;
        }
    }
    false
}

/// What each lane found for itself, and for the others.
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

    /// Horizontal and vertical messages apart (§2.8): what is for the lane across goes beside first, and from there down
    /// in one message with what is for the lane below.
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
            // Seen from the other lane it lies one pixel farther out.
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

/// Each lane takes its quarter of the taps, and sums them up for each lane with the weight that the plane through all
/// taps, at that lane's place, gives them.
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
            // The lane lies half a pixel from the middle.
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

/// Of two neighbouring columns, or rows, of pixels, the `k`th outwards: where the sampler weighs them as the filter does,
/// from the middle of the quad, and the sum of their weights.
fn pair(cfg: &QuadConvolution, k: i32) -> (f32, f32) {
    let (near, far) = (outwards(cfg, 2 * k), outwards(cfg, 2 * k + 1));
    let weight = near + far;
    (2.0 * k as f32 + 0.5 + far / weight, weight)
}

/// Weight of a column, or row, of pixels, the `k`th outwards from the middle of the quad.
fn outwards(cfg: &QuadConvolution, k: i32) -> f32 {
    let n = 2 * cfg.radius + 1;
    match cfg.weights {
        Weights::Box => 1.0 / (n + 1) as f32,
        _ => pascal(n, cfg.radius + 1 + k),
    }
}

/// Weight of the pixel that lies `i` and `j` outwards, of each lane.
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

/// Number `k` of row `n` of Pascal's triangle, over the row's sum.
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
