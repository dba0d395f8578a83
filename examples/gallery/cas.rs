//! Contrast adaptive sharpening (Lottes, FidelityFX CAS, 2019), without scaling.

use straightline_kernels::prelude::*;

/// Sharpens `color`, least at `sharpness` 0 and most at 1.
pub fn cas(color: &Frame<Vec4>, sharpness: f32, pixel: IVec2) -> Vec4 {
    let load = |x, y| color.load(pixel + ivec2(x, y)).truncate();
    let (a, b, c) = (load(-1, -1), load(0, -1), load(1, -1));
    let (d, e, f) = (load(-1, 0), load(0, 0), load(1, 0));
    let (g, h, i) = (load(-1, 1), load(0, 1), load(1, 1));

    // Extremes of the cross, plus those with the corners.
    let mut least = d.min(e).min(f).min(b).min(h);
    let mut most = d.max(e).max(f).max(b).max(h);
    least += least.min(a).min(c).min(g).min(i);
    most += most.max(a).max(c).max(g).max(i);

    // Headroom until a colour clips.
    let room = (least.min(2.0 - most) / most).clamp(Vec3::ZERO, Vec3::ONE);
    let peak = -1.0 / mix(8.0, 5.0, sharpness);
    let weight = room.map(f32::sqrt) * peak;
    let sharpened = ((b + d + f + h) * weight + e) / (1.0 + 4.0 * weight);
    sharpened.clamp(Vec3::ZERO, Vec3::ONE).extend(1.0)
}
