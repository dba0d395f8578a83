//! Kuwahara filter: painterly smoothing (Kuwahara et al. 1976).

use straightline_kernels::prelude::*;

options! {
    /// Options of the Kuwahara filter.
    pub struct Kuwahara {
        /// Side of each of the four quadrants, minus one, in pixels.
        pub radius: i32 [1..=5] = 3,
    }
}

/// Mean of the quadrant with the least variance.
pub fn kuwahara(cfg: &Kuwahara, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let count = ((cfg.radius + 1) * (cfg.radius + 1)) as f32;
    let mut best = Vec3::ZERO;
    let mut least = f32::MAX;
    for quarter in [ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 1), ivec2(1, 1)] {
        let mut sum = Vec3::ZERO;
        let mut squares = Vec3::ZERO;
        for y in 0..=cfg.radius {
            for x in 0..=cfg.radius {
                let tap = color.load(pixel + ivec2(x, y) * quarter).truncate();
                sum += tap;
                squares += tap * tap;
            }
        }
        let mean = sum / count;
        let variance = (squares / count - mean * mean).element_sum();
        if variance < least {
            least = variance;
            best = mean;
        }
    }
    best.extend(color.load(pixel).w)
}
