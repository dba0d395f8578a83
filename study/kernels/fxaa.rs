//! FXAA with its default options, its loops left in the shader: a pixel without contrast returns early, a search that has ended
//! reads no more, and strides come from a table.

use straightline_kernels::prelude::*;

const THRESHOLD: f32 = 0.125;
const THRESHOLD_MIN: f32 = 0.0312;
const SUBPIXEL: f32 = 0.75;
const STRIDES: [f32; 8] = [1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 2.0, 2.0];

fn luma(color: Vec4) -> f32 {
    color.truncate().dot(vec3(0.299, 0.587, 0.114))
}

/// Equals `fxaa`, bit for bit.
pub fn fxaa(color: &Frame<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut around = [0.0; 9];
    for k in 0..9 {
        around[k] = luma(color.load(pixel + ivec2(k as i32 % 3 - 1, k as i32 / 3 - 1)));
    }
    let [_, n, _, w, m, e, _, s, _] = around;
    let brightest = m.max(n).max(s).max(w).max(e);
    let contrast = brightest - m.min(n).min(s).min(w).min(e);
    #[cfg_attr(false, branch)]
    if contrast < THRESHOLD_MIN.max(brightest * THRESHOLD) {
        here
    } else {
        smoothed(color, linear, pixel, around, contrast)
    }
}

/// Colour of a pixel with an edge.
fn smoothed(color: &Frame<Vec4>, linear: &Sampler, pixel: IVec2, around: [f32; 9], contrast: f32) -> Vec4 {
    let texel = Vec2::ONE / color.size().as_vec2();
    let at = (pixel.as_vec2() + 0.5) * texel;
    let [nw, n, ne, w, m, e, sw, s, se] = around;
    // Direction of the edge, and the side of the pixel it is on.
    let across_rows = (nw + sw - 2.0 * w).abs() + 2.0 * (n + s - 2.0 * m).abs() + (ne + se - 2.0 * e).abs();
    let across_columns = (nw + ne - 2.0 * n).abs() + 2.0 * (w + e - 2.0 * m).abs() + (sw + se - 2.0 * s).abs();
    let horizontal = across_rows >= across_columns;
    let (before, after) = if horizontal { (n, s) } else { (w, e) };
    let steeper = (before - m).abs() >= (after - m).abs();
    let gradient = 0.25 * (before - m).abs().max((after - m).abs());
    let side = if steeper { -1.0 } else { 1.0 };
    let edge = 0.5 * (m + if steeper { before } else { after });
    let normal = if horizontal {
        vec2(0.0, texel.y)
    } else {
        vec2(texel.x, 0.0)
    };
    let along = if horizontal {
        vec2(texel.x, 0.0)
    } else {
        vec2(0.0, texel.y)
    };

    // Search for both ends of the edge.
    let start = at + 0.5 * side * normal;
    let mut ends = [0.0; 2];
    let mut lumas = [0.0; 2];
    for k in 0..2 {
        let way = if k == 0 { -1.0 } else { 1.0 };
        let mut going = true;
        let mut end = 0.0;
        let mut last = 0.0;
        for step in 0..8 {
            #[cfg_attr(false, branch)]
            if going {
                end += STRIDES[step];
                last = luma(color.sample(linear, start + way * end * along)) - edge;
                going = last.abs() < gradient;
            }
        }
        ends[k] = end;
        lumas[k] = last;
    }
    let nearest = ends[0].min(ends[1]);
    let luma_there = if ends[0] < ends[1] { lumas[0] } else { lumas[1] };
    let crosses = (m - edge < 0.0) != (luma_there < 0.0);
    let by_edge = if crosses {
        0.5 - nearest / (ends[0] + ends[1])
    } else {
        0.0
    };

    let mean = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
    let alone = smoothstep(0.0, 1.0, saturate((mean - m).abs() / contrast.max(1.0e-6)));
    let shift = by_edge.max(alone * alone * SUBPIXEL);
    color.sample(linear, at + shift * side * normal)
}
