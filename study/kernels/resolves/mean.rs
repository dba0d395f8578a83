//! The mean of the samples of a pixel, as supersampling and multisampling resolve them.

use straightline_kernels::prelude::*;

/// Of four, a layer of `colors` each.
pub fn mean4(colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    mean::<4>(colors, pixel)
}

/// Of sixteen.
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
