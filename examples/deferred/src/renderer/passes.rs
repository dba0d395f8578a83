//! Pipelines of `scene.wgsl`, and the render passes that use them.

use super::targets::ALBEDO;
use super::view::UNIFORMS;
use crate::scene;
use glam::Vec3;
use straightline_sraa::runtime::Span;
use straightline_sraa::{COLOR, DEPTH, GUIDE, GeometryPass, NORMAL, wgpu};
use wgpu::TextureFormat;

/// Pipelines, and everything else that does not depend on the size.
pub struct Passes {
    pub device: wgpu::Device,
    corners: wgpu::Buffer,
    count: u32,
    /// Uniforms of the samples, whose matrix is the camera's own, and of the centre.
    pub uniforms: wgpu::Buffer,
    /// Geometry of all samples and of the centre, without a guide and with one.
    geometry: [[wgpu::RenderPipeline; 2]; 2],
    /// Shading at the pixel's centre, where SRAA says, or at all samples.
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
        let over_all = |fragment, format| pipeline(device, &shader, ["cover", fragment], &[format], None);
        let geometry = |fragment, formats: &[TextureFormat]| {
            [4, 1].map(|samples| pipeline(device, &shader, ["corner", fragment], formats, Some(samples)))
        };
        Passes {
            corners: buffer(device, queue, wgpu::BufferUsages::VERTEX, &bytes(numbers)),
            count: corners.len() as u32,
            uniforms: buffer(device, queue, wgpu::BufferUsages::UNIFORM, &[0; UNIFORMS]),
            geometry: [geometry("surface", &[ALBEDO, NORMAL]), geometry("guided_surface", &[ALBEDO, NORMAL, GUIDE])],
            shade_centre: over_all("shade_centre", COLOR),
            shade_placed: over_all("shade_placed", COLOR),
            shade_samples: over_all("shade_samples", COLOR),
            present: over_all("present", format),
            device: device.clone(),
        }
    }

    /// Draws the scene into a pass of SRAA's, and the albedo beside it.
    pub fn draw_geometry(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        geometry: GeometryPass<'_>,
        albedo: &wgpu::TextureView,
        span: Option<Span<'_>>,
    ) {
        let albedo = attachment(albedo, wgpu::LoadOp::Clear(wgpu::Color::WHITE));
        let [samples, centre] = &self.geometry[usize::from(geometry.guide().is_some())];
        let pipeline = if geometry.sample_count > 1 { samples } else { centre };
        let mut pass = geometry.begin_with(encoder, &[albedo], span.as_ref().map(Span::render_writes));
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.bind(pipeline, Some(&self.uniforms), &[]), &[]);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.draw(0..self.count, 0..1);
    }

    /// Draws one triangle that covers all of `target`.
    pub fn cover(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        (uniforms, inputs): (Option<&wgpu::Buffer>, &[(u32, &wgpu::TextureView)]),
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

    /// Binds uniforms at binding 0, and textures.
    fn bind(
        &self,
        pipeline: &wgpu::RenderPipeline,
        uniforms: Option<&wgpu::Buffer>,
        textures: &[(u32, &wgpu::TextureView)],
    ) -> wgpu::BindGroup {
        let uniforms = uniforms.map(|buffer| wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() });
        let textures = textures.iter().map(|(binding, view)| wgpu::BindGroupEntry {
            binding: *binding,
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

/// Creates a pipeline of two functions of the shader, with the layout that they require. With a number of samples, it draws
/// geometry.
pub fn pipeline(
    device: &wgpu::Device,
    shader: &wgpu::ShaderModule,
    [vertex, fragment]: [&str; 2],
    formats: &[TextureFormat],
    geometry: Option<u32>,
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
            buffers: if geometry.is_some() { std::slice::from_ref(&corners) } else { &[] },
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: geometry.map(|_| wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            // Reversed depth: larger is nearer.
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: geometry.unwrap_or(1), ..Default::default() },
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
