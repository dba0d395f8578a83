//! Joint bilateral upsampling: a small picture enlarged along the edges of a large depth buffer (Kopf et al. 2007).

use straightline_kernels::prelude::*;

options! {
    /// What the upsampling is made of.
    pub struct Upsampling {
        /// How fast a texel's weight falls with its relative difference in depth.
        pub sharpness: f32 [0.0..=1000.0] = 60.0,
    }
}

/// `low` at the resolution of `depth`: the four texels around, those at the pixel's own depth counting most.
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
            // Never 0 altogether: where nothing fits, the nearest texels have to do.
            let weight = tent * (-cfg.sharpness * difference).exp() + 1.0e-6;
            sum += weight * low.load(at);
            total += weight;
        }
    }
    sum / total
}
