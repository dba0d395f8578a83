//! List of the hard cases.

mod color;
mod coordinates;
mod depth;
mod normal;
mod parameter;
mod shape;

use super::case::{Case, Normal, Place, Seen};
use glam::{Vec3, vec3};

/// Returns all cases.
pub fn all_cases() -> Vec<Case> {
    [
        shape::CASES,
        depth::CASES,
        normal::CASES,
        color::CASES,
        parameter::CASES,
        coordinates::CASES,
    ]
    .concat()
}

/// A wall in front of another, both slightly slanted: depths 5 and 8.
fn two_walls(place: &Place) -> Seen {
    match place.is_behind() {
        true => noisy_surface(place, 8.0, vec3(0.6, 0.0, 0.8)),
        false => noisy_surface(place, 5.0, vec3(0.0, -0.28, 0.96)),
    }
}

/// A surface with noise as its colour.
fn noisy_surface(place: &Place, depth: f32, normal: Vec3) -> Seen {
    Seen {
        depth,
        normal: Normal::Vector(normal),
        color: place.color(),
    }
}

/// Returns the `steps`-th floating-point number after `x`, of the same sign.
fn steps_from(x: f32, steps: u32) -> f32 {
    f32::from_bits(x.to_bits() + steps)
}
