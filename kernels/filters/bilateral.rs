//! Bilateral filter: averages noise away and keeps edges (Tomasi and Manduchi 1998).

use straightline_kernels::prelude::*;

options! {
    /// Options of the bilateral filter.
    pub struct Bilateral {
        /// Radius of the filter, in pixels.
        pub radius: i32 [1..=6] = 3,
        /// Standard deviation on the screen, in pixels.
        pub sigma: f32 [0.3..=6.0] = 1.8,
        /// Standard deviation in colour.
        pub tolerance: f32 [0.001..=1.0] = 0.15,
    }
}

/// Mean of the neighbours that look like the pixel, weighted towards the near ones.
pub fn bilateral(cfg: &Bilateral, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let centre = color.load(pixel);
    let mut sum = Vec3::ZERO;
    let mut total = 0.0;
    for y in -cfg.radius..=cfg.radius {
        for x in -cfg.radius..=cfg.radius {
            let tap = color.load(pixel + ivec2(x, y)).truncate();
            let space = (x * x + y * y) as f32 / (2.0 * cfg.sigma * cfg.sigma);
            let range = tap.distance_squared(centre.truncate()) / (2.0 * cfg.tolerance * cfg.tolerance);
            let weight = (-space - range).exp();
            sum += weight * tap;
            total += weight;
        }
    }
    (sum / total).extend(centre.w)
}
