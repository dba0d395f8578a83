//! Cases of depths: far, near, equal, encoded in few bits, and not finite.

use super::{noisy_surface, steps_from, two_walls};
use crate::hard::case::{Case, Place, Seen};
use glam::{Vec3, vec3};
use straightline_scene::encode::DepthStorage;

const PERSPECTIVE: &[(&str, &str)] = &[("depth", "perspective")];
const REVERSED: &[(&str, &str)] = &[("depth", "reversed")];
const INFINITE: &[(&str, &str)] = &[("depth", "reversed-infinite")];

pub const CASES: &[Case] = &[
    Case::new(
        "sky-behind",
        "a wall before an infinite depth: infinity less infinity is no number",
        sky_behind,
    )
    .mark_common(),
    Case::new("all-sky", "infinite depth everywhere", |p| {
        noisy_surface(p, f32::INFINITY, Vec3::ZERO)
    })
    .mark_common(),
    Case::new(
        "sky-in-spots",
        "infinite depth in some pixels, as seen through a grid",
        |p| depth_spot(p, f32::INFINITY),
    )
    .mark_common(),
    Case::new("sky-in-one-lane", "infinite depth in one lane of each quad", |p| {
        let mut seen = two_walls(p);
        if p.is_one_lane() {
            seen.depth = f32::INFINITY;
        }
        seen
    }),
    Case::new(
        "odd-sky",
        "an infinite depth where quads stick out of the picture",
        sky_behind,
    )
    .with_size(13, 7)
    .mark_common(),
    Case::new(
        "huge-depth",
        "depths of 3e38 in some pixels, and of -3e38 in others",
        |p| depth_spot(p, if p.pixel.x % 2 == 0 { 3.0e38 } else { -3.0e38 }),
    ),
    Case::new("cleared-sky", "a sky of the largest finite depth, 3.4e38", |p| {
        depth_behind(p, f32::MAX)
    })
    .mark_common(),
    Case::new(
        "deep",
        "depths from 1e5 to 1e29: differences overflow once they are scaled",
        huge_depths,
    ),
    Case::new(
        "zero-depth",
        "depth 0 everywhere, which nothing can be divided by",
        |p| noisy_surface(p, 0.0, Vec3::Z),
    ),
    Case::new(
        "inside-geometry",
        "the eye is inside of a surface: depths from -1 through 0 to 1",
        |p| noisy_surface(p, p.centred().x, Vec3::Z),
    ),
    Case::new("behind-the-eye", "depths below 0", |p| {
        noisy_surface(p, -two_walls(p).depth, Vec3::Z)
    }),
    Case::new("subnormal-depth", "depths of 1e-40, which may be flushed to 0", |p| {
        noisy_surface(p, if p.is_behind() { 1.0e-40 } else { 2.0e-40 }, Vec3::Z)
    }),
    Case::new("nan-depth", "depths that are no numbers, in some pixels", |p| {
        depth_spot(p, f32::NAN)
    }),
    Case::new("nan-depth-everywhere", "no depth is a number", |p| {
        noisy_surface(p, f32::NAN, Vec3::Z)
    }),
    Case::new(
        "minus-infinite-depth",
        "depths of minus infinity, in some pixels",
        |p| depth_spot(p, f32::NEG_INFINITY),
    ),
    Case::new(
        "ulp-steps-near",
        "one unit in the last place between the walls, at 0.1",
        |p| depth_step(p, 0.1),
    ),
    Case::new(
        "ulp-steps-far",
        "one unit in the last place between the walls, at 1e6: a step of 1/16",
        |p| depth_step(p, 1.0e6),
    ),
    Case::new(
        "half-scale-steps",
        "steps of 1e-3 at depth 100: more than f32 needs, less than f16 has",
        |p| noisy_surface(p, if p.is_behind() { 100.003 } else { 100.0 }, Vec3::Z),
    )
    .mark_common(),
    Case::new(
        "depth-16-bit",
        "perspective depth in 16 bits: at 8 of 1000 a step is 1/100",
        two_walls,
    )
    .with_options(PERSPECTIVE)
    .with_storage(DepthStorage::Unorm16)
    .mark_common(),
    Case::new("depth-24-bit", "perspective depth in 24 bits, a sky at 1", sky_behind)
        .with_options(PERSPECTIVE)
        .with_storage(DepthStorage::Unorm24)
        .mark_common(),
    Case::new(
        "depth-24-bit-far",
        "perspective depth in 24 bits at the end of its range: 990 of 1000",
        |p| noisy_surface(p, if p.is_behind() { 990.0 } else { 950.0 }, Vec3::Z),
    )
    .with_options(PERSPECTIVE)
    .with_storage(DepthStorage::Unorm24),
    Case::new("reversed-24-bit", "reversed depth in 24 bits, a sky at 0", sky_behind)
        .with_options(REVERSED)
        .with_storage(DepthStorage::Unorm24)
        .mark_common(),
    Case::new(
        "reversed-sky",
        "reversed infinite depth, a sky of 0, which is divided by",
        sky_behind,
    )
    .with_options(INFINITE)
    .mark_common(),
    Case::new("reversed-all-sky", "reversed infinite depth, 0 everywhere", |p| {
        noisy_surface(p, f32::INFINITY, Vec3::Z)
    })
    .with_options(INFINITE)
    .mark_common(),
    Case::new(
        "reversed-subnormal",
        "reversed infinite depth so far that it is stored below 1e-38",
        |p| noisy_surface(p, if p.is_behind() { 2.0e37 } else { 1.0e37 }, Vec3::Z),
    )
    .with_options(INFINITE)
    .with_planes(1.0e-3, 1.0),
    Case::new(
        "reversed-nan",
        "reversed infinite depth that is no number, in some pixels",
        |p| depth_spot(p, f32::NAN),
    )
    .with_options(INFINITE),
    Case::new(
        "infinite-far-plane",
        "perspective depth with an infinite far plane",
        sky_behind,
    )
    .with_options(PERSPECTIVE)
    .with_planes(0.1, f32::INFINITY),
    Case::new(
        "far-plane-1e38",
        "perspective depth whose near and far plane have no finite product",
        two_walls,
    )
    .with_options(PERSPECTIVE)
    .with_planes(4.0, 3.0e38),
    Case::new(
        "no-near-plane",
        "a near plane of 0: every perspective depth is stored as 1, which is 0/0",
        two_walls,
    )
    .with_options(PERSPECTIVE)
    .with_planes(0.0, 1000.0),
];

fn depth_behind(place: &Place, depth: f32) -> Seen {
    match place.is_behind() {
        true => noisy_surface(place, depth, Vec3::ZERO),
        false => noisy_surface(place, 5.0 + place.centred().y, vec3(0.0, 0.6, 0.8)),
    }
}

fn sky_behind(place: &Place) -> Seen {
    depth_behind(place, f32::INFINITY)
}

fn huge_depths(place: &Place) -> Seen {
    noisy_surface(place, 10.0f32.powf(17.0 + 12.0 * place.centred().x), Vec3::Z)
}

fn depth_spot(place: &Place, depth: f32) -> Seen {
    let mut seen = two_walls(place);
    if place.is_spot() {
        seen.depth = depth;
    }
    seen
}

fn depth_step(place: &Place, depth: f32) -> Seen {
    noisy_surface(place, steps_from(depth, u32::from(place.is_behind())), Vec3::Z)
}
