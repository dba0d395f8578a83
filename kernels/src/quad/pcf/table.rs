//! Weight tables for `weights=lookup`.

use crate::prelude::*;

/// Creates the table of a filter that ends at `half` texels from its middle (2 for 4×4 texels, 4 for 8×8), `texels` wide. For
/// each distance of a texel, from `-half` to `half - 1`, x is the summed weight of it and its neighbour. y is the position, 0 to
/// 1, where one comparison weights both as the filter does (Sigg and Hadwiger 2005). `weight` maps a distance to a weight >= 0.
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
