//! Rasterising and shading on a device of wgpu.

mod drawing;
pub(crate) mod guard;
mod listed;
mod multisampled;
mod passes;
mod pipelines;
mod read;
mod resources;

use super::frame::{Lighting, Pass};
use super::shade::{GuideLight, Surface, direct_light, guide, shade_surface, surface_paint};
use super::{RenderError, Renderer, check_offsets};
use crate::scene::{Camera, Scene};
use glam::{UVec2, Vec2, Vec3, Vec4};
use guard::with_error_scope;
pub use listed::Listed;
pub use multisampled::MultisampledGeometry;
pub use passes::{FramePass, FramePasses, Samples, Timestamps};
use pipelines::Pipelines;
use resources::{Resources, check_limits};
use straightline_kernels::prelude::Frame;

/// Draws on the caller's device, which needs no features beyond wgpu's default limits.
#[derive(Debug)]
pub struct GpuRenderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    camera: Camera,
    size: UVec2,
    lighting: Lighting,
    pipelines: Pipelines,
    resources: Resources,
}

impl GpuRenderer {
    /// A renderer of `scene` in pictures of `size` pixels on `device`, to which `queue` belongs. Uploads the scene.
    ///
    /// # Errors
    ///
    /// [`RenderError::Scene`] if [`Scene::check`] refuses it, [`RenderError::Size`] and [`RenderError::Limit`] if
    /// picture or scene are beyond the device's limits, [`RenderError::Device`] if it runs out of memory or is lost.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, scene: &Scene, size: UVec2) -> Result<Self, RenderError> {
        scene.check()?;
        check_limits(device, scene, size)?;
        let pipelines = with_error_scope(device, "compiling the renderer's shaders", || {
            Pipelines::new(device, scene)
        })?;
        let resources = with_error_scope(device, "uploading the scene", || {
            Resources::new(device, queue, &pipelines, scene, size)
        })?;
        Ok(GpuRenderer {
            device: device.clone(),
            queue: queue.clone(),
            camera: scene.camera,
            lighting: Lighting::new(scene, size),
            size,
            pipelines,
            resources,
        })
    }

    /// Draws the G-buffer at `offset`, and what `more` records after it.
    fn submit_pass(&self, pass: Pass, more: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<(), RenderError> {
        with_error_scope(&self.device, "drawing", || {
            self.queue
                .write_buffer(&self.resources.pass, 0, bytemuck::bytes_of(&pass));
            let mut encoder = self
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let resources = &self.resources;
            self.pipelines
                .record_draw(&mut encoder, resources, &resources.geometry_group, None);
            more(&mut encoder);
            self.queue.submit([encoder.finish()]);
        })
    }
}

impl Renderer for GpuRenderer {
    fn size(&self) -> UVec2 {
        self.size
    }

    fn camera(&self) -> Camera {
        self.camera
    }

    fn draw_geometry(&self, offset: Vec2) -> Result<(Frame<f32>, Frame<Vec3>), RenderError> {
        check_offsets(&[offset])?;
        self.submit_pass(Pass::new(&self.camera, self.size, offset), |_| {})?;
        let texels = read::read_texture(&self.device, &self.queue, &self.resources.normal_depth)?;
        let (depth, normal) = texels.iter().map(|texel| (texel.w, texel.truncate())).unzip();
        Ok((Frame::new(self.size, depth), Frame::new(self.size, normal)))
    }

    fn draw_shaded(&self, offset: Vec2) -> Result<Frame<Vec4>, RenderError> {
        self.draw_mean(&[offset])
    }

    fn draw_surfaces(&self, offset: Vec2) -> Result<Vec<Surface>, RenderError> {
        check_offsets(&[offset])?;
        self.submit_pass(Pass::new(&self.camera, self.size, offset), |_| {})?;
        let read = |texture| read::read_texture(&self.device, &self.queue, texture);
        let (geometry, paint) = (
            read(&self.resources.normal_depth)?,
            read(&self.resources.color_material)?,
        );
        let surface = |(geometry, paint): (&Vec4, &Vec4)| Surface {
            normal: geometry.truncate(),
            depth: geometry.w,
            color: paint.truncate(),
            material: paint.w,
        };
        Ok(geometry.iter().zip(&paint).map(surface).collect())
    }

    fn shade_surface(&self, surface: &Surface, place: Vec2) -> Vec3 {
        shade_surface(&self.lighting, surface, self.lighting.ray(place, self.size))
    }

    fn surface_paint(&self, surface: &Surface, place: Vec2) -> Vec4 {
        surface_paint(&self.lighting, surface, self.lighting.ray(place, self.size))
    }

    fn direct_light(&self, surface: &Surface, place: Vec2) -> Vec3 {
        direct_light(&self.lighting, surface, self.lighting.ray(place, self.size))
    }

    fn guide_by(&self, known: GuideLight, surface: &Surface, place: Vec2) -> Vec3 {
        guide(&self.lighting, surface, self.lighting.ray(place, self.size), known)
    }

    /// Adds up on the device, in 32 bits, and reads back once.
    fn draw_mean(&self, offsets: &[Vec2]) -> Result<Frame<Vec4>, RenderError> {
        check_offsets(offsets)?;
        for (i, offset) in offsets.iter().enumerate() {
            let mut pass = Pass::new(&self.camera, self.size, *offset);
            pass.keep = if i == 0 { 0.0 } else { 1.0 };
            self.submit_pass(pass, |encoder| {
                self.pipelines.record_shading(encoder, &self.resources, self.size)
            })?;
        }
        let sums = read::read_buffer(&self.device, &self.queue, &self.resources.colors)?;
        let share = 1.0 / offsets.len() as f32;
        Ok(Frame::new(self.size, sums.into_iter().map(|sum| sum * share).collect()))
    }
}
