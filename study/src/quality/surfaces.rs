//! Which samples of a picture see the same surface.
//!
//! Two samples see one surface if their normals are within ten degrees of each other and each point lies on the other's
//! tangent plane, to within a tenth of a pixel for each pixel that they are apart on the screen. What is only painted
//! differently is one surface. Without a camera, or without normals in view space, depths must agree to a hundredth of
//! themselves instead of planes; without normals depth alone counts. The sky is one surface.

use crate::capture::Capture;
use crate::scene::SKY_DEPTH;
use glam::{IVec2, UVec2, Vec2, Vec3, vec3};
use straightline_kernels::prelude::Frame;

/// Cosine of the angle between two normals of one surface: ten degrees.
const ALIKE: f32 = 0.984_8;

/// How far a point may lie off a plane, in pixels, for each pixel on the screen.
const OFF_PLANE: f32 = 0.1;

/// How much two depths of one surface may differ where planes are not known.
const OFF_DEPTH: f32 = 0.01;

/// What one sample of a pixel sees.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// On the screen, in pixels.
    place: Vec2,
    depth: f32,
    normal: Option<Vec3>,
    /// In view space.
    position: Option<Vec3>,
}

impl Point {
    /// The pixel that it is in.
    pub fn pixel(&self) -> UVec2 {
        self.place.as_uvec2()
    }

    /// How different another point is, in depth or normal, as SRAA's metric `depth-normals` has it.
    pub fn unlike(&self, other: &Point) -> f32 {
        let turned = match (self.normal, other.normal) {
            (Some(a), Some(b)) => 1.0 - a.dot(b),
            _ => 0.0,
        };
        (self.depth - other.depth).abs().max(turned).min(16.0)
    }
}

struct Layer<'a> {
    offset: Vec2,
    depth: &'a Frame<f32>,
    normal: Option<&'a Frame<Vec3>>,
}

/// The geometry of a picture, at all samples of some captures of it.
pub struct Surfaces<'a> {
    size: UVec2,
    layers: Vec<Layer<'a>>,
    shaded: usize,
    /// Half of what is seen at depth 1, if planes can be told.
    extent: Option<Vec2>,
    /// A pixel at depth 1.
    pixel: f32,
}

impl<'a> Surfaces<'a> {
    /// Of captures of one view; shading is where the first has it. `None` of no captures.
    pub fn of(captures: &[&'a Capture]) -> Option<Surfaces<'a>> {
        let first = captures.first()?;
        let mut layers = Vec::new();
        for capture in captures {
            for layer in 0..capture.layer_count() {
                layers.push(Layer {
                    offset: capture.samples.get(layer).copied().unwrap_or(Vec2::ZERO),
                    depth: &capture.depth.layers()[layer],
                    normal: capture.normal.as_ref().map(|normals| &normals.layers()[layer]),
                });
            }
        }
        let mut surfaces = Surfaces {
            size: first.size,
            layers,
            shaded: first.shaded_layer(),
            extent: None,
            pixel: 0.0,
        };
        if let Some(camera) = first.camera.filter(|_| first.normal.is_some()) {
            let extent = camera.half_extent(first.size);
            surfaces.pixel = 2.0 * extent.y / first.size.y as f32;
            surfaces.extent = Some(extent);
            // Normals of another space look away from the camera somewhere.
            if !surfaces.face_the_camera() {
                surfaces.extent = None;
            }
        }
        Some(surfaces)
    }

    /// Width and height in pixels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// How many samples a pixel has.
    pub fn samples(&self) -> usize {
        self.layers.len()
    }

    /// What the shading sample of a pixel sees; `None` outside the picture.
    pub fn shaded(&self, pixel: IVec2) -> Option<Point> {
        let inside = pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(self.size.as_ivec2()).all();
        inside.then(|| self.point(pixel.as_uvec2(), self.shaded))
    }

    /// What a sample of a pixel inside the picture sees.
    pub fn point(&self, pixel: UVec2, sample: usize) -> Point {
        let layer = &self.layers[sample];
        let at = (pixel.y * self.size.x + pixel.x) as usize;
        let depth = layer.depth.texels()[at];
        let place = pixel.as_vec2() + 0.5 + layer.offset;
        let ray = |extent: Vec2| {
            let seen = place / self.size.as_vec2() * 2.0 - 1.0;
            vec3(seen.x * extent.x, -seen.y * extent.y, -1.0)
        };
        Point {
            place,
            depth,
            normal: layer.normal.map(|normals| normals.texels()[at]),
            position: self.extent.map(|extent| ray(extent) * depth),
        }
    }

    /// Whether two points are of one surface.
    pub fn same(&self, a: &Point, b: &Point) -> bool {
        let sky = |point: &Point| point.depth >= SKY_DEPTH || point.depth.is_nan();
        match (sky(a), sky(b)) {
            (true, true) => return true,
            (false, false) => {}
            _ => return false,
        }
        // Of normals that are not numbers, none is like another.
        let alike = match (a.normal, b.normal) {
            (Some(a), Some(b)) => a.dot(b) >= ALIKE,
            _ => true,
        };
        if !alike {
            return false;
        }
        let nearer = a.depth.min(b.depth);
        match (a.position, a.normal, b.position, b.normal) {
            (Some(p), Some(n), Some(q), Some(m)) => {
                let off = (q - p).dot(n).abs().max((q - p).dot(m).abs());
                let apart = a.place.distance(b.place).max(1.0);
                off <= OFF_PLANE * self.pixel * nearer * apart
            }
            _ => (a.depth - b.depth).abs() <= OFF_DEPTH * nearer.abs(),
        }
    }

    /// Whether next to no normal at the shading samples looks away from the camera, as in view space none can.
    fn face_the_camera(&self) -> bool {
        let (mut seen, mut away) = (0usize, 0usize);
        for y in 0..self.size.y {
            for x in 0..self.size.x {
                let point = self.point(UVec2::new(x, y), self.shaded);
                if let (Some(position), Some(normal), true) = (point.position, point.normal, point.depth < SKY_DEPTH) {
                    seen += 1;
                    // Interpolated normals may look away a little.
                    away += usize::from(position.normalize_or_zero().dot(normal) > 0.3);
                }
            }
        }
        away * 100 <= seen
    }
}
