//! Parallax occlusion mapping (Tatarchuk, Practical parallax occlusion mapping, 2006): a march through the layers of a height
//! map, and one step of the secant method.

use straightline_kernels::prelude::*;

/// Colour of a surface up to `depth` deep, seen along `view` (tangent space, z towards the eye).
pub fn parallax_occlusion(
    height: &Texture<f32>,
    albedo: &Texture<Vec4>,
    linear: &Sampler,
    view: Vec3,
    depth: f32,
    resolution: UVec2,
    pixel: IVec2,
) -> Vec4 {
    let mut uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
    // More layers for a flatter view.
    let layers = mix(64.0, 16.0, view.z);
    let layer = 1.0 / layers;
    let shift = view.truncate() / view.z * depth * layer;

    let mut ray = 0.0;
    let mut below = 1.0 - height.sample(linear, uv);
    let mut below_before = below;
    while ray < below {
        uv -= shift;
        ray += layer;
        below_before = below;
        below = 1.0 - height.sample(linear, uv);
    }
    let after = ray - below;
    let before = below_before - (ray - layer);
    let found = if after + before > 0.0 {
        uv + shift * (after / (after + before))
    } else {
        uv
    };
    if found.x < 0.0 || found.x > 1.0 || found.y < 0.0 || found.y > 1.0 {
        return Vec4::ZERO;
    }
    albedo.sample(linear, found)
}
