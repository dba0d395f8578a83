//! Normals from depths alone (Turánszki, Improved normal reconstruction from depth, 2019). In each direction the neighbour that
//! is nearer in depth is used, so that no edge is smeared.

use straightline_kernels::prelude::*;

/// Position of a pixel in view space: x right, y down, z away. At distance 1, one unit is `focal` pixels wide.
fn position(depth: &Frame<f32>, at: IVec2, focal: f32) -> Vec3 {
    let at = at.clamp(IVec2::ZERO, depth.size().as_ivec2() - 1);
    let centre = at.as_vec2() + 0.5 - 0.5 * depth.size().as_vec2();
    let z = depth.load(at);
    (centre / focal * z).extend(z)
}

/// Step to a neighbour on the same surface, towards positive coordinates.
fn tangent(depth: &Frame<f32>, pixel: IVec2, along: IVec2, focal: f32) -> Vec3 {
    let here = position(depth, pixel, focal);
    let ahead = position(depth, pixel + along, focal) - here;
    let back = here - position(depth, pixel - along, focal);
    // At the border one of the two steps is zero.
    match (ahead == Vec3::ZERO, back == Vec3::ZERO) {
        (true, _) => back,
        (_, true) => ahead,
        _ if ahead.z.abs() < back.z.abs() => ahead,
        _ => back,
    }
}

/// Normal facing the eye, -1 to 1 in each component.
pub fn normal_from_depth(depth: &Frame<f32>, focal: f32, pixel: IVec2) -> Vec4 {
    let right = tangent(depth, pixel, ivec2(1, 0), focal);
    let down = tangent(depth, pixel, ivec2(0, 1), focal);
    down.cross(right).normalize().extend(1.0)
}
