//! Robust contrast adaptive sharpening (Lottes, FidelityFX Super Resolution 1.0, 2021), with noise suppression.

use straightline_kernels::prelude::*;

/// Strongest negative lobe.
const LIMIT: f32 = 0.25 - 1.0 / 16.0;

/// Twice the luma.
fn luma(c: Vec3) -> f32 {
    c.z * 0.5 + (c.x * 0.5 + c.y)
}

fn max3(v: Vec3) -> f32 {
    v.x.max(v.y).max(v.z)
}

/// Sharpens `color`, most at `stops` 0 and half as much with each further stop.
pub fn rcas(color: &Frame<Vec4>, stops: f32, pixel: IVec2) -> Vec4 {
    let load = |x, y| color.load(pixel + ivec2(x, y)).truncate();
    let (b, d, e, f, h) = (load(0, -1), load(-1, 0), load(0, 0), load(1, 0), load(0, 1));
    let [bl, dl, el, fl, hl] = [b, d, e, f, h].map(luma);

    let mean = 0.25 * (bl + dl + fl + hl);
    let most = bl.max(dl).max(el).max(fl).max(hl);
    let least = bl.min(dl).min(el).min(fl).min(hl);
    let range = most - least;
    let noise = if range > 0.0 {
        saturate((mean - el).abs() / range)
    } else {
        0.0
    };
    let noise = -0.5 * noise + 1.0;

    // Lobe at which the result would clip to white or black.
    let least = b.min(d).min(f).min(h);
    let most = b.max(d).max(f).max(h);
    let hit_least = least.min(e) / (4.0 * most);
    let hit_most = (1.0 - most.max(e)) / (4.0 * least - 4.0);
    let lobe = max3((-hit_least).max(hit_most));
    let lobe = lobe.clamp(-LIMIT, 0.0) * (-stops).exp2() * noise;
    ((lobe * (b + d + h + f) + e) / (4.0 * lobe + 1.0)).extend(1.0)
}
