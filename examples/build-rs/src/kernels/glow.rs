//! Light that spills over from bright places.

use straightline_kernels::prelude::*;

options! {
    /// What a glow is made of.
    pub struct Glow {
        /// How far light spills, in pixels.
        pub radius: i32 [1..=4] = 2,
        /// Brightness from which a place spills light.
        pub threshold: f32 [0.0..=1.0] = 0.7,
        /// How much of the light spills.
        pub strength: f32 [0.0..=4.0] = 0.8,
    }
}

/// The picture with the light that spills into each pixel, most of it from close by.
pub fn glow(cfg: &Glow, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut light = Vec3::ZERO;
    let mut sum = 0.0;
    for y in -cfg.radius..=cfg.radius {
        for x in -cfg.radius..=cfg.radius {
            let reach = cfg.radius as f32 + 1.0;
            let weight = (1.0 - x.abs() as f32 / reach) * (1.0 - y.abs() as f32 / reach);
            let tap = color.load(pixel + ivec2(x, y)).truncate();
            light += weight * (tap - cfg.threshold).max(Vec3::ZERO);
            sum += weight;
        }
    }
    let here = color.load(pixel);
    (here.truncate() + light * (cfg.strength / sum)).min(Vec3::ONE).extend(here.w)
}
