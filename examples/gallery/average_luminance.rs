//! The average luminance of a histogram, by one workgroup: the second pass of Alex Tardif, "Adaptive Exposure from Luminance
//! Histograms" (2019). Dispatched over one pixel. The last frame's average blends into this one's over time.

use straightline_kernels::prelude::*;

pub fn average_luminance(
    bins: &Buffer<u32>,
    least: f32,
    range: f32,
    pixels: f32,
    last: f32,
    share: f32,
    sums: &Shared<[f32; 256]>,
    group: &Workgroup<16, 16>,
) -> PerThread<f32> {
    let dark = group.each(|thread| {
        let count = bins.load(thread.index) as f32;
        // The first bin's weight is 0, so the darkest pixels are ignored.
        sums.store(thread.index, count * thread.index as f32);
        bins.load(0) as f32
    });
    for step in 0..8 {
        let cutoff = 128 >> step;
        group.each(|thread| {
            if thread.index < cutoff {
                sums.store(thread.index, sums.load(thread.index) + sums.load(thread.index + cutoff));
            }
        });
    }
    group.each(|thread| {
        let lit = (pixels - dark.of(thread)).max(1.0);
        let average = sums.load(0) / lit - 1.0;
        let luminance = (average / 254.0 * range + least).exp2();
        last + (luminance - last) * share
    })
}
