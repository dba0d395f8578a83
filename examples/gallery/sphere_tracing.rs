//! Sphere tracing of distance functions (Hart 1996), with hard instead of soft shadows (Quilez 2010): a ball on a plane.

use straightline_kernels::prelude::*;

const FAR: f32 = 30.0;
const CLOSE: f32 = 2.0e-4;

/// Materials that a ray can hit.
#[derive(Clone, Copy, PartialEq)]
enum Material {
    Ball,
    Ground,
}

/// Distance to the nearest surface, and its material.
fn scene(at: Vec3) -> (f32, Material) {
    let ball = (at - vec3(0.0, 1.0, 0.0)).length() - 1.0;
    let ground = at.y;
    if ball < ground {
        (ball, Material::Ball)
    } else {
        (ground, Material::Ground)
    }
}

struct Hit {
    at: Vec3,
    material: Material,
}

fn trace(from: Vec3, direction: Vec3) -> Option<Hit> {
    let mut travelled = 0.0;
    for _ in 0..160 {
        let at = from + direction * travelled;
        let (distance, material) = scene(at);
        if distance < CLOSE {
            return Some(Hit { at, material });
        }
        travelled += distance;
        if travelled > FAR {
            break;
        }
    }
    None
}

/// Gradient of the distance, from the four corners of a tetrahedron.
fn normal(at: Vec3) -> Vec3 {
    let corners = [
        vec3(1.0, -1.0, -1.0),
        vec3(-1.0, -1.0, 1.0),
        vec3(-1.0, 1.0, -1.0),
        vec3(1.0, 1.0, 1.0),
    ];
    let mut sum = Vec3::ZERO;
    for corner in corners {
        sum += corner * scene(at + corner * 1.0e-3).0;
    }
    sum.normalize()
}

/// Renders the view from a camera on a circle around the ball, at `angle` radians.
pub fn sphere_tracing(resolution: UVec2, angle: f32, pixel: IVec2) -> Vec4 {
    let size = resolution.as_vec2();
    let place = (pixel.as_vec2() + 0.5 - 0.5 * size) / size.y;
    let (sin, cos) = angle.sin_cos();
    let from = vec3(4.0 * cos, 2.0, 4.0 * sin);
    let ahead = (vec3(0.0, 0.8, 0.0) - from).normalize();
    let right = ahead.cross(Vec3::Y).normalize();
    let up = right.cross(ahead);
    let direction = (1.4 * ahead + place.x * right - place.y * up).normalize();
    let sky = vec3(0.55, 0.7, 0.9);
    let color = match trace(from, direction) {
        None => sky,
        Some(hit) => {
            let light = vec3(0.6, 0.7, 0.4).normalize();
            let normal = normal(hit.at);
            let shadowed = trace(hit.at + normal * 5.0e-3, light).is_some();
            let diffuse = if shadowed { 0.0 } else { normal.dot(light).max(0.0) };
            let albedo = match hit.material {
                Material::Ball => vec3(0.9, 0.4, 0.2),
                Material::Ground => vec3(0.4, 0.5, 0.4),
            };
            albedo * (0.15 + 0.85 * diffuse)
        }
    };
    color.extend(1.0)
}
