//! A kernel with options that a host sets when it creates the pipeline.

use straightline_kernels::prelude::*;

options! {
    /// Options.
    pub struct Fade {
        /// Part of the colour that is kept.
        pub strength: f32 [0.0..=1.0] = 0.5,
        /// Keeps the dark parts.
        pub inverted: bool = false,
    }
}

/// Fades a picture.
pub fn faded(cfg: &Fade, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let texel = color.load(pixel);
    let kept = if cfg.inverted { Vec4::ONE - texel } else { texel };
    kept * cfg.strength
}
