//! Filmic curve of the ACES reference transforms as fitted by Stephen Hill (2015), from linear light to sRGB.

use straightline_kernels::prelude::*;

/// sRGB to the transform's primaries, including its desaturation. By rows.
const INPUT: [Vec3; 3] = [
    vec3(0.59719, 0.35458, 0.04823),
    vec3(0.07600, 0.90834, 0.01566),
    vec3(0.02840, 0.13383, 0.83777),
];
/// The inverse, by rows.
const OUTPUT: [Vec3; 3] = [
    vec3(1.60475, -0.53108, -0.07367),
    vec3(-0.10208, 1.10813, -0.00605),
    vec3(-0.00327, -0.07276, 1.07602),
];

fn rows(rows: [Vec3; 3], v: Vec3) -> Vec3 {
    vec3(rows[0].dot(v), rows[1].dot(v), rows[2].dot(v))
}

fn curve(v: Vec3) -> Vec3 {
    let a = v * (v + 0.0245786) - 0.000090537;
    let b = v * (0.983729 * v + 0.432951) + 0.238081;
    a / b
}

/// Transfer function of sRGB.
fn encoded(linear: f32) -> f32 {
    if linear <= 0.0031308 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

pub fn aces(color: &Frame<Vec4>, exposure: f32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mapped = rows(OUTPUT, curve(rows(INPUT, here.truncate() * exposure.exp2())));
    mapped.clamp(Vec3::ZERO, Vec3::ONE).map(encoded).extend(here.w)
}
