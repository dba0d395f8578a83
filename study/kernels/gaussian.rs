//! The Gaussian blur with its default options, its loops left in the shader: the weights come from a table.

use straightline_kernels::prelude::*;

/// Equals `gaussian`, bit for bit.
pub fn gaussian(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut weights = [0.0; 13];
    let mut total = 0.0;
    #[cfg_attr(false, unroll(full))]
    for tap in 0..13 {
        let x = (tap as f32 - 6.0) / 2.5;
        weights[tap] = (-0.5 * x * x).exp();
        total += weights[tap];
    }
    let mut sum = Vec4::ZERO;
    for tap in 0..13 {
        sum += weights[tap] * color.load(pixel + ivec2(tap as i32 - 6, 0));
    }
    sum / total
}
