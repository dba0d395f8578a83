//! Toon shading: colours in few steps, outlines where a detector of edges found some.

use straightline_kernels::prelude::*;

options! {
    /// How a toon picture is made.
    pub struct Toon {
        /// Steps of brightness.
        pub steps: i32 [2..=16] = 4,
        /// How dark outlines are: 0 leaves them out, 1 is black.
        pub ink: f32 [0.0..=1.0] = 0.85,
        /// Share of an edge below which there is no outline.
        pub least: f32 [0.0..=1.0] = 0.4,
    }
}

/// `color` in steps of brightness that keep its hue, darkened where `edges` (red, 0 to 1) says that there is an edge.
pub fn toon(cfg: &Toon, color: &Frame<Vec4>, edges: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let own = color.load(pixel).xyz();
    // Steps are even to the eye: of the square root of light.
    let light = own.dot(vec3(0.2126, 0.7152, 0.0722)).max(1.0e-4);
    let seen = light.sqrt() * cfg.steps as f32;
    let step = (seen.floor() + 0.5) / cfg.steps as f32;
    let flat = own * (step * step / light);
    let edge = edges.load(pixel).x;
    let ink = if edge > cfg.least { cfg.ink * edge } else { 0.0 };
    (flat * (1.0 - ink)).extend(1.0)
}
