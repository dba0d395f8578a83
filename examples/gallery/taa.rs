//! Temporal antialiasing (Karis, High-quality temporal supersampling, 2014): the last picture, reprojected and clipped to
//! the colours around the pixel in this one.

use straightline_kernels::prelude::*;

fn ycocg(rgb: Vec3) -> Vec3 {
    vec3(
        0.25 * rgb.x + 0.5 * rgb.y + 0.25 * rgb.z,
        0.5 * rgb.x - 0.5 * rgb.z,
        -0.25 * rgb.x + 0.5 * rgb.y - 0.25 * rgb.z,
    )
}

fn rgb(ycocg: Vec3) -> Vec3 {
    let rest = ycocg.x - ycocg.z;
    vec3(rest + ycocg.y, ycocg.x + ycocg.z, rest - ycocg.y)
}

/// Moves `color` towards the centre of a box until it is inside.
fn clipped(color: Vec3, low: Vec3, high: Vec3) -> Vec3 {
    let middle = 0.5 * (low + high);
    let reach = 0.5 * (high - low) + 1.0e-4;
    let from = color - middle;
    let beyond = (from / reach).abs().max_element();
    if beyond > 1.0 { middle + from / beyond } else { color }
}

/// Weight of a colour. Bright pixels weigh less, so that a flickering one does not dominate.
fn tamed(color: Vec3) -> f32 {
    1.0 / (1.0 + color.x)
}

pub fn taa(
    color: &Frame<Vec4>,
    history: &Texture<Vec4>,
    velocities: &Frame<Vec2>,
    linear: &Sampler,
    share: f32,
    resolution: UVec2,
    pixel: IVec2,
) -> Vec4 {
    let here = color.load(pixel);
    let uv = (pixel.as_vec2() + 0.5) / resolution.as_vec2();
    let before = uv - velocities.load(pixel) / resolution.as_vec2();
    if before.cmplt(Vec2::ZERO).any() || before.cmpgt(Vec2::ONE).any() {
        return here;
    }
    let (mut mean, mut squares) = (Vec3::ZERO, Vec3::ZERO);
    for y in -1..=1 {
        for x in -1..=1 {
            let tap = ycocg(color.load(pixel + ivec2(x, y)).truncate());
            mean += tap / 9.0;
            squares += tap * tap / 9.0;
        }
    }
    let spread = (squares - mean * mean).max(Vec3::ZERO).map(f32::sqrt);
    let old = clipped(
        ycocg(history.sample(linear, before).truncate()),
        mean - spread,
        mean + spread,
    );
    let new = ycocg(here.truncate());
    let (old_weight, new_weight) = ((1.0 - share) * tamed(old), share * tamed(new));
    rgb((old * old_weight + new * new_weight) / (old_weight + new_weight)).extend(here.w)
}
