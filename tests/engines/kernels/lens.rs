//! Numbers of the camera: planes and projection have to be those of the engine's camera.

use straightline_kernels::prelude::*;

/// The planes, a scale of the projection, and one of its inverse, over a picture that is not shown.
pub fn lens(
    color: &Frame<Vec4>,
    near: f32,
    far: f32,
    projection: Mat4,
    inverse_projection: Mat4,
    pixel: IVec2,
) -> Vec4 {
    let hidden = color.load(pixel) * 0.0;
    vec4(near, far, projection.x_axis.x, inverse_projection.y_axis.y) + hidden
}
