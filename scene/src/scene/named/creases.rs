//! Folded and faceted things: where two facets meet, depth goes on and the normal turns.

use super::{add_ball, add_lawn, outdoor_scene};
use crate::scene::Scene;
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::TAU;

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 600.0, vec3(0.45, 0.44, 0.42));
    add_screen(&mut mesh, vec3(-5.2, 0.0, -3.4), 5.0, 34);
    mesh.add_at(
        Affine3A::from_translation(vec3(5.6, 0.0, -2.4)) * Affine3A::from_rotation_y(-0.9),
        |mesh| add_screen(mesh, vec3(-2.6, 0.0, 0.0), 2.3, 15),
    );
    add_studs(&mut mesh);
    mesh.add_block(vec3(-0.7, 0.0, -1.9), vec3(0.7, 0.75, -0.5), vec3(0.4, 0.4, 0.42));
    add_ball(&mut mesh, vec3(0.0, 1.62, -1.2), 0.88, 7, false, vec3(0.72, 0.70, 0.66));
    add_gem(&mut mesh, vec3(2.25, 0.0, -0.1), 0.85, 1.5, 9, vec3(0.62, 0.50, 0.42));
    add_gem(&mut mesh, vec3(-2.1, 0.0, 0.5), 0.62, 1.05, 7, vec3(0.46, 0.55, 0.60));
    outdoor_scene(mesh, vec3(-1.6, 2.3, 6.2), vec3(0.15, 1.05, -1.4), 42.0)
}

/// A folded screen of `folds` leaves along +x from `from`, a third of a metre each.
fn add_screen(mesh: &mut Mesh, from: Vec3, height: f32, folds: u32) {
    let foot = |k: u32| from + vec3(0.31 * k as f32, 0.0, if k.is_multiple_of(2) { 0.0 } else { 0.16 });
    for k in 0..folds {
        let (a, b) = (foot(k), foot(k + 1));
        let rise = Vec3::Y * height.min(2.9);
        mesh.add_polygon(&[a, b, b + rise, a + rise], vec3(0.66, 0.60, 0.50));
    }
}

/// A floor of low pyramids.
fn add_studs(mesh: &mut Mesh) {
    const SIDE: f32 = 0.36;
    for row in 0..28 {
        for column in 0..34 {
            let corner = vec3(-6.2 + SIDE * column as f32, 0.0, 4.6 - SIDE * row as f32);
            let base = [(0.0, 0.0), (1.0, 0.0), (1.0, -1.0), (0.0, -1.0)].map(|(x, z)| corner + vec3(x, 0.0, z) * SIDE);
            let tip = corner + vec3(0.5 * SIDE, 0.075, -0.5 * SIDE);
            for i in 0..4 {
                mesh.add_polygon(&[base[i], base[(i + 1) % 4], tip], vec3(0.56, 0.52, 0.46));
            }
        }
    }
}

/// A cut stone on its point: a crown and a pavilion of `sides` facets.
fn add_gem(mesh: &mut Mesh, foot: Vec3, radius: f32, height: f32, sides: u32, color: Vec3) {
    let ring = |k: u32, at: f32, r: f32, turn: f32| {
        let angle = TAU * (k as f32 + turn) / sides as f32;
        foot + vec3(angle.cos() * r * radius, at * height, -angle.sin() * r * radius)
    };
    for k in 0..sides {
        let girdle = [ring(k, 0.55, 1.0, 0.0), ring(k + 1, 0.55, 1.0, 0.0)];
        let middle = ring(k, 0.25, 0.62, 0.5);
        let next = ring(k + 1, 0.25, 0.62, 0.5);
        let table = [ring(k, 1.0, 0.55, 0.5), ring(k + 1, 1.0, 0.55, 0.5)];
        mesh.add_polygon(&[middle, girdle[1], girdle[0]], color);
        mesh.add_polygon(&[middle, next, girdle[1]], color);
        mesh.add_polygon(&[foot, next, middle], color);
        mesh.add_polygon(&[girdle[0], girdle[1], table[0]], color);
        mesh.add_polygon(&[girdle[1], table[1], table[0]], color);
        mesh.add_polygon(&[table[0], table[1], foot + Vec3::Y * height], color * 1.1);
    }
}
