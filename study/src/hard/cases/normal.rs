//! Cases of invalid normals.

use super::{noisy_surface, steps_from, two_walls};
use crate::hard::case::{Case, Normal, Place, Seen};
use glam::{Vec3, Vec4, vec3};

pub const CASES: &[Case] = &[
    Case::new("zero-normals", "no normals where nothing was drawn", |p| {
        normal_behind(p, Vec3::ZERO)
    })
    .mark_common(),
    Case::new("zero-normals-everywhere", "no normals at all", |p| {
        noisy_surface(p, 5.0, Vec3::ZERO)
    }),
    Case::new(
        "long-normals",
        "lengths from 1/100 to 100, as of interpolated and unnormalised ones",
        |p| {
            let length = 10.0f32.powf(2.0 * p.centred().x);
            noisy_surface(p, 5.0, length * vec3(0.0, 0.6, 0.8))
        },
    ),
    Case::new(
        "short-normals",
        "interpolated normals that were not made unit vectors: lengths from 0.7 to 1",
        |p| {
            let length = 0.85 + 0.15 * p.centred().x;
            noisy_surface(p, 5.0, length * vec3(0.0, 0.6, 0.8))
        },
    )
    .mark_common(),
    Case::new(
        "nan-normals",
        "normals that were divided by their length of 0, where nothing was drawn",
        |p| normal_behind(p, Vec3::NAN),
    )
    .mark_common(),
    Case::new(
        "nan-normals-in-spots",
        "normals that are no numbers, in some pixels",
        |p| {
            let mut seen = two_walls(p);
            if p.is_spot() {
                seen.normal = Normal::Vector(vec3(f32::NAN, 0.0, 1.0));
            }
            seen
        },
    ),
    Case::new("infinite-normals", "components that are infinite, of both signs", |p| {
        normal_behind(p, vec3(f32::INFINITY, f32::NEG_INFINITY, 1.0))
    }),
    Case::new("huge-normals", "components of 1e30, whose squares are infinite", |p| {
        normal_behind(p, vec3(1.0e30, -1.0e30, 1.0))
    }),
    Case::new(
        "subnormal-normals",
        "components of 1e-40, which may be flushed to 0",
        |p| normal_behind(p, Vec3::splat(1.0e-40)),
    ),
    Case::new("ulp-bumps", "normals that differ in their last place only", |p| {
        noisy_surface(
            p,
            5.0,
            vec3(0.0, steps_from(0.6, (4.0 * p.sample_noise(7)) as u32), 0.8),
        )
    }),
    Case::new(
        "cleared-unorm",
        "8-bit normals decoded from a texel cleared to 0",
        |p| texel_behind(p, Vec4::ZERO),
    )
    .with_options(&[("normals", "unorm")])
    .mark_common(),
    Case::new(
        "grey-unorm",
        "8-bit normals decoded from 1/2, which is no direction",
        |p| texel_behind(p, Vec4::splat(0.5)),
    )
    .with_options(&[("normals", "unorm")]),
    Case::new(
        "almost-grey-unorm",
        "8-bit normals decoded from 128/255, which is hardly a direction",
        |p| texel_behind(p, Vec4::splat(128.0 / 255.0)),
    )
    .with_options(&[("normals", "unorm")]),
    Case::new(
        "cleared-octahedral",
        "octahedral normals decoded from a texel cleared to 0",
        |p| texel_behind(p, Vec4::ZERO),
    )
    .with_options(&[("normals", "octahedral")])
    .mark_common(),
    Case::new(
        "octahedral-seams",
        "octahedral normals on the folds of the square",
        |p| {
            let angle = 0.5 * std::f32::consts::PI * (4.0 * p.centred().x).round();
            noisy_surface(p, 5.0, vec3(angle.cos(), angle.sin(), 0.02 * p.centred().y).normalize())
        },
    )
    .with_options(&[("normals", "octahedral")]),
    Case::new(
        "packed",
        "normal and depth in four halves, a sky clamped to 65504",
        |p| {
            let mut seen = two_walls(p);
            if p.is_behind() {
                seen.depth = f32::INFINITY;
            }
            seen
        },
    )
    .with_options(&[("normals", "packed")])
    .mark_common(),
];

/// Two walls; the rear one has the given normal.
fn normal_behind(place: &Place, normal: Vec3) -> Seen {
    let mut seen = two_walls(place);
    if place.is_behind() {
        seen.normal = Normal::Vector(normal);
    }
    seen
}

/// Two walls; the rear one has the given texel as its normal.
fn texel_behind(place: &Place, texel: Vec4) -> Seen {
    let mut seen = two_walls(place);
    if place.is_behind() {
        seen.normal = Normal::Texel(texel);
    }
    seen
}
