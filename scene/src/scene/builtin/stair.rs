//! The stair to the right of the house: a flight up to a landing at its wall, with a railing of thin bars.

use super::paint;
use crate::scene::mesh::Mesh;
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::FRAC_PI_2;

const STEPS: u32 = 11;
const RISE: f32 = 0.17;
const RUN: f32 = 0.29;
const WIDTH: f32 = 1.5;
/// Height of the landing, and its depth towards the back.
const LANDING: f32 = RISE * STEPS as f32;
const DEPTH: f32 = 2.3;

pub(super) fn add(mesh: &mut Mesh) {
    // The flight rises towards -z and ends at z = 0 of its own place; turned so that its side shows.
    let place = Affine3A::from_translation(vec3(6.35, 0.0, -0.25)) * Affine3A::from_rotation_y(FRAC_PI_2);
    mesh.add_at(place, |mesh| {
        add_flight(mesh);
        add_landing(mesh);
        for x in [0.06, WIDTH - 0.06] {
            add_railing(
                mesh,
                vec3(x, RISE, STEPS as f32 * RUN - 0.12),
                vec3(x, LANDING, 0.05),
                STEPS * 2,
            );
        }
        add_railing(
            mesh,
            vec3(WIDTH - 0.06, LANDING, 0.0),
            vec3(WIDTH - 0.06, LANDING, -DEPTH),
            16,
        );
        add_railing(mesh, vec3(0.06, LANDING, 0.0), vec3(0.06, LANDING, -DEPTH), 16);
    });
}

/// Solid steps with treads that stand out a little.
fn add_flight(mesh: &mut Mesh) {
    for step in 0..STEPS {
        let front = (STEPS - step) as f32 * RUN;
        let top = (step + 1) as f32 * RISE;
        mesh.add_block(
            vec3(0.0, 0.0, front - RUN),
            vec3(WIDTH, top - 0.045, front),
            paint::STONE * 0.85,
        );
        mesh.add_block(
            vec3(-0.04, top - 0.045, front - RUN),
            vec3(WIDTH + 0.04, top, front + 0.04),
            paint::TRIM * 0.92,
        );
    }
}

/// A slab on piers.
fn add_landing(mesh: &mut Mesh) {
    mesh.add_block(
        vec3(-0.05, LANDING - 0.16, -DEPTH - 0.05),
        vec3(WIDTH + 0.05, LANDING, 0.0),
        paint::TRIM * 0.9,
    );
    for x in [0.02, WIDTH - 0.26] {
        for z in [-DEPTH, -0.3] {
            mesh.add_block(vec3(x, 0.0, z), vec3(x + 0.24, LANDING - 0.16, z + 0.24), paint::STONE);
        }
    }
}

/// Balusters between two points at the foot of the railing, with a hand rail and a lower rail.
pub(in crate::scene) fn add_railing(mesh: &mut Mesh, from: Vec3, to: Vec3, balusters: u32) {
    const HEIGHT: f32 = 0.92;
    let at = |share: f32, height: f32| from.lerp(to, share) + Vec3::Y * height;
    mesh.add_bar(at(0.0, HEIGHT), at(1.0, HEIGHT), 0.028, 8, paint::TIMBER * 1.6);
    mesh.add_bar(at(0.0, 0.12), at(1.0, 0.12), 0.012, 6, paint::IRON);
    mesh.add_bar(at(0.0, HEIGHT - 0.1), at(1.0, HEIGHT - 0.1), 0.009, 6, paint::IRON);
    for i in 0..=balusters {
        let share = i as f32 / balusters as f32;
        // Posts at both ends; between them bars of 8 mm, about a pixel wide.
        let (radius, low, high) = match i {
            0 => (0.03, -RISE, HEIGHT + 0.08),
            _ if i == balusters => (0.03, -RISE, HEIGHT + 0.08),
            _ => (0.008, 0.12, HEIGHT),
        };
        mesh.add_bar(at(share, low), at(share, high), radius, 6, paint::IRON);
    }
}
