//! Balls, posts and a wall in the light of four coloured lamps, a weak sun and an environment: rough and sharp highlights, studs
//! that normals alone show, and shadows of several lights that cross. A cheap guide knows the sun alone.

use super::{add_ball, add_slabs, outdoor_scene};
use crate::scene::mesh::Mesh;
use crate::scene::{Lamp, Material, Scene, Shade};
use glam::{Vec3, vec3};

/// Balls that cast shadows: centre, radius, material and colour.
const BALLS: [(Vec3, f32, Material, Vec3); 7] = [
    (vec3(-1.5, 0.75, -0.6), 0.75, Material::Studded, vec3(0.46, 0.18, 0.12)),
    (vec3(0.25, 0.55, 0.35), 0.55, Material::Glossy, vec3(0.12, 0.13, 0.16)),
    (vec3(1.55, 0.9, -0.9), 0.9, Material::Plain, vec3(0.72, 0.70, 0.66)),
    (vec3(-0.45, 0.3, 1.3), 0.3, Material::Plain, vec3(0.20, 0.42, 0.62)),
    (vec3(1.25, 0.26, 1.15), 0.26, Material::Glossy, vec3(0.52, 0.36, 0.12)),
    (vec3(-2.75, 1.85, -1.7), 0.4, Material::Glossy, vec3(0.40, 0.41, 0.43)),
    (vec3(3.0, 2.0, -1.7), 0.38, Material::Studded, vec3(0.30, 0.46, 0.22)),
];

const LAMPS: [Lamp; 4] = [
    lamp([-2.6, 2.7, 1.6], [1.10, 0.42, 0.12], 2.4),
    lamp([2.4, 2.2, 1.9], [0.10, 0.42, 1.05], 2.4),
    lamp([0.2, 3.2, -1.9], [0.75, 0.16, 0.62], 2.2),
    lamp([0.9, 0.55, 2.6], [0.22, 0.62, 0.26], 1.2),
];

const fn lamp(place: [f32; 3], color: [f32; 3], reach: f32) -> Lamp {
    Lamp { place, color, reach }
}

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_room(&mut mesh);
    for (centre, radius, material, color) in BALLS {
        mesh.add_with_material(material, |mesh| add_ball(mesh, centre, radius, 40, true, color));
    }
    for (x, height) in [(-2.75, 1.45), (3.0, 1.62)] {
        mesh.add_bar(
            vec3(x, 0.0, -1.7),
            vec3(x, height, -1.7),
            0.09,
            16,
            vec3(0.55, 0.52, 0.48),
        );
    }
    for k in 0..8 {
        let x = -3.3 + 0.28 * k as f32;
        mesh.add_bar(vec3(x, 0.0, 1.0), vec3(x, 0.55, 1.0), 0.02, 10, vec3(0.50, 0.48, 0.44));
    }
    mesh.add_bar(
        vec3(-3.4, 0.5, 1.0),
        vec3(-1.2, 0.5, 1.0),
        0.025,
        10,
        vec3(0.50, 0.48, 0.44),
    );
    mesh.add_with_material(Material::Emissive, |mesh| {
        for lamp in LAMPS {
            add_ball(mesh, lamp.place.into(), 0.05, 10, true, Vec3::from(lamp.color) * 0.4);
        }
    });
    let mut scene = outdoor_scene(mesh, vec3(0.1, 1.75, 6.0), vec3(0.1, 0.95, -0.6), 40.0);
    scene.sun.color = [0.46, 0.42, 0.36];
    scene.sky.zenith = [0.05, 0.06, 0.09];
    scene.sky.horizon = [0.10, 0.11, 0.14];
    scene.sky.ground = [0.05, 0.04, 0.03];
    scene.sky.haze = 0.0;
    scene.environment = ENVIRONMENT;
    scene.lamps = LAMPS.to_vec();
    scene.shades = BALLS
        .map(|(centre, radius, ..)| Shade {
            centre: centre.into(),
            radius,
        })
        .to_vec();
    scene
}

/// A bright window at the left, a warm wall at the right, and little from above.
const ENVIRONMENT: [[f32; 3]; 9] = [
    [0.085, 0.080, 0.085],
    [0.020, -0.005, -0.040],
    [0.020, 0.025, 0.035],
    [0.025, 0.022, 0.018],
    [-0.010, -0.006, 0.004],
    [0.012, 0.010, 0.006],
    [0.006, 0.006, 0.008],
    [0.014, 0.004, -0.010],
    [0.010, 0.012, 0.018],
];

/// A floor of boards, a studded wall and a plinth along it.
fn add_room(mesh: &mut Mesh) {
    add_slabs(mesh, -9..9, -6..5, 1.0, |x, z| {
        vec3(0.52, 0.47, 0.40) * if (x + z) % 2 == 0 { 1.0 } else { 0.72 }
    });
    mesh.add_with_material(Material::Studded, |mesh| {
        mesh.add_block(vec3(-8.0, 0.0, -3.0), vec3(8.0, 2.9, -2.75), vec3(0.50, 0.48, 0.45));
    });
    mesh.add_block(vec3(-8.0, 0.0, -2.75), vec3(8.0, 0.22, -2.6), vec3(0.36, 0.30, 0.24));
}
