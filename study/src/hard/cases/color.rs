//! Cases of colours: bright, dark, and not finite.

use super::two_walls;
use crate::hard::case::{Case, Place, Seen};
use glam::{Vec4, vec4};

pub const CASES: &[Case] = &[
    Case::new("nan-colours", "a colour here and there is no number", |p| {
        color_spot(p, f32::NAN)
    }),
    Case::new("infinite-colours", "a colour here and there is infinite", |p| {
        color_spot(p, f32::INFINITY)
    }),
    Case::new(
        "minus-infinite-colours",
        "a colour here and there is minus infinity",
        |p| color_spot(p, f32::NEG_INFINITY),
    ),
    Case::new(
        "nan-alpha",
        "of a colour here and there alpha alone is no number",
        |p| {
            let mut seen = two_walls(p);
            if p.is_spot() {
                seen.color.w = f32::NAN;
            }
            seen
        },
    ),
    Case::new("no-good-colour", "no colour is a number", |p| {
        colored_walls(p, Vec4::NAN)
    }),
    Case::new("one-good-colour", "one colour of all is a number", |p| {
        let own = two_walls(p).color;
        colored_walls(p, if p.pixel == p.size / 2 { own } else { Vec4::INFINITY })
    }),
    Case::new(
        "bad-wall",
        "of the nearer wall no colour is a number: hardly any weight is left beside it",
        |p| {
            let own = two_walls(p).color;
            colored_walls(p, if p.is_behind() { own } else { Vec4::NAN })
        },
    ),
    Case::new("black", "every colour is 0", |p| colored_walls(p, Vec4::ZERO)).mark_common(),
    Case::new(
        "subnormal-colours",
        "colours of 1e-40, which may be flushed to 0",
        |p| colored_walls(p, two_walls(p).color * 1.0e-40),
    ),
    Case::new(
        "negative-colours",
        "colours from -1 to 1, as of a sharpened picture",
        |p| colored_walls(p, 2.0 * two_walls(p).color - 1.0),
    ),
    Case::new(
        "bright-colours",
        "colours from 0.01 to 1000 beside each other",
        bright_walls,
    )
    .mark_common(),
    Case::new("emissive-1e30", "a wall of 1e30 before one of 1", |p| {
        let factor = if p.is_behind() { 1.0 } else { 1.0e30 };
        colored_walls(p, two_walls(p).color * factor)
    }),
    Case::new(
        "brightest-colours",
        "colours of 3e37, of which ten still have a sum: compilers may take 1/10 of that",
        |p| colored_walls(p, (0.5 + 0.5 * two_walls(p).color) * 3.0e37),
    ),
    Case::new(
        "largest-halves",
        "65504, the largest number in 16 bits, beside 65505 and 65519, which round to it",
        |p| {
            let value = [65504.0, 65505.0, 65519.0][(p.pixel.x % 3) as usize];
            colored_walls(p, vec4(value, value, value, 1.0))
        },
    ),
    Case::new("beyond-halves", "65520, which is infinite in 16 bits, beside 1", |p| {
        let value = if p.is_spot() { 65520.0 } else { 1.0 };
        colored_walls(p, vec4(value, value, value, 1.0))
    }),
    Case::new(
        "premultiplied",
        "transparent colours, premultiplied by an alpha from 0 to 1",
        |p| {
            let alpha = (p.pixel.x % 5) as f32 / 4.0;
            colored_walls(p, two_walls(p).color * alpha)
        },
    )
    .mark_common(),
];

fn colored_walls(place: &Place, color: Vec4) -> Seen {
    Seen {
        color,
        ..two_walls(place)
    }
}

fn color_spot(place: &Place, value: f32) -> Seen {
    let mut color = two_walls(place).color;
    if place.is_spot() {
        color[(place.pixel.x % 3) as usize] = value;
    }
    colored_walls(place, color)
}

fn bright_walls(place: &Place) -> Seen {
    let factor = 10.0f32.powf(5.0 * place.pixel_noise(11) - 2.0);
    let color = two_walls(place).color;
    colored_walls(place, (color.truncate() * factor).extend(1.0))
}
