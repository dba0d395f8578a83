//! An aerial, a weather vane, a kite, birds and masts of boats: little geometry, and infinite depth behind all of it.

use super::{add_tube, outdoor_scene};
use crate::scene::Scene;
use crate::scene::builtin::hash_noise;
use crate::scene::builtin::mast::add_wire;
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::TAU;

const IRON: Vec3 = vec3(0.05, 0.052, 0.06);

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    for (k, (x, z, height, lean)) in [
        (-6.0, -9.0, 9.5, 0.05),
        (-3.2, -13.0, 11.0, -0.03),
        (5.2, -12.0, 11.5, 0.02),
        (8.0, -16.0, 12.5, -0.04),
    ]
    .into_iter()
    .enumerate()
    {
        let place = Affine3A::from_translation(vec3(x, -4.0, z)) * Affine3A::from_rotation_z(lean);
        mesh.add_at(place, |mesh| boat_mast(mesh, height, k as u32));
    }
    mesh.add_at(Affine3A::from_translation(vec3(1.2, -3.0, -6.0)), add_aerial);
    mesh.add_at(Affine3A::from_translation(vec3(-1.6, 0.2, -5.5)), add_vane);
    add_kite(&mut mesh);
    for k in 0..26 {
        let at = vec3(
            -9.0 + 20.0 * hash_noise(k * 3),
            3.6 + 6.0 * hash_noise(k * 3 + 1),
            -16.0 - 14.0 * hash_noise(k * 3 + 2),
        );
        add_bird(&mut mesh, at, 0.3 + 0.25 * hash_noise(k + 70), hash_noise(k + 300));
    }
    let mut scene = outdoor_scene(mesh, vec3(0.0, 0.0, 3.5), vec3(0.1, 2.9, -8.0), 50.0);
    scene.sky.haze = 0.0;
    scene
}

/// A mast with spreaders, shrouds, a forestay and a pennant.
fn boat_mast(mesh: &mut Mesh, height: f32, seed: u32) {
    let top = Vec3::Y * height;
    add_tube(mesh, &[Vec3::ZERO, top], 0.045, 8, vec3(0.62, 0.62, 0.60));
    for share in [0.45, 0.72] {
        let at = top * share;
        add_tube(mesh, &[at - Vec3::X * 0.55, at + Vec3::X * 0.55], 0.015, 6, IRON * 6.0);
        for side in [-0.55, 0.55] {
            let end = at + Vec3::X * side;
            add_tube(mesh, &[vec3(1.4 * side, 0.0, 0.0), end, top], 0.004, 4, IRON);
        }
    }
    add_wire(mesh, top, vec3(-2.4, 0.0, 1.0), 0.05, 0.004);
    add_wire(mesh, top, vec3(2.2, 0.0, -1.0), 0.05, 0.003);
    let hue = [
        vec3(0.6, 0.08, 0.06),
        vec3(0.08, 0.2, 0.5),
        vec3(0.7, 0.55, 0.08),
        vec3(0.1, 0.4, 0.2),
    ][seed as usize % 4];
    mesh.add_polygon(&[top, top + vec3(0.75, -0.10, 0.1), top - Vec3::Y * 0.24], hue);
}

/// A Yagi aerial on a pole with stays.
fn add_aerial(mesh: &mut Mesh) {
    let top = Vec3::Y * 6.6;
    add_tube(mesh, &[Vec3::ZERO, top], 0.022, 8, IRON * 3.0);
    for (height, turn, reach) in [(6.3, 0.3_f32, 1.25), (5.2, -0.6, 0.95)] {
        let boom = vec3(turn.cos(), 0.05, turn.sin()) * reach;
        let middle = Vec3::Y * height;
        add_tube(mesh, &[middle - boom, middle + boom], 0.010, 6, IRON * 3.0);
        for k in 0..13 {
            let at = middle + boom * (-1.0 + k as f32 / 6.0);
            let half = vec3(-turn.sin(), 0.75, turn.cos()).normalize() * (0.42 - 0.017 * k as f32);
            add_tube(mesh, &[at - half, at + half], 0.0045 - 0.0002 * k as f32, 5, IRON * 2.0);
        }
    }
    for end in [vec3(-3.2, 0.0, 0.6), vec3(2.9, 0.0, 0.9), vec3(0.4, 0.0, -3.0)] {
        add_tube(mesh, &[Vec3::Y * 5.8, end], 0.0028, 4, IRON);
    }
}

