//! Ground-truth ambient occlusion (Jimenez, Wu, Pesce and Jarabo, Practical real-time strategies for accurate indirect occlusion,
//! 2016): horizons on both sides of a few slices, and the integral of the light between them.

use std::f32::consts::{FRAC_PI_2, PI};
use straightline_kernels::prelude::*;

const SLICES: i32 = 3;
const STEPS: i32 = 6;

/// Position of a pixel in view space: x right, y down, z away. At distance 1, one unit is `focal` pixels wide.
fn position(depth: &Frame<f32>, at: IVec2, focal: f32) -> Vec3 {
    let centre = at.as_vec2() + 0.5 - 0.5 * depth.size().as_vec2();
    let z = depth.load(at);
    (centre / focal * z).extend(z)
}

/// Integral of the cosine to a normal at angle `n`, from the horizon at `h`.
fn arc(h: f32, n: f32) -> f32 {
    0.25 * (-(2.0 * h - n).cos() + n.cos() + 2.0 * h * n.sin())
}

/// `depth` is the distance along the view; `normal` is in view space with y up and z towards the viewer.
pub fn gtao(depth: &Frame<f32>, normal: &Frame<Vec3>, radius: f32, focal: f32, pixel: IVec2) -> Vec4 {
    let here = position(depth, pixel, focal);
    let view = -here.normalize();
    let facing = normal.load(pixel) * vec3(1.0, -1.0, -1.0);
    // Radius in pixels at this depth.
    let reach = (radius * focal / here.z).clamp(1.0, 64.0);
    let turn = fract(52.982_918 * fract(0.06711056 * pixel.x as f32 + 0.00583715 * pixel.y as f32));

    let mut visible = 0.0;
    for slice in 0..SLICES {
        let angle = (slice as f32 + turn) * PI / SLICES as f32;
        let (sin, cos) = angle.sin_cos();
        let direction = vec2(cos, sin);
        let tangent = direction.extend(0.0) - view * view.dot(direction.extend(0.0));
        let axis = tangent.cross(view).normalize();
        let projected = facing - axis * facing.dot(axis);
        let length = projected.length();
        if length < 1.0e-4 {
            continue;
        }
        let cos_n = (projected.dot(view) / length).clamp(-1.0, 1.0);
        let n = sign(projected.dot(tangent)) * cos_n.acos();

        // Cosine of the horizon on both sides, initially that of the surface itself.
        let mut horizons = [(-FRAC_PI_2 + n).cos(), (FRAC_PI_2 + n).cos()];
        for (side, horizon) in [-1.0, 1.0].into_iter().zip(horizons.iter_mut()) {
            for step in 1..=STEPS {
                let along = direction * (side * reach * step as f32 / STEPS as f32);
                let at = pixel + (along + 0.5).floor().as_ivec2();
                let to = position(depth, at, focal) - here;
                let distance = to.length();
                if at == pixel || distance > radius {
                    continue;
                }
                *horizon = horizon.max(to.dot(view) / distance);
            }
        }
        let left = n + (-horizons[0].clamp(-1.0, 1.0).acos() - n).max(-FRAC_PI_2);
        let right = n + (horizons[1].clamp(-1.0, 1.0).acos() - n).min(FRAC_PI_2);
        visible += length * (arc(left, n) + arc(right, n));
    }
    Vec3::splat((visible / SLICES as f32).clamp(0.0, 1.0)).extend(1.0)
}
