//! Fast approximate antialiasing, after version 3.11 (Lottes 2011).

use straightline_kernels::prelude::*;

options! {
    /// Options of FXAA.
    pub struct Fxaa {
        /// Contrast, relative to the brightest neighbour, above which a pixel is filtered.
        pub threshold: f32 [0.03..=0.5] = 0.125,
        /// Contrast below which nothing is filtered.
        pub threshold_min: f32 [0.0..=0.1] = 0.0312,
        /// Strength of the blur on isolated pixels.
        pub subpixel: f32 [0.0..=1.0] = 0.75,
        /// Number of steps along an edge towards each end.
        pub steps: i32 [1..=12] = 8,
    }
}

fn luma(color: Vec4) -> f32 {
    color.truncate().dot(vec3(0.299, 0.587, 0.114))
}

/// Length of step `k`, in pixels. The first steps are short.
fn stride(k: i32) -> f32 {
    match k {
        0..=2 => 1.0,
        3 => 1.5,
        4..=7 => 2.0,
        _ => 4.0,
    }
}

/// Smooths the edges of `color`, found from the colours alone.
pub fn fxaa(cfg: &Fxaa, color: &Frame<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    let texel = Vec2::ONE / color.size().as_vec2();
    let at = (pixel.as_vec2() + 0.5) * texel;
    let mut around = [0.0; 9];
    for k in 0..9 {
        around[k] = luma(color.load(pixel + ivec2(k as i32 % 3 - 1, k as i32 / 3 - 1)));
    }
    let [nw, n, ne, w, m, e, sw, s, se] = around;
    let brightest = m.max(n).max(s).max(w).max(e);
    let contrast = brightest - m.min(n).min(s).min(w).min(e);

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

    // Search for both ends of the edge. A search that has ended stops moving.
    let start = at + 0.5 * side * normal;
    let mut ends = [0.0; 2];
    let mut lumas = [0.0; 2];
    for k in 0..2 {
        let way = if k == 0 { -1.0 } else { 1.0 };
        let mut going = true;
        for step in 0..cfg.steps {
            let next = ends[k] + stride(step);
            let there = luma(color.sample(linear, start + way * next * along)) - edge;
            if going {
                ends[k] = next;
                lumas[k] = there;
            }
            going = going && there.abs() < gradient;
        }
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
    let shift = by_edge.max(alone * alone * cfg.subpixel);
    let filtered = color.sample(linear, at + shift * side * normal);
    if contrast < cfg.threshold_min.max(brightest * cfg.threshold) {
        color.load(pixel)
    } else {
        filtered
    }
}
