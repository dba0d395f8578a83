//! The last pass of a reconstruction filter for plausible motion blur (McGuire, Hennessy, Bukowski and Osman 2012).

use straightline_kernels::prelude::*;

const SAMPLES: i32 = 15;
/// Difference in depth below which two depths count as equal.
const SOFT: f32 = 0.1;

/// Half the motion of a pixel while the shutter is open, in pixels.
fn velocity(velocities: &Frame<Vec2>, at: IVec2) -> Vec2 {
    velocities.load(at) * 0.5
}

/// Degree to which `a` is nearer than `b`, 0 to 1.
fn nearer(a: f32, b: f32) -> f32 {
    (1.0 - (a - b) / SOFT).clamp(0.0, 1.0)
}

/// 1 at a position, falling to 0 where its motion ends.
fn cone(distance: f32, speed: f32) -> f32 {
    (1.0 - distance / speed).clamp(0.0, 1.0)
}

/// 1 as far as a position moves, 0 beyond.
fn cylinder(distance: f32, speed: f32) -> f32 {
    1.0 - smoothstep(0.95 * speed, 1.05 * speed, distance)
}

/// Pseudo-random offset of a pixel, -0.5 to 0.5.
fn jitter(at: IVec2) -> f32 {
    let noise = (at.x as f32 * 0.06711056 + at.y as f32 * 0.00583715) * 1.0;
    fract(52.982_918 * fract(noise)) - 0.5
}

/// Blurs `color` along the motion. `most` has the fastest velocity around each pixel; depths increase with distance.
pub fn motion_blur(
    color: &Frame<Vec4>,
    velocities: &Frame<Vec2>,
    most: &Frame<Vec2>,
    depth: &Frame<f32>,
    pixel: IVec2,
) -> Vec4 {
    let along = velocity(most, pixel);
    let here = color.load(pixel);
    if along.length() <= 0.5 {
        return here;
    }
    let speed = velocity(velocities, pixel).length().max(0.5);
    let near = depth.load(pixel);
    let mut total = 1.0 / speed;
    let mut sum = here * total;
    let shift = jitter(pixel);
    for k in 0..SAMPLES {
        if k == (SAMPLES - 1) / 2 {
            continue;
        }
        let part = mix(-1.0, 1.0, (k as f32 + shift + 1.0) / (SAMPLES as f32 + 1.0));
        let at = pixel + (along * part + 0.5).floor().as_ivec2();
        let there = depth.load(at);
        let distance = (at - pixel).as_vec2().length();
        let its_speed = velocity(velocities, at).length().max(0.5);
        let in_front = nearer(there, near) * cone(distance, its_speed);
        let behind = nearer(near, there) * cone(distance, speed);
        let both = cylinder(distance, its_speed) * cylinder(distance, speed) * 2.0;
        let weight = in_front + behind + both;
        total += weight;
        sum += color.load(at) * weight;
    }
    sum / total
}
