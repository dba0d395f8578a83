//! An antialiasing method for comparison by `study error`: a blur over depth edges.

use straightline_kernels::prelude::*;

options! {
    /// Options of the blur.
    pub struct EdgeBlur {
        /// Difference in depth, relative to the nearer one, from which there is an edge.
        pub step: f32 [1.0e-4..=10.0] = 0.05,
        /// Weight of each of the four neighbours beyond an edge; the pixel itself has a weight of 1.
        pub weight: f32 [0.0..=1.0] = 0.25,
    }
}

/// Mixes a pixel at an edge with the neighbours beyond the edge.
pub fn edge_blur(cfg: &EdgeBlur, color: &Frame<Vec4>, depth: &Frame<f32>, pixel: IVec2) -> Vec4 {
    let here = depth.load(pixel);
    let mut sum = color.load(pixel);
    let mut weights = 1.0;
    for to in [ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1)] {
        let there = depth.load(pixel + to);
        if (there - here).abs() > cfg.step * here.min(there) {
            sum += color.load(pixel + to) * cfg.weight;
            weights += cfg.weight;
        }
    }
    sum / weights
}
