//! The two pipelines: triangles to G-buffer, G-buffer to colours.

use super::drawing::{ColorTarget, Drawing, Drawn, full_view};
use super::resources::{Resources, TEXEL_FORMAT};
use crate::scene::Scene;
use glam::UVec2;
use wgpu::{BindingType, BufferBindingType, ShaderStages};

/// Invocations of a workgroup on each axis, as `shading.wgsl` has it.
pub(super) const WORKGROUP: u32 = 8;

#[derive(Debug)]
pub(super) struct Pipelines {
    /// Beginning of the text of every shader that draws the scene.
    pub geometry_text: String,
    /// Text of what shades it, which may follow.
    pub shade_text: String,
    geometry: wgpu::RenderPipeline,
    shading: wgpu::ComputePipeline,
    pub geometry_layout: wgpu::BindGroupLayout,
    pub texture_layout: wgpu::BindGroupLayout,
    pub shading_layout: wgpu::BindGroupLayout,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device, scene: &Scene) -> Self {
        let (geometry_text, shade_text) = (geometry_text(scene), shade_text(scene));
        let geometry_layout = group_layout(device, &[(ShaderStages::VERTEX_FRAGMENT, uniform_binding())]);
        let read = (
            ShaderStages::FRAGMENT,
            buffer_binding(BufferBindingType::Storage { read_only: true }),
        );
        let texture_layout = group_layout(device, &[read, read]);
        let compute = ShaderStages::COMPUTE;
        let shading_layout = group_layout(
            device,
            &[
                (compute, uniform_binding()),
                (compute, uniform_binding()),
                (compute, texture_binding()),
                (compute, texture_binding()),
                (compute, storage_binding()),
            ],
        );
        Pipelines {
            geometry: geometry_pipeline(device, [&geometry_layout, &texture_layout], &geometry_text),
            shading: shading_pipeline(device, &shading_layout, &shade_text),
            geometry_text,
            shade_text,
            geometry_layout,
            texture_layout,
            shading_layout,
        }
    }

    /// Groups of what draws the scene: a view, and textures.
    pub fn drawing_layouts(&self) -> [&wgpu::BindGroupLayout; 2] {
        [&self.geometry_layout, &self.texture_layout]
    }

    /// Records drawing the scene into the G-buffer, as seen by the [`Pass`](crate::render::frame::Pass) of `group`.
    pub fn record_draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        resources: &Resources,
        group: &wgpu::BindGroup,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let [normal_depth, color_material, tested] =
            [&resources.normal_depth, &resources.color_material, &resources.depth].map(full_view);
        // `Surface::SKY`.
        let sky = wgpu::Color {
            r: 0.0,
            g: 0.0,
            b: 1.0,
            a: f64::from(crate::scene::SKY_DEPTH),
        };
        let drawing = Drawing {
            label: "straightline geometry",
            pipeline: &self.geometry,
            group,
            targets: &[
                ColorTarget::cleared(&normal_depth, sky),
                ColorTarget::cleared(&color_material, wgpu::Color::TRANSPARENT),
            ],
            tested: &tested,
            behind: None,
            timestamps,
        };
        drawing.record(encoder, resources);
    }

    /// Records shading the G-buffer of `size` pixels.
    pub fn record_shading(&self, encoder: &mut wgpu::CommandEncoder, resources: &Resources, size: UVec2) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("straightline shading"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.shading);
        pass.set_bind_group(0, &resources.shading_group, &[]);
        pass.dispatch_workgroups(size.x.div_ceil(WORKGROUP), size.y.div_ceil(WORKGROUP), 1);
    }
}

fn geometry_text(scene: &Scene) -> String {
    let has_textures = !scene.textures.images.is_empty();
    let chosen = format!("const HAS_TEXTURES: bool = {has_textures};");
    [&chosen, include_str!("../paint.wgsl"), include_str!("geometry.wgsl")].join("\n")
}

fn shade_text(scene: &Scene) -> String {
    let has_environment = scene.environment != [[0.0; 3]; 9];
    let has_lamps = has_environment || !scene.lamps.is_empty() || !scene.shades.is_empty();
    let chosen = format!("const HAS_LAMPS: bool = {has_lamps};");
    [&chosen, include_str!("../shade.wgsl")].join("\n")
}

fn geometry_pipeline(device: &wgpu::Device, layouts: [&wgpu::BindGroupLayout; 2], text: &str) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline geometry"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let drawn = Drawn {
        label: "straightline geometry",
        layouts,
        module: &module,
        entries: ["corner", "texels"],
        targets: &[TEXEL_FORMAT, TEXEL_FORMAT],
        samples: 1,
        behind: false,
    };
    drawn.create_pipeline(device)
}

fn shading_pipeline(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, shade_text: &str) -> wgpu::ComputePipeline {
    let text = [shade_text, include_str!("shading.wgsl")].join("\n");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline shading"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("straightline shading"),
        layout: Some(&pipeline_layout(device, &[layout])),
        module: &module,
        entry_point: Some("light"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}

/// Groups 0, 1, ...
pub(super) fn pipeline_layout(device: &wgpu::Device, groups: &[&wgpu::BindGroupLayout]) -> wgpu::PipelineLayout {
    let groups: Vec<_> = groups.iter().map(|group| Some(*group)).collect();
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &groups,
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

/// A storage buffer that is read.
pub(super) fn read_storage() -> BindingType {
    buffer_binding(BufferBindingType::Storage { read_only: true })
}

pub(super) fn uniform_binding() -> BindingType {
    buffer_binding(BufferBindingType::Uniform)
}

/// A storage buffer that is written.
pub(super) fn storage_binding() -> BindingType {
    buffer_binding(BufferBindingType::Storage { read_only: false })
}

fn buffer_binding(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

pub(super) fn texture_binding() -> BindingType {
    BindingType::Texture {
        // Floats of 32 bits cannot be filtered everywhere, and need not be.
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}
