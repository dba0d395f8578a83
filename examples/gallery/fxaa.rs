//! Fast approximate antialiasing, version 3.11 (Lottes 2009, 2011), quality presets 12 to 39 depending on its steps.

use straightline_kernels::prelude::*;

/// Contrast below which a pixel is unchanged: relative to the brightest pixel around, and absolute for dark areas.
const EDGE_THRESHOLD: f32 = 0.166;
const EDGE_THRESHOLD_MIN: f32 = 0.0833;
/// Strength of the blur on isolated pixels.
const SUBPIXEL: f32 = 0.75;
/// Length of each step along an edge, in pixels (preset 39).
const STEPS: [f32; 12] = [1.0, 1.0, 1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 2.0, 2.0, 4.0, 8.0];

fn luma(color: Vec4) -> f32 {
    color.truncate().dot(vec3(0.299, 0.587, 0.114))
}

/// Smooths the edges of `color`, which is in display encoding, not linear.
pub fn fxaa(color: &Frame<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {
    let size = color.size().as_vec2();
    let sample = |at: Vec2| color.sample(linear, at / size);
    let load = |x, y| luma(color.load(pixel + ivec2(x, y)));
    let at = pixel.as_vec2() + 0.5;
    let here = color.load(pixel);
    let middle = luma(here);
    let (south, east, north, west) = (load(0, 1), load(1, 0), load(0, -1), load(-1, 0));
    let brightest = middle.max(south).max(east).max(north).max(west);
    let darkest = middle.min(south).min(east).min(north).min(west);
    let range = brightest - darkest;
    if range < EDGE_THRESHOLD_MIN.max(brightest * EDGE_THRESHOLD) {
        return here;
    }

    // Direction of the edge.
    let (north_west, south_east, north_east, south_west) = (load(-1, -1), load(1, 1), load(1, -1), load(-1, 1));
    let across_rows = (north_west + south_west - 2.0 * west).abs()
        + 2.0 * (north + south - 2.0 * middle).abs()
        + (north_east + south_east - 2.0 * east).abs();
    let across_columns = (north_west + north_east - 2.0 * north).abs()
        + 2.0 * (west + east - 2.0 * middle).abs()
        + (south_west + south_east - 2.0 * south).abs();
    let horizontal = across_rows >= across_columns;

    // Contrast of the pixel with its neighbours.
    let around = 2.0 * (north + south + east + west) + north_west + north_east + south_west + south_east;
    let lone = ((around / 12.0 - middle).abs() / range).clamp(0.0, 1.0);
    let lone = lone * lone * (3.0 - 2.0 * lone);

    let (one, other) = if horizontal { (north, south) } else { (west, east) };
    let (step_one, step_other) = (one - middle, other - middle);
    let first = step_one.abs() >= step_other.abs();
    let gradient = 0.25 * step_one.abs().max(step_other.abs());
    let side = if first { -1.0 } else { 1.0 };
    let border = 0.5 * (middle + if first { one } else { other });
    let darker = middle < border;

    // Search for both ends of the edge, between two rows of pixels.
    let (along, beside) = if horizontal {
        (Vec2::X, Vec2::Y)
    } else {
        (Vec2::Y, Vec2::X)
    };
    let start = at + beside * (0.5 * side);
    let mut back = start - along * STEPS[0];
    let mut ahead = start + along * STEPS[0];
    let mut end_back = luma(sample(back)) - border;
    let mut end_ahead = luma(sample(ahead)) - border;
    for step in STEPS.into_iter().skip(1) {
        let (done_back, done_ahead) = (end_back.abs() >= gradient, end_ahead.abs() >= gradient);
        if done_back && done_ahead {
            break;
        }
        if !done_back {
            back -= along * step;
            end_back = luma(sample(back)) - border;
        }
        if !done_ahead {
            ahead += along * step;
            end_ahead = luma(sample(ahead)) - border;
        }
    }

    let (length_back, length_ahead) = ((at - back).dot(along), (ahead - at).dot(along));
    let nearer_end = if length_back < length_ahead {
        end_back
    } else {
        end_ahead
    };
    let right_way = (nearer_end < 0.0) != darker;
    let offset = if right_way {
        0.5 - length_back.min(length_ahead) / (length_back + length_ahead)
    } else {
        0.0
    };
    let offset = offset.max(lone * lone * SUBPIXEL);
    sample(at + beside * (offset * side)).truncate().extend(here.w)
}
