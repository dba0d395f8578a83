//! Levels of a picture: each texel of the next one is the mean of 2x2.

use straightline_kernels::prelude::*;

options! {
    /// Options of the levels.
    pub struct Mips {
        /// Levels after the first one. 1920x1080 texels have 10: 960x540 to 1x1.
        pub levels: i32 [1..=14] = 10,
    }
}

/// Mean of 2x2 texels of the level before. Of an odd size the last row or column is left out.
fn mean(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for corner in [ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)] {
        sum += from.load(pixel * 2 + corner);
    }
    sum * 0.25
}

/// Computes the levels of a picture.
pub fn mips(cfg: &Mips, color: &Texture<Vec4>) -> Vec<Texture<Vec4>> {
    let level: Texture<Vec4> = draw(color.size() / 2, |pixel| mean(color, pixel));
    let mut levels = vec![level];
    for k in 1..cfg.levels as usize {
        let level: Texture<Vec4> = draw(levels[k - 1].size() / 2, |pixel| mean(&levels[k - 1], pixel));
        levels.push(level);
    }
    levels
}
