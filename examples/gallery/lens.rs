//! Correction of a lens's distortion (Brown 1966). Newton's method finds the image position of an undistorted ray.

use straightline_kernels::prelude::*;

/// Radial distortion: the radius at which a ray at `radius` is seen.
fn distorted(radius: f32, k1: f32, k2: f32) -> f32 {
    let square = radius * radius;
    radius * (1.0 + square * (k1 + square * k2))
}

/// Inverse of the distortion: the radius of a ray that is seen at `seen`.
fn undistorted(seen: f32, k1: f32, k2: f32) -> f32 {
    let mut radius = seen;
    for _ in 0..20 {
        let square = radius * radius;
        let slope = 1.0 + square * (3.0 * k1 + square * 5.0 * k2);
        let step = (distorted(radius, k1, k2) - seen) / slope;
        radius -= step;
        if step.abs() < 1.0e-6 {
            break;
        }
    }
    radius
}

/// The image as a lens without distortion would show it. `k1` and `k2` are for radii in units of half the picture's height.
pub fn lens(image: &Texture<Vec4>, linear: &Sampler, k1: f32, k2: f32, resolution: UVec2, pixel: IVec2) -> Vec4 {
    let size = resolution.as_vec2();
    let from = (pixel.as_vec2() + 0.5 - 0.5 * size) / (0.5 * size.y);
    let seen = from.length();
    if seen < 1.0e-6 {
        return image.sample(linear, vec2(0.5, 0.5));
    }
    let at = from * (undistorted(seen, k1, k2) / seen);
    let uv = at * (0.5 * size.y) / size + 0.5;
    if uv.clamp(Vec2::ZERO, Vec2::ONE) != uv {
        return Vec4::ZERO;
    }
    image.sample(linear, uv)
}
