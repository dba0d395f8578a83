//! Cellular texture (Worley, A cellular texture basis function, 1996): distances to the nearest and second-nearest of random
//! points, one in each cell.

use straightline_kernels::prelude::*;

/// Position of a cell's point, 0 to 1 (PCG: Jarzynski and Olano, Hash functions for GPU rendering, 2020).
fn point(cell: IVec2) -> Vec2 {
    let scrambled = |word: u32| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    let (mut x, mut y) = (scrambled(cell.x as u32), scrambled(cell.y as u32));
    for _ in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(1_664_525));
        y = y.wrapping_add(x.wrapping_mul(1_664_525));
        x ^= x >> 16;
        y ^= y >> 16;
    }
    vec2((x >> 8) as f32, (y >> 8) as f32) / 16_777_216.0
}

/// Cellular texture with cells of `size` pixels.
pub fn worley(size: f32, pixel: IVec2) -> Vec4 {
    let at = pixel.as_vec2() / size;
    let cell = at.floor();
    let (mut first, mut second) = (f32::INFINITY, f32::INFINITY);
    for y in -2..=2 {
        for x in -2..=2 {
            let there = cell + vec2(x as f32, y as f32);
            let distance = (there + point(there.as_ivec2())).distance_squared(at);
            if distance < first {
                second = std::mem::replace(&mut first, distance);
            } else if distance < second {
                second = distance;
            }
        }
    }
    let (first, second) = (first.sqrt(), second.sqrt());
    vec4(first, second, second - first, 1.0)
}
