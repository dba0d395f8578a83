//! Cases of picture sizes, and of surfaces in unfavourable positions.

use super::{noisy_surface, steps_from, two_walls};
use crate::hard::case::{Case, Place, Seen};
use glam::{Vec3, vec3};

pub const CASES: &[Case] = &[
    Case::new(
        "one-pixel",
        "every tap is the border: one texel stands for all nine",
        two_walls,
    )
    .with_size(1, 1),
    Case::new("one-wide", "left and right of every pixel is the border", two_walls).with_size(1, 16),
    Case::new("one-high", "above and below every pixel is the border", two_walls).with_size(16, 1),
    Case::new("two-by-two", "no pixel has all its neighbours", two_walls).with_size(2, 2),
    Case::new("odd-size", "quads stick out of the picture at two sides", two_walls)
        .with_size(13, 7)
        .mark_common(),
    Case::new("two-walls", "the plain case: a step of 3 between two walls", two_walls).mark_common(),
    Case::new(
        "thin-wire",
        "a wire that no shading sample saw: all weights of its samples underflow",
        wire,
    )
    .mark_common(),
    Case::new(
        "lost-samples",
        "every geometry sample sees a surface of its own: all weights of all samples underflow",
        lost_samples,
    ),
    Case::new("crease", "depth goes on, the normal turns by a right angle", crease).mark_common(),
    Case::new(
        "round-edge",
        "normals turn by a few degrees a pixel: differences near the smallest that count",
        round,
    )
    .mark_common(),
    Case::new(
        "grazing-floor",
        "a floor to the horizon: depth grows from 1 to 700, by hundreds in a pixel at the end",
        floor,
    )
    .mark_common(),
    Case::new(
        "grazing-wall",
        "normals at a right angle to the rays: the plane passes through the eye",
        edge_on,
    ),
    Case::new(
        "one-wall",
        "no edge at all: every weight is as large as any other",
        flat,
    )
    .mark_common(),
    Case::new(
        "coincident",
        "two surfaces at one depth with one normal: only colours differ",
        coincident,
    )
    .mark_common(),
    Case::new(
        "z-fighting",
        "of two surfaces one millionth apart each sample sees either",
        fighting,
    )
    .mark_common(),
    Case::new(
        "back-to-back",
        "opposite normals at one depth: as different as normals can be",
        back,
    ),
    Case::new(
        "depth-chequers",
        "depths 1 and 100 in turn: no neighbour is on the pixel's surface",
        chequers,
    ),
    Case::new(
        "sample-chequers",
        "depths 1 and 100 from sample to sample",
        sample_chequers,
    ),
    Case::new(
        "normal-chequers",
        "three normals at right angles in turn",
        normal_chequers,
    ),
    Case::new(
        "tiny-steps-everywhere",
        "each sample one unit in the last place deeper than the last",
        staircase,
    ),
];

fn wire(place: &Place) -> Seen {
    // Half a pixel wide, and next to the pixel centres.
    let across = (place.at.x + 0.25 * place.at.y).rem_euclid(6.0);
    match place.sample.is_some() && (0.6..1.0).contains(&across) {
        true => noisy_surface(place, 2.0, Vec3::Z),
        false => noisy_surface(place, 9.0, vec3(0.6, 0.0, 0.8)),
    }
}

fn lost_samples(place: &Place) -> Seen {
    let depth = place.sample.map_or(3.0, |k| 10.0 + 5.0 * k as f32);
    noisy_surface(place, depth, Vec3::Z)
}

fn crease(place: &Place) -> Seen {
    let side = place.centred().x;
    let normal = vec3(side.signum() * 0.707_106_77, 0.0, 0.707_106_77);
    noisy_surface(place, 4.0 + 0.5 * side.abs(), normal)
}

fn round(place: &Place) -> Seen {
    let angle = place.centred().x * 0.4;
    noisy_surface(place, 6.0 - angle.cos(), vec3(angle.sin(), 0.0, angle.cos()))
}

fn floor(place: &Place) -> Seen {
    // The horizon is just above the picture.
    let below = place.at.y / place.size.y as f32 + 0.0012;
    noisy_surface(place, 1.0 / below, Vec3::Y)
}

fn edge_on(place: &Place) -> Seen {
    let normal = vec3(1.0, 0.0, 0.5 * place.centred().x).normalize();
    noisy_surface(place, 5.0 + 3.0 * place.centred().y, normal)
}

fn flat(place: &Place) -> Seen {
    noisy_surface(place, 5.0, Vec3::Z)
}

fn coincident(place: &Place) -> Seen {
    let mut seen = flat(place);
    if place.is_behind() {
        seen.color *= 0.01;
    }
    seen
}

fn fighting(place: &Place) -> Seen {
    let depth = if place.sample_noise(5) < 0.5 { 5.0 } else { 5.000_005 };
    noisy_surface(place, depth, Vec3::Z)
}

fn back(place: &Place) -> Seen {
    let normal = vec3(0.36, 0.48, 0.8);
    noisy_surface(place, 5.0, if place.is_behind() { normal } else { -normal })
}

fn chequers(place: &Place) -> Seen {
    let odd = (place.pixel.x + place.pixel.y) % 2 == 1;
    noisy_surface(place, if odd { 100.0 } else { 1.0 }, Vec3::Z)
}

fn sample_chequers(place: &Place) -> Seen {
    let odd = place.sample.is_some_and(|k| (k as u32 + place.pixel.x) % 2 == 1);
    noisy_surface(place, if odd { 100.0 } else { 1.0 }, Vec3::Z)
}

fn normal_chequers(place: &Place) -> Seen {
    let axis = (place.pixel.x + 2 * place.pixel.y) % 3;
    noisy_surface(place, 5.0, Vec3::AXES[axis as usize])
}

fn staircase(place: &Place) -> Seen {
    let sample = place.sample.map_or(0, |k| k as u32 + 1);
    noisy_surface(
        place,
        steps_from(5.0, sample + 17 * (place.pixel.x + place.pixel.y)),
        Vec3::Z,
    )
}
