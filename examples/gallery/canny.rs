//! The first three steps of Canny's edge detector (1986): smoothed gradients, thinned to their crests, in two strengths.

use straightline_kernels::prelude::*;

fn luma(color: &Frame<Vec4>, at: IVec2) -> f32 {
    color.load(at).truncate().dot(vec3(0.2126, 0.7152, 0.0722))
}

/// Gradient by Sobel's operator.
fn gradient(color: &Frame<Vec4>, at: IVec2) -> Vec2 {
    let mut sum = Vec2::ZERO;
    for k in -1i32..=1 {
        let weight = (2 - k.abs()) as f32;
        sum.x += weight * (luma(color, at + ivec2(1, k)) - luma(color, at + ivec2(-1, k)));
        sum.y += weight * (luma(color, at + ivec2(k, 1)) - luma(color, at + ivec2(k, -1)));
    }
    sum
}

/// Offset to the neighbour across an edge, in one of the four pixel directions.
fn across(gradient: Vec2) -> IVec2 {
    const TAN_22_5: f32 = 0.414_213_56;
    let steep = gradient.abs();
    if steep.y < steep.x * TAN_22_5 {
        ivec2(1, 0)
    } else if steep.x < steep.y * TAN_22_5 {
        ivec2(0, 1)
    } else if gradient.x * gradient.y > 0.0 {
        ivec2(1, 1)
    } else {
        ivec2(1, -1)
    }
}

/// Edge strength: 1 for a strong edge, and 0.5 for one that counts only if it touches a strong one.
pub fn canny(color: &Frame<Vec4>, low: f32, high: f32, pixel: IVec2) -> Vec4 {
    let here = gradient(color, pixel);
    let strength = here.length();
    if strength < low {
        return vec4(0.0, 0.0, 0.0, 1.0);
    }
    let across = across(here);
    for side in [-1, 1] {
        if gradient(color, pixel + across * side).length() > strength {
            return vec4(0.0, 0.0, 0.0, 1.0);
        }
    }
    Vec3::splat(if strength >= high { 1.0 } else { 0.5 }).extend(1.0)
}
