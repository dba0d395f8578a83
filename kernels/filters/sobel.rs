//! Edges by the Sobel operator.

use straightline_kernels::prelude::*;

/// Rec. 709 luma.
fn luma(color: Vec4) -> f32 {
    color.truncate().dot(vec3(0.2126, 0.7152, 0.0722))
}

/// Length of the luma gradient in grey, and its direction in red and green.
pub fn sobel(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    const SMOOTH: [f32; 3] = [1.0, 2.0, 1.0];
    const SLOPE: [f32; 3] = [-1.0, 0.0, 1.0];
    let mut gradient = Vec2::ZERO;
    for y in 0..3 {
        for x in 0..3 {
            let weight = vec2(SLOPE[x] * SMOOTH[y], SMOOTH[x] * SLOPE[y]);
            // The centre has weight 0 and is not read.
            if weight != Vec2::ZERO {
                gradient += weight * luma(color.load(pixel + ivec2(x as i32 - 1, y as i32 - 1)));
            }
        }
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
