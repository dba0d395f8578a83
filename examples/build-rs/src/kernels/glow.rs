//! Light that spills over from bright areas.

use straightline_kernels::prelude::*;

options! {
    /// Options of the glow.
    pub struct Glow {
        /// Radius of the glow, in pixels.
        pub radius: i32 [1..=4] = 2,
        /// Brightness above which a pixel spills light.
        pub threshold: f32 [0.0..=1.0] = 0.7,
        /// Share of the light that spills.
        pub strength: f32 [0.0..=4.0] = 0.8,
    }
}

/// Adds the light that spills into each pixel to the picture, most of it from close by.
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
