//! Depth of field in one pass (Gustafsson, Bokeh depth of field in a single pass, 2018): a spiral of samples, each as large as
//! its circle of confusion.

use straightline_kernels::prelude::*;

const GOLDEN_ANGLE: f32 = 2.399_963_2;
const MOST: f32 = 10.0;
/// Step of the spiral. Smaller is finer, and slower.
const GROWTH: f32 = 1.0;

/// Size of a point at this depth, in pixels.
fn blur(depth: f32, focus: f32, strength: f32) -> f32 {
    ((1.0 / focus - 1.0 / depth) * strength).clamp(-1.0, 1.0).abs() * MOST
}

pub fn bokeh(color: &Frame<Vec4>, depth: &Frame<f32>, focus: f32, strength: f32, pixel: IVec2) -> Vec4 {
    let centre_depth = depth.load(pixel);
    let centre_size = blur(centre_depth, focus, strength);
    let mut sum = color.load(pixel).truncate();
    let mut total = 1.0;
    let mut radius = GROWTH;
    let mut angle = 0.0f32;
    while radius < MOST {
        let at = pixel + (vec2(angle.cos(), angle.sin()) * radius + 0.5).floor().as_ivec2();
        let sample_depth = depth.load(at);
        let mut size = blur(sample_depth, focus, strength);
        if sample_depth > centre_depth {
            size = size.clamp(0.0, centre_size * 2.0);
        }
        let weight = smoothstep(radius - 0.5, radius + 0.5, size);
        sum += mix(sum / total, color.load(at).truncate(), weight);
        total += 1.0;
        radius += GROWTH / radius;
        angle += GOLDEN_ANGLE;
    }
    (sum / total).extend(1.0)
}
