//! The bilateral filter with its default options, its loops left in the shader: invariants of a row are computed once, and
//! divisions by constants are products.

use straightline_kernels::prelude::*;

/// Exponents of 2 per squared pixel of distance, and per squared unit of colour.
const SPACE: f32 = -std::f32::consts::LOG2_E / (2.0 * 1.8 * 1.8);
const RANGE: f32 = -std::f32::consts::LOG2_E / (2.0 * 0.15 * 0.15);

/// Equals `bilateral`, except for rounding.
pub fn bilateral(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let centre = color.load(pixel);
    let mut sum = Vec3::ZERO;
    let mut total = 0.0;
    for y in -3..=3 {
        let row = SPACE * (y * y) as f32;
        for x in -3..=3 {
            let tap = color.load(pixel + ivec2(x, y)).truncate();
            let turn = tap - centre.truncate();
            let weight = (row + SPACE * (x * x) as f32 + RANGE * turn.dot(turn)).exp2();
            sum += weight * tap;
            total += weight;
        }
    }
    (sum / total).extend(centre.w)
}
