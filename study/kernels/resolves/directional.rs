//! The directionally adaptive filter (Iourcha, Yang and Pomianowski 2009). Its definition in f64 explains the reasoning:
//! `study/src/baselines/directional.rs`.

use straightline_kernels::prelude::*;

/// Smallest difference of luma that is an edge: a step of 8 bits.
const EDGE: f32 = 1.0 / 255.0;

/// Share of the variance that a plane must explain.
const EXPLAINED: f32 = 0.5;

/// Samples of `latin4`, from the pixel's centre, which is their mean.
const SAMPLES: [Vec2; 4] = [
    vec2(-0.125, -0.375),
    vec2(0.375, -0.125),
    vec2(-0.375, 0.125),
    vec2(0.125, 0.375),
];

/// Resolves the colour of `pixel` from the samples of 3×3 pixels, linear, a layer of `colors` each.
pub fn directional(colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    let mut even = Vec4::ZERO;
    let mut dark = 1.0f32;
    let mut bright = 0.0f32;
    for sample in 0..4 {
        let color = colors.load(pixel, sample);
        let luma = luma(color);
        even += 0.25 * color;
        dark = dark.min(luma);
        bright = bright.max(luma);
    }
    // Most pixels are uniform.
    #[cfg_attr(false, branch)]
    let resolved = if bright - dark < EDGE {
        even
    } else {
        along_the_edge(colors, pixel, even)
    };
    resolved
}

/// Colour of a pixel whose samples differ; `even` where no plane fits the picture around it.
fn along_the_edge(colors: &FrameLayers<Vec4>, pixel: IVec2, even: Vec4) -> Vec4 {
    let mut around = [Vec4::ZERO; 36];
    let mut lumas = [0.0; 36];
    let mut mean = 0.0;
    for k in 0..36 {
        around[k] = colors.load(pixel + neighbour(k), k % 4);
        lumas[k] = luma(around[k]);
        mean += lumas[k] / 36.0;
    }
    // The best-fitting plane. The layout of the samples is the same around every pixel, so that terms of it alone are constants.
    let mut squares = Mat2::ZERO;
    let mut moment = Vec2::ZERO;
    let mut variance = 0.0;
    for k in 0..36 {
        let from = place(k);
        let off = lumas[k] - mean;
        squares += Mat2::from_cols(from * from.x, from * from.y);
        moment += from * off;
        variance += off * off;
    }
    let slope = squares.inverse() * moment;
    let explained = slope.dot(moment);
    if explained < EXPLAINED * variance || explained <= 0.0 {
        return even;
    }
    let along = slope.perp().normalize();
    let mut sum = Vec4::ZERO;
    let mut total = 0.0;
    for k in 0..36 {
        let weight = chord(place(k), along);
        sum += weight * around[k];
        total += weight;
    }
    sum / total
}

/// Pixel of sample `k` of all samples around.
fn neighbour(k: usize) -> IVec2 {
    ivec2((k / 4 % 3) as i32 - 1, (k / 12) as i32 - 1)
}

/// Position of sample `k`.
fn place(k: usize) -> Vec2 {
    neighbour(k).as_vec2() + SAMPLES[k % 4]
}

/// Luma of the display-encoded picture.
fn luma(linear: Vec4) -> f32 {
    let c = linear.truncate().clamp(Vec3::ZERO, Vec3::ONE);
    let shown = vec3(encoded(c.x), encoded(c.y), encoded(c.z));
    shown.dot(vec3(0.2126, 0.7152, 0.0722))
}

/// Encodes a linear value as sRGB, 0 to 1.
fn encoded(c: f32) -> f32 {
    if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// Length of the line through `place` in the direction `along` within the pixel around the origin.
fn chord(place: Vec2, along: Vec2) -> f32 {
    // An axis-parallel line is tilted so little that it leaves the pixel at its far ends.
    let steep = along.abs().cmplt(Vec2::splat(1.0e-6));
    let inverse = 1.0 / Vec2::select(steep, Vec2::splat(1.0e-6), along);
    let one = (-0.5 - place) * inverse;
    let other = (0.5 - place) * inverse;
    let from = one.min(other).max_element();
    let to = one.max(other).min_element();
    (to - from).max(0.0)
}
