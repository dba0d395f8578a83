//! The Kuwahara filter with its default options, its loops kept: all 7×7 pixels are read once, into an array.

use straightline_kernels::prelude::*;

/// As `kuwahara`, bit for bit.
pub fn kuwahara(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut texels = [Vec4::ZERO; 49];
    for k in 0..49 {
        texels[k] = color.load(pixel + ivec2(k as i32 % 7 - 3, k as i32 / 7 - 3));
    }
    let mut best = Vec3::ZERO;
    let mut least = f32::MAX;
    for quarter in 0..4 {
        // Outwards from the middle, as the original goes.
        let (right, down) = (quarter % 2 * 2 - 1, quarter / 2 * 14 - 7);
        let mut sum = Vec3::ZERO;
        let mut squares = Vec3::ZERO;
        for y in 0..4 {
            for x in 0..4 {
                let tap = texels[(24 + x * right + y * down) as usize].truncate();
                sum += tap;
                squares += tap * tap;
            }
        }
        let mean = sum / 16.0;
        let variance = (squares / 16.0 - mean * mean).element_sum();
        if variance < least {
            least = variance;
            best = mean;
        }
    }
    best.extend(texels[24].w)
}
