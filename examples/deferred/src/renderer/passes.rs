//! Pipelines of `scene.wgsl`, and the render passes that use them.

use super::targets::{ALBEDO, COLOR, DEPTH, LAYERS, NORMAL, Targets, Z_BUFFER, layer};
use super::view::UNIFORMS;
use crate::scene;
use glam::Vec3;
use straightline_runtime::{Span, wgpu};
use wgpu::TextureFormat;

/// Linear depth of the background.
const SKY: f64 = 1.0e6;

/// Pipelines, and everything else that does not depend on the size.
pub struct Passes {
    pub device: wgpu::Device,
    corners: wgpu::Buffer,
    count: u32,
    /// Uniforms of each layer.
    pub uniforms: Vec<wgpu::Buffer>,
    geometry: wgpu::RenderPipeline,
    /// Shading at the pixel's centre, where the kernel `sraa_place` says, or at all samples.
    pub shade_centre: wgpu::RenderPipeline,
    pub shade_placed: wgpu::RenderPipeline,
    pub shade_samples: wgpu::RenderPipeline,
    pub present: wgpu::RenderPipeline,
}

impl Passes {
    /// Creates the pipelines for pictures of `format`.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, format: TextureFormat) -> Self {
        let shader = device.create_shader_module(wgpu::include_wgsl!("../scene.wgsl"));
        let corners = scene::corners();
        let numbers = corners.as_flattened().iter().flat_map(Vec3::to_array);
        let uniforms = || buffer(device, queue, wgpu::BufferUsages::UNIFORM, &[0; UNIFORMS]);
        let over_all = |fragment, format| pipeline(device, &shader, ["cover", fragment], &[format], false);
        Passes {
            corners: buffer(device, queue, wgpu::BufferUsages::VERTEX, &bytes(numbers)),
            count: corners.len() as u32,
            uniforms: (0..LAYERS).map(|_| uniforms()).collect(),
            geometry: pipeline(device, &shader, ["corner", "surface"], &[DEPTH, NORMAL, ALBEDO], true),
            shade_centre: over_all("shade_centre", COLOR),
            shade_placed: over_all("shade_placed", COLOR),
            shade_samples: over_all("shade_samples", COLOR),
            present: over_all("present", format),
            device: device.clone(),
        }
    }

    /// Draws the scene into one layer of the G-buffer.
    pub fn draw_geometry(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        at: u32,
        span: Option<Span<'_>>,
    ) {
        let [depth, normal, albedo] = targets.geometry.each_ref().map(|texture| layer(texture, at));
        let cleared =
            |view, [r, g, b]: [f64; 3]| attachment(view, wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 0.0 }));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("geometry"),
            color_attachments: &[
                cleared(&depth, [SKY, 0.0, 0.0]),
                // A normal of length 0 says that there is no surface.
                cleared(&normal, [0.0; 3]),
                cleared(&albedo, [1.0; 3]),
            ],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.z_buffer,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes: span.as_ref().map(Span::render_writes),
            ..Default::default()
        });
        pass.set_pipeline(&self.geometry);
        pass.set_bind_group(0, &self.bind(&self.geometry, Some(&self.uniforms[at as usize]), &[]), &[]);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.draw(0..self.count, 0..1);
    }

    /// Draws one triangle that covers all of `target`.
    pub fn cover(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        (uniforms, inputs): (Option<&wgpu::Buffer>, &[&wgpu::TextureView]),
        target: &wgpu::TextureView,
        span: Option<Span<'_>>,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("cover"),
            color_attachments: &[attachment(target, wgpu::LoadOp::Clear(wgpu::Color::BLACK))],
            timestamp_writes: span.as_ref().map(Span::render_writes),
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.bind(pipeline, uniforms, inputs), &[]);
        pass.draw(0..3, 0..1);
    }

    /// Binds uniforms at binding 0 and textures from 1 on.
    fn bind(
        &self,
        pipeline: &wgpu::RenderPipeline,
        uniforms: Option<&wgpu::Buffer>,
        textures: &[&wgpu::TextureView],
    ) -> wgpu::BindGroup {
        let uniforms = uniforms.map(|buffer| wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() });
        let textures = (1..).zip(textures);
        let textures = textures.map(|(binding, view)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &uniforms.into_iter().chain(textures).collect::<Vec<_>>(),
        })
    }
}

fn attachment(
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    })
}

/// Creates a pipeline of two functions of the shader, with the layout that they require.
pub fn pipeline(
    device: &wgpu::Device,
    shader: &wgpu::ShaderModule,
    [vertex, fragment]: [&str; 2],
    formats: &[TextureFormat],
    geometry: bool,
) -> wgpu::RenderPipeline {
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3];
    let corners = Some(wgpu::VertexBufferLayout {
        array_stride: 36,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    });
    let targets: Vec<_> = formats.iter().map(|format| Some((*format).into())).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: None,
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: if geometry { std::slice::from_ref(&corners) } else { &[] },
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: geometry.then(|| wgpu::DepthStencilState {
            format: Z_BUFFER,
            depth_write_enabled: Some(true),
            // Reversed depth: larger is nearer.
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn buffer(device: &wgpu::Device, queue: &wgpu::Queue, usage: wgpu::BufferUsages, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, bytes);
    buffer
}

pub fn bytes(numbers: impl Iterator<Item = f32>) -> Vec<u8> {
    numbers.flat_map(f32::to_le_bytes).collect()
}
