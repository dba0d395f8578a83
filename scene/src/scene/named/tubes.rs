//! Bicycles at a rack before a wall.

use super::{add_lawn, add_tube, outdoor_scene};
use crate::scene::Scene;
use crate::scene::builtin::hash_noise;
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::TAU;

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 400.0, vec3(0.44, 0.43, 0.41));
    add_wall(&mut mesh);
    for (x, z, turn, lean, paint) in [
        (-0.95, 0.15, 0.18, 0.10, vec3(0.55, 0.07, 0.05)),
        (0.65, -0.35, -0.30, -0.08, vec3(0.06, 0.22, 0.40)),
        (2.25, -0.65, 0.42, 0.06, vec3(0.62, 0.52, 0.10)),
    ] {
        let place = Affine3A::from_translation(vec3(x, 0.0, z))
            * Affine3A::from_rotation_y(turn)
            * Affine3A::from_rotation_x(lean);
        mesh.add_at(place, |mesh| add_bicycle(mesh, paint));
    }
    add_rack(&mut mesh);
    outdoor_scene(mesh, vec3(-0.15, 1.15, 3.9), vec3(0.42, 0.50, -0.6), 35.0)
}

/// Courses of pale bricks.
fn add_wall(mesh: &mut Mesh) {
    mesh.add_block(vec3(-9.0, 0.0, -2.4), vec3(12.0, 3.2, -2.03), vec3(0.33, 0.31, 0.29));
    for course in 0..22 {
        let y = 0.145 * course as f32;
        let shift = if course % 2 == 0 { 0.0 } else { 0.24 };
        for k in 0..44 {
            let x = -9.0 + shift + 0.48 * k as f32;
            let tint = 0.86 + 0.24 * hash_noise(course * 64 + k);
            mesh.add_block(
                vec3(x, y, -2.1),
                vec3(x + 0.462, y + 0.13, -2.0),
                vec3(0.62, 0.57, 0.50) * tint,
            );
        }
    }
}

/// Hoops along the wall.
fn add_rack(mesh: &mut Mesh) {
    let steel = vec3(0.45, 0.46, 0.48);
    for k in 0..7 {
        let x = -2.4 + 0.95 * k as f32;
        let hoop: Vec<Vec3> = (0..=16)
            .map(|i| {
                let angle = std::f32::consts::PI * i as f32 / 16.0;
                vec3(x, 0.5 + 0.32 * angle.sin(), -1.45 - 0.30 * angle.cos())
            })
            .collect();
        let (first, last) = (hoop[0], hoop[16]);
        add_tube(mesh, &hoop, 0.018, 8, steel);
        add_tube(mesh, &[vec3(x, 0.0, first.z), first], 0.018, 8, steel);
        add_tube(mesh, &[last, vec3(x, 0.0, last.z)], 0.018, 8, steel);
    }
}

