//! Guards of quad filters: depths that are not NaN, and colours that are finite.

use crate::prelude::*;

/// Larger than any depth, and finite: subtracting the sky's infinite depth from itself would be NaN.
pub(super) const DEEPEST: f32 = 1.0e30;

/// Smaller than any depth of a surface, and not flushed to 0 by any device.
pub(super) const NEAREST: f32 = 1.0e-30;

/// Larger than any colour. The difference of two colours is still finite, as messages by derivatives require.
pub(super) const BRIGHTEST: f32 = 1.5e38;

/// `depth`, clamped to at most 1e30; infinite and NaN depths become 1e30.
pub(super) fn bounded(depth: Quad<f32>) -> Quad<f32> {
    depth.abs().lt(DEEPEST).select(depth, Quad::splat(DEEPEST))
}

/// Returns whether a component of a colour is finite. By comparison, which is false for a NaN: quads have no bit tests.
pub(super) fn is_bright(component: Quad<f32>) -> Quad<bool> {
    component.abs().lt(BRIGHTEST)
}

/// Returns whether the first three components of a colour are finite.
pub(super) fn is_bright_color(color: Quad<Vec3>) -> Quad<bool> {
    is_bright(color.x()) & is_bright(color.y()) & is_bright(color.z())
}

/// Replacement for a texel that must not count: black, and so far from every depth, even the sky's, that it has no weight.
pub(super) fn no_surface() -> Quad<Vec4> {
    Quad::splat(vec4(0.0, 0.0, 0.0, -DEEPEST))
}
