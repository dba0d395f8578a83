//! A street at night: lamps, signs and lit windows, from as bright as white to fifty times that. Where a light and the
//! dark share a pixel, an average of linear colours is all light.

use super::{add_ball, add_lawn, add_tube, outdoor_scene};
use crate::scene::builtin::hash_noise;
use crate::scene::mesh::Mesh;
use crate::scene::{EMISSION, Material, Scene, Sky, Sun};
use glam::{Affine3A, Vec3, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 300.0, vec3(0.22, 0.22, 0.24));
    for (k, (x, z, width, height)) in [
        (-7.5, -6.0, 5.4, 7.5),
        (-7.2, -13.0, 5.0, 10.0),
        (-7.0, -20.0, 4.6, 6.5),
        (7.6, -8.0, 5.0, 9.0),
        (7.2, -16.0, 5.0, 6.8),
        (0.5, -34.0, 12.0, 11.0),
    ]
    .into_iter()
    .enumerate()
    {
        add_building(&mut mesh, vec3(x, 0.0, z), width, height, k as u32);
    }
    for z in [0.5, -5.5, -11.5, -17.5] {
        for side in [-1.0, 1.0] {
            add_lamp(&mut mesh, vec3(3.4 * side, 0.0, z), side);
        }
    }
    for (k, z) in [-3.0, -7.5, -12.5].into_iter().enumerate() {
        add_bulb_string(&mut mesh, vec3(-4.9, 4.6, z), vec3(5.1, 5.0, z - 1.5), k as u32);
    }
    let sign = Affine3A::from_translation(vec3(-4.75, 2.2, -4.4)) * Affine3A::from_rotation_y(1.2);
    mesh.add_at(sign, add_neon);
    let mut scene = outdoor_scene(mesh, vec3(-0.7, 1.75, 6.5), vec3(-0.2, 2.6, -8.0), 48.0);
    scene.sun = Sun {
        direction: vec3(-0.4, 0.75, 0.3).normalize().into(),
        color: [0.14, 0.16, 0.22],
    };
    scene.sky = Sky {
        zenith: [0.006, 0.009, 0.022],
        horizon: [0.035, 0.033, 0.045],
        ground: [0.02, 0.017, 0.014],
        haze: 0.004,
    };
    scene
}

/// A light of a radiance, in multiples of white.
fn add_light(mesh: &mut Mesh, build: impl FnOnce(&mut Mesh)) {
    mesh.add_with_material(Material::Emissive, build);
}

fn scale_radiance(color: Vec3, times: f32) -> Vec3 {
    color * (times / EMISSION)
}

/// A block with windows on the sides towards the street and the camera, some of them lit.
fn add_building(mesh: &mut Mesh, foot: Vec3, width: f32, height: f32, seed: u32) {
    let half = 0.5 * width;
    let (min, max) = (foot - vec3(half, 0.0, 2.6), foot + vec3(half, height, 2.6));
    mesh.add_block(min, max, vec3(0.26, 0.24, 0.25));
    mesh.add_block(
        vec3(min.x - 0.1, height, min.z - 0.1),
        max + vec3(0.1, 0.18, 0.1),
        vec3(0.3, 0.29, 0.3),
    );
    let mut window = |at: Vec3, right: Vec3, seed: u32| {
        let lit = hash_noise(seed) > 0.45;
        let out = right.cross(Vec3::Y) * 0.02;
        let up = Vec3::Y * 1.05;
        let corners = [at, at + right, at + right + up, at + up].map(|p| p + out);
        let warm = vec3(
            1.0,
            0.72 + 0.2 * hash_noise(seed + 1),
            0.40 + 0.3 * hash_noise(seed + 2),
        );
        if lit {
            add_light(mesh, |mesh| {
                mesh.add_polygon(&corners, scale_radiance(warm, 0.5 + 3.0 * hash_noise(seed + 3).powi(3)));
            });
            // A cross of bars before it.
            let middle = at + 0.5 * right + out * 2.0;
            mesh.add_bar(middle, middle + up, 0.015, 4, Vec3::splat(0.02));
            let bar = at + 0.55 * up + out * 2.0;
            mesh.add_bar(bar, bar + right, 0.012, 4, Vec3::splat(0.02));
        } else {
            mesh.add_polygon(&corners, vec3(0.03, 0.04, 0.05));
        }
    };
    let side = if foot.x < 0.0 { max.x } else { min.x };
    for floor in 0..((height - 1.0) / 1.7) as u32 {
        let y = 0.9 + 1.7 * floor as f32;
        for k in 0..((width - 0.6) / 1.1) as u32 {
            let x = min.x + 0.45 + 1.1 * k as f32;
            window(vec3(x, y, max.z), Vec3::X * 0.7, seed * 977 + floor * 37 + k * 5);
        }
        for k in 0..4 {
            let z = min.z + 0.5 + 1.2 * k as f32;
            let (at, right) = match foot.x < 0.0 {
                true => (vec3(side, y, z + 0.7), Vec3::NEG_Z * 0.7),
                false => (vec3(side, y, z), Vec3::Z * 0.7),
            };
            window(at, right, seed * 977 + floor * 41 + k * 7 + 400);
        }
    }
}

