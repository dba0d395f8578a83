//! Fog by distance: an engine's depth has to be the distance along the view, whatever the engine stores.

use straightline_kernels::prelude::*;

options! {
    /// Options of the fog.
    pub struct Fog {
        /// Share of the light that one scene unit of fog keeps from the viewer.
        pub density: f32 [0.0..=1.0] = 0.125,
    }
}

/// The picture in grey fog, and the distance in alpha.
pub fn fog(cfg: &Fog, color: &Frame<Vec4>, depth: &Frame<f32>, pixel: IVec2) -> Vec4 {
    let distance = depth.load(pixel);
    let seen = (-cfg.density * distance).exp();
    let lit = color.load(pixel).truncate() * seen + Vec3::splat(0.5) * (1.0 - seen);
    lit.extend(distance)
}
