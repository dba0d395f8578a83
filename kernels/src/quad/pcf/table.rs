//! Tables of weights, for `weights=lookup`.

use crate::prelude::*;

/// The table of a filter that ends at `half` texels from its middle, 2 of 4×4 texels and 4 of 8×8, `texels` wide: for the
/// distance of a texel, from `-half` to `half - 1`, the weight of it and its neighbour in x, and in y where between the two one
/// comparison weighs both as the filter does, 0 to 1 (Sigg and Hadwiger 2005). `weight` is by distance, and not negative.
///
/// A shader interpolates between texels of the table: 64 are enough for a cubic B-spline, to a 1000th.
pub fn table(half: f32, texels: u32, weight: impl Fn(f32) -> f32) -> Texture<Vec4> {
    let texel = |k: u32| {
        let first = k as f32 / (texels - 1).max(1) as f32 * (2.0 * half - 1.0) - half;
        let (near, far) = (weight(first.abs()), weight((first + 1.0).abs()));
        let both = near + far;
        let place = if both > 0.0 { far / both } else { 0.5 };
        vec4(both, place, 0.0, 0.0)
    };
    Texture::new(uvec2(texels.max(1), 1), (0..texels.max(1)).map(texel).collect())
}
