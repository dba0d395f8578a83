//! Aggregate G-buffer antialiasing (Crassin, McGuire, Fatahalian and Lefohn 2015), before and after its shading:
//! `scene/src/render/aggregate.rs` describes the method.

use straightline_kernels::prelude::*;

/// Difference below which samples belong to one aggregate.
const ALIKE: f32 = 0.1;

/// Depth of the sky.
const SKY: f32 = 1.0e6;

/// Difference between samples that cannot be averaged.
const APART: f32 = 1.0e30;

/// Material number of the sky in this kernel.
const SKY_MATERIAL: f32 = -1.0;

/// Samples of `latin16`, in sixteenths of a pixel, each minus a half to make it an integer.
const LATIN16: [IVec2; 16] = [
    ivec2(1, 1),
    ivec2(2, 5),
    ivec2(5, 3),
    ivec2(6, 7),
    ivec2(-3, 2),
    ivec2(-2, 6),
    ivec2(-6, 4),
    ivec2(-8, 0),
    ivec2(-1, -3),
    ivec2(-5, -2),
    ivec2(-4, -6),
    ivec2(-7, -8),
    ivec2(4, -1),
    ivec2(3, -5),
    ivec2(0, -7),
    ivec2(7, -4),
];

/// Samples of a pixel, one layer each.
pub struct GBuffer {
    /// Normal, and depth along the view.
    pub geometry: FrameLayers<Vec4>,
    /// Albedo and material number.
    pub paint: FrameLayers<Vec4>,
}

/// Aggregates of a pixel.
pub struct Aggregates {
    /// Normal in two octahedral coordinates, depth, and number of samples.
    pub geometry_0: Vec4,
    /// Albedo; the material number; and 16 times the shading position in the pixel, x and 256 y in 255ths.
    pub paint_0: Vec4,
    /// The second aggregate, without samples if all samples are alike.
    pub geometry_1: Vec4,
    pub paint_1: Vec4,
}

/// Aggregates of the samples of `latin4`.
pub fn aggregate4(samples: &GBuffer, pixel: IVec2) -> Aggregates {
    let places = [
        vec2(-0.125, -0.375),
        vec2(0.375, -0.125),
        vec2(-0.375, 0.125),
        vec2(0.125, 0.375),
    ];
    aggregates::<4>(samples, places, pixel)
}

/// Aggregates of the samples of `latin16`.
pub fn aggregate16(samples: &GBuffer, pixel: IVec2) -> Aggregates {
    let places = LATIN16.map(|place| (place.as_vec2() + 0.5) / 16.0);
    aggregates::<16>(samples, places, pixel)
}

/// Colour of `pixel`: those of its aggregates, a layer of `colors` each, weighted by their number of samples.
pub fn aggregated(geometry_0: &Frame<Vec4>, geometry_1: &Frame<Vec4>, colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    let first = geometry_0.load(pixel).w;
    let second = geometry_1.load(pixel).w;
    let color = colors.load(pixel, 0);
    if second == 0.0 {
        return color;
    }
    (first * color + second * colors.load(pixel, 1)) / (first + second)
}

#[derive(Clone, Copy)]
struct Sample {
    normal: Vec3,
    depth: f32,
    color: Vec3,
    /// Material number, or that of the sky.
    material: f32,
}

fn sample(samples: &GBuffer, pixel: IVec2, k: usize) -> Sample {
    let geometry = samples.geometry.load(pixel, k);
    let paint = samples.paint.load(pixel, k);
    Sample {
        normal: geometry.truncate(),
        depth: geometry.w,
        color: paint.truncate(),
        material: if geometry.w >= SKY { SKY_MATERIAL } else { paint.w },
    }
}

/// Difference between two samples.
fn apart(a: &Sample, b: &Sample) -> f32 {
    let turned = 1.0 - a.normal.dot(b.normal);
    let step = (a.depth - b.depth).abs() / a.depth.min(b.depth);
    if a.material != b.material {
        APART
    } else if a.material == SKY_MATERIAL {
        0.0
    } else {
        turned + step
    }
}

fn aggregates<const N: usize>(samples: &GBuffer, places: [Vec2; N], pixel: IVec2) -> Aggregates {
    let seen: [Sample; N] = std::array::from_fn(|k| sample(samples, pixel, k));
    // The two samples that differ most, if they are not alike.
    let mut most = ALIKE;
    let mut pair = (0, 0);
    for i in 1..N {
        for j in 0..i {
            let difference = apart(&seen[i], &seen[j]);
            if difference > ALIKE && difference >= most {
                most = difference;
                pair = (i, j);
            }
        }
    }
    let one = sample(samples, pixel, pair.0.min(N - 1));
    let other = sample(samples, pixel, pair.1.min(N - 1));
    let is_first: [bool; N] = std::array::from_fn(|k| apart(&seen[k], &other) <= apart(&seen[k], &one));
    let is_second = is_first.map(|first| !first);
    let (geometry_0, paint_0) = mean(&seen, places, is_first);
    let (geometry_1, paint_1) = mean(&seen, places, is_second);
    Aggregates {
        geometry_0,
        paint_0,
        geometry_1,
        paint_1,
    }
}

/// Means of the samples in a group that have its most frequent material.
fn mean<const N: usize>(seen: &[Sample; N], places: [Vec2; N], is_of: [bool; N]) -> (Vec4, Vec4) {
    let mut members = 0u32;
    let mut most = 0u32;
    let mut material = SKY_MATERIAL;
    let mut kind = Vec3::Z;
    for k in 0..N {
        members += is_of[k] as u32;
        let mut alike = 0u32;
        for other in 0..N {
            alike += (is_of[other] && seen[other].material == seen[k].material) as u32;
        }
        if is_of[k] && alike >= most {
            most = alike;
            material = seen[k].material;
            kind = seen[k].normal;
        }
    }
    let mut normal = Vec3::ZERO;
    let mut depth = 0.0;
    let mut color = Vec3::ZERO;
    let mut place = Vec2::ZERO;
    for k in 0..N {
        let weight = (is_of[k] && seen[k].material == material) as u32 as f32;
        normal += weight * seen[k].normal;
        depth += weight * seen[k].depth;
        color += weight * seen[k].color;
        place += weight * places[k];
    }
    let share = 1.0 / most.max(1) as f32;
    let square = normal.length_squared();
    let unit = if square > 0.0 { normal / square.sqrt() } else { kind };
    let at = ((place * share + 0.5) * 255.0 + 0.5).floor();
    let packed = material.max(0.0) + 16.0 * (at.x + 256.0 * at.y);
    (
        unfolded(unit).extend(depth * share).extend(members as f32),
        (color * share).extend(packed),
    )
}

/// Octahedral coordinates of a unit vector, -1 to 1 (Cigolle et al. 2014).
fn unfolded(unit: Vec3) -> Vec2 {
    let square = unit.truncate() / (unit.x.abs() + unit.y.abs() + unit.z.abs());
    let turned = (1.0 - vec2(square.y, square.x).abs()) * vec2(sign(square.x), sign(square.y));
    if unit.z < 0.0 { turned } else { square }
}

fn sign(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}
