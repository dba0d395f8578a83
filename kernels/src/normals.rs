//! Decoding of normals from textures.

use crate::prelude::*;

/// Smaller than the square of any normal's length, and not 0 in 16 bits.
const NO_NORMAL: f32 = 1.0e-4;

/// Decodes a unit vector from its octahedral map, a square from -1 to 1 (Cigolle et al. 2014, "A Survey of Efficient
/// Representations for Independent Unit Vectors").
pub fn folded(square: Vec2) -> Vec3 {
    let z = 1.0 - square.x.abs() - square.y.abs();
    let beyond = (-z).max(0.0);
    let x = if square.x >= 0.0 {
        square.x - beyond
    } else {
        square.x + beyond
    };
    let y = if square.y >= 0.0 {
        square.y - beyond
    } else {
        square.y + beyond
    };
    unit(vec3(x, y, z))
}

/// Scales a vector to length 1. One shorter than 1/100, which no surface has, is multiplied by 100: zero stays zero.
pub fn unit(v: Vec3) -> Vec3 {
    v * inverse_sqrt(v.dot(v).max(NO_NORMAL))
}
