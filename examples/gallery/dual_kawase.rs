//! Downsampling by the dual filter (Bjørge, Bandwidth-efficient rendering, 2015): blurs a picture to half its size in five reads.

use straightline_kernels::prelude::*;

pub fn dual_kawase(image: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
    let half_pixel = 0.5 / resolution.as_vec2();
    let mut sum = image.sample(linear, uv) * 4.0;
    for corner in [vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(-1.0, 1.0), vec2(1.0, 1.0)] {
        sum += image.sample(linear, uv + corner * half_pixel);
    }
    sum / 8.0
}
