//! Joint bilateral upsampling: a small picture enlarged along the edges of a large depth buffer (Kopf et al. 2007).

use straightline_kernels::prelude::*;

options! {
    /// Options of the upsampling.
    pub struct Upsampling {
        /// Falloff of a texel's weight with its relative difference in depth.
        pub sharpness: f32 [0.0..=1000.0] = 60.0,
    }
}

/// Resamples `low` at the resolution of `depth` from the nearest four texels, weighted towards those at the pixel's own depth.
pub fn joint_bilateral_upsampling(
    cfg: &Upsampling,
    low: &Texture<Vec4>,
    low_depth: &Texture<f32>,
    depth: &Frame<f32>,
    pixel: IVec2,
) -> Vec4 {
    let here = depth.load(pixel);
    let place = (pixel.as_vec2() + 0.5) / depth.size().as_vec2() * low.size().as_vec2() - 0.5;
    let corner = place.floor();
    let t = place - corner;
    let mut sum = Vec4::ZERO;
    let mut total = 0.0;
    for y in 0..2 {
        for x in 0..2 {
            let at = corner.as_ivec2() + ivec2(x, y);
            let tent = (if x == 0 { 1.0 - t.x } else { t.x }) * (if y == 0 { 1.0 - t.y } else { t.y });
            let difference = (low_depth.load(at) - here).abs() / here.max(1.0e-6);
            // Never quite 0: where no texel fits, the nearest ones are used.
            let weight = tent * (-cfg.sharpness * difference).exp() + 1.0e-6;
            sum += weight * low.load(at);
            total += weight;
        }
    }
    sum / total
}
