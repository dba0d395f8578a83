//! The scene: an armillary sphere on a turntable, with rings thinner than a pixel in the distance, facets, and a striped disc.
//! A sun and the sky light it.

use glam::{Vec3, vec3};
use std::f32::consts::TAU;

/// Direction towards the sun, in world space.
pub const SUN: Vec3 = vec3(0.48, 0.64, 0.60);

/// Light of the sun on a surface that faces it.
pub const SUN_LIGHT: Vec3 = vec3(1.3, 1.15, 0.95);

/// Light on surfaces that face the ground and the sky; those between have a mixture.
pub const GROUND_LIGHT: Vec3 = vec3(0.10, 0.09, 0.08);
pub const SKY_LIGHT: Vec3 = vec3(0.22, 0.27, 0.34);

/// Position, normal and colour of one corner, as read by the vertex shader.
pub type Corner = [Vec3; 3];

/// Returns three corners for each triangle.
pub fn corners() -> Vec<Corner> {
    let mut corners = Vec::new();
    disc(&mut corners);
    let brass = vec3(0.62, 0.42, 0.14);
    for (axis, radius, thickness) in [
        (vec3(0.0, 1.0, 0.35), 1.30, 0.022),
        (vec3(1.0, 0.1, 0.0), 1.24, 0.016),
        (vec3(0.2, 0.3, 1.0), 1.18, 0.011),
        (vec3(0.9, 0.8, 0.5), 1.12, 0.007),
        (vec3(-0.6, 0.7, 0.6), 1.06, 0.004),
    ] {
        ring(&mut corners, axis.normalize(), radius, thickness, brass);
    }
    for k in 0..24 {
        let angle = TAU * k as f32 / 24.0;
        let out = vec3(angle.cos(), 0.0, angle.sin());
        let foot = out * 1.75 + Vec3::Y * FLOOR;
        bar(&mut corners, foot, foot + Vec3::Y * 0.42, 0.010, vec3(0.05, 0.05, 0.06));
    }
    bar(&mut corners, Vec3::Y * FLOOR, Vec3::Y * -0.5, 0.05, brass);
    ball(&mut corners, 0.52, vec3(0.25, 0.42, 0.60));
    corners
}

/// Height of the turntable.
const FLOOR: f32 = -1.45;

/// Adds a flat polygon, counter-clockwise seen from outside.
fn polygon(corners: &mut Vec<Corner>, points: &[Vec3], color: Vec3) {
    let normal = (points[1] - points[0]).cross(points[2] - points[0]).normalize_or_zero();
    for k in 2..points.len() {
        corners.extend([points[0], points[k - 1], points[k]].map(|point| [point, normal, color]));
    }
}

fn disc(corners: &mut Vec<Corner>) {
    const SPOKES: u32 = 48;
    let rim = |k: u32, radius: f32| {
        let angle = TAU * k as f32 / SPOKES as f32;
        vec3(angle.cos() * radius, FLOOR, -angle.sin() * radius)
    };
    for k in 0..SPOKES {
        for (band, (inner, outer)) in [(0.0, 0.7), (0.7, 1.3), (1.3, 2.0)].into_iter().enumerate() {
            let light = (k as usize / 2 + band).is_multiple_of(2);
            let color = if light { vec3(0.55, 0.52, 0.46) } else { vec3(0.20, 0.17, 0.16) };
            polygon(corners, &[rim(k, outer), rim(k + 1, outer), rim(k + 1, inner), rim(k, inner)], color);
        }
        let down = Vec3::Y * -0.12;
        polygon(corners, &[rim(k, 2.0) + down, rim(k + 1, 2.0) + down, rim(k + 1, 2.0), rim(k, 2.0)], Vec3::splat(0.3));
    }
}

fn ring(corners: &mut Vec<Corner>, axis: Vec3, radius: f32, thickness: f32, color: Vec3) {
    let (u, v) = axis.any_orthonormal_pair();
    let at = |k: u32| {
        let angle = TAU * k as f32 / 96.0;
        (u * angle.cos() + v * angle.sin()) * radius
    };
    for k in 0..96 {
        bar(corners, at(k), at(k + 1), thickness, color);
    }
}

/// Adds a bar of six flat faces.
fn bar(corners: &mut Vec<Corner>, from: Vec3, to: Vec3, radius: f32, color: Vec3) {
    let (u, v) = (to - from).normalize().any_orthonormal_pair();
    let around = |k: u32| {
        let angle = TAU * k as f32 / 6.0;
        (u * angle.cos() + v * angle.sin()) * radius
    };
    for k in 0..6 {
        let (a, b) = (around(k), around(k + 1));
        polygon(corners, &[from + a, from + b, to + b, to + a], color);
    }
}

/// Adds a ball of flat facets.
fn ball(corners: &mut Vec<Corner>, radius: f32, color: Vec3) {
    const RINGS: u32 = 8;
    let at = |ring: u32, side: u32| {
        let (polar, angle) = (0.5 * TAU * ring as f32 / RINGS as f32, TAU * side as f32 / 14.0);
        vec3(polar.sin() * angle.cos(), -polar.cos(), -polar.sin() * angle.sin()) * radius
    };
    for ring in 0..RINGS {
        for side in 0..14 {
            let (a, b, c, d) = (at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side));
            if ring > 0 {
                polygon(corners, &[a, b, c], color);
            }
            if ring + 1 < RINGS {
                polygon(corners, &[c, d, a], color);
            }
        }
    }
}
