//! Ordered dithering (Bayer 1973) to a few levels, with the matrix built from the bits of the coordinates.

use straightline_kernels::prelude::*;

/// Threshold of a pixel, in 0..1, from a matrix of 2^`bits` rows.
fn threshold(pixel: IVec2, bits: u32) -> f32 {
    let x = pixel.x as u32;
    let y = pixel.y as u32;
    let mut rank = 0;
    for bit in 0..bits {
        let (a, b) = ((x >> bit) & 1, (y >> bit) & 1);
        rank = (rank << 2) | ((a ^ b) << 1) | b;
    }
    (rank as f32 + 0.5) / (1u32 << (2 * bits)) as f32
}

pub fn ordered_dither(color: &Frame<Vec4>, levels: i32, pixel: IVec2) -> Vec4 {
    let steps = (levels - 1).max(1) as f32;
    let here = color.load(pixel);
    let dithered = (here.truncate().clamp(Vec3::ZERO, Vec3::ONE) * steps + threshold(pixel, 3)).floor() / steps;
    dithered.min(Vec3::ONE).extend(here.w)
}
