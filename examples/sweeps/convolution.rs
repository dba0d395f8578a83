//! A pass of a separable blur with its radius as an option, for the sweep in `docs/study-of-your-own.md`.

use straightline_kernels::prelude::*;

options! {
    /// Options of the blur.
    pub struct Row {
        /// Radius of the blur, in pixels.
        pub radius: i32 [1..=32] = 4,
    }
}

/// Mean of a row of pixels, weighted by a Gaussian whose radius is two standard deviations.
pub fn convolution(cfg: &Row, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let sigma = 0.5 * cfg.radius as f32;
    let mut sum = Vec4::ZERO;
    let mut total = 0.0;
    for x in -cfg.radius..=cfg.radius {
        let distance = x as f32 / sigma;
        let weight = (-0.5 * distance * distance).exp();
        sum += color.load(pixel + ivec2(x, 0)) * weight;
        total += weight;
    }
    sum / total
}
