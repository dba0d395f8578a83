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

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_kernels::testing::*;

    #[test]
    fn thresholds_are_between_none_and_all() {
        for_all_in(0..=4096, |pixel: IVec2| {
            assert!(threshold(pixel, 3) > 0.0);
            assert!(threshold(pixel, 3) < 1.0);
        });
    }

    #[test]
    fn a_ramp_becomes_dots() {
        let size = uvec2(64, 16);
        let ramp: Frame<Vec4> = draw(size, |pixel| Vec3::splat(pixel.x as f32 / 63.0).extend(1.0));
        assert_picture(
            "golden/dither.png",
            size,
            |pixel| ordered_dither(&ramp, 2, pixel),
            exactly(),
        );
    }
}
