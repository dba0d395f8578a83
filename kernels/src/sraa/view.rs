//! What the scene was seen with. A shader binds only what its metric and its encoding of depth need.

use super::gbuffer::Depth;
use super::metric::Difference;
use super::options::Sraa;
use crate::prelude::*;

/// How the camera projects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// From an eye: what is farther away looks smaller.
    Perspective,
    /// Along one direction (orthographic): everything looks as large as it is.
    Parallel,
}

/// Rays through the pixels, planes of the projection.
///
/// A ray is the way from the eye to linear depth 1, in the space that normals are in: view space, or the world's. The ray
/// through the centre of pixel (x, y) is `ray_corner + (x + 0.5) * ray_right + (y + 0.5) * ray_down`.
pub struct View {
    /// The ray through the upper left corner of the image. Of metric=planes-normals.
    pub ray_corner: Vec3,
    /// How a ray differs from that through the pixel to the left; of projection=parallel how far apart the two are.
    pub ray_right: Vec3,
    /// How a ray differs from that through the pixel above; of projection=parallel how far apart the two are.
    pub ray_down: Vec3,
    /// Of projection=parallel: the way along each ray from linear depth 0 to 1.
    pub ray_forward: Vec3,
    /// Where the inputs' upper left pixel lies in the image: (0, 0), or where a tile begins.
    pub origin: IVec2,
    /// Distance of the near plane, in scene units. Of encoded depth.
    pub near: f32,
    /// Distance of the far plane, in scene units. Of encoded depth.
    pub far: f32,
}

impl View {
    /// The ray through the centre of a pixel of the inputs.
    pub(super) fn ray(&self, pixel: IVec2) -> Vec3 {
        let place = (pixel + self.origin).as_vec2() + 0.5;
        self.ray_corner + place.x * self.ray_right + place.y * self.ray_down
    }
}

impl Sraa {
    /// Refuses what only a perspective has.
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
