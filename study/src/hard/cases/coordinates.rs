//! Cases of shadow-map coordinates that are not finite or far away, and of tiny maps.

use super::two_walls;
use crate::hard::case::{Case, Place};
use glam::{Vec3, vec3};

pub const CASES: &[Case] = &[
    coordinate_case(
        "shadow-coordinates",
        "the plain case: two walls in a map of as many texels",
        Place::shadow_coordinates,
    )
    .mark_common(),
    coordinate_case(
        "nan-coordinates",
        "coordinates that are no numbers, in some pixels",
        |p| replace_coordinates(p, p.is_spot(), Vec3::NAN),
    ),
    coordinate_case(
        "nan-lane",
        "coordinates that are no numbers, in one lane of each quad",
        |p| replace_coordinates(p, p.is_one_lane(), Vec3::NAN),
    ),
    coordinate_case(
        "nan-lanes",
        "coordinates that are numbers in one lane of each quad alone",
        |p| replace_coordinates(p, !p.is_one_lane(), Vec3::NAN),
    ),
    coordinate_case(
        "nan-component",
        "of each bad coordinate one component is no number",
        |p| {
            let mut coord = p.shadow_coordinates();
            if p.is_one_lane() {
                coord[(p.pixel.x / 2 + p.pixel.y) as usize % 3] = f32::NAN;
            }
            coord
        },
    ),
    coordinate_case("no-coordinates", "no coordinate is a number", |_| Vec3::NAN),
    coordinate_case(
        "infinite-coordinates",
        "coordinates of both signs divided by a w of 0, in some pixels",
        |p| replace_coordinates(p, p.is_spot(), (p.centred() - 0.1).extend(1.0) / 0.0),
    ),
    coordinate_case("infinite-lane", "infinite coordinates in one lane of each quad", |p| {
        replace_coordinates(p, p.is_one_lane(), Vec3::INFINITY)
    }),
    coordinate_case("infinite-half", "infinite coordinates in half of the picture", |p| {
        replace_coordinates(p, p.is_behind(), vec3(f32::INFINITY, f32::NEG_INFINITY, f32::INFINITY))
    }),
    coordinate_case(
        "infinite-coordinates-everywhere",
        "every coordinate is infinite",
        |_| Vec3::NEG_INFINITY,
    ),
    coordinate_case(
        "infinite-depth-to-compare",
        "a depth to compare that is infinite, in some pixels",
        |p| {
            let mut coord = p.shadow_coordinates();
            if p.is_spot() {
                coord.z = if p.pixel.x % 3 == 0 {
                    f32::NEG_INFINITY
                } else {
                    f32::INFINITY
                };
            }
            coord
        },
    ),
    coordinate_case(
        "through-the-light",
        "w passes through 0 in the picture: coordinates grow without bound on both sides",
        |p| p.shadow_coordinates() / (p.centred().x + 0.013),
    ),
    coordinate_case("far-coordinates", "places 50 maps away: the border's light", |p| {
        p.shadow_coordinates() + vec3(50.0, -50.0, 0.0)
    }),
    coordinate_case("far-lane", "a place 1000 maps away in one lane of each quad", |p| {
        replace_coordinates(p, p.is_one_lane(), vec3(1000.0, -1000.0, 0.3))
    }),
    coordinate_case(
        "huge-coordinates",
        "coordinates of 1e30 and 3e38, in some pixels",
        |p| {
            replace_coordinates(
                p,
                p.is_spot(),
                if p.pixel.x % 2 == 0 {
                    vec3(1.0e30, 0.5, 0.3)
                } else {
                    Vec3::splat(-3.0e38)
                },
            )
        },
    ),
    coordinate_case("huge-coordinates-everywhere", "coordinates of 3e38 alone", |_| {
        Vec3::splat(3.0e38)
    }),
    coordinate_case(
        "subnormal-coordinates",
        "coordinates of 1e-40, which may be flushed to 0",
        |_| Vec3::splat(1.0e-40),
    ),
    coordinate_case(
        "negative-depth-to-compare",
        "depths to compare below 0: all is lit",
        |p| p.shadow_coordinates() * vec3(1.0, 1.0, -1.0),
    ),
    coordinate_case("seen-from-afar", "eight texels and more from pixel to pixel", |p| {
        (p.centred() * 3.1 + 0.5).extend(0.35)
    }),
    coordinate_case(
        "on-texels",
        "places on the borders of texels, which a rounding moves across",
        |p| {
            let at = p.pixel.as_vec2() / 2.0;
            (at.floor() / glam::vec2(16.0, 12.0) + 0.25).extend(0.3)
        },
    ),
    coordinate_case("one-texel", "a map of one texel", Place::shadow_coordinates).with_shadow_map(1, 1),
    coordinate_case(
        "one-row",
        "a map of one row, and coordinates that are no numbers in some pixels",
        |p| replace_coordinates(p, p.is_spot(), Vec3::NAN),
    )
    .with_shadow_map(16, 1),
    coordinate_case(
        "one-column",
        "a map of one column, and infinite coordinates in some pixels",
        |p| replace_coordinates(p, p.is_spot(), Vec3::INFINITY),
    )
    .with_shadow_map(1, 12),
    coordinate_case(
        "odd-shadow",
        "quads stick out of the picture, and their lanes inside have no coordinates here and there",
        |p| replace_coordinates(p, p.pixel.x == 12 && p.pixel.y % 3 == 0, Vec3::NAN),
    )
    .with_size(13, 7),
];

const fn coordinate_case(name: &'static str, about: &'static str, coord: fn(&Place) -> Vec3) -> Case {
    Case::new(name, about, two_walls).with_coordinates(coord)
}

fn replace_coordinates(place: &Place, is_bad: bool, bad: Vec3) -> Vec3 {
    match is_bad {
        true => bad,
        false => place.shadow_coordinates(),
    }
}
