//! SRAA with its default options, its loops left in the shader, hand-optimised: the surfaces at the taps are read once, into
//! arrays, and of nine taps only the four within a sample's tent are visited.

use straightline_kernels::prelude::*;

/// Positions of the geometry samples in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Direct3D's standard pattern of 4.
    Latin4,
    /// Direct3D's standard pattern of 16, shifted so that its mean is the pixel's centre.
    Latin16,
}

/// Metric of the difference between two surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// The larger of the differences in depth and in normal.
    DepthNormals,
    /// Only the difference in depth: no normals are read.
    Depth,
}

options! {
    /// Options of the filter.
    pub struct Sraa {
        /// Positions of the geometry samples in a pixel.
        pub pattern: Pattern = Pattern::Latin4,
        /// Metric of the difference between two surfaces.
        pub metric: Metric = Metric::DepthNormals,
    }
}

/// Offsets in thirty-seconds of a pixel.
const LATIN4: [IVec2; 4] = [ivec2(-4, -12), ivec2(12, -4), ivec2(-12, 4), ivec2(4, 12)];

/// Offsets in thirty-seconds of a pixel.
const LATIN16: [IVec2; 16] = [
    ivec2(3, 3),
    ivec2(5, 11),
    ivec2(11, 7),
    ivec2(13, 15),
    ivec2(-5, 5),
    ivec2(-3, 13),
    ivec2(-11, 9),
    ivec2(-15, 1),
    ivec2(-1, -5),
    ivec2(-9, -3),
    ivec2(-7, -11),
    ivec2(-13, -15),
    ivec2(9, -1),
    ivec2(7, -9),
    ivec2(1, -13),
    ivec2(15, -7),
];

const DEEPEST: f32 = 1.0e30;
const FAR: f32 = 16.0;
const STEEPNESS: f32 = 500.0 * std::f32::consts::LOG2_E;
const EPSILON: f32 = 1.0e-30;

/// Antialiased colour of `pixel`. Equals `sraa` except for rounding: this version multiplies by the falloff.
pub fn sraa(
    cfg: &Sraa,
    depth: &FrameLayers<f32>,
    normal: &FrameLayers<Vec4>,
    color: &Frame<Vec4>,
    pixel: IVec2,
) -> Vec4 {
    match cfg.pattern {
        Pattern::Latin4 => filtered::<4>(cfg, LATIN4, depth, normal, color, pixel),
        Pattern::Latin16 => filtered::<16>(cfg, LATIN16, depth, normal, color, pixel),
    }
}

/// Colour of the pixel from the 3×3 shading samples around it.
fn filtered<const SAMPLES: usize>(
    cfg: &Sraa,
    places: [IVec2; SAMPLES],
    depth: &FrameLayers<f32>,
    normal: &FrameLayers<Vec4>,
    color: &Frame<Vec4>,
    pixel: IVec2,
) -> Vec4 {
    // Surfaces at the taps, each read once.
    let mut depths = [0.0; 9];
    let mut normals = [Vec3::ZERO; 9];
    for tap in 0..9 {
        let at = pixel + ivec2(tap as i32 % 3 - 1, tap as i32 / 3 - 1);
        depths[tap] = depth.load(at, SAMPLES).min(DEEPEST);
        normals[tap] = match cfg.metric {
            Metric::DepthNormals => normal.load(at, SAMPLES).truncate(),
            Metric::Depth => Vec3::ZERO,
        };
    }
    let mut weights = [0.0; 9];
    for sample in 0..SAMPLES {
        let seen_depth = depth.load(pixel, sample).min(DEEPEST);
        let seen_normal = match cfg.metric {
            Metric::DepthNormals => normal.load(pixel, sample).truncate(),
            Metric::Depth => Vec3::ZERO,
        };
        // The upper left of the four taps within the sample's tent.
        let place = places[sample].as_vec2() / 32.0;
        let left = if place.x < 0.0 { 0 } else { 1 };
        let top = if place.y < 0.0 { 0 } else { 1 };
        let first = top * 3 + left;
        let mut falloffs = [0.0; 4];
        let mut distances = [0.0; 4];
        let mut nearest = FAR;
        for k in 0..4 {
            let tap = first + k / 2 * 3 + k % 2;
            let away = (vec2((left + k % 2) as f32 - 1.0, (top + k / 2) as f32 - 1.0) - place).abs();
            let falloff = (1.0 - away.x) * (1.0 - away.y);
            let deeper = (seen_depth - depths[tap]).abs();
            let d = match cfg.metric {
                Metric::DepthNormals => {
                    let (a, b) = (seen_normal, normals[tap]);
                    deeper.max(1.0 - a.x * b.x - a.y * b.y - a.z * b.z)
                }
                Metric::Depth => deeper,
            };
            falloffs[k] = falloff;
            distances[k] = d.min(FAR);
            nearest = nearest.min(d);
        }
        let mut sum = 0.0;
        for k in 0..4 {
            let nearness = (-STEEPNESS * (distances[k] - nearest)).exp2();
            let w = falloffs[k] * nearness;
            distances[k] = w;
            sum += w;
        }
        let scale = 1.0 / SAMPLES as f32 / sum;
        for k in 0..4 {
            weights[first + k / 2 * 3 + k % 2] += distances[k] * scale;
        }
    }
    let mut result = Vec4::ZERO;
    let mut sum = 0.0;
    for tap in 0..9 {
        let shaded = color.load(pixel + ivec2(tap as i32 % 3 - 1, tap as i32 / 3 - 1));
        let w = if shaded.is_finite() { weights[tap] } else { 0.0 };
        // 0 times an infinite colour is not 0.
        if w != 0.0 {
            result += w * shaded;
        }
        sum += w;
    }
    result / sum.max(EPSILON)
}
