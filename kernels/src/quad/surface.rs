//! What filters of quads take for a surface: depths that are numbers, and colours that are finite.

use crate::prelude::*;

/// More than any depth, and finite: the sky's infinite depth less itself is not a number.
pub(super) const DEEPEST: f32 = 1.0e30;

/// Less than any depth of a surface, and no number that a device takes for 0.
pub(super) const NEAREST: f32 = 1.0e-30;

/// More than any colour: the difference of two is finite, as a message by derivatives needs it.
pub(super) const BRIGHTEST: f32 = 1.5e38;

/// `depth`, at most 1e30; what is infinite or not a number is as deep.
pub(super) fn bounded(depth: Quad<f32>) -> Quad<f32> {
    depth.abs().lt(DEEPEST).select(depth, Quad::splat(DEEPEST))
}

/// Whether a component of a colour is a finite number. A comparison, which a NaN fails: quads have no test of bits.
pub(super) fn is_bright(component: Quad<f32>) -> Quad<bool> {
    component.abs().lt(BRIGHTEST)
}

/// Whether the first three components of a colour are finite numbers.
pub(super) fn is_bright_color(color: Quad<Vec3>) -> Quad<bool> {
    is_bright(color.x()) & is_bright(color.y()) & is_bright(color.z())
}

/// What stands for a texel that must not count: black, and so far from every depth, the sky's too, that it has no weight.
pub(super) fn no_surface() -> Quad<Vec4> {
    Quad::splat(vec4(0.0, 0.0, 0.0, -DEEPEST))
}
