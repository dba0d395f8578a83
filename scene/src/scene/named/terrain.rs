//! Hills seen from just above the ground: one smooth surface whose depth changes by metres from pixel to pixel, and its
//! silhouettes against itself.

use super::outdoor_scene;
use crate::scene::builtin::hash_noise;
use crate::scene::mesh::Mesh;
use crate::scene::{Material, Scene};
use glam::{Vec2, Vec3, vec2, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    // Rings of fixed angle, farther apart the farther they are, so that facets look alike on the screen.
    const ROWS: u32 = 170;
    const COLUMNS: u32 = 190;
    let corner = |column: u32, row: u32| {
        let angle = (column as f32 / COLUMNS as f32 - 0.5) * 1.9;
        let distance = 2.5 * 420.0_f32.powf(row as f32 / ROWS as f32);
        let at = vec2(angle.sin(), -angle.cos()) * distance;
        // As fine as the facets are there.
        let step = 0.02 * distance;
        let slope = |along: Vec2| (ground_height(at + along * step) - ground_height(at - along * step)) / (2.0 * step);
        let normal = vec3(-slope(Vec2::X), 1.0, -slope(Vec2::Y)).normalize();
        (vec3(at.x, ground_height(at), at.y), normal)
    };
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let corners = [
                corner(column, row),
                corner(column + 1, row),
                corner(column + 1, row + 1),
                corner(column, row + 1),
            ];
            let (middle, up) = corners[0];
            let rock = ((0.93 - up.y) * 9.0).clamp(0.0, 1.0);
            let snow = ((middle.y - 60.0) / 30.0).clamp(0.0, 1.0) * (1.0 - rock);
            let grass = vec3(0.19, 0.27, 0.10) * (0.97 + 0.06 * hash_noise(row * COLUMNS + column));
            let color = grass
                .lerp(vec3(0.34, 0.31, 0.28), rock)
                .lerp(vec3(0.85, 0.87, 0.9), snow);
            mesh.add_fan(&corners, color, Material::Plain);
        }
    }
    let eye = ground_height(Vec2::ZERO) + 1.9;
    let mut scene = outdoor_scene(mesh, vec3(0.0, eye, 0.0), vec3(1.0, eye + 0.35, -10.0), 34.0);
    scene.sun.direction = Vec3::normalize(vec3(0.85, 0.42, -0.25)).into();
    scene.sky.haze = 0.0016;
    scene
}

/// Height of the ground at (x, z): waves of value noise, higher far away.
fn ground_height(at: Vec2) -> f32 {
    let far = (at.length() / 200.0).powf(1.1).min(3.6);
    let mut sum = 0.0;
    let mut place = at / 60.0 + vec2(3.7, 9.2);
    let mut share = 34.0 * far;
    for octave in 0..6 {
        sum += share * (value_noise(place, octave) - 0.42);
        // Turned, so that no grid shows.
        place = vec2(1.6 * place.x + 1.2 * place.y, -1.2 * place.x + 1.6 * place.y);
        share *= 0.46;
    }
    let near = value_noise(at / 11.0, 17) + 0.25 * value_noise(at / 3.1, 18);
    sum + 2.2 * near
}

/// Smooth noise between 0 and 1.
fn value_noise(at: Vec2, seed: u32) -> f32 {
    let cell = at.floor();
    let t = at - cell;
    let t = t * t * (3.0 - 2.0 * t);
    let corner = |x: f32, y: f32| {
        let (x, y) = ((cell.x + x) as i32, (cell.y + y) as i32);
        hash_noise((x as u32).wrapping_mul(0x9e37_79b9) ^ (y as u32).wrapping_mul(0x85eb_ca6b) ^ (seed << 20))
    };
    let low = corner(0.0, 0.0) * (1.0 - t.x) + corner(1.0, 0.0) * t.x;
    let high = corner(0.0, 1.0) * (1.0 - t.x) + corner(1.0, 1.0) * t.x;
    low * (1.0 - t.y) + high * t.y
}
