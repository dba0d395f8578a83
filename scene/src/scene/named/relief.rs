//! Walls, ground, columns and a ball with studs that normals alone show, as normal maps do, from close by to far away.

use super::{add_ball, add_slabs, outdoor_scene};
use crate::scene::mesh::Mesh;
use crate::scene::{Material, Scene};
use glam::{Affine3A, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    mesh.add_with_material(Material::Studded, |mesh| {
        add_slabs(mesh, -7..7, -10..4, 2.0, |_, _| vec3(0.44, 0.42, 0.38));
        mesh.add_block(vec3(-3.4, 0.0, -12.0), vec3(-3.0, 2.6, 0.5), vec3(0.62, 0.50, 0.38));
        mesh.add_block(vec3(-3.0, 0.0, -12.4), vec3(7.0, 3.4, -12.0), vec3(0.58, 0.54, 0.46));
        let turned = Affine3A::from_translation(vec3(0.9, 0.0, -2.2)) * Affine3A::from_rotation_y(0.7);
        mesh.add_at(turned, |mesh| {
            mesh.add_block(vec3(-0.6, 0.0, -0.6), vec3(0.6, 1.1, 0.6), vec3(0.46, 0.22, 0.16));
        });
        add_ball(mesh, vec3(-0.9, 0.65, -1.2), 0.65, 32, true, vec3(0.30, 0.40, 0.46));
        for k in 0..4 {
            let foot = vec3(2.6, 0.0, -1.5 - 2.4 * k as f32);
            mesh.add_frustum(
                [(foot, 0.26), (foot + 2.4 * glam::Vec3::Y, 0.22)],
                24,
                vec3(0.66, 0.63, 0.56),
                true,
            );
        }
    });
    for k in 0..9 {
        let z = -0.6 - 0.9 * k as f32;
        mesh.add_bar(
            vec3(-1.9, 0.0, z),
            vec3(-1.9, 0.9, z),
            0.018,
            10,
            vec3(0.16, 0.17, 0.18),
        );
    }
    mesh.add_bar(
        vec3(-1.9, 0.88, -0.6),
        vec3(-1.9, 0.88, -7.8),
        0.022,
        10,
        vec3(0.16, 0.17, 0.18),
    );
    outdoor_scene(mesh, vec3(-0.3, 1.5, 3.0), vec3(0.35, 0.85, -3.0), 46.0)
}
