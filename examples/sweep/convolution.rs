//! A row of a separable blur, with its radius as an option: what `docs/study-of-your-own.md` sweeps.

use straightline_kernels::prelude::*;

options! {
    /// What a row of a blur is made of.
    pub struct Row {
        /// How far it reaches to each side, in pixels.
        pub radius: i32 [1..=32] = 4,
    }
}

/// The mean of a row of pixels, weighed by a Gaussian of which two standard deviations are the radius.
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
