//! Gaussian blur, one axis at a time.

use straightline_kernels::prelude::*;

/// Direction of one of the two passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along rows.
    Horizontal,
    /// Along columns.
    Vertical,
}

options! {
    /// Options of the blur.
    pub struct Gaussian {
        /// Direction of this pass.
        pub axis: Axis = Axis::Horizontal,
        /// Radius of the blur, in pixels.
        pub radius: i32 [1..=16] = 6,
        /// Standard deviation in pixels.
        pub sigma: f32 [0.3..=16.0] = 2.5,
    }
}

/// Blurs the picture along one axis. The weights are computed when the shader is generated.
pub fn gaussian(cfg: &Gaussian, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let along = match cfg.axis {
        Axis::Horizontal => ivec2(1, 0),
        Axis::Vertical => ivec2(0, 1),
    };
    let mut sum = Vec4::ZERO;
    let mut total = 0.0;
    for tap in -cfg.radius..=cfg.radius {
        let x = tap as f32 / cfg.sigma;
        let weight = (-0.5 * x * x).exp();
        sum += weight * color.load(pixel + along * tap);
        total += weight;
    }
    sum / total
}
