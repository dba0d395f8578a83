//! Cases of options and uniforms at the ends of their ranges, and beyond.

use super::{noisy_surface, two_walls};
use crate::hard::case::{Case, Place, Seen};
use glam::vec3;

const UNIFORM: &[(&str, &str)] = &[("tau", "uniform"), ("depth-scale", "uniform")];

pub const CASES: &[Case] = &[
    Case::new("tau-0", "every surface counts alike", slanted_walls).with_options(&[("tau", "0")]),
    Case::new(
        "tau-tiny",
        "weights differ by less than they are rounded by",
        slanted_walls,
    )
    .with_options(&[("tau", "1e-9")]),
    Case::new(
        "tau-1e6",
        "all weights but the nearest surface's underflow",
        slanted_walls,
    )
    .with_options(&[("tau", "1e6")]),
    Case::new("tau-0-at-run-time", "the same as a uniform", slanted_walls)
        .with_options(UNIFORM)
        .with_uniforms(&[("tau", 0.0)]),
    Case::new("tau-1e6-at-run-time", "the same as a uniform", slanted_walls)
        .with_options(UNIFORM)
        .with_uniforms(&[("tau", 1.0e6)]),
    Case::new(
        "tau-infinite",
        "beyond its range at run time: infinity times the difference 0",
        slanted_walls,
    )
    .with_options(UNIFORM)
    .with_uniforms(&[("tau", f64::INFINITY)]),
    Case::new("depth-scale-0", "depth counts for nothing", slanted_walls).with_options(&[("depth-scale", "0")]),
    Case::new(
        "depth-scale-tiny",
        "depth counts for less than the rounding of normals",
        slanted_walls,
    )
    .with_options(&[("depth-scale", "1e-12")]),
    Case::new(
        "depth-scale-1e6",
        "every step in depth is one between surfaces",
        slanted_walls,
    )
    .with_options(&[("depth-scale", "1e6")]),
    Case::new(
        "depth-scale-0-at-run-time",
        "the same as a uniform, before an infinite sky",
        walls_before_sky,
    )
    .with_options(UNIFORM)
    .with_uniforms(&[("depth_scale", 0.0)]),
    Case::new(
        "depth-scale-1e6-at-run-time",
        "the same as a uniform, before an infinite sky",
        walls_before_sky,
    )
    .with_options(UNIFORM)
    .with_uniforms(&[("depth_scale", 1.0e6)]),
    Case::new(
        "depth-scale-1e38",
        "beyond its range at run time: a step of 3 becomes infinite",
        slanted_walls,
    )
    .with_options(UNIFORM)
    .with_uniforms(&[("depth_scale", 1.0e38)]),
    Case::new(
        "narrowest-gaussian",
        "the narrowest falloff: corners weigh 1e-28, and may be the only ones",
        slanted_walls,
    )
    .with_options(&[("falloff", "gaussian"), ("sigma", "0.125"), ("pattern", "latin16")]),
    Case::new(
        "masked-at-0",
        "a mask that keeps only what does not differ at all",
        slanted_walls,
    )
    .with_options(&[("mask", "select"), ("mask-threshold", "0")]),
    Case::new("relative-at-0", "depth counts by its share, and begins at 0", |p| {
        noisy_surface(p, 1.0 + p.centred().x, vec3(0.0, 0.0, 1.0))
    })
    .with_options(&[("difference", "relative")]),
];

/// Receding walls, with depth differences of all sizes.
fn slanted_walls(place: &Place) -> Seen {
    let mut seen = two_walls(place);
    seen.depth += 0.003 * place.at.x + 0.000_3 * place.at.y * place.at.y;
    seen
}

fn walls_before_sky(place: &Place) -> Seen {
    let mut seen = slanted_walls(place);
    if place.is_behind() {
        seen.depth = f32::INFINITY;
    }
    seen
}
