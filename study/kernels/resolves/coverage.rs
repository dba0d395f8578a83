//! Coverage sampling: each of a pixel's sixteen samples selects one of four stored colours.

use straightline_kernels::prelude::*;

/// Colour of `pixel`: the mean of the stored colours, a layer of `colors` each, weighted by their number of samples. A sample
/// has four bits of `codes`, from the lowest of `x` on: the layer, or 15 if it sees none of the stored surfaces.
pub fn coverage(codes: &Frame<UVec2>, colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    let words = codes.load(pixel);
    let mut counts = [0u32; 4];
    for sample in 0..16u32 {
        let word = if sample < 8 { words.x } else { words.y };
        let code = (word >> (sample % 8 * 4)) & 15;
        for stored in 0..4u32 {
            counts[stored as usize] += (code == stored) as u32;
        }
    }
    let mut sum = Vec4::ZERO;
    for stored in 0..4 {
        sum += counts[stored] as f32 * colors.load(pixel, stored);
    }
    sum / (counts[0] + counts[1] + counts[2] + counts[3]) as f32
}
