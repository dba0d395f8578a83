//! A chain of two passes.

use straightline_kernels::prelude::*;

/// Adds a glow around what is bright.
pub fn glow(color: &Texture<Vec4>, linear: &Sampler, strength: f32) -> Texture<Vec4> {
    let small: Texture<Vec4> = draw(color.size() / 2, |pixel| {
        let texel = color.load(pixel * 2);
        texel * (texel.x - 0.5).max(0.0)
    });
    draw(color.size(), |pixel| {
        let uv = (pixel.as_vec2() + 0.5) / color.size().as_vec2();
        color.load(pixel) + strength * small.sample(linear, uv)
    })
}