/// An arrow on a rod over a cross of letters' arms.
fn add_vane(mesh: &mut Mesh) {
    add_tube(mesh, &[Vec3::Y * -3.0, Vec3::Y * 1.9], 0.016, 8, IRON);
    for k in 0..4 {
        let angle = TAU * (k as f32 / 4.0 + 0.06);
        let out = vec3(angle.cos(), 0.0, angle.sin()) * 0.42;
        add_tube(mesh, &[Vec3::Y * 1.2, Vec3::Y * 1.2 + out], 0.007, 6, IRON);
    }
    let (tail, tip) = (vec3(-0.62, 1.75, 0.2), vec3(0.66, 1.75, -0.2));
    add_tube(mesh, &[tail, tip], 0.008, 6, IRON);
    let along = (tip - tail).normalize();
    mesh.add_polygon(&[tip + along * 0.16, tip + Vec3::Y * 0.09, tip - Vec3::Y * 0.09], IRON);
    let fin = [
        tail,
        tail - along * 0.05 + Vec3::Y * 0.2,
        tail + along * 0.22 + Vec3::Y * 0.2,
        tail + along * 0.27,
    ];
    mesh.add_polygon(&fin, IRON);
}

/// A kite with a tail of bows, and its line down to a hand below the picture.
fn add_kite(mesh: &mut Mesh) {
    let at = vec3(3.3, 6.3, -9.0);
    let [top, right, foot, left] =
        [(0.15, 0.95), (0.72, 0.15), (-0.2, -1.0), (-0.7, 0.3)].map(|(x, y)| at + vec3(x, y, 0.1 * x));
    for (corners, color) in [
        ([top, at, right], vec3(0.75, 0.16, 0.08)),
        ([right, at, foot], vec3(0.85, 0.62, 0.10)),
        ([foot, at, left], vec3(0.75, 0.16, 0.08)),
        ([left, at, top], vec3(0.12, 0.30, 0.60)),
    ] {
        mesh.add_polygon(&corners, color);
    }
    let tail = |k: u32| foot + vec3(0.22 * (0.7 * k as f32).sin() - 0.05 * k as f32, -0.16 * k as f32, 0.0);
    add_tube(mesh, &(0..18).map(tail).collect::<Vec<_>>(), 0.006, 4, IRON);
    for k in (2..18).step_by(3) {
        let knot = tail(k);
        for side in [-1.0, 1.0] {
            let out = vec3(0.14 * side, 0.03, 0.0);
            mesh.add_polygon(
                &[knot, knot + out + Vec3::Y * 0.06, knot + out - Vec3::Y * 0.06],
                vec3(0.85, 0.62, 0.10),
            );
        }
    }
    add_wire(mesh, at, vec3(-1.4, -2.5, -2.0), 0.5, 0.0022);
}

/// Two thin wings.
fn add_bird(mesh: &mut Mesh, at: Vec3, span: f32, beat: f32) {
    let rise = Vec3::Y * span * (0.1 + 0.5 * beat);
    for side in [-1.0, 1.0] {
        let elbow = at + vec3(0.5 * side * span, 0.0, 0.0) + rise;
        let tip = at + vec3(side * span, 0.0, 0.06) + rise * 0.55;
        let back = Vec3::Y * (-0.10 * span) + Vec3::Z * 0.05;
        mesh.add_polygon(&[at, elbow, elbow + back, at + back], IRON);
        mesh.add_polygon(&[elbow, tip, elbow + back], IRON);
    }
}
