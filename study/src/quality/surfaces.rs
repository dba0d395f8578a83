//! Samples of a picture that see the same surface.
//!
//! Two samples see one surface if their normals are within ten degrees of each other and each point lies on the other's
//! tangent plane, to within a tenth of a pixel for each pixel of distance on the screen. A difference in colour alone does
//! not separate surfaces. Without a camera, or with normals in another space than declared, depths must agree to one per
//! cent instead; without normals only depth counts. The sky is one surface.

use glam::{IVec2, UVec2, Vec2, Vec3};
use straightline_kernels::prelude::Frame;
use straightline_scene::capture::Capture;
use straightline_scene::gbuffer::has_planes;
use straightline_scene::scene::SKY_DEPTH;

/// Cosine of the largest angle between two normals of one surface: ten degrees.
const ALIKE: f32 = 0.984_8;

/// Greatest distance of a point from a plane, in pixels, for each pixel on the screen.
const OFF_PLANE: f32 = 0.1;

/// Greatest relative difference of two depths of one surface if planes are unknown.
const OFF_DEPTH: f32 = 0.01;

/// Point that one sample of a pixel sees.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position on the screen, in pixels.
    place: Vec2,
    depth: f32,
    normal: Option<Vec3>,
    /// Position relative to the eye, in the space of normals.
    position: Option<Vec3>,
}

impl Point {
    /// Returns the pixel that contains the point.
    pub fn pixel(&self) -> UVec2 {
        self.place.as_uvec2()
    }

    /// Returns the difference to another point, in depth or normal, by SRAA's metric `depth-normals`.
    pub fn difference_to(&self, other: &Point) -> f32 {
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

/// Geometry of a picture, at all samples of one or more captures of it.
pub struct Surfaces<'a> {
    size: UVec2,
    layers: Vec<Layer<'a>>,
    /// Layers of the shading samples.
    shaded: Vec<usize>,
    /// Rays through the pixels in the space of normals, if planes are known: see [`Capture::rays`].
    rays: Option<[Vec3; 3]>,
    /// Size of a pixel at depth 1.
    pixel: f32,
}

impl<'a> Surfaces<'a> {
    /// Collects captures of one view, with the shading samples of the first. Returns `None` without captures.
    pub fn from_captures(captures: &[&'a Capture]) -> Option<Surfaces<'a>> {
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
        let rays = first.perspective_rays().filter(|_| has_planes(first));
        Some(Surfaces {
            size: first.size,
            layers,
            shaded: first.shaded_layers(),
            rays,
            pixel: rays.map_or(0.0, |[_, _, down]| down.length()),
        })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Returns the number of samples of a pixel.
    pub fn sample_count(&self) -> usize {
        self.layers.len()
    }

    /// Returns the points that the shading samples of a pixel see; none outside the picture.
    pub fn shaded_points(&self, pixel: IVec2) -> impl Iterator<Item = Point> {
        let inside = pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(self.size.as_ivec2()).all();
        let shaded = if inside { &self.shaded[..] } else { &[] };
        shaded.iter().map(move |layer| self.point(pixel.as_uvec2(), *layer))
    }

    /// Returns the point that a sample of a pixel inside the picture sees.
    pub fn point(&self, pixel: UVec2, sample: usize) -> Point {
        let layer = &self.layers[sample];
        let at = (pixel.y * self.size.x + pixel.x) as usize;
        let depth = layer.depth.texels()[at];
        let place = pixel.as_vec2() + 0.5 + layer.offset;
        Point {
            place,
            depth,
            normal: layer.normal.map(|normals| normals.texels()[at]),
            position: self
                .rays
                .map(|[corner, right, down]| (corner + place.x * right + place.y * down) * depth),
        }
    }

    /// Returns whether two points are of one surface.
    pub fn is_same_surface(&self, a: &Point, b: &Point) -> bool {
        let sky = |point: &Point| point.depth.is_nan() || point.depth >= SKY_DEPTH;
        match (sky(a), sky(b)) {
            (true, true) => return true,
            (false, false) => {}
            _ => return false,
        }
        if let (Some(a), Some(b)) = (a.normal, b.normal)
            && (a.dot(b).is_nan() || a.dot(b) < ALIKE)
        {
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
}
