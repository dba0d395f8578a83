//! Camera of the scene. A shader binds only the fields that its metric and its encoding of depth need.

use super::gbuffer::Depth;
use super::metric::Difference;
use super::options::Sraa;
use crate::prelude::*;

/// Projection of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// From an eye: distant objects look smaller.
    Perspective,
    /// Along one direction (orthographic): the size of objects does not depend on their distance.
    Parallel,
}

/// Rays through the pixels, and planes of the projection.
///
/// A ray runs from the eye to linear depth 1, in the space of the normals: view space or world space. The ray
/// through the centre of pixel (x, y) is `ray_corner + (x + 0.5) * ray_right + (y + 0.5) * ray_down`.
pub struct View {
    /// Ray through the upper left corner of the image. For metric=planes-normals.
    pub ray_corner: Vec3,
    /// Difference between a ray and that through the pixel to the left. With projection=parallel: the distance between the two.
    pub ray_right: Vec3,
    /// Difference between a ray and that through the pixel above. With projection=parallel: the distance between the two.
    pub ray_down: Vec3,
    /// With projection=parallel: the vector along each ray from linear depth 0 to 1.
    pub ray_forward: Vec3,
    /// Position of the inputs' upper left pixel in the image: (0, 0), or the origin of a tile.
    pub origin: IVec2,
    /// Distance of the near plane, in scene units. For encoded depth.
    pub near: f32,
    /// Distance of the far plane, in scene units. For encoded depth.
    pub far: f32,
}

impl View {
    /// Ray through the centre of a pixel of the inputs.
    pub(super) fn ray(&self, pixel: IVec2) -> Vec3 {
        let place = (pixel + self.origin).as_vec2() + 0.5;
        self.ray_corner + place.x * self.ray_right + place.y * self.ray_down
    }
}

impl Sraa {
    /// Panics if the options require a perspective projection.
    pub(super) fn check_projection(&self) {
        if self.projection == Projection::Parallel {
            assert!(
                self.difference == Difference::Absolute,
                "difference=relative measures by distance from the eye, and projection=parallel has none: set difference=absolute, and \
                 depth-scale to 10 divided by the height of what is seen"
            );
            assert!(
                self.depth != Depth::ReversedInfinite,
                "projection=parallel has a far plane: set depth=reversed, depth=perspective or depth=linear"
            );
        }
    }
}
