//! Uniforms of a scene's passes at one size, in the form that shaders read.

use crate::scene::{Camera, MAX_LAMPS, MAX_SHADES, Scene};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, UVec2, UVec4, Vec2, Vec3, Vec4, uvec4, vec2, vec3};

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
    /// Half the width and height seen at depth 1, the size of a pixel there, and 1 for a parallel projection, else 0.
    pub extent: Vec4,
    pub environment: [Vec4; 9],
    /// Places in world space; the last component is the square of the reach.
    pub lamp_places: [Vec4; MAX_LAMPS],
    pub lamp_colors: [Vec4; MAX_LAMPS],
    /// Centres in world space and squares of radii of the balls that cast shadows.
    pub shades: [Vec4; MAX_SHADES],
    /// Numbers of lamps and of balls.
    pub counts: UVec4,
}

/// Line of sight through one place of a picture, in view space.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// At linear depth 0.
    pub from: Vec3,
    /// How the place changes by a unit of linear depth.
    pub along: Vec3,
}

impl Ray {
    /// Returns the place at a linear depth.
    pub fn at(self, depth: f32) -> Vec3 {
        self.from + self.along * depth
    }
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
            extent: extent
                .extend(2.0 * extent.y / size.y as f32)
                .extend(parallel(&scene.camera)),
            environment: scene.environment.map(rgb),
            lamp_places: filled(scene.lamps.iter().map(|lamp| squared(lamp.place, lamp.reach))),
            lamp_colors: filled(scene.lamps.iter().map(|lamp| rgb(lamp.color))),
            shades: filled(scene.shades.iter().map(|ball| squared(ball.centre, ball.radius))),
            counts: uvec4(scene.lamps.len() as u32, scene.shades.len() as u32, 0, 0),
        }
    }

    /// Returns the line of sight through a place in pixels from the upper left corner of a picture of `size`.
    pub fn ray(&self, place: Vec2, size: UVec2) -> Ray {
        let place = place / size.as_vec2() * 2.0 - 1.0;
        let across = vec2(place.x * self.extent.x, -place.y * self.extent.y);
        match self.extent.w > 0.0 {
            true => Ray {
                from: across.extend(0.0),
                along: vec3(0.0, 0.0, -1.0),
            },
            false => Ray {
                from: Vec3::ZERO,
                along: across.extend(-1.0),
            },
        }
    }

    /// Returns the size of a pixel at a linear depth, in scene units.
    pub fn pixel_size(&self, depth: f32) -> f32 {
        self.extent.z * if self.extent.w > 0.0 { 1.0 } else { depth }
    }
}

/// Returns 1 for a parallel projection, else 0.
fn parallel(camera: &Camera) -> f32 {
    f32::from(u8::from(camera.parallel_height.is_some()))
}

fn squared(place: [f32; 3], length: f32) -> Vec4 {
    Vec3::from(place).extend(length * length)
}

/// Fills the rest with zeros. [`Scene::check`] has refused more than there is room for.
fn filled<const N: usize>(values: impl Iterator<Item = Vec4>) -> [Vec4; N] {
    let mut all = [Vec4::ZERO; N];
    all.iter_mut().zip(values).for_each(|(place, value)| *place = value);
    all
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
    /// 1 for a parallel projection, else 0.
    pub parallel: f32,
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
            parallel: parallel(camera),
        }
    }

    /// Returns the line of sight through the sample of `pixel`.
    pub fn ray(&self, lighting: &Lighting, pixel: UVec2) -> Ray {
        lighting.ray(pixel.as_vec2() + 0.5 + self.offset, self.size)
    }
}
