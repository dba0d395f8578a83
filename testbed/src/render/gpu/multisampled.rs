//! One 4× multisampled pass instead of four shifted ones (paper §3.4).

use super::guard::guarded;
use super::pipelines::{group_layout, pipeline_layout, storage, uniform, vertex_layout};
use super::resources::{DEPTH_FORMAT, group};
use super::{GpuRenderer, read};
use crate::render::RenderError;
use crate::render::frame::Pass;
use crate::scene::{SKY_DEPTH, Vertex};
use glam::{Vec2, Vec3, Vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};
use wgpu::{BindingType, BufferUsages, ShaderStages, TextureFormat, TextureUsages};

/// Samples of each pixel, at the standard places of graphics APIs: the pattern `latin4`, in its order.
const SAMPLES: u32 = 4;

/// Linear depth, whole. Of the formats of 32 bits a channel only this one can be multisampled on every device.
const DEPTH: TextureFormat = TextureFormat::R32Float;

/// Unit normals in view space, to eleven bits: no wider format can be multisampled on every device.
const NORMAL: TextureFormat = TextureFormat::Rgba16Float;

/// Geometry at four samples of each pixel, in multisampled textures.
#[derive(Debug)]
pub struct MultisampledGeometry {
    device: wgpu::Device,
    queue: wgpu::Queue,
    depth: wgpu::Texture,
    normal: wgpu::Texture,
}

impl MultisampledGeometry {
    /// Linear depth: `r32float`, four samples, to be bound as `texture_multisampled_2d<f32>`.
    pub fn depth(&self) -> &wgpu::Texture {
        &self.depth
    }

    /// Unit normals in view space, rounded to halves: `rgba16float`, four samples, alpha 0.
    pub fn normal(&self) -> &wgpu::Texture {
        &self.normal
    }

    /// Both read back, a layer for each sample in the order of the pattern `latin4`. Normals are as stored: halves.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn read(&self) -> Result<(FrameLayers<f32>, FrameLayers<Vec3>), RenderError> {
        let size = glam::uvec2(self.depth.width(), self.depth.height());
        let (mut depths, mut normals) = (Vec::new(), Vec::new());
        for sample in 0..SAMPLES {
            let texels = self.sample(sample)?;
            let (depth, normal) = texels.iter().map(|texel| (texel.w, texel.truncate())).unzip();
            depths.push(Frame::new(size, depth));
            normals.push(Frame::new(size, normal));
        }
        Ok((FrameLayers::new(depths), FrameLayers::new(normals)))
    }

    /// Normal and depth of one sample of each pixel.
    fn sample(&self, sample: u32) -> Result<Vec<Vec4>, RenderError> {
        let device = &self.device;
        let pixels = u64::from(self.depth.width()) * u64::from(self.depth.height());
        let texels = guarded(device, "reading samples", || {
            let buffer = |usage, size| {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: None,
                    size,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let texels = buffer(
                BufferUsages::STORAGE | BufferUsages::COPY_SRC,
                pixels * size_of::<Vec4>() as u64,
            );
            let chosen = buffer(BufferUsages::UNIFORM | BufferUsages::COPY_DST, 16);
            self.queue
                .write_buffer(&chosen, 0, bytemuck::bytes_of(&[sample, 0, 0, 0]));
            let compute = ShaderStages::COMPUTE;
            let multisampled = BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: true,
            };
            let layout = group_layout(
                device,
                &[
                    (compute, multisampled),
                    (compute, multisampled),
                    (compute, storage()),
                    (compute, uniform()),
                ],
            );
            let module = device.create_shader_module(wgpu::include_wgsl!("samples.wgsl"));
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("straightline samples"),
                layout: Some(&pipeline_layout(device, &layout)),
                module: &module,
                entry_point: Some("read_sample"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            let views = [&self.depth, &self.normal].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
            let group = group(
                device,
                &layout,
                &[
                    wgpu::BindingResource::TextureView(&views[0]),
                    wgpu::BindingResource::TextureView(&views[1]),
                    texels.as_entire_binding(),
                    chosen.as_entire_binding(),
                ],
            );
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(self.depth.width().div_ceil(8), self.depth.height().div_ceil(8), 1);
            drop(pass);
            self.queue.submit([encoder.finish()]);
            texels
        })?;
        read::buffer(device, &self.queue, &texels)
    }
}

impl GpuRenderer {
    /// Geometry at four samples of each pixel from one multisampled pass: the same as [`geometry`] at each offset of the
    /// pattern `latin4`, but for samples within a rounding of a triangle's edge. Compiles its pipeline each time.
    ///
    /// [`geometry`]: crate::render::Renderer::geometry
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`] if the device has too little memory, or is gone.
    pub fn multisampled(&self) -> Result<MultisampledGeometry, RenderError> {
        let device = &self.device;
        guarded(device, "drawing multisampled geometry", || {
            let target = |format, usage| {
                device.create_texture(&wgpu::TextureDescriptor {
                    label: Some("straightline multisampled geometry"),
                    size: wgpu::Extent3d {
                        width: self.size.x,
                        height: self.size.y,
                        depth_or_array_layers: 1,
                    },
                    mip_level_count: 1,
                    sample_count: SAMPLES,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: usage | TextureUsages::RENDER_ATTACHMENT,
                    view_formats: &[],
                })
            };
            let depth = target(DEPTH, TextureUsages::TEXTURE_BINDING);
            let normal = target(NORMAL, TextureUsages::TEXTURE_BINDING);
            let tested = target(DEPTH_FORMAT, TextureUsages::empty());
            let pass = Pass::new(&self.camera, self.size, Vec2::ZERO);
            self.queue
                .write_buffer(&self.resources.pass, 0, bytemuck::bytes_of(&pass));
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.draw_samples(&mut encoder, [&depth, &normal, &tested]);
            self.queue.submit([encoder.finish()]);
            MultisampledGeometry {
                device: device.clone(),
                queue: self.queue.clone(),
                depth,
                normal,
            }
        })
    }

    fn draw_samples(&self, encoder: &mut wgpu::CommandEncoder, targets: [&wgpu::Texture; 3]) {
        let [depth, normal, tested] = targets.map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
        let cleared = |view, [r, g, b]: [f64; 3]| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 0.0 }),
                    store: wgpu::StoreOp::Store,
                },
            })
        };
        let pipeline = pipeline(&self.device, &self.pipelines.geometry_layout);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("straightline multisampled geometry"),
            color_attachments: &[
                cleared(&depth, [f64::from(SKY_DEPTH), 0.0, 0.0]),
                cleared(&normal, [0.0, 0.0, 1.0]),
            ],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &tested,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        let resources = &self.resources;
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &resources.geometry_group, &[]);
        pass.set_vertex_buffer(0, resources.vertices.slice(..));
        pass.set_index_buffer(resources.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..resources.index_count, 0, 0..1);
    }
}

fn pipeline(device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::RenderPipeline {
    let text = concat!(include_str!("geometry.wgsl"), "\n", include_str!("multisampled.wgsl"));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline multisampled geometry"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("straightline multisampled geometry"),
        layout: Some(&pipeline_layout(device, layout)),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("sampled_corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Vertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &vertex_layout(),
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(super::pipelines::depth_test()),
        multisample: wgpu::MultisampleState {
            count: SAMPLES,
            ..Default::default()
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("sampled_texels"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(DEPTH.into()), Some(NORMAL.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
