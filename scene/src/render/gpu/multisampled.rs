//! A 4× multisampled pass instead of four shifted ones (paper §3.4).

use super::drawing::{ColorTarget, Drawing, Drawn, full_view};
use super::guard::with_error_scope;
use super::pipelines::{Pipelines, group_layout, pipeline_layout, storage_binding, uniform_binding};
use super::resources::{DEPTH_FORMAT, Resources, create_bind_group};
use super::{GpuRenderer, read};
use crate::render::RenderError;
use crate::render::frame::Pass;
use crate::scene::SKY_DEPTH;
use glam::{UVec2, Vec2, Vec3, Vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};
use wgpu::{BindingType, BufferUsages, ShaderStages, TextureFormat, TextureUsages};

/// Samples of each pixel, at the standard places of graphics APIs: the pattern `latin4`, in its order.
pub(super) const SAMPLES: u32 = 4;

/// Linear depth, whole. Of the formats of 32 bits a channel only this one can be multisampled on every device.
pub(super) const DEPTH: TextureFormat = TextureFormat::R32Float;

/// Unit normals in view space, to eleven bits: no wider format can be multisampled on every device.
pub(super) const NORMAL: TextureFormat = TextureFormat::Rgba16Float;

/// Depth where nothing is drawn.
pub(super) const SKY_AT: wgpu::Color = wgpu::Color {
    r: SKY_DEPTH as f64,
    g: 0.0,
    b: 0.0,
    a: 0.0,
};

/// Normal where nothing is drawn.
pub(super) const SKY_FACING: wgpu::Color = wgpu::Color {
    r: 0.0,
    g: 0.0,
    b: 1.0,
    a: 0.0,
};

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
            let texels = self.read_sample(sample)?;
            let (depth, normal) = texels.iter().map(|texel| (texel.w, texel.truncate())).unzip();
            depths.push(Frame::new(size, depth));
            normals.push(Frame::new(size, normal));
        }
        Ok((FrameLayers::new(depths), FrameLayers::new(normals)))
    }

    /// Normal and depth of one sample of each pixel.
    fn read_sample(&self, sample: u32) -> Result<Vec<Vec4>, RenderError> {
        let device = &self.device;
        let pixels = u64::from(self.depth.width()) * u64::from(self.depth.height());
        let texels = with_error_scope(device, "reading samples", || {
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
                    (compute, storage_binding()),
                    (compute, uniform_binding()),
                ],
            );
            let module = device.create_shader_module(wgpu::include_wgsl!("samples.wgsl"));
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("straightline samples"),
                layout: Some(&pipeline_layout(device, &[&layout])),
                module: &module,
                entry_point: Some("read_sample"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            let views = [&self.depth, &self.normal].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
            let group = create_bind_group(
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
        read::read_buffer(device, &self.queue, &texels)
    }
}

impl GpuRenderer {
    /// Geometry at four samples of each pixel from one multisampled pass: the same as [`draw_geometry`] at each offset of the
    /// pattern `latin4`, but for samples within a rounding of a triangle's edge. Compiles its pipeline each time.
    ///
    /// [`draw_geometry`]: crate::render::Renderer::draw_geometry
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`] if the device has too little memory, or is gone.
    pub fn draw_multisampled(&self) -> Result<MultisampledGeometry, RenderError> {
        let device = &self.device;
        with_error_scope(device, "drawing multisampled geometry", || {
            let targets = Multisampled::new(device, self.size, &self.pipelines);
            let pass = Pass::new(&self.camera, self.size, Vec2::ZERO);
            self.queue
                .write_buffer(&self.resources.pass, 0, bytemuck::bytes_of(&pass));
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            targets.record_draw(&mut encoder, &self.resources, &self.resources.geometry_group, None);
            self.queue.submit([encoder.finish()]);
            targets.to_geometry(device, &self.queue)
        })
    }
}

/// The pipeline of the multisampled pass, and what it draws into.
#[derive(Debug)]
pub(super) struct Multisampled {
    pipeline: wgpu::RenderPipeline,
    depth: wgpu::Texture,
    normal: wgpu::Texture,
    tested: wgpu::Texture,
}

impl Multisampled {
    /// For pictures of `size`, and groups of `layout`.
    pub fn new(device: &wgpu::Device, size: UVec2, pipelines: &Pipelines) -> Self {
        let target = |format, usage| multisampled_target(device, size, format, usage);
        Multisampled {
            pipeline: create_pipeline(device, pipelines),
            depth: target(DEPTH, TextureUsages::TEXTURE_BINDING),
            normal: target(NORMAL, TextureUsages::TEXTURE_BINDING),
            tested: target(DEPTH_FORMAT, TextureUsages::empty()),
        }
    }

    /// Records the pass, as seen by the [`Pass`] of `group`.
    pub fn record_draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        resources: &Resources,
        group: &wgpu::BindGroup,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let [depth, normal, tested] = [&self.depth, &self.normal, &self.tested].map(full_view);
        let drawing = Drawing {
            label: "straightline multisampled geometry",
            pipeline: &self.pipeline,
            group,
            targets: &[
                ColorTarget::cleared(&depth, SKY_AT),
                ColorTarget::cleared(&normal, SKY_FACING),
            ],
            tested: &tested,
            behind: None,
            timestamps,
        };
        drawing.record(encoder, resources);
    }

    /// Returns the geometry that was drawn.
    pub fn to_geometry(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> MultisampledGeometry {
        MultisampledGeometry {
            device: device.clone(),
            queue: queue.clone(),
            depth: self.depth.clone(),
            normal: self.normal.clone(),
        }
    }
}

/// Of four samples a pixel.
pub(super) fn multisampled_target(
    device: &wgpu::Device,
    size: UVec2,
    format: TextureFormat,
    usage: TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("straightline multisampled target"),
        size: wgpu::Extent3d {
            width: size.x,
            height: size.y,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: SAMPLES,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

fn create_pipeline(device: &wgpu::Device, pipelines: &Pipelines) -> wgpu::RenderPipeline {
    let text = [&pipelines.geometry_text, include_str!("multisampled.wgsl")].join("\n");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline multisampled geometry"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let drawn = Drawn {
        label: "straightline multisampled geometry",
        layouts: pipelines.drawing_layouts(),
        module: &module,
        entries: ["sampled_corner", "sampled_texels"],
        targets: &[DEPTH, NORMAL],
        samples: SAMPLES,
        behind: false,
    };
    drawn.create_pipeline(device)
}
