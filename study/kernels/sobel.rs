//! The Sobel operator, its loops left in the shader: over a list of the eight neighbours with a weight.

use straightline_kernels::prelude::*;

const PLACES: [IVec2; 8] = [
    ivec2(-1, -1),
    ivec2(0, -1),
    ivec2(1, -1),
    ivec2(-1, 0),
    ivec2(1, 0),
    ivec2(-1, 1),
    ivec2(0, 1),
    ivec2(1, 1),
];

const WEIGHTS: [Vec2; 8] = [
    vec2(-1.0, -1.0),
    vec2(0.0, -2.0),
    vec2(1.0, -1.0),
    vec2(-2.0, 0.0),
    vec2(2.0, 0.0),
    vec2(-1.0, 1.0),
    vec2(0.0, 2.0),
    vec2(1.0, 1.0),
];

/// Equals `sobel`, bit for bit.
pub fn sobel(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut gradient = Vec2::ZERO;
    for k in 0..8 {
        let luma = color.load(pixel + PLACES[k]).truncate().dot(vec3(0.2126, 0.7152, 0.0722));
        gradient += WEIGHTS[k] * luma;
    }
    let strength = gradient.length();
    let direction = if strength > 1.0e-4 {
        gradient / strength
    } else {
        Vec2::ZERO
    };
    let tinted = vec3(0.5 + 0.5 * direction.x, 0.5 + 0.5 * direction.y, 0.5) * strength;
    tinted.min(Vec3::ONE).extend(1.0)
}
