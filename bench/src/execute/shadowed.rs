//! A scene drawn by a forward pass with a shadow map.

use super::{Bench, Corner, ExecuteError, Forward, Inputs};
use glam::{Mat4, UVec2, Vec3, Vec4, vec2, vec4};
use straightline_codegen::{Kernel, Settings};
use straightline_kernels::prelude::Frame;
use straightline_scene::scene::Scene;

/// A scene's triangles with their positions in the sun's shadow map, and that map.
#[derive(Clone, Debug)]
pub struct Shadowed {
    /// Width and height of the picture.
    pub size: UVec2,
    /// Corners in the camera's clip space. Their varying is a position in the shadow map and the depth to compare
    /// there.
    pub corners: Vec<Corner>,
    /// Corners at the same positions. Their varying is the reflected light: of the sun in the colour, of the sky in
    /// alpha.
    pub shades: Vec<Corner>,
    /// Depths from the sun, 0 to 1.
    pub map: Frame<Vec4>,
}

/// Kernel that returns the interpolated value unchanged.
const PASS_ON: &str = "
/// The interpolated value.
pub fn pass_on(value: Quad<Vec4>) -> Quad<Vec4> {
    value
}
";

impl Shadowed {
    /// Draws the shadow map of `texels` columns and rows, covering `radius` scene units around the camera's target.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn new(gpu: &Bench, scene: &Scene, size: UVec2, texels: u32, radius: f32) -> Result<Shadowed, ExecuteError> {
        let sun = Vec3::from(scene.sun.direction).normalize_or(Vec3::Y);
        let to_sun = sun_space(sun, scene.camera.target.into(), radius);
        let to_clip = scene.camera.projection(size, glam::Vec2::ZERO) * scene.camera.view();
        // Surfaces at grazing angles to the sun would shadow themselves; an offset along the normal prevents that.
        let step = 6.0 * radius / texels as f32;
        let (mut corners, mut shades, mut seen_by_sun) = (Vec::new(), Vec::new(), Vec::new());
        for index in scene.triangles.iter().flatten() {
            let vertex = &scene.vertices[*index as usize];
            let (position, normal) = (Vec3::from(vertex.position), Vec3::from(vertex.normal));
            let clip = to_clip * position.extend(1.0);
            // The camera's depths are reversed; these are not.
            let clip = vec4(clip.x, clip.y, clip.w - clip.z, clip.w);
            let facing = normal
                * normal
                    .dot((Vec3::from(scene.camera.position) - position).normalize_or_zero())
                    .signum();
            let there = to_sun.transform_point3(position + facing * step);
            let uv = vec2(there.x * 0.5 + 0.5, 0.5 - there.y * 0.5);
            corners.push(Corner {
                position: clip,
                varyings: vec![vec4(uv.x, uv.y, there.z, 0.0)],
            });
            let color = Vec3::from(vertex.color);
            let sunlight = color * Vec3::from(scene.sun.color) * facing.dot(sun).max(0.0);
            let sky = 0.35 + 0.15 * facing.y;
            shades.push(Corner {
                position: clip,
                varyings: vec![sunlight.extend(sky * color.element_sum() / 3.0)],
            });
            let there = to_sun.transform_point3(position);
            seen_by_sun.push(Corner {
                position: there.extend(1.0),
                varyings: vec![Vec4::splat(there.z.clamp(1.0e-6, 1.0))],
            });
        }
        let depths = draw_corners(gpu, UVec2::splat(texels), &seen_by_sun)?;
        let border = |k: usize| {
            let (x, y) = (k as u32 % texels, k as u32 / texels);
            x == 0 || y == 0 || x == texels - 1 || y == texels - 1
        };
        // Texels without geometry, and those at the border of the map, are lit.
        let clear = |(k, texel): (usize, &Vec4)| match texel.x == 0.0 || border(k) {
            true => Vec4::ONE,
            false => Vec4::splat(texel.x),
        };
        let map = depths.texels().iter().enumerate().map(clear).collect();
        Ok(Shadowed {
            size,
            corners,
            shades,
            map: Frame::new(UVec2::splat(texels), map),
        })
    }

    /// Returns the pass that draws the image `coord`, for shadow kernels that are dispatched.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn coordinate_pass(&self, gpu: &Bench) -> Result<Forward, ExecuteError> {
        pass_on(gpu, self.size, &self.corners)
    }

    /// Returns the inputs of a shadow kernel; `coord` for those that read it from an image.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn kernel_inputs(&self, gpu: &Bench) -> Result<Inputs, ExecuteError> {
        let coord = gpu.draw_forward(&self.coordinate_pass(gpu)?)?;
        Ok(Inputs::new(self.size)
            .with_image("shadow", self.map.clone())
            .with_image("coord", coord))
    }

    /// Draws the picture, given the sunlight at each pixel.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn shade_picture(&self, gpu: &Bench, lit: &Frame<Vec4>) -> Result<Frame<Vec4>, ExecuteError> {
        let shades = draw_corners(gpu, self.size, &self.shades)?;
        let texel = |(shade, lit): (&Vec4, &Vec4)| match *shade == Vec4::ZERO {
            true => vec4(0.55, 0.65, 0.75, 1.0),
            false => (shade.truncate() * lit.x + Vec3::new(0.8, 0.9, 1.1) * shade.w).extend(1.0),
        };
        let texels = shades.texels().iter().zip(lit.texels()).map(texel).collect();
        Ok(Frame::new(self.size, texels))
    }
}

/// Returns the transform from world space to the sun's clip space: parallel rays, depth 0 near the sun and 1 far from
/// it.
fn sun_space(sun: Vec3, target: Vec3, radius: f32) -> Mat4 {
    let right = if sun.y.abs() > 0.99 {
        Vec3::X
    } else {
        Vec3::Y.cross(sun).normalize()
    };
    let up = sun.cross(right);
    let row = |axis: Vec3, scale: f32, shift: f32| (axis * scale).extend(shift - axis.dot(target) * scale);
    let reach = 4.0 * radius;
    Mat4::from_cols(
        row(right, 1.0 / radius, 0.0),
        row(up, 1.0 / radius, 0.0),
        row(-sun, 0.5 / reach, 0.5),
        Vec4::W,
    )
    .transpose()
}

/// Draws the first varying of the nearest triangle at each pixel.
fn pass_on(gpu: &Bench, size: UVec2, corners: &[Corner]) -> Result<Forward, ExecuteError> {
    let compiled = Kernel::from_text("pass_on.rs", PASS_ON, "pass_on")
        .compile(&Settings::default())
        .map_err(|e| ExecuteError::Input(e.to_string()))?;
    gpu.prepare_forward(&compiled, &Inputs::new(size), corners)
}

fn draw_corners(gpu: &Bench, size: UVec2, corners: &[Corner]) -> Result<Frame<Vec4>, ExecuteError> {
    gpu.draw_forward(&pass_on(gpu, size, corners)?)
}
