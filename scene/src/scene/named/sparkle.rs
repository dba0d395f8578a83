//! Highlights narrower than a pixel on hammered metal, and the hard shadows of slats on a floor and a stair: edges of
//! shading that no geometry tells of.

use super::{add_ball, add_slabs, outdoor_scene};
use crate::scene::builtin::hash_noise;
use crate::scene::mesh::Mesh;
use crate::scene::{Material, Scene};
use glam::{Vec3, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    mesh.add_with_material(Material::Slats, |mesh| {
        add_floor(mesh);
        add_stair(mesh);
        mesh.add_block(vec3(-8.0, 0.0, -5.4), vec3(9.0, 4.2, -5.0), vec3(0.58, 0.53, 0.46));
        mesh.add_block(vec3(-2.9, 0.0, -2.4), vec3(-1.7, 1.2, -1.2), vec3(0.45, 0.31, 0.18));
    });
    mesh.add_with_material(Material::Glossy, |mesh| {
        add_hammered_ball(mesh, vec3(-0.55, 0.85, -0.35), 0.85, vec3(0.50, 0.30, 0.14));
        add_ball(mesh, vec3(1.05, 0.42, 0.85), 0.42, 28, true, vec3(0.10, 0.14, 0.20));
        add_ball(mesh, vec3(-2.3, 1.55, -1.8), 0.35, 9, false, vec3(0.42, 0.43, 0.45));
        add_metal_sheet(mesh);
        for k in 0..9 {
            let x = 1.75 + 0.34 * k as f32;
            mesh.add_bar(
                vec3(x, 0.2 * k as f32, -1.02),
                vec3(x, 0.2 * k as f32 + 0.95, -1.02),
                0.016,
                10,
                vec3(0.4, 0.4, 0.42),
            );
        }
        mesh.add_bar(
            vec3(1.6, 0.87, -1.02),
            vec3(4.75, 2.72, -1.02),
            0.03,
            12,
            vec3(0.4, 0.4, 0.42),
        );
    });
    outdoor_scene(mesh, vec3(-1.1, 1.9, 4.9), vec3(0.6, 0.8, -1.6), 40.0)
}

fn add_floor(mesh: &mut Mesh) {
    add_slabs(mesh, -9..10, -6..7, 1.0, |x, z| {
        let tint = 0.9 + 0.16 * hash_noise((x + 40) as u32 * 64 + (z + 40) as u32);
        vec3(0.60, 0.55, 0.47) * tint
    });
}

/// Steps up to the right along the wall.
fn add_stair(mesh: &mut Mesh) {
    for step in 0..9 {
        let (x, y) = (1.6 + 0.34 * step as f32, 0.2 * step as f32);
        mesh.add_block(
            vec3(x, 0.0, -2.9),
            vec3(x + 0.34, y + 0.2, -1.1),
            vec3(0.55, 0.53, 0.50),
        );
        mesh.add_block(
            vec3(x - 0.03, y + 0.165, -2.93),
            vec3(x + 0.34, y + 0.2, -1.07),
            vec3(0.68, 0.66, 0.62),
        );
    }
}

/// A ball of many small dents: its normals stray from the round by some degrees.
fn add_hammered_ball(mesh: &mut Mesh, centre: Vec3, radius: f32, color: Vec3) {
    const RINGS: u32 = 64;
    let corner = |ring: u32, side: u32| {
        let side = side % (2 * RINGS);
        let polar = std::f32::consts::PI * ring as f32 / RINGS as f32;
        let angle = std::f32::consts::PI * side as f32 / RINGS as f32;
        let out = vec3(polar.sin() * angle.cos(), -polar.cos(), -polar.sin() * angle.sin());
        let seed = (ring * 2 * RINGS + side) * 3;
        let stray = vec3(hash_noise(seed), hash_noise(seed + 1), hash_noise(seed + 2)) - 0.5;
        (centre + out * radius, (out + stray * 0.34).normalize_or(out))
    };
    for ring in 0..RINGS {
        for side in 0..2 * RINGS {
            let corners = [
                corner(ring, side),
                corner(ring, side + 1),
                corner(ring + 1, side + 1),
                corner(ring + 1, side),
            ];
            mesh.add_fan(&corners, color, Material::Glossy);
        }
    }
}

/// A rippled sheet of metal that leans back so that all of it is close to mirroring the sun: which ripple does changes
/// from pixel to pixel.
fn add_metal_sheet(mesh: &mut Mesh) {
    const SIDE: u32 = 90;
    let facing = vec3(-0.14, 0.52, 0.84).normalize();
    let right = Vec3::Y.cross(facing).normalize();
    let up = facing.cross(right);
    let foot = vec3(1.62, 0.05, 1.3);
    let corner = |x: u32, y: u32| {
        let (x, y) = (2.3 * x as f32 / SIDE as f32, 1.5 * y as f32 / SIDE as f32);
        let (a, b) = (50.0 * x + 27.0 * y, 64.0 * y - 23.0 * x);
        let tilt = right * (0.24 * a.cos() - 0.12 * (1.7 * b).cos()) + up * (0.22 * b.cos() + 0.10 * a.sin());
        (foot + right * x + up * y, (facing + tilt).normalize())
    };
    for x in 0..SIDE {
        for y in 0..SIDE {
            let corners = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
            mesh.add_fan(&corners, vec3(0.12, 0.15, 0.17), Material::Glossy);
        }
    }
}
