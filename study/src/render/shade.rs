//! Shading at one point, in Rust. `gpu/shade.wgsl` says the same in WGSL, name by name and line by line.

use crate::scene::{Camera, Material, SKY_DEPTH, Scene};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, UVec2, Vec2, Vec3, vec2};

/// What is the same for all pixels of one pass. The shaders' uniform buffer, in WGSL's layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct View {
    /// World space to clip space, with the pass's offset.
    pub to_clip: Mat4,
    pub eye: Vec3,
    /// Side of a pixel at linear depth 1, in scene units.
    pub pixel: f32,
    /// Unit vector of linear depth.
    pub forward: Vec3,
    /// Share of the light that haze takes per scene unit, as a negative binary logarithm.
    pub haze: f32,
    /// From the picture's middle to its right and upper edge at linear depth 1.
    pub right: Vec3,
    /// 1 if colours are to be added to what is there, 0 if they are to replace it.
    pub add: u32,
    pub up: Vec3,
    pub pad_up: u32,
    pub sun_direction: Vec3,
    pub pad_sun_direction: u32,
    pub sun_color: Vec3,
    pub pad_sun_color: u32,
    pub zenith: Vec3,
    pub pad_zenith: u32,
    pub horizon: Vec3,
    pub pad_horizon: u32,
    pub ground: Vec3,
    pub pad_ground: u32,
    pub size: UVec2,
    /// Where in a pixel it is sampled, from its centre, y down.
    pub offset: Vec2,
}

impl View {
    /// The view of a scene in a picture of `size` pixels, sampled at their centres.
    pub fn new(scene: &Scene, size: UVec2) -> Self {
        let camera = &scene.camera;
        let to_view = camera.view();
        let half = camera.half_extent(size);
        View {
            to_clip: camera.projection(size, Vec2::ZERO) * to_view,
            eye: camera.position.into(),
            pixel: 2.0 * half.y / size.y as f32,
            forward: -to_view.row(2).truncate(),
            haze: scene.sky.haze,
            right: to_view.row(0).truncate() * half.x,
            add: 0,
            up: to_view.row(1).truncate() * half.y,
            sun_direction: scene.sun.direction.into(),
            sun_color: scene.sun.color.into(),
            zenith: scene.sky.zenith.into(),
            horizon: scene.sky.horizon.into(),
            ground: scene.sky.ground.into(),
            size,
            offset: Vec2::ZERO,
            ..Self::zeroed()
        }
    }

    /// The same sampled at `offset`.
    pub fn at(&self, camera: &Camera, offset: Vec2) -> Self {
        View {
            to_clip: camera.projection(self.size, offset) * camera.view(),
            offset,
            ..*self
        }
    }
}

/// What one sample of the G-buffer holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub depth: f32,
    pub normal: Vec3,
    pub color: Vec3,
    pub material: u32,
}

/// Where there is no geometry.
pub(super) const SKY: Surface = Surface {
    depth: SKY_DEPTH,
    normal: Vec3::Z,
    color: Vec3::ZERO,
    material: 0,
};

/// Share of a tile's side that its joint takes.
const JOINT: f32 = 0.035;

/// Linear colour of a surface sampled at `at`, in pixels from the picture's upper left corner.
pub(super) fn shade(view: &View, surface: &Surface, at: Vec2) -> Vec3 {
    let ndc = 2.0 * at / view.size.as_vec2() - 1.0;
    let ray = view.forward + ndc.x * view.right - ndc.y * view.up;
    let outwards = ray.normalize();
    if surface.depth >= SKY_DEPTH {
        return sky(view, outwards);
    }
    let normal = surface.normal;
    let mut albedo = surface.color;
    if surface.material == Material::Tiles as u32 {
        let slant = outwards.dot(normal).abs().max(1.0e-3);
        albedo *= tiles(view.eye + ray * surface.depth, outwards, view.pixel * surface.depth, slant);
    }
    let around = 0.5 * (view.zenith + view.horizon);
    let ambient = view.ground.lerp(around, 0.5 + 0.5 * normal.y);
    let lit = normal.dot(view.sun_direction).max(0.0);
    let halfway = (view.sun_direction - outwards).normalize();
    let sharp = normal.dot(halfway).max(0.0).powi(32);
    let color = albedo * (ambient + lit * view.sun_color) + 0.1 * lit * sharp * view.sun_color;
    let clear = (-view.haze * surface.depth).exp2();
    view.horizon.lerp(color, clear).clamp(Vec3::ZERO, Vec3::ONE)
}

/// The sky in a direction.
fn sky(view: &View, outwards: Vec3) -> Vec3 {
    let height = outwards.y.clamp(0.0, 1.0).sqrt();
    view.horizon.lerp(view.zenith, height).clamp(Vec3::ZERO, Vec3::ONE)
}

/// Brightness of a floor of two kinds of tiles with dark joints, averaged over the footprint of a pixel, so that the
/// floor has no aliasing of its own that no filter of edges could help.
fn tiles(position: Vec3, outwards: Vec3, across: f32, slant: f32) -> f32 {
    let p = vec2(position.x, position.z);
    let along = vec2(outwards.x, outwards.z).abs();
    let width = across * (1.0 + along * (1.0 / slant - 1.0));
    let (low, high) = (p - 0.5 * width, p + 0.5 * width);
    let joints = (joints_below(high) - joints_below(low)) / width;
    let joint = 1.0 - (1.0 - joints.x) * (1.0 - joints.y);
    let kinds = (kinds_below(high) - kinds_below(low)) / width;
    (1.0 + 0.13 * kinds.x * kinds.y) * (1.0 - 0.6 * joint)
}

/// Integral from 0 of a function that is 1 in joints and 0 else.
fn joints_below(p: Vec2) -> Vec2 {
    JOINT * p.floor() + (p - p.floor()).min(Vec2::splat(JOINT))
}

/// Integral from 0 of a function that is 1 and -1 on alternate tiles.
fn kinds_below(p: Vec2) -> Vec2 {
    let pair = 0.5 * p;
    1.0 - (2.0 * (pair - pair.floor()) - 1.0).abs()
}
