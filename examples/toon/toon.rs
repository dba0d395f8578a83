//! Toon shading: colours in a few steps, and outlines where an edge detector found some.

use straightline_kernels::prelude::*;

options! {
    /// Options of the toon shading.
    pub struct Toon {
        /// Number of brightness steps.
        pub steps: i32 [2..=16] = 4,
        /// Darkness of outlines: 0 is none, 1 is black.
        pub ink: f32 [0.0..=1.0] = 0.85,
        /// Edge strength below which there is no outline.
        pub least: f32 [0.0..=1.0] = 0.4,
    }
}

/// Quantises the brightness of `color`, keeps its hue, and darkens it where `edges` (red, 0 to 1) reports an edge.
pub fn toon(cfg: &Toon, color: &Frame<Vec4>, edges: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let own = color.load(pixel).xyz();
    // Perceptually even steps: of the square root of light.
    let light = own.dot(vec3(0.2126, 0.7152, 0.0722)).max(1.0e-4);
    let seen = light.sqrt() * cfg.steps as f32;
    let step = (seen.floor() + 0.5) / cfg.steps as f32;
    let flat = own * (step * step / light);
    let edge = edges.load(pixel).x;
    let ink = if edge > cfg.least { cfg.ink * edge } else { 0.0 };
    (flat * (1.0 - ink)).extend(1.0)
}
