//! Ambient occlusion that is blurred along surfaces and darkens a picture.
//!
//! The kernel is `kernels/filters/ssao.rs`.

use super::ssao::{Ssao, ssao};
use straightline_kernels::prelude::*;

/// Radius of the blur, in texels.
const RADIUS: i32 = 3;

/// Share of the depth by which a texel of another surface differs.
const APART: f32 = 0.02;

/// Mean along one direction of the texels on the pixel's own surface.
fn along(open: &Frame<f32>, depth: &Frame<f32>, pixel: IVec2, step: IVec2) -> f32 {
    let here = depth.load(pixel);
    let mut sum = 0.0;
    let mut total = 0.0;
    for tap in -RADIUS..=RADIUS {
        let at = pixel + step * tap;
        let apart = (depth.load(at) - here).abs() / (APART * here);
        let weight = (1.0 - apart).max(0.0);
        sum += weight * open.load(at);
        total += weight;
    }
    // The pixel's own texel weighs 1.
    sum / total
}

/// Darkens what little light from around reaches.
pub fn occlusion(cfg: &Ssao, color: &Frame<Vec4>, depth: &Frame<f32>, normal: &Frame<Vec3>) -> Frame<Vec4> {
    let open: Frame<f32> = draw(color.size(), |pixel| ssao(cfg, depth, normal, pixel).x);
    let rows: Frame<f32> = draw(color.size(), |pixel| along(&open, depth, pixel, ivec2(1, 0)));
    draw(color.size(), |pixel| {
        let open = along(&rows, depth, pixel, ivec2(0, 1));
        (color.load(pixel).truncate() * open).extend(1.0)
    })
}
