//! The ground, the hills, the fences, the trees and a faceted stone.

use super::{hash_noise, paint};
use crate::scene::Material;
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::{PI, TAU};

/// Cuts of the ground along x and z, from the camera's surroundings to where haze has taken it. One large patch would do for
/// exact arithmetic; drivers lose digits on triangles that pass the camera and reach the horizon.
const CUTS: [f32; 15] = [
    -1500.0, -400.0, -120.0, -48.0, -24.0, -12.0, -6.0, 0.0, 6.0, 12.0, 24.0, 48.0, 120.0, 400.0, 1500.0,
];

pub(super) fn add(mesh: &mut Mesh) {
    add_ground(mesh);
    add_hills(mesh);
    add_fence(mesh, vec3(11.0, 0.0, -3.4), vec3(45.0, 0.0, -9.0), 150);
    for (i, (x, z, height)) in [
        (-6.9, -3.5, 4.6),
        (-7.7, -9.0, 5.6),
        (-7.9, -17.0, 5.2),
        (11.2, -9.0, 4.8),
        (17.5, -13.0, 5.4),
        (25.0, -15.0, 5.0),
    ]
    .into_iter()
    .enumerate()
    {
        add_cypress(mesh, vec3(x, 0.0, z), height, i as u32);
    }
    let place = Affine3A::from_translation(vec3(-6.0, 0.0, 3.9));
    mesh.add_at(place, add_monument);
}

/// A tiled floor up to the horizon.
pub(in crate::scene) fn add_ground(mesh: &mut Mesh) {
    for x in CUTS.windows(2) {
        for z in CUTS.windows(2) {
            let corners = [(x[0], z[1]), (x[1], z[1]), (x[1], z[0]), (x[0], z[0])].map(|(x, z)| vec3(x, 0.0, z));
            mesh.add_patch(&corners, vec3(0.60, 0.48, 0.36), Material::Tiles);
        }
    }
}

/// Two ranges around the far half of the horizon, in large facets.
fn add_hills(mesh: &mut Mesh) {
    const FACETS: u32 = 90;
    for (range, (distance, height)) in [(900.0, 95.0), (620.0, 42.0)].into_iter().enumerate() {
        let range = range as u32;
        let point = |at: u32, row: u32| {
            let seed = range * 1000 + row * 300 + at;
            let angle = PI * (at as f32 + 0.5 * row as f32 + 0.4 * hash_noise(seed)) / FACETS as f32;
            let out = distance * (1.0 + 0.06 * row as f32 + 0.03 * hash_noise(seed + 100));
            // Long waves, and short ones on them.
            let wave = 0.55 + 0.45 * (0.23 * at as f32 + 2.0 * range as f32).sin();
            let rise = [0.0, 0.55, 1.0][row as usize] * height * (0.25 + 0.6 * wave + 0.3 * hash_noise(seed + 200));
            vec3(-angle.cos() * out, rise, -angle.sin() * out)
        };
        for row in 0..2 {
            for at in 0..FACETS {
                let color = vec3(0.20, 0.25, 0.13) * (0.85 + 0.3 * hash_noise(at + 500 * row));
                let (a, b) = (point(at, row), point(at + 1, row));
                let (c, d) = (point(at + 1, row + 1), point(at, row + 1));
                mesh.add_polygon(&[a, b, d], color);
                mesh.add_polygon(&[b, c, d], color);
            }
        }
    }
}

