//! Temporal antialiasing and sharpening. What one frame keeps is the `history` of the next.
//!
//! The kernels are those of `examples/gallery`.

use super::rcas::rcas;
use super::taa::taa;
use straightline_kernels::prelude::*;

/// Returns the picture to keep for the next frame, and the one to show.
pub fn temporal(
    color: &Frame<Vec4>,
    history: &Texture<Vec4>,
    velocities: &Frame<Vec2>,
    linear: &Sampler,
    share: f32,
    stops: f32,
) -> (Frame<Vec4>, Frame<Vec4>) {
    let kept: Frame<Vec4> = draw(color.size(), |pixel| {
        taa(color, history, velocities, linear, share, color.size(), pixel)
    });
    let shown: Frame<Vec4> = draw(color.size(), |pixel| rcas(&kept, stops, pixel));
    (kept, shown)
}
