//! A step of the edge-avoiding à-trous wavelet transform (Dammertz, Sewtz, Hanika and Lensch 2010), with the edge-stopping
//! functions of SVGF (Schied et al. 2017).

use straightline_kernels::prelude::*;

/// Weights of the B3 spline.
const WEIGHTS: [f32; 3] = [3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];

fn luma(color: Vec4) -> f32 {
    color.truncate().dot(vec3(0.2126, 0.7152, 0.0722))
}

/// Filters `color` with holes `spacing` pixels wide. Run once for each `spacing` of 1, 2, 4, ...
pub fn atrous(
    color: &Frame<Vec4>,
    normal: &Frame<Vec3>,
    depth: &Frame<f32>,
    spacing: i32,
    sigma: f32,
    pixel: IVec2,
) -> Vec4 {
    let here = color.load(pixel);
    let facing = normal.load(pixel);
    let distance = depth.load(pixel);
    let mut total = WEIGHTS[0] * WEIGHTS[0];
    let mut sum = here * total;
    for y in -2i32..=2 {
        for x in -2i32..=2 {
            if x == 0 && y == 0 {
                continue;
            }
            let at = pixel + ivec2(x, y) * spacing;
            let kernel = WEIGHTS[x.unsigned_abs() as usize] * WEIGHTS[y.unsigned_abs() as usize];
            let there = color.load(at);
            let by_normal = facing.dot(normal.load(at)).max(0.0).powf(128.0);
            let reach = ivec2(x, y).as_vec2().length() * spacing as f32;
            let by_depth = (distance - depth.load(at)).abs() / (0.05 * reach);
            let by_luma = (luma(here) - luma(there)).abs() / sigma;
            let weight = kernel * by_normal * (-by_depth - by_luma).exp();
            total += weight;
            sum += there * weight;
        }
    }
    sum / total
}
