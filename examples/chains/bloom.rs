//! Bloom: what is bright glows (after Jimenez, *Next generation post processing in Call of Duty: Advanced Warfare*, 2014).

use straightline_kernels::prelude::*;

options! {
    /// Options of the bloom.
    pub struct Bloom {
        /// Sizes of the blur, each half of the one before.
        pub levels: i32 [1..=8] = 6,
        /// Share of each larger blur that is added to a smaller one.
        pub spread: f32 [0.0..=1.0] = 0.7,
    }
}

/// Light of a colour.
fn luminance(color: Vec3) -> f32 {
    color.dot(vec3(0.2126, 0.7152, 0.0722))
}

/// Keeps what is brighter than the threshold.
fn bright(color: Vec4, threshold: f32) -> Vec4 {
    let light = luminance(color.truncate());
    color * ((light - threshold).max(0.0) / light.max(1.0e-4))
}

/// Position of a pixel in a picture of a size, 0 to 1.
fn place(pixel: IVec2, size: UVec2) -> Vec2 {
    (pixel.as_vec2() + 0.5) / size.as_vec2()
}

/// Half of a picture's size: the mean of 4x4 texels, by four reads.
fn halve(from: &Texture<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    let texel = 1.0 / from.size().as_vec2();
    let uv = (pixel.as_vec2() * 2.0 + 1.0) * texel;
    let mut sum = Vec4::ZERO;
    for corner in [vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(-1.0, 1.0), vec2(1.0, 1.0)] {
        sum += from.sample(linear, uv + corner * texel);
    }
    sum / 4.0
}

/// A tent over 3x3 texels of a smaller picture.
fn spread_out(from: &Texture<Vec4>, linear: &Sampler, uv: Vec2) -> Vec4 {
    let texel = 1.0 / from.size().as_vec2();
    let mut sum = Vec4::ZERO;
    for y in -1..=1_i32 {
        for x in -1..=1_i32 {
            let weight = (2 - x.abs()) * (2 - y.abs());
            sum += weight as f32 * from.sample(linear, uv + ivec2(x, y).as_vec2() * texel);
        }
    }
    sum / 16.0
}

/// Adds a glow around what is brighter than `threshold`.
pub fn bloom(cfg: &Bloom, color: &Texture<Vec4>, linear: &Sampler, threshold: f32, strength: f32) -> Texture<Vec4> {
    let light: Texture<Vec4> = draw(color.size() / 2, |pixel| {
        let mut sum = Vec4::ZERO;
        for corner in [ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)] {
            sum += bright(color.load(pixel * 2 + corner), threshold);
        }
        sum / 4.0
    });
    let mut levels = vec![light];
    for k in 1..cfg.levels as usize {
        let from = &levels[k - 1];
        let down: Texture<Vec4> = draw(from.size() / 2, |pixel| halve(from, linear, pixel));
        levels.push(down);
    }
    let mut glow = levels.pop().unwrap();
    for level in levels.iter().rev() {
        let up: Texture<Vec4> = draw(level.size(), |pixel| {
            let wide = spread_out(&glow, linear, place(pixel, level.size()));
            level.load(pixel).lerp(wide, cfg.spread)
        });
        glow = up;
    }
    draw(color.size(), |pixel| {
        let wide = spread_out(&glow, linear, place(pixel, color.size()));
        color.load(pixel) + strength * wide
    })
}
