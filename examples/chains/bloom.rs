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

/// Half of a picture's size: the mean of 4x4 texels.
fn halve(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for y in -1..=2 {
        for x in -1..=2 {
            sum += from.load(pixel * 2 + ivec2(x, y));
        }
    }
    sum / 16.0
}

/// Weights of a quadratic B-spline a quarter of a texel from the middle one: of the farther neighbour, the middle, the nearer one.
const SPLINE: [f32; 3] = [0.03125, 0.6875, 0.28125];

/// Twice a picture's size, smoothly: 3x3 texels of it.
fn spread_out(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    // Direction of the nearer neighbour.
    let side = (pixel % 2) * 2 - 1;
    let mut sum = Vec4::ZERO;
    for (y, above) in SPLINE.iter().enumerate() {
        for (x, beside) in SPLINE.iter().enumerate() {
            let step = (ivec2(x as i32, y as i32) - 1) * side;
            sum += beside * above * from.load(pixel / 2 + step);
        }
    }
    sum
}

/// Adds a glow around what is brighter than `threshold`.
pub fn bloom(cfg: &Bloom, color: &Texture<Vec4>, threshold: f32, strength: f32) -> Texture<Vec4> {
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
        let down: Texture<Vec4> = draw(from.size() / 2, |pixel| halve(from, pixel));
        levels.push(down);
    }
    let mut glow = levels.pop().unwrap();
    for level in levels.iter().rev() {
        let up: Texture<Vec4> = draw(level.size(), |pixel| {
            level.load(pixel).lerp(spread_out(&glow, pixel), cfg.spread)
        });
        glow = up;
    }
    draw(color.size(), |pixel| {
        color.load(pixel) + strength * spread_out(&glow, pixel)
    })
}
