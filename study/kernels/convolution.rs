//! The 5×5 convolution with its default weights, its loops left in the shader: over a list of the neighbours with a weight.

use straightline_kernels::prelude::*;

/// Neighbours with a weight, without the pixel itself, which comes in the middle of them.
const PLACES: [IVec2; 12] = [
    ivec2(0, -2),
    ivec2(-1, -1),
    ivec2(0, -1),
    ivec2(1, -1),
    ivec2(-2, 0),
    ivec2(-1, 0),
    ivec2(1, 0),
    ivec2(2, 0),
    ivec2(-1, 1),
    ivec2(0, 1),
    ivec2(1, 1),
    ivec2(0, 2),
];

const WEIGHTS: [f32; 12] = [
    -0.125, -0.125, -0.25, -0.125, -0.125, -0.25, -0.25, -0.125, -0.125, -0.25, -0.125, -0.125,
];

/// Equals `convolution`, bit for bit.
pub fn convolution(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let centre = color.load(pixel);
    let mut sum = Vec3::ZERO;
    for k in 0..6 {
        sum += WEIGHTS[k] * color.load(pixel + PLACES[k]).truncate();
    }
    sum += 3.0 * centre.truncate();
    for k in 6..12 {
        sum += WEIGHTS[k] * color.load(pixel + PLACES[k]).truncate();
    }
    sum.extend(centre.w)
}
