//! A footbridge with railings, a picket fence, and a chain-link fence whose holes are alpha-tested.

use super::{add_lawn, add_tube, outdoor_scene};
use crate::scene::builtin::square::{add_cypress, add_fence};
use crate::scene::builtin::stair::add_railing;
use crate::scene::mesh::Mesh;
use crate::scene::{Material, Scene};
use glam::{Vec3, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 900.0, vec3(0.20, 0.26, 0.12));
    add_deck(&mut mesh);
    for x in [-1.35, 1.35] {
        add_railing(&mut mesh, vec3(x, 0.12, 3.4), vec3(x, 0.12, -24.0), 150);
    }
    chain_link(&mut mesh, -4.2, 6.0, -30.0);
    add_fence(&mut mesh, vec3(3.6, 0.0, 1.5), vec3(3.6, 0.0, -26.0), 170);
    add_fence(&mut mesh, vec3(3.6, 0.0, -26.0), vec3(30.0, 0.0, -28.0), 150);
    for (k, (x, z, height)) in [
        (-8.5, -12.0, 5.0),
        (-7.4, -21.0, 5.8),
        (6.8, -11.0, 4.4),
        (9.5, -20.0, 5.4),
        (-11.0, -34.0, 7.0),
    ]
    .into_iter()
    .enumerate()
    {
        add_cypress(&mut mesh, vec3(x, 0.0, z), height, k as u32 + 20);
    }
    outdoor_scene(mesh, vec3(-0.55, 1.62, 5.6), vec3(-0.15, 1.05, -6.0), 46.0)
}

/// Planks across the way.
fn add_deck(mesh: &mut Mesh) {
    for plank in 0..190 {
        let z = 3.6 - 0.15 * plank as f32;
        let tint = 0.8 + 0.35 * crate::scene::builtin::hash_noise(plank + 600);
        mesh.add_block(
            vec3(-1.5, 0.05, z - 0.14),
            vec3(1.5, 0.12, z),
            vec3(0.34, 0.25, 0.16) * tint,
        );
    }
    for x in [-1.5, 1.42] {
        mesh.add_block(vec3(x, 0.0, -25.0), vec3(x + 0.08, 0.05, 3.6), vec3(0.16, 0.12, 0.08));
    }
}

/// Posts, a rail, and wires that are a texture with holes.
fn chain_link(mesh: &mut Mesh, x: f32, from: f32, to: f32) {
    const HEIGHT: f32 = 2.1;
    let iron = vec3(0.33, 0.36, 0.37);
    let panels = ((from - to) / 3.0).ceil() as u32;
    let at = |k: u32| from + (to - from) * k as f32 / panels as f32;
    for k in 0..=panels {
        let foot = vec3(x, 0.0, at(k));
        add_tube(mesh, &[foot, foot + Vec3::Y * (HEIGHT + 0.06)], 0.028, 8, iron);
    }
    add_tube(mesh, &[vec3(x, HEIGHT, from), vec3(x, HEIGHT, to)], 0.02, 8, iron);
    mesh.add_with_material(Material::ChainLink, |mesh| {
        for k in 0..panels {
            let corner = |y: f32, k: u32| vec3(x, y, at(k));
            mesh.add_polygon(
                &[
                    corner(0.02, k),
                    corner(0.02, k + 1),
                    corner(HEIGHT, k + 1),
                    corner(HEIGHT, k),
                ],
                iron,
            );
        }
    });
}