/// A bicycle in the plane of z = 0, its front to the left.
fn add_bicycle(mesh: &mut Mesh, paint: Vec3) {
    const WHEEL: f32 = 0.345;
    let steel = vec3(0.55, 0.56, 0.58);
    let black = vec3(0.03, 0.03, 0.032);
    let front = vec3(-0.52, WHEEL, 0.0);
    let back = vec3(0.50, WHEEL, 0.0);
    add_wheel(mesh, front, WHEEL);
    add_wheel(mesh, back, WHEEL);
    let crank = vec3(0.06, 0.29, 0.0);
    let seat = vec3(0.20, 0.78, 0.0);
    let head = [vec3(-0.36, 0.70, 0.0), vec3(-0.40, 0.83, 0.0)];
    // The frame: top, down and seat tube, then stays and fork in pairs.
    add_tube(mesh, &[head[1], seat], 0.0145, 8, paint);
    add_tube(mesh, &[head[0], crank, seat + vec3(0.02, 0.07, 0.0)], 0.0165, 8, paint);
    add_tube(mesh, &[head[0], head[1]], 0.019, 8, paint);
    for z in [-0.045, 0.045] {
        let side = Vec3::Z * z;
        add_tube(mesh, &[crank + side * 0.6, back + side], 0.008, 6, paint);
        add_tube(mesh, &[seat + side * 0.3, back + side], 0.007, 6, paint);
        add_tube(
            mesh,
            &[head[0] + side * 0.7, vec3(-0.44, 0.5, z), front + side],
            0.010,
            6,
            paint,
        );
    }
    // Seat, handlebar, stem, brake cables.
    let post = seat + vec3(0.045, 0.16, 0.0);
    add_tube(mesh, &[seat, post], 0.012, 8, steel);
    mesh.add_hexahedron(
        [0.0, 0.035].map(|y| {
            [(-0.13, 0.018), (0.12, 0.075), (0.12, -0.075), (-0.13, -0.018)].map(|(x, z)| post + vec3(x, y, z))
        }),
        black,
    );
    let stem = head[1] + vec3(-0.045, 0.075, 0.0);
    add_tube(mesh, &[head[1], stem], 0.012, 8, steel);
    let bar: Vec<Vec3> = [
        (0.10, 0.02, -0.30),
        (-0.03, 0.02, -0.22),
        (-0.05, 0.0, 0.0),
        (-0.03, 0.02, 0.22),
        (0.10, 0.02, 0.30),
    ]
    .map(|(x, y, z)| stem + vec3(x, y, z))
    .to_vec();
    add_tube(mesh, &bar, 0.011, 8, steel);
    for (k, z) in [(0, -0.22), (1, 0.22)] {
        let cable: Vec<Vec3> = (0..=10)
            .map(|i| {
                let t = i as f32 / 10.0;
                let bow = vec3(-0.14, 0.07, 0.0) * (4.0 * t * (1.0 - t));
                (stem + vec3(-0.03, 0.02, z)).lerp(head[k], t) + bow
            })
            .collect();
        add_tube(mesh, &cable, 0.0025, 4, black);
    }
    // Chainring, pedals, chain, mudguards and a carrier.
    add_ring(mesh, crank + Vec3::Z * 0.05, 0.095, 0.004, 28, steel);
    for (x, z) in [(0.15, 0.07), (-0.15, -0.07)] {
        let pedal = crank + vec3(x, -0.06 * x.signum(), z);
        add_tube(mesh, &[crank + Vec3::Z * z, pedal], 0.007, 6, steel);
        mesh.add_block(pedal - vec3(0.045, 0.01, 0.04), pedal + vec3(0.045, 0.01, 0.04), black);
    }
    for y in [-0.09, 0.09] {
        let (from, to) = (crank + vec3(0.0, y, 0.05), back + vec3(0.0, 0.4 * y, 0.05));
        add_tube(mesh, &[from, to], 0.0035, 4, black);
    }
    for (hub, from, to) in [(front, 0.25, 2.7), (back, -0.1, 2.5)] {
        let guard: Vec<Vec3> = (0..=18)
            .map(|k| {
                let angle: f32 = from + (to - from) * k as f32 / 18.0;
                hub + vec3(angle.cos(), angle.sin(), 0.0) * (WHEEL + 0.03)
            })
            .collect();
        add_tube(mesh, &guard, 0.010, 6, paint * 0.8);
    }
    for z in [-0.06, 0.06] {
        add_tube(
            mesh,
            &[seat + vec3(0.06, -0.06, z), vec3(0.72, 0.74, z), back + Vec3::Z * z],
            0.005,
            5,
            steel,
        );
    }
}

/// Tyre, rim, hub and spokes.
fn add_wheel(mesh: &mut Mesh, hub: Vec3, radius: f32) {
    add_ring(mesh, hub, radius - 0.014, 0.014, 56, vec3(0.03, 0.03, 0.032));
    add_ring(mesh, hub, radius - 0.034, 0.006, 48, vec3(0.6, 0.61, 0.62));
    add_tube(
        mesh,
        &[hub - Vec3::Z * 0.05, hub + Vec3::Z * 0.05],
        0.018,
        8,
        vec3(0.5, 0.5, 0.52),
    );
    for k in 0..32 {
        let angle = TAU * k as f32 / 32.0;
        let rim = hub + vec3(angle.cos(), angle.sin(), 0.0) * (radius - 0.034);
        // Crossed: each leaves the hub at a tangent, on alternate sides.
        let (turn, side) = if k % 2 == 0 { (1.3, 0.03) } else { (-1.3, -0.03) };
        let start = hub + vec3((angle + turn).cos() * 0.018, (angle + turn).sin() * 0.018, side);
        add_tube(mesh, &[start, rim], 0.0011, 4, vec3(0.62, 0.63, 0.65));
    }
}

/// A ring in the plane of z.
fn add_ring(mesh: &mut Mesh, centre: Vec3, radius: f32, thickness: f32, pieces: u32, color: Vec3) {
    let at = |k: u32| {
        let angle = TAU * k as f32 / pieces as f32;
        centre + vec3(angle.cos(), angle.sin(), 0.0) * radius
    };
    add_tube(mesh, &(0..=pieces).map(at).collect::<Vec<_>>(), thickness, 7, color);
}
