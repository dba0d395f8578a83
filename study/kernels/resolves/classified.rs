//! Deferred multisampling with edge detection: where all samples of a pixel see one surface, its first is shaded, else all are.
//! `study/src/quality/surfaces.rs` defines one surface.

use straightline_kernels::prelude::*;

/// Cosine of the largest angle between two normals of one surface: ten degrees.
const ALIKE: f32 = 0.984_8;

/// Largest distance of a point from a plane, in pixels.
const OFF_PLANE: f32 = 0.1;

/// Depth of the sky.
const SKY: f32 = 1.0e6;

/// Samples of `latin4`, from the pixel's centre.
const SAMPLES: [Vec2; 4] = [
    vec2(-0.125, -0.375),
    vec2(0.375, -0.125),
    vec2(-0.375, 0.125),
    vec2(0.125, 0.375),
];

/// Geometry of the samples, one layer each, and the rays through the pixels: at the picture's corner, and a pixel to the
/// right and down.
pub struct Geometry {
    pub depth: FrameLayers<f32>,
    pub normal: FrameLayers<Vec4>,
    pub ray_corner: Vec3,
    pub ray_right: Vec3,
    pub ray_down: Vec3,
}

struct Point {
    depth: f32,
    normal: Vec3,
    position: Vec3,
}

/// Colour of `pixel` from the colours of its samples, one layer each.
pub fn classified(geometry: &Geometry, colors: &FrameLayers<Vec4>, pixel: IVec2) -> Vec4 {
    let first = point(geometry, pixel, 0);
    let reach = OFF_PLANE * geometry.ray_down.length();
    let mut even = true;
    for sample in 1..4 {
        even &= is_same(&first, &point(geometry, pixel, sample), reach);
    }
    let color = colors.load(pixel, 0);
    if even {
        return color;
    }
    0.25 * (color + colors.load(pixel, 1) + colors.load(pixel, 2) + colors.load(pixel, 3))
}

fn point(geometry: &Geometry, pixel: IVec2, sample: usize) -> Point {
    let depth = geometry.depth.load(pixel, sample);
    let place = pixel.as_vec2() + (0.5 + SAMPLES[sample]);
    let ray = geometry.ray_corner + place.x * geometry.ray_right + place.y * geometry.ray_down;
    Point {
        depth,
        normal: geometry.normal.load(pixel, sample).truncate(),
        position: ray * depth,
    }
}

/// Returns whether each point is on the other's tangent plane and the normals are alike. The sky is one surface.
fn is_same(a: &Point, b: &Point, reach: f32) -> bool {
    let way = b.position - a.position;
    let off = way.dot(a.normal).abs().max(way.dot(b.normal).abs());
    let nearer = a.depth.min(b.depth);
    let is_near = off <= reach * nearer && a.normal.dot(b.normal) >= ALIKE;
    (nearer >= SKY) || (a.depth.max(b.depth) < SKY && is_near)
}
