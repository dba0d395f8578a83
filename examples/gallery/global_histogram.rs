//! The histogram of `luminance_histogram.rs` (Tardif 2019), counted in one buffer by all pixels.

use straightline_kernels::prelude::*;

/// Luminance below which a pixel counts in the first bin.
const EPSILON: f32 = 0.005;

pub fn global_histogram(color: &Frame<Vec4>, least: f32, inverse_range: f32, bins: &AtomicBuffer<u32>, pixel: IVec2) {
    let luminance = color.load(pixel).truncate().dot(vec3(0.2127, 0.7152, 0.0722));
    if luminance < EPSILON {
        bins.add(0, 1);
        return;
    }
    let share = saturate((luminance.log2() - least) * inverse_range);
    bins.add((share * 254.0 + 1.0) as usize, 1);
}
