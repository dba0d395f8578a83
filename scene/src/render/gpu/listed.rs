//! Further shading samples of the pixels that the kernel `sraa_extra` lists, by dispatches whose size the list says.

use super::GpuRenderer;
use super::guard::with_error_scope;
use super::pipelines::{
    group_layout, pipeline_layout, read_storage, storage_binding, texture_binding, uniform_binding,
};
use super::read;
use super::resources::{create_bind_group, create_buffer};
use crate::render::RenderError;
use crate::render::check_offsets;
use crate::render::frame::Pass;
use glam::{Vec2, Vec4};
use straightline_kernels::prelude::Frame;
use wgpu::{BufferUsages, ShaderStages};

/// Shades what is listed of the pictures of one renderer.
#[derive(Debug)]
pub struct Listed<'a> {
    renderer: &'a GpuRenderer,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
    /// The number of the sample that the G-buffer was drawn at last.
    drawn: wgpu::Buffer,
}

impl<'a> Listed<'a> {
    /// Of what `renderer` draws.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn new(renderer: &'a GpuRenderer) -> Result<Self, RenderError> {
        let device = &renderer.device;
        with_error_scope(device, "compiling the renderer's shaders", || {
            let text = [
                &renderer.pipelines.shade_text,
                include_str!("shading.wgsl"),
                include_str!("listed.wgsl"),
            ];
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("straightline listed shading"),
                source: wgpu::ShaderSource::Wgsl(text.join("\n").into()),
            });
            let bindings = [
                uniform_binding(),
                uniform_binding(),
                texture_binding(),
                texture_binding(),
                storage_binding(),
                read_storage(),
                read_storage(),
                uniform_binding(),
            ];
            let layout = group_layout(device, &bindings.map(|binding| (ShaderStages::COMPUTE, binding)));
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("straightline listed shading"),
                layout: Some(&pipeline_layout(device, &[&layout])),
                module: &module,
                entry_point: Some("light_listed"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            Listed {
                renderer,
                layout,
                pipeline,
                drawn: create_buffer(device, BufferUsages::UNIFORM | BufferUsages::COPY_DST, 4),
            }
        })
    }

    /// Linear colour of each pixel that is listed, shaded at the one of `samples` that its entry names; 0 of all others.
    ///
    /// `counts` and `list` are as `sraa_extra` left them: 4 numbers of 32 bits, usable for indirect dispatches and as
    /// storage, and 2 numbers an entry. The G-buffer is drawn once for each sample, as this renderer keeps no more than
    /// one, and what is listed there is shaded.
    ///
    /// # Errors
    ///
    /// As [`Renderer::geometry`](crate::render::Renderer::draw_geometry).
    pub fn shade(
        &self,
        samples: &[Vec2],
        counts: &wgpu::Buffer,
        list: &wgpu::Buffer,
    ) -> Result<Frame<Vec4>, RenderError> {
        check_offsets(samples)?;
        let GpuRenderer {
            device,
            queue,
            resources,
            camera,
            size,
            ..
        } = self.renderer;
        let group = with_error_scope(device, "binding a list of pixels", || {
            let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
            let bindings = [
                resources.pass.as_entire_binding(),
                resources.lighting.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&resources.normal_depth)),
                wgpu::BindingResource::TextureView(&view(&resources.color_material)),
                resources.colors.as_entire_binding(),
                counts.as_entire_binding(),
                list.as_entire_binding(),
                self.drawn.as_entire_binding(),
            ];
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.clear_buffer(&resources.colors, 0, None);
            queue.submit([encoder.finish()]);
            create_bind_group(device, &self.layout, &bindings)
        })?;
        for (sample, offset) in samples.iter().enumerate() {
            queue.write_buffer(&self.drawn, 0, &(sample as u32).to_ne_bytes());
            self.renderer
                .submit_pass(Pass::new(camera, *size, *offset), |encoder| {
                    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                        label: Some("straightline listed shading"),
                        timestamp_writes: None,
                    });
                    pass.set_pipeline(&self.pipeline);
                    pass.set_bind_group(0, &group, &[]);
                    pass.dispatch_workgroups_indirect(counts, 0);
                })?;
        }
        Ok(Frame::new(*size, read::read_buffer(device, queue, &resources.colors)?))
    }
}
