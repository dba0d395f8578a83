//! An environment blurred for a rough mirror (Karis, Real shading in Unreal Engine 4, 2013), by importance sampling of GGX
//! with the Hammersley sequence. The environment is a picture in longitude and latitude.

use std::f32::consts::{PI, TAU};
use straightline_kernels::prelude::*;

const SAMPLES: u32 = 64;

/// Bits of a number, mirrored at the binary point.
fn radical_inverse(bits: u32) -> f32 {
    let bits = bits.rotate_left(16);
    let bits = ((bits & 0x5555_5555) << 1) | ((bits & 0xAAAA_AAAA) >> 1);
    let bits = ((bits & 0x3333_3333) << 2) | ((bits & 0xCCCC_CCCC) >> 2);
    let bits = ((bits & 0x0F0F_0F0F) << 4) | ((bits & 0xF0F0_F0F0) >> 4);
    let bits = ((bits & 0x00FF_00FF) << 8) | ((bits & 0xFF00_FF00) >> 8);
    bits as f32 * 2.328_306_4e-10
}

/// Half vector around z, distributed like the normals of microfacets of this roughness.
fn half_vector(k: u32, roughness: f32) -> Vec3 {
    let a = roughness * roughness;
    let (x, y) = (k as f32 / SAMPLES as f32, radical_inverse(k));
    let cos = ((1.0 - y) / (1.0 + (a * a - 1.0) * y)).sqrt();
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (s, c) = (TAU * x).sin_cos();
    vec3(sin * c, sin * s, cos)
}

fn direction(uv: Vec2) -> Vec3 {
    let (longitude, latitude) = ((uv.x - 0.5) * TAU, (0.5 - uv.y) * PI);
    vec3(
        latitude.cos() * longitude.cos(),
        latitude.sin(),
        latitude.cos() * longitude.sin(),
    )
}

fn place(direction: Vec3) -> Vec2 {
    vec2(
        direction.z.atan2(direction.x) / TAU + 0.5,
        0.5 - direction.y.clamp(-1.0, 1.0).asin() / PI,
    )
}

pub fn environment_prefilter(
    image: &Texture<Vec4>,
    linear: &Sampler,
    roughness: f32,
    resolution: UVec2,
    pixel: IVec2,
) -> Vec4 {
    let normal = direction((pixel.as_vec2() + 0.5) / resolution.as_vec2());
    let up = if normal.z.abs() < 0.999 { Vec3::Z } else { Vec3::X };
    let tangent = up.cross(normal).normalize();
    let basis = Mat3::from_cols(tangent, normal.cross(tangent), normal);
    let (mut sum, mut total) = (Vec3::ZERO, 0.0);
    for k in 0..SAMPLES {
        let half = basis * half_vector(k, roughness);
        // The view direction is assumed to be the normal.
        let light = 2.0 * normal.dot(half) * half - normal;
        let weight = normal.dot(light);
        if weight > 0.0 {
            sum += image.sample(linear, place(light)).truncate() * weight;
            total += weight;
        }
    }
    (sum / total).extend(1.0)
}
