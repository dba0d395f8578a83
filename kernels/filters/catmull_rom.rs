//! Bicubic resampling with the Catmull-Rom kernel.

use straightline_kernels::prelude::*;

/// Weights of the texels at -1, 0, 1 and 2 for a position `t` past the texel at 0.
fn weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        -0.5 * t3 + t2 - 0.5 * t,
        1.5 * t3 - 2.5 * t2 + 1.0,
        -1.5 * t3 + 2.0 * t2 + 0.5 * t,
        0.5 * t3 - 0.5 * t2,
    ]
}

/// Resamples `image` at the output's resolution. The curve passes through the texels, without the blur of a linear filter.
pub fn catmull_rom(image: &Texture<Vec4>, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let place = (pixel.as_vec2() + 0.5) / resolution.as_vec2() * image.size().as_vec2() - 0.5;
    let corner = place.floor();
    let t = place - corner;
    let (across, down) = (weights(t.x), weights(t.y));
    let mut sum = Vec4::ZERO;
    for y in 0..4 {
        let mut row = Vec4::ZERO;
        for x in 0..4 {
            row += across[x] * image.load(corner.as_ivec2() + ivec2(x as i32 - 1, y as i32 - 1));
        }
        sum += down[y] * row;
    }
    sum
}
