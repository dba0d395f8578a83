//! Uniforms of a scene's passes at one size, in the form that shaders read.

use crate::scene::{Camera, Scene};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, UVec2, Vec2, Vec3, Vec4, vec3};

/// Light, air and camera. In view space where there is a direction. Laid out as `Lighting` in `shade.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Lighting {
    /// View space to world space.
    pub to_world: Mat4,
    /// Towards the sun; its last component is the haze.
    pub sun_direction: Vec4,
    pub sun_color: Vec4,
    /// The world's y.
    pub up: Vec4,
    pub zenith: Vec4,
    pub horizon: Vec4,
    pub ground: Vec4,
    /// Half the width and height seen at depth 1, and the size of a pixel there.
    pub extent: Vec4,
}

impl Lighting {
    pub fn new(scene: &Scene, size: UVec2) -> Self {
        let view = scene.camera.view();
        let direction = |world: Vec3| view.transform_vector3(world);
        let extent = scene.camera.half_extent(size);
        let rgb = |color: [f32; 3]| Vec3::from(color).extend(0.0);
        let sun = Vec3::from(scene.sun.direction).normalize_or(Vec3::Y);
        Lighting {
            to_world: view.inverse(),
            sun_direction: direction(sun).extend(scene.sky.haze),
            sun_color: rgb(scene.sun.color),
            up: direction(Vec3::Y).extend(0.0),
            zenith: rgb(scene.sky.zenith),
            horizon: rgb(scene.sky.horizon),
            ground: rgb(scene.sky.ground),
            extent: Vec4::new(extent.x, extent.y, 2.0 * extent.y / size.y as f32, 0.0),
        }
    }
}

impl Lighting {
    /// Through a place in pixels from the upper left corner of a picture of `size`, in view space, at linear depth 1.
    pub fn ray(&self, place: Vec2, size: UVec2) -> Vec3 {
        let place = place / size.as_vec2() * 2.0 - 1.0;
        vec3(place.x * self.extent.x, -place.y * self.extent.y, -1.0)
    }
}

/// Uniforms of one pass. Laid out as `Pass` in the shaders.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Pass {
    /// World space to clip space.
    pub to_clip: Mat4,
    /// World space to view space.
    pub to_view: Mat4,
    pub size: UVec2,
    /// From the pixels' centres, y down.
    pub offset: Vec2,
    /// 1 to add to what is there, 0 to replace it.
    pub keep: f32,
    /// Number of times that each sample is shaded, where [`FramePasses`](super::FramePasses) shades it.
    pub evaluations: u32,
    /// Size of a pixel at depth 1.
    pub pixel_angle: f32,
    pub padding: f32,
}

impl Pass {
    pub fn new(camera: &Camera, size: UVec2, offset: Vec2) -> Self {
        let to_view = camera.view();
        Pass {
            to_clip: camera.projection(size, offset) * to_view,
            to_view,
            size,
            offset,
            keep: 0.0,
            evaluations: 1,
            pixel_angle: 2.0 * camera.half_extent(size).y / size.y as f32,
            padding: 0.0,
        }
    }

    /// Through the sample of `pixel`, in view space, at linear depth 1.
    pub fn ray(&self, lighting: &Lighting, pixel: UVec2) -> Vec3 {
        lighting.ray(pixel.as_vec2() + 0.5 + self.offset, self.size)
    }
}
