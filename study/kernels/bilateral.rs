//! The bilateral filter with its default options, its loops kept: what distance on the screen takes away comes from a table,
//! and divisions by what is constant are products.

use straightline_kernels::prelude::*;

const SIGMA: f32 = 1.8;
const TOLERANCE: f32 = 0.15;

/// As `bilateral`, but for roundings.
pub fn bilateral(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let log2_e = std::f32::consts::LOG2_E;
    let mut space = [0.0; 49];
    #[cfg_attr(false, unroll(full))]
    for k in 0..49 {
        let away = vec2((k % 7) as f32 - 3.0, (k / 7) as f32 - 3.0);
        space[k] = -log2_e * away.dot(away) / (2.0 * SIGMA * SIGMA);
    }
    let steepness = log2_e / (2.0 * TOLERANCE * TOLERANCE);
    let centre = color.load(pixel);
    let mut sum = Vec3::ZERO;
    let mut total = 0.0;
    for k in 0..49 {
        let tap = color.load(pixel + ivec2(k as i32 % 7 - 3, k as i32 / 7 - 3)).truncate();
        let turn = tap - centre.truncate();
        let weight = (space[k] - steepness * turn.dot(turn)).exp2();
        sum += weight * tap;
        total += weight;
    }
    (sum / total).extend(centre.w)
}
