//! A street of telegraph poles, and a fan of wires at all angles, each thinner than the last.

use super::{add_lawn, add_tube, outdoor_scene};
use crate::scene::Scene;
use crate::scene::builtin::mast::add_wire;
use crate::scene::mesh::Mesh;
use glam::{Vec3, vec3};

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_lawn(&mut mesh, 900.0, vec3(0.30, 0.29, 0.20));
    let poles = [14.0, 0.0, -14.0, -28.0, -42.0, -56.0, -70.0, -90.0];
    for z in poles {
        add_pole(&mut mesh, vec3(-4.5, 0.0, z));
    }
    for pair in poles.windows(2) {
        for (arm, height) in [(0, 6.9), (1, 6.2)] {
            for k in 0..6 {
                let x = -4.5 + 0.42 * (k as f32 - 2.5);
                let radius = 0.010 - 0.0014 * (k + arm) as f32;
                add_wire(
                    &mut mesh,
                    vec3(x, height, pair[0]),
                    vec3(x, height, pair[1]),
                    0.45,
                    radius.max(0.0012),
                );
            }
        }
    }
    add_wire_fan(&mut mesh, vec3(3.2, 0.0, -6.0));
    outdoor_scene(mesh, vec3(0.2, 1.7, 4.5), vec3(-0.2, 4.75, -8.0), 48.0)
}

/// A pole with two cross-arms and insulators.
fn add_pole(mesh: &mut Mesh, foot: Vec3) {
    let wood = vec3(0.22, 0.15, 0.09);
    mesh.add_frustum([(foot, 0.13), (foot + Vec3::Y * 7.4, 0.09)], 10, wood, true);
    for height in [6.8, 6.1] {
        let arm = vec3(1.25, 0.06, 0.05);
        let middle = foot + Vec3::Y * height;
        mesh.add_block(middle - arm, middle + arm, wood * 1.2);
        for k in 0..6 {
            let pin = middle + vec3(0.42 * (k as f32 - 2.5), 0.06, 0.0);
            mesh.add_frustum(
                [(pin, 0.035), (pin + Vec3::Y * 0.07, 0.018)],
                8,
                vec3(0.55, 0.62, 0.6),
                true,
            );
        }
    }
}

/// A mast with stays: around it wires to points all about, from 12 millimetres down to one.
fn add_wire_fan(mesh: &mut Mesh, foot: Vec3) {
    let iron = vec3(0.03, 0.031, 0.035);
    let hub = foot + Vec3::Y * 4.6;
    add_tube(mesh, &[foot, hub], 0.06, 10, iron * 4.0);
    const WIRES: u32 = 44;
    for k in 0..WIRES {
        let angle = std::f32::consts::TAU * k as f32 / WIRES as f32;
        let out = vec3(angle.cos() * 3.1, angle.sin() * 3.1, 0.25 * (7.0 * angle).sin());
        // The thickest and the thinnest side by side, at every angle.
        let radius = 0.006 * 0.5_f32.powf((k % 4) as f32 * 1.2);
        add_tube(mesh, &[hub + out * 0.06, hub + out], radius, 4, iron);
    }
    for turn in 1..=3 {
        let ring: Vec<Vec3> = (0..=60)
            .map(|k| {
                let angle = std::f32::consts::TAU * k as f32 / 60.0;
                hub + vec3(angle.cos(), angle.sin(), 0.0) * (1.03 * turn as f32)
            })
            .collect();
        add_tube(mesh, &ring, 0.012 / turn as f32, 5, iron);
    }
}
