//! What the scene was seen with. A shader binds only what its metric and its encoding of depth need.

use crate::prelude::*;

/// Rays through the pixels, planes of the projection.
///
/// A ray is the way from the eye to linear depth 1, in the space that normals are in: view space, or the world's. The ray
/// through the centre of pixel (x, y) is `ray_corner + (x + 0.5) * ray_right + (y + 0.5) * ray_down`.
pub struct View {
    /// The ray through the upper left corner of the image. Of metric=planes-normals.
    pub ray_corner: Vec3,
    /// How a ray differs from that through the pixel to the left.
    pub ray_right: Vec3,
    /// How a ray differs from that through the pixel above.
    pub ray_down: Vec3,
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
