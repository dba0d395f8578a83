//! Detects flips of the image, vertical and horizontal: a filter whose result differs from its mirror image's.

use straightline_kernels::prelude::*;

options! {
    /// Weights of the mixture.
    pub struct Orientation {
        /// Weight of the pixel two rows below.
        pub below: f32 [0.0..=1.0] = 0.5,
    }
}

/// A mixture of the pixel, the one to its right and the one two rows below.
pub fn orientation(cfg: &Orientation, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let right = color.load(pixel + ivec2(1, 0));
    let below = color.load(pixel + ivec2(0, 2));
    let across = here.x * 0.5 + right.y * 0.25;
    vec4(across, right.y, below.z * cfg.below + here.z * 0.25, 1.0)
}
