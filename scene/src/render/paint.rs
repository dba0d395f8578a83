//! Colours that textures give to a surface. `paint.wgsl` says the same line by line.

use crate::scene::{Image, Textures, decode_texel};
use glam::{Vec2, Vec4, uvec2};

/// Linear colour and alpha of image `k` at `uv`, averaged over `footprint` texels: of two levels, and of four texels of each. It
/// repeats.
pub(super) fn sample_texture(textures: &Textures, k: u32, uv: Vec2, footprint: f32) -> Vec4 {
    let image = &textures.images[k as usize];
    let level = footprint.max(1.0).log2().clamp(0.0, (image.levels - 1) as f32);
    let finer = level.floor();
    let fine = of_level(textures, image, finer as u32, uv);
    let coarse = of_level(textures, image, (finer as u32 + 1).min(image.levels - 1), uv);
    fine + (coarse - fine) * (level - finer)
}

fn of_level(textures: &Textures, image: &Image, level: u32, uv: Vec2) -> Vec4 {
    let mut first = image.first;
    let mut size = uvec2(image.size[0], image.size[1]);
    for _ in 0..level {
        first += size.x * size.y;
        size = (size / 2).max(uvec2(1, 1));
    }
    let at = (uv - uv.floor()) * size.as_vec2() - 0.5;
    let corner = at.floor();
    let share = at - corner;
    // Half a texel before the first lies the last.
    let near = (corner + size.as_vec2()).as_uvec2() % size;
    let far = (near + 1) % size;
    let texel = |x: u32, y: u32| decode_texel(textures.texels[(first + y * size.x + x) as usize]);
    let upper = texel(near.x, near.y).lerp(texel(far.x, near.y), share.x);
    let lower = texel(near.x, far.y).lerp(texel(far.x, far.y), share.x);
    upper.lerp(lower, share.y)
}
