//! Shrubs and grass of triangles that are a pixel or a few large, before a wall.

use super::{add_lawn, outdoor_scene};
use crate::scene::Scene;
use crate::scene::builtin::hash_noise;
use crate::scene::mesh::Mesh;
use glam::{Vec3, vec3};

/// Shrubs: foot, radius, height and number of leaves.
const SHRUBS: [(Vec3, f32, f32, u32); 5] = [
    (vec3(-1.7, 0.0, -1.0), 0.9, 1.9, 9_000),
    (vec3(0.6, 0.0, -2.2), 1.1, 2.3, 11_000),
    (vec3(2.4, 0.0, -0.6), 0.7, 1.3, 6_000),
    (vec3(-3.6, 0.0, -3.4), 1.2, 2.7, 7_000),
    (vec3(4.2, 0.0, -4.0), 1.3, 2.9, 6_000),
];

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 60.0, vec3(0.16, 0.20, 0.09));
    mesh.add_block(vec3(-7.0, 0.0, -5.6), vec3(7.0, 1.6, -5.3), vec3(0.62, 0.58, 0.52));
    let mut seed = 0;
    for (foot, radius, height, leaves) in SHRUBS {
        mesh.add_bar(
            foot,
            foot + vec3(0.0, 0.6 * height, 0.0),
            0.05,
            8,
            vec3(0.20, 0.13, 0.08),
        );
        for _ in 0..leaves {
            let [a, b, c] = [0, 1, 2].map(|k| hash_noise(seed + k) - 0.5);
            // Denser towards the outside, as leaves are.
            let out = vec3(a, b, c).normalize_or(Vec3::Y) * (0.55 + 0.45 * hash_noise(seed + 3));
            let centre = foot + vec3(out.x * radius, (0.55 + 0.45 * out.y) * height, out.z * radius);
            add_leaf(&mut mesh, centre, seed + 4);
            seed += 16;
        }
    }
    for _ in 0..6_000 {
        let foot = vec3(9.0 * (hash_noise(seed) - 0.5), 0.0, 2.2 - 5.0 * hash_noise(seed + 1));
        let lean = vec3(hash_noise(seed + 2) - 0.5, 1.6, hash_noise(seed + 3) - 0.5);
        let tint = 0.7 + 0.6 * hash_noise(seed + 4);
        let aside = vec3(0.008, 0.0, 0.0);
        mesh.add_polygon(
            &[foot - aside, foot + aside, foot + 0.12 * lean],
            vec3(0.20, 0.30, 0.09) * tint,
        );
        seed += 16;
    }
    outdoor_scene(mesh, vec3(0.1, 1.5, 4.6), vec3(0.2, 1.05, -2.0), 42.0)
}

/// Two triangles in a direction and of a green of their own.
fn add_leaf(mesh: &mut Mesh, centre: Vec3, seed: u32) {
    let axis = |k: u32| vec3(hash_noise(seed + k), hash_noise(seed + k + 1), hash_noise(seed + k + 2)) - 0.5;
    let along = axis(0).normalize_or(Vec3::X) * 0.035;
    let across = along.cross(axis(3)).normalize_or(Vec3::Z) * 0.015;
    let green = vec3(0.16, 0.30, 0.08) * (0.6 + 0.8 * hash_noise(seed + 6));
    mesh.add_polygon(
        &[centre - along, centre - across, centre + along, centre + across],
        green,
    );
}
