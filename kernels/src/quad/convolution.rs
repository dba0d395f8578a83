//! Convolution with (2k+1)² weights from (k+1)² reads a pixel (§2.8).

use crate::prelude::*;

options! {
    /// What an image is convolved with.
    pub struct QuadConvolution {
        /// Pixels on each side that count: 1 for 3×3, 2 for 5×5, 3 for 7×7.
        pub radius: i32 [1..=8] = 1,
        /// Who reads them.
        pub sharing: Sharing = Sharing::Quad,
        /// How the pixels around are weighed.
        pub weights: Weights = Weights::Box,
        /// Weights of 7×7 pixels, row by row, for `given`; with a smaller radius those around the centre. They are taken as
        /// they are: give weights that sum to 1 for an image that keeps its brightness.
        pub given: [f32; 49] = [0.0; 49],
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
/// 4, 2, 2 and 1; they are sums already. Reads beyond the border give the border's pixels.
pub fn quad_convolution(cfg: &QuadConvolution, image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    if cfg.weights == Weights::Given {
        assert!(
            cfg.radius <= 3,
            "weights=given has 49 weights, of a radius of 3: set radius to 1, 2 or 3"
        );
        assert!(any(cfg.given), "weights=given needs weights in `given`: all 49 are 0");
    }
    match cfg.sharing {
        Sharing::Quad => shared(cfg, image, pixel),
        Sharing::Alone => {
            let mut sum = Quad::splat(Vec4::ZERO);
            for y in -cfg.radius..=cfg.radius {
                for x in -cfg.radius..=cfg.radius {
                    sum += image.load(pixel + ivec2(x, y)) * weight_at(cfg, x, y);
                }
            }
            sum
        }
    }
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

fn shared(cfg: &QuadConvolution, image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let outwards = quad_vector().as_ivec2();
    let mut own = Quad::splat(Vec4::ZERO);
    let mut beside = Quad::splat(Vec4::ZERO);
    let mut below = Quad::splat(Vec4::ZERO);
    let mut across = Quad::splat(Vec4::ZERO);
    for j in 0..=cfg.radius {
        for i in 0..=cfg.radius {
            let tap = image.load(pixel + outwards * ivec2(i, j));
            own += tap * weight(cfg, i, j);
            // Seen from the other lane it lies one pixel farther out.
            if i < cfg.radius {
                beside += tap * weight(cfg, i + 1, j);
            }
            if j < cfg.radius {
                below += tap * weight(cfg, i, j + 1);
            }
            if i < cfg.radius && j < cfg.radius {
                across += tap * weight(cfg, i + 1, j + 1);
            }
        }
    }
    own + beside.swap_horizontal() + below.swap_vertical() + across.swap_diagonal()
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
        Weights::Binomial => binomial(cfg.radius, x) * binomial(cfg.radius, y),
        Weights::Given => cfg.given[((y + 3) * 7 + x + 3) as usize],
    }
}

/// Of the row 2k of Pascal's triangle, the number `x` from its middle, over the row's sum.
fn binomial(radius: i32, x: i32) -> f32 {
    let n = 2 * radius;
    let mut share = 1.0;
    for step in 0..n {
        share *= 0.5;
        if step < radius + x {
            share *= (n - step) as f32 / (step + 1) as f32;
        }
    }
    share
}