/// Pickets with points and two rails, from one post to the other.
pub(in crate::scene) fn add_fence(mesh: &mut Mesh, from: Vec3, to: Vec3, pickets: u32) {
    let color = paint::TRIM * 0.8;
    let along = (to - from).normalize();
    let out = along.cross(Vec3::Y) * 0.02;
    for height in [0.25, 0.85] {
        let rise = Vec3::Y * height;
        mesh.add_bar(from + rise - out, to + rise - out, 0.025, 4, color * 0.8);
    }
    for i in 0..=pickets {
        let foot = from.lerp(to, i as f32 / pickets as f32);
        let half = along * 0.045;
        let plank = |y: f32| {
            [
                foot - half - out,
                foot + half - out,
                foot + half + out,
                foot - half + out,
            ]
            .map(|p| p + Vec3::Y * y)
        };
        mesh.add_hexahedron([plank(0.05), plank(0.95)], color);
        let [a, b, c, d] = plank(0.95);
        let tip = foot + Vec3::Y * 1.08;
        for (p, q) in [(a, b), (b, c), (c, d), (d, a)] {
            mesh.add_polygon(&[p, q, tip], color);
        }
    }
}

/// A slender tree of flat facets.
pub(in crate::scene) fn add_cypress(mesh: &mut Mesh, foot: Vec3, height: f32, seed: u32) {
    const RINGS: u32 = 9;
    const SIDES: u32 = 9;
    mesh.add_bar(foot, foot + Vec3::Y * 0.6, 0.09, 6, paint::TIMBER);
    let point = |ring: u32, side: u32| {
        let share = ring as f32 / RINGS as f32;
        let side = side % SIDES;
        let wobble = 0.8 + 0.4 * hash_noise(seed * 997 + ring * SIDES + side);
        let radius = height * 0.16 * (PI * share.powf(0.65)).sin().max(0.0).powf(0.8) * wobble;
        let angle = TAU * (side as f32 + 0.5 * (ring % 2) as f32) / SIDES as f32;
        foot + vec3(
            angle.cos() * radius,
            0.35 + share * (height - 0.35),
            -angle.sin() * radius,
        )
    };
    for ring in 0..RINGS {
        for side in 0..SIDES {
            let tint = 0.75 + 0.5 * hash_noise(seed * 131 + ring * SIDES + side);
            let color = vec3(0.045, 0.115, 0.035) * tint;
            let (a, b) = (point(ring, side), point(ring, side + 1));
            let (c, d) = (point(ring + 1, side + 1), point(ring + 1, side));
            mesh.add_polygon(&[a, b, c], color);
            mesh.add_polygon(&[a, c, d], color);
        }
    }
}

/// A stone of large facets, creases without a step in depth, on a pedestal that is smooth.
fn add_monument(mesh: &mut Mesh) {
    mesh.add_block(vec3(-0.75, 0.0, -0.75), vec3(0.75, 0.14, 0.75), paint::STONE);
    mesh.add_block(vec3(-0.6, 0.14, -0.6), vec3(0.6, 0.28, 0.6), paint::STONE);
    mesh.add_frustum(
        [(vec3(0.0, 0.28, 0.0), 0.42), (vec3(0.0, 0.95, 0.0), 0.32)],
        32,
        paint::TRIM,
        true,
    );
    mesh.add_frustum(
        [(vec3(0.0, 0.95, 0.0), 0.46), (vec3(0.0, 1.05, 0.0), 0.46)],
        32,
        paint::TRIM,
        true,
    );
    const SIDES: u32 = 11;
    const RINGS: u32 = 6;
    let point = |ring: u32, side: u32| {
        let polar = PI * ring as f32 / RINGS as f32;
        let angle = TAU * (side as f32 + 0.5 * ring as f32) / SIDES as f32;
        let around = vec3(angle.cos(), 0.0, -angle.sin()) * polar.sin();
        (around - Vec3::Y * polar.cos()) * 0.55 + Vec3::Y * 1.56
    };
    for ring in 0..RINGS {
        for side in 0..SIDES {
            let color = vec3(0.62, 0.60, 0.58);
            let (a, b) = (point(ring, side), point(ring, side + 1));
            let (c, d) = (point(ring + 1, side + 1), point(ring + 1, side));
            // Rings are turned by half a side against each other: two triangles that meet in a crease.
            mesh.add_polygon(&[a, b, d], color);
            mesh.add_polygon(&[b, c, d], color);
        }
    }
}