/// A post with an arm over the street and a bulb fifty times as bright as white.
fn add_lamp(mesh: &mut Mesh, foot: Vec3, side: f32) {
    let iron = vec3(0.10, 0.11, 0.12);
    let top = foot + Vec3::Y * 3.6;
    let head = top + vec3(-0.75 * side, 0.25, 0.0);
    add_tube(mesh, &[foot, top], 0.045, 8, iron);
    add_tube(mesh, &[top, top + vec3(-0.25 * side, 0.22, 0.0), head], 0.03, 8, iron);
    mesh.add_frustum(
        [(head - Vec3::Y * 0.06, 0.20), (head + Vec3::Y * 0.08, 0.05)],
        14,
        iron,
        false,
    );
    add_light(mesh, |mesh| {
        add_ball(
            mesh,
            head - Vec3::Y * 0.10,
            0.09,
            8,
            false,
            scale_radiance(vec3(1.0, 0.86, 0.66), 50.0),
        );
    });
}

/// Small bulbs on a wire across the street.
fn add_bulb_string(mesh: &mut Mesh, from: Vec3, to: Vec3, seed: u32) {
    const BULBS: u32 = 22;
    let at = |k: u32| {
        let t = k as f32 / BULBS as f32;
        from.lerp(to, t) - Vec3::Y * (3.2 * t * (1.0 - t))
    };
    add_tube(
        mesh,
        &(0..=BULBS).map(at).collect::<Vec<_>>(),
        0.008,
        4,
        Vec3::splat(0.02),
    );
    let hues = [
        vec3(1.0, 0.35, 0.2),
        vec3(1.0, 0.8, 0.3),
        vec3(0.35, 0.8, 1.0),
        vec3(0.5, 1.0, 0.45),
    ];
    add_light(mesh, |mesh| {
        for k in 1..BULBS {
            let hue = hues[((k + seed) % 4) as usize];
            add_ball(mesh, at(k) - Vec3::Y * 0.05, 0.035, 5, false, scale_radiance(hue, 14.0));
        }
    });
}

/// A star and a frame of thin tubes.
fn add_neon(mesh: &mut Mesh) {
    add_light(mesh, |mesh| {
        let star: Vec<Vec3> = (0..=10)
            .map(|k| {
                let angle = std::f32::consts::TAU * (k as f32 / 10.0 + 0.05);
                let radius = if k % 2 == 0 { 0.34 } else { 0.80 };
                vec3(angle.cos() * radius, 1.0 + angle.sin() * radius, 0.0)
            })
            .collect();
        add_tube(mesh, &star, 0.018, 6, scale_radiance(vec3(1.0, 0.16, 0.35), 20.0));
        let frame = [(-1.0, 0.0), (1.0, 0.0), (1.0, 2.0), (-1.0, 2.0), (-1.0, 0.0)].map(|(x, y)| vec3(x, y, 0.0));
        add_tube(mesh, &frame, 0.012, 6, scale_radiance(vec3(0.2, 0.7, 1.0), 12.0));
    });
}
