//! A panelled wall and crates: surfaces side by side, a few centimetres apart, that face the same way. Seen at an angle,
//! depth changes more from pixel to pixel along one of them than from one to the other.

use super::{add_lawn, outdoor_scene};
use crate::scene::Scene;
use crate::scene::builtin::hash_noise;
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 600.0, vec3(0.36, 0.35, 0.33));
    add_wall(&mut mesh);
    add_pavement(&mut mesh);
    for (k, (x, y, z, side, turn)) in [
        (0.9, 0.0, -0.3, 1.2, 0.5),
        (1.0, 1.2, -0.35, 0.85, 0.15),
        (2.6, 0.0, -1.6, 1.1, -0.35),
        (-0.4, 0.0, 1.3, 0.8, -0.2),
        (4.4, 0.0, -3.1, 1.25, 0.8),
    ]
    .into_iter()
    .enumerate()
    {
        let place = Affine3A::from_translation(vec3(x, y, z)) * Affine3A::from_rotation_y(turn);
        let tint = 0.85 + 0.3 * hash_noise(k as u32 + 5);
        mesh.add_at(place, |mesh| crate_of(mesh, side, vec3(0.50, 0.35, 0.19) * tint));
    }
    outdoor_scene(mesh, vec3(-0.9, 1.7, 5.4), vec3(-0.35, 1.1, -2.0), 40.0)
}

/// A wall that recedes from the camera, of panels with two fields each.
fn add_wall(mesh: &mut Mesh) {
    const PANELS: u32 = 26;
    const WIDTH: f32 = 1.15;
    const HEIGHT: f32 = 3.4;
    let place =
        Affine3A::from_translation(vec3(-3.1, 0.0, 3.0)) * Affine3A::from_rotation_y(std::f32::consts::FRAC_PI_2);
    mesh.add_at(place, |mesh| {
        // Along x of this place, facing +z.
        for panel in 0..PANELS {
            let x = WIDTH * panel as f32;
            let tint = 0.9 + 0.2 * hash_noise(panel + 40);
            add_inset(mesh, [x, x + WIDTH - 0.02], [0.0, HEIGHT], 0.0, tint);
        }
        let end = WIDTH * PANELS as f32;
        mesh.add_block(
            vec3(0.0, HEIGHT, -0.4),
            vec3(end, HEIGHT + 0.18, 0.07),
            vec3(0.62, 0.6, 0.56),
        );
        mesh.add_block(vec3(0.0, 0.0, -0.4), vec3(end, HEIGHT, -0.09), vec3(0.2, 0.2, 0.21));
    });
}

/// A panel: a rim, a step back, grooves within.
fn add_inset(mesh: &mut Mesh, [left, right]: [f32; 2], [low, high]: [f32; 2], front: f32, tint: f32) {
    let rim = vec3(0.70, 0.66, 0.58) * tint;
    const RIM: f32 = 0.13;
    let slab = |mesh: &mut Mesh, x: [f32; 2], y: [f32; 2], z: f32, color: Vec3| {
        mesh.add_block(vec3(x[0], y[0], -0.1), vec3(x[1], y[1], z), color);
    };
    slab(mesh, [left, left + RIM], [low, high], front, rim);
    slab(mesh, [right - RIM, right], [low, high], front, rim);
    let (inner_left, inner_right) = (left + RIM, right - RIM);
    for y in [low, 0.5 * (low + high) - 0.5 * RIM, high - RIM] {
        slab(mesh, [inner_left, inner_right], [y, y + RIM], front, rim);
    }
    // Boards in the two fields, each a little back, with grooves between.
    const BOARDS: u32 = 5;
    let width = (inner_right - inner_left) / BOARDS as f32;
    for board in 0..BOARDS {
        let x = inner_left + width * board as f32;
        let color = vec3(0.36, 0.45, 0.47) * tint;
        slab(mesh, [x + 0.012, x + width - 0.012], [low, high], front - 0.035, color);
    }
}

/// Slabs with joints between, flush but for a centimetre.
fn add_pavement(mesh: &mut Mesh) {
    for row in 0..22 {
        for column in 0..12 {
            let seed = row * 12 + column;
            let corner = vec3(-3.0 + column as f32 * 0.8, 0.0, 4.0 - row as f32 * 0.8);
            let top = 0.02 + 0.012 * hash_noise(seed + 900);
            let color = vec3(0.52, 0.50, 0.46) * (0.85 + 0.3 * hash_noise(seed));
            mesh.add_block(corner, corner + vec3(0.78, top, 0.78), color);
        }
    }
}

/// A crate with a rim along its edges and boards set back between them.
fn crate_of(mesh: &mut Mesh, side: f32, color: Vec3) {
    const RIM: f32 = 0.09;
    const BACK: f32 = 0.025;
    let half = 0.5 * side;
    let low = vec3(-half, 0.0, -half);
    let core = vec3(0.06, 0.03, 0.06);
    mesh.add_block(low + core, vec3(half, side, half) - core, color * 0.2);
    for board in 0..6 {
        // Boards alternate in depth by a centimetre.
        let y = side * board as f32 / 6.0;
        let back = BACK + 0.010 * (board % 2) as f32;
        let inset = vec3(back, 0.0, back);
        let from = low + vec3(0.0, y + 0.004, 0.0) + inset;
        let to = vec3(half, (y + side / 6.0 - 0.004).min(side - BACK), half) - inset;
        mesh.add_block(from.max(low + Vec3::Y * BACK), to, color * 0.72);
    }
    let mut bar = |from: Vec3, to: Vec3| mesh.add_block(from, to, color);
    for a in [-half, half - RIM] {
        for b in [-half, half - RIM] {
            bar(vec3(a, 0.0, b), vec3(a + RIM, side, b + RIM));
        }
        for y in [0.0, side - RIM] {
            bar(vec3(-half, y, a), vec3(half, y + RIM, a + RIM));
            bar(vec3(a, y, -half), vec3(a + RIM, y + RIM, half));
        }
    }
}
