//! Gaussian blur: along rows, then along columns.

use straightline_kernels::prelude::*;

options! {
    /// Options of the blur.
    pub struct Blur {
        /// Radius in texels.
        pub radius: i32 [1..=16] = 4,
        /// Standard deviation in texels.
        pub sigma: f32 [0.3..=16.0] = 2.0,
    }
}

/// One direction of the blur.
fn along(cfg: &Blur, from: &Texture<Vec4>, pixel: IVec2, step: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    let mut total = 0.0;
    for tap in -cfg.radius..=cfg.radius {
        let x = tap as f32 / cfg.sigma;
        let weight = (-0.5 * x * x).exp();
        sum += weight * from.load(pixel + step * tap);
        total += weight;
    }
    sum / total
}

/// Blurs a picture.
pub fn blur(cfg: &Blur, color: &Texture<Vec4>) -> Texture<Vec4> {
    let rows: Texture<Vec4> = draw(color.size(), |pixel| along(cfg, color, pixel, ivec2(1, 0)));
    draw(color.size(), |pixel| along(cfg, &rows, pixel, ivec2(0, 1)))
}
