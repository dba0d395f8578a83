//! A histogram of the logarithm of luminance, counted in workgroup memory first: the first pass of Alex Tardif, "Adaptive
//! Exposure from Luminance Histograms" (2019).

use straightline_kernels::prelude::*;

/// Luminance below which a pixel counts in the first bin, because its logarithm is meaningless.
const EPSILON: f32 = 0.005;

/// Bin of a colour: 1 to 255 for logarithms from `least`, in a range whose inverse is `inverse_range`.
fn bin(colour: Vec3, least: f32, inverse_range: f32) -> usize {
    let luminance = colour.dot(vec3(0.2127, 0.7152, 0.0722));
    if luminance < EPSILON {
        return 0;
    }
    let share = saturate((luminance.log2() - least) * inverse_range);
    (share * 254.0 + 1.0) as usize
}

pub fn luminance_histogram(
    color: &Frame<Vec4>,
    least: f32,
    inverse_range: f32,
    counts: &AtomicShared<[u32; 256]>,
    bins: &AtomicBuffer<u32>,
    group: &Workgroup<16, 16>,
) {
    group.each(|thread| {
        if thread.inside {
            let colour = color.load(thread.pixel).truncate();
            counts.add(bin(colour, least, inverse_range), 1);
        }
    });
    group.each(|thread| {
        bins.add(thread.index, counts.load(thread.index));
    });
}
