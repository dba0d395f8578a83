//! A lattice mast and the wires that run from it.

use super::paint;
use crate::scene::mesh::Mesh;
use glam::{Vec3, vec3};

/// Foot of the mast.
const FOOT: Vec3 = vec3(22.5, 0.0, -17.0);
const HEIGHT: f32 = 15.0;

pub(super) fn add(mesh: &mut Mesh) {
    add_lattice(mesh);
    let arms = [(11.6, 1.9), (13.4, 1.4)];
    for (y, reach) in arms {
        cross_arm(mesh, y, reach);
    }
    let tip = |height: f32, side: f32| FOOT + vec3(side, height, 0.0);
    // Across the sky to beyond the upper left, over the roof; each a little thinner.
    for (i, (height, side)) in [(11.6, -1.9), (11.6, 1.9), (13.4, -1.4), (13.4, 1.4)]
        .into_iter()
        .enumerate()
    {
        let i = i as f32;
        let far = vec3(-15.0, 10.2 + 0.9 * i, -4.0 - 1.2 * i);
        add_wire(mesh, tip(height, side), far, 0.9, 0.009 - 0.002 * i);
        let right = vec3(62.0, 10.0 + 0.8 * i, -15.0 - i);
        add_wire(mesh, tip(height, side), right, 0.7, 0.009);
    }
    // Service wires to the house, low before the wall and the roof.
    add_wire(mesh, tip(9.4, 0.0), vec3(3.9, 3.7, 0.12), 0.8, 0.007);
    add_wire(mesh, vec3(3.9, 3.55, 0.2), vec3(-3.9, 3.42, 0.2), 0.16, 0.0022);
    add_wire(mesh, vec3(-4.4, 3.95, 0.5), vec3(-9.5, 6.4, 3.0), 0.15, 0.003);
    add_wire(mesh, vec3(-4.4, 3.85, 0.5), vec3(-9.5, 6.1, 3.0), 0.15, 0.0016);
    add_aerial(mesh, vec3(1.9, 6.1, -3.0));
}

/// Four legs that lean in, with braces between them.
fn add_lattice(mesh: &mut Mesh) {
    const BAYS: u32 = 11;
    let half = |y: f32| 1.15 - 0.95 * (y / HEIGHT).powf(0.8);
    let corner = |leg: u32, bay: u32| {
        let y = HEIGHT * (1.0 - (1.0 - bay as f32 / BAYS as f32).powf(1.25));
        let (x, z) = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)][leg as usize % 4];
        FOOT + vec3(x * half(y), y, z * half(y))
    };
    let color = paint::IRON * 3.0;
    for bay in 0..BAYS {
        for leg in 0..4 {
            mesh.add_bar(corner(leg, bay), corner(leg, bay + 1), 0.035, 4, color);
            mesh.add_bar(corner(leg, bay), corner(leg + 1, bay + 1), 0.016, 4, color);
            mesh.add_bar(corner(leg + 1, bay), corner(leg, bay + 1), 0.016, 4, color);
            mesh.add_bar(corner(leg, bay + 1), corner(leg + 1, bay + 1), 0.018, 4, color);
        }
    }
}

/// An arm to both sides with stays above and insulators below.
fn cross_arm(mesh: &mut Mesh, y: f32, reach: f32) {
    let color = paint::IRON * 3.0;
    for side in [-1.0, 1.0] {
        let tip = FOOT + vec3(reach * side, y + 0.25, 0.0);
        for z in [-0.25, 0.25] {
            mesh.add_bar(FOOT + vec3(0.0, y, z), tip, 0.025, 4, color);
            mesh.add_bar(FOOT + vec3(0.0, y + 0.8, z), tip, 0.018, 4, color);
        }
        let hang = tip - Vec3::Y * 0.25;
        for disc in 0..3 {
            let at = hang + Vec3::Y * (0.08 * disc as f32);
            mesh.add_frustum([(at, 0.06), (at + Vec3::Y * 0.04, 0.03)], 8, paint::TRIM, true);
        }
    }
}

/// A wire of square section that hangs `sag` below the straight line in its middle.
pub(in crate::scene) fn add_wire(mesh: &mut Mesh, from: Vec3, to: Vec3, sag: f32, radius: f32) {
    const PIECES: u32 = 24;
    let at = |i: u32| {
        let share = i as f32 / PIECES as f32;
        from.lerp(to, share) - Vec3::Y * (4.0 * sag * share * (1.0 - share))
    };
    for i in 0..PIECES {
        mesh.add_bar(at(i), at(i + 1), radius, 4, paint::IRON);
    }
}

/// A television aerial with elements thinner than a pixel, and stays thinner yet.
fn add_aerial(mesh: &mut Mesh, foot: Vec3) {
    let top = foot + Vec3::Y * 2.3;
    mesh.add_bar(foot, top, 0.018, 6, paint::IRON * 2.0);
    let boom = vec3(0.85, 0.12, 0.35);
    mesh.add_bar(top - boom, top + boom, 0.010, 4, paint::IRON * 2.0);
    for i in 0..9 {
        let at = top + boom * (-1.0 + 0.25 * i as f32);
        let half = vec3(0.12, 0.30, 0.0) * (1.0 - 0.05 * i as f32);
        mesh.add_bar(at - half, at + half, 0.0045, 4, paint::IRON * 2.0);
    }
    for end in [vec3(-1.6, -0.25, 0.9), vec3(1.5, -0.2, 0.8), vec3(0.1, -0.2, -1.2)] {
        mesh.add_bar(top - Vec3::Y * 0.3, foot + end, 0.002, 4, paint::IRON);
    }
}
