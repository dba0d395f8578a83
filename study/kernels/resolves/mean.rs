//! The mean of a pixel's samples, as in the resolve of supersampling and multisampling.

use straightline_kernels::prelude::*;

/// Mean of four samples, a layer of `colors` each.
pub fn mean4(colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    mean::<4>(colors, pixel)
}

/// Mean of sixteen samples.
pub fn mean16(colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    mean::<16>(colors, pixel)
}

fn mean<const N: usize>(colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for sample in 0..N {
        sum += colors.load(pixel, sample);
    }
    sum / N as f32
}
