//! Walls, blocks and ground with dots painted on them, seen straight and at a grazing angle, posts before them.

use super::{add_ball, add_slabs, outdoor_scene};
use crate::scene::mesh::Mesh;
use crate::scene::{Material, Scene};
use glam::{Affine3A, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    mesh.add_with_material(Material::Dots, |mesh| {
        add_slabs(mesh, -8..8, -8..4, 2.0, |_, _| vec3(0.55, 0.54, 0.50));
        mesh.add_block(vec3(-7.0, 0.0, -6.4), vec3(1.2, 3.6, -6.0), vec3(0.80, 0.74, 0.62));
        mesh.add_block(vec3(3.4, 0.0, -9.0), vec3(3.8, 3.0, 1.0), vec3(0.75, 0.42, 0.30));
        let turned = Affine3A::from_translation(vec3(-1.2, 0.0, -2.6)) * Affine3A::from_rotation_y(0.6);
        mesh.add_at(turned, |mesh| {
            mesh.add_block(vec3(-0.6, 0.0, -0.6), vec3(0.6, 1.2, 0.6), vec3(0.62, 0.66, 0.40));
        });
        add_ball(mesh, vec3(1.1, 0.7, -2.0), 0.7, 24, true, vec3(0.82, 0.60, 0.24));
    });
    for k in 0..5 {
        let x = -3.0 + 1.1 * k as f32;
        mesh.add_bar(vec3(x, 0.0, -0.6), vec3(x, 1.1, -0.6), 0.03, 12, vec3(0.30, 0.32, 0.34));
    }
    mesh.add_bar(
        vec3(-3.0, 0.95, -0.6),
        vec3(1.4, 0.95, -0.6),
        0.02,
        12,
        vec3(0.30, 0.32, 0.34),
    );
    outdoor_scene(mesh, vec3(-0.4, 1.7, 3.6), vec3(0.3, 0.9, -3.0), 48.0)
}
