//! Any 5×5 convolution with weights fixed when the shader is generated.

use straightline_kernels::prelude::*;

options! {
    /// Options of the convolution.
    pub struct Convolution {
        /// Weights, row by row from the top. The default sharpens.
        pub weights: [f32; 25] = [
            0.0, 0.0, -0.125, 0.0, 0.0,
            0.0, -0.125, -0.25, -0.125, 0.0,
            -0.125, -0.25, 3.0, -0.25, -0.125,
            0.0, -0.125, -0.25, -0.125, 0.0,
            0.0, 0.0, -0.125, 0.0, 0.0,
        ],
        /// Offset added to every colour.
        pub offset: f32 [-1.0..=1.0] = 0.0,
    }
}

/// Weighted sum of the 5×5 pixels around. A weight of zero costs nothing: its pixel is not read.
pub fn convolution(cfg: &Convolution, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec3::splat(cfg.offset);
    for k in 0..25 {
        if cfg.weights[k] != 0.0 {
            let tap = color.load(pixel + ivec2(k as i32 % 5 - 2, k as i32 / 5 - 2));
            sum += cfg.weights[k] * tap.truncate();
        }
    }
    sum.extend(color.load(pixel).w)
}
