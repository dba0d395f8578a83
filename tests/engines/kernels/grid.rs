//! The target's size without a `Frame`, and the pixel.

use straightline_kernels::prelude::*;

/// Width and height of the target, and the pixel's column and row, over a picture that is not shown.
pub fn grid(color: &Texture<Vec4>, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let hidden = color.load(pixel) * 0.0;
    resolution.as_vec2().extend(pixel.x as f32).extend(pixel.y as f32) + hidden
}
