//! Enhanced subpixel morphological antialiasing, third pass: blends each pixel with its neighbours (Jimenez, Echevarria, Sousa
//! and Gutierrez, SMAA, 2012; after the reference implementation, MIT licence, https://github.com/iryoku/smaa).

use straightline_kernels::prelude::*;

pub fn smaa_blend(color: &Frame<Vec4>, weights: &Frame<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    let here = weights.load(pixel);
    let right = weights.load(pixel + ivec2(1, 0)).w;
    let below = weights.load(pixel + ivec2(0, 1)).y;
    let (above, left) = (here.x, here.z);
    if right + below + above + left < 1.0e-5 {
        return color.load(pixel);
    }
    let size = color.size().as_vec2();
    let uv = (pixel.as_vec2() + 0.5) / size;
    let horizontal = right.max(left) > below.max(above);
    let (one, other, by) = if horizontal {
        (vec2(right, 0.0), vec2(left, 0.0), vec2(right, left))
    } else {
        (vec2(0.0, below), vec2(0.0, above), vec2(below, above))
    };
    let by = by / (by.x + by.y);
    // Reads between two pixels blend them.
    by.x * color.sample(linear, uv + one / size) + by.y * color.sample(linear, uv - other / size)
}
