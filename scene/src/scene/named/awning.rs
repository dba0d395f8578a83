//! Ground, a wall, steps and posts in the shadow of slats: hard edges of light on surfaces that are even.

use super::{add_ball, add_slabs, outdoor_scene};
use crate::scene::mesh::Mesh;
use crate::scene::{Material, Scene};
use glam::{Affine3A, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    mesh.add_with_material(Material::Slats, |mesh| {
        add_slabs(mesh, -6..6, -5..4, 2.0, |_, _| vec3(0.62, 0.58, 0.50));
        mesh.add_block(vec3(-9.0, 0.0, -5.6), vec3(9.0, 3.8, -5.2), vec3(0.70, 0.62, 0.50));
        for step in 0..4 {
            let (y, z) = (0.18 * step as f32, -2.4 - 0.4 * step as f32);
            mesh.add_block(vec3(1.2, 0.0, -4.4), vec3(4.2, y + 0.18, z), vec3(0.55, 0.53, 0.50));
        }
        let turned = Affine3A::from_translation(vec3(-1.4, 0.0, -1.8)) * Affine3A::from_rotation_y(0.5);
        mesh.add_at(turned, |mesh| {
            mesh.add_block(vec3(-0.6, 0.0, -0.6), vec3(0.6, 1.1, 0.6), vec3(0.48, 0.30, 0.20));
        });
        add_ball(mesh, vec3(0.3, 0.6, -1.2), 0.6, 24, true, vec3(0.36, 0.46, 0.55));
        for k in 0..6 {
            let x = -3.4 + 1.3 * k as f32;
            mesh.add_bar(vec3(x, 0.0, 0.4), vec3(x, 2.2, 0.4), 0.035, 12, vec3(0.40, 0.36, 0.32));
        }
    });
    outdoor_scene(mesh, vec3(-0.6, 1.8, 4.6), vec3(0.2, 0.8, -2.4), 44.0)
}
