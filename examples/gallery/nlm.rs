//! Non-local means (Buades, Coll and Morel 2005): a pixel becomes the mean of those with similar surroundings.

use straightline_kernels::prelude::*;

options! {
    /// Options of non-local means.
    pub struct Nlm {
        /// Radius of the search, in pixels.
        pub search: i32 [1..=7] = 3,
        /// Radius of the compared surroundings, in pixels.
        pub patch: i32 [0..=3] = 1,
        /// Difference in colour that counts as noise.
        pub noise: f32 [0.01..=1.0] = 0.1,
    }
}

/// Mean squared difference between the surroundings of two pixels.
fn difference(cfg: &Nlm, color: &Frame<Vec4>, a: IVec2, b: IVec2) -> f32 {
    let mut sum = 0.0;
    for y in -cfg.patch..=cfg.patch {
        for x in -cfg.patch..=cfg.patch {
            let by = ivec2(x, y);
            sum += (color.load(a + by) - color.load(b + by)).truncate().length_squared();
        }
    }
    let side = 2 * cfg.patch + 1;
    sum / (3 * side * side) as f32
}

pub fn nlm(cfg: &Nlm, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    let mut total = 0.0;
    for y in -cfg.search..=cfg.search {
        for x in -cfg.search..=cfg.search {
            let there = pixel + ivec2(x, y);
            let weight = (-difference(cfg, color, pixel, there) / (cfg.noise * cfg.noise)).exp();
            sum += color.load(there) * weight;
            total += weight;
        }
    }
    sum / total
}
