//! The two pipelines: triangles to G-buffer, G-buffer to colours.

use super::resources::{DEPTH_FORMAT, Resources, TEXEL_FORMAT};
use crate::scene::Vertex;
use glam::UVec2;
use wgpu::{BindingType, BufferBindingType, ShaderStages};

/// Invocations of a workgroup on each axis, as `shading.wgsl` has it.
const WORKGROUP: u32 = 8;

#[derive(Debug)]
pub(super) struct Pipelines {
    geometry: wgpu::RenderPipeline,
    shading: wgpu::ComputePipeline,
    pub geometry_layout: wgpu::BindGroupLayout,
    pub shading_layout: wgpu::BindGroupLayout,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device) -> Self {
        let geometry_layout = group_layout(device, &[(ShaderStages::VERTEX_FRAGMENT, uniform())]);
        let compute = ShaderStages::COMPUTE;
        let shading_layout = group_layout(
            device,
            &[
                (compute, uniform()),
                (compute, uniform()),
                (compute, texture()),
                (compute, texture()),
                (compute, storage()),
            ],
        );
        Pipelines {
            geometry: geometry_pipeline(device, &geometry_layout),
            shading: shading_pipeline(device, &shading_layout),
            geometry_layout,
            shading_layout,
        }
    }

    /// Records drawing the scene into the G-buffer.
    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, resources: &Resources) {
        let target = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let views = [&resources.normal_depth, &resources.color_material].map(target);
        let depth = target(&resources.depth);
        let cleared = |view, clear| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(clear),
                    store: wgpu::StoreOp::Store,
                },
            })
        };
        // `Surface::SKY`.
        let sky = wgpu::Color {
            r: 0.0,
            g: 0.0,
            b: 1.0,
            a: f64::from(crate::scene::SKY_DEPTH),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("straightline geometry"),
            color_attachments: &[cleared(&views[0], sky), cleared(&views[1], wgpu::Color::TRANSPARENT)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
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
        pass.set_pipeline(&self.geometry);
        pass.set_bind_group(0, &resources.geometry_group, &[]);
        pass.set_vertex_buffer(0, resources.vertices.slice(..));
        pass.set_index_buffer(resources.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..resources.index_count, 0, 0..1);
    }

    /// Records shading the G-buffer of `size` pixels.
    pub fn shade(&self, encoder: &mut wgpu::CommandEncoder, resources: &Resources, size: UVec2) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("straightline shading"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.shading);
        pass.set_bind_group(0, &resources.shading_group, &[]);
        pass.dispatch_workgroups(size.x.div_ceil(WORKGROUP), size.y.div_ceil(WORKGROUP), 1);
    }
}

/// The fields of a [`Vertex`].
pub(super) fn vertex_layout() -> [wgpu::VertexAttribute; 4] {
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Uint32]
}

/// The nearest surface, by the reciprocal of depth.
pub(super) fn depth_test() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

fn geometry_pipeline(device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("geometry.wgsl"));
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("straightline geometry"),
        layout: Some(&pipeline_layout(device, layout)),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<Vertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &vertex_layout(),
            })],
        },
        // Both sides are drawn; counter-clockwise is the front.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth_test()),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("texels"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(TEXEL_FORMAT.into()), Some(TEXEL_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn shading_pipeline(device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::ComputePipeline {
    let text = concat!(include_str!("../shade.wgsl"), "\n", include_str!("shading.wgsl"));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline shading"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("straightline shading"),
        layout: Some(&pipeline_layout(device, layout)),
        module: &module,
        entry_point: Some("light"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}

pub(super) fn pipeline_layout(device: &wgpu::Device, group: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(group)],
        immediate_size: 0,
    })
}

/// Bindings 0, 1, 2, ... of group 0.
pub(super) fn group_layout(device: &wgpu::Device, bindings: &[(ShaderStages, BindingType)]) -> wgpu::BindGroupLayout {
    let entry = |(at, (visibility, ty)): (usize, &(ShaderStages, BindingType))| wgpu::BindGroupLayoutEntry {
        binding: at as u32,
        visibility: *visibility,
        ty: *ty,
        count: None,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &bindings.iter().enumerate().map(entry).collect::<Vec<_>>(),
    })
}

pub(super) fn uniform() -> BindingType {
    buffer(BufferBindingType::Uniform)
}

/// A storage buffer that is written.
pub(super) fn storage() -> BindingType {
    buffer(BufferBindingType::Storage { read_only: false })
}

fn buffer(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn texture() -> BindingType {
    BindingType::Texture {
        // Floats of 32 bits cannot be filtered everywhere, and need not be.
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}
