//! Pipelines, targets and bindings of a frame's passes.

use super::{FramePasses, Samples};
use crate::render::frame::{Lighting, Pass};
use crate::render::gpu::GpuRenderer;
use crate::render::gpu::drawing::{Drawn, full_view};
use crate::render::gpu::multisampled::{self, DEPTH, Multisampled, NORMAL, multisampled_target};
use crate::render::gpu::pipelines::{group_layout, pipeline_layout, texture_binding, uniform_binding};
use crate::render::gpu::resources::{DEPTH_FORMAT, create_bind_group, create_buffer};
use crate::scene::Scene;
use glam::UVec2;
use wgpu::{BindingType, BufferUsages, ShaderStages, TextureFormat, TextureUsages, TextureView};

/// Format of shaded colours: half floats can be written by shaders, multisampled and resolved on every device.
const COLOR: TextureFormat = TextureFormat::Rgba16Float;

/// A sample's place, and where in the layers its colour goes.
#[derive(Debug)]
pub(super) struct Place {
    pub geometry: wgpu::BindGroup,
    pub shading: wgpu::BindGroup,
}

/// The mean of so many layers.
#[derive(Debug)]
pub(super) struct Mean {
    pub pipeline: wgpu::ComputePipeline,
    pub group: wgpu::BindGroup,
}

#[derive(Debug)]
pub(super) struct Targets {
    pub deferred: wgpu::ComputePipeline,
    pub auxiliary: wgpu::RenderPipeline,
    pub auxiliary_depth: wgpu::Texture,
    pub auxiliary_normal: wgpu::Texture,
    /// Of depth and normal for each sample.
    pub auxiliary_views: Vec<[TextureView; 2]>,
    pub multisampled: Multisampled,
    pub picture: wgpu::Texture,
}

#[derive(Debug)]
pub(super) struct Forward {
    pub surfaces: wgpu::RenderPipeline,
    pub sky: wgpu::RenderPipeline,
    pub group: wgpu::BindGroup,
    pub color: wgpu::Texture,
    pub tested: wgpu::Texture,
}

/// Makes everything. Errors are the caller's to catch.
pub(super) fn create_passes(renderer: GpuRenderer, scene: &Scene, evaluations: u32) -> FramePasses {
    let (device, size) = (&renderer.device, renderer.size);
    let text = [
        &renderer.pipelines.geometry_text,
        &renderer.pipelines.shade_text,
        include_str!("passes.wgsl"),
    ];
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline frame"),
        source: wgpu::ShaderSource::Wgsl(text.join("\n").into()),
    });
    let filled = |bytes: &[u8]| {
        let buffer = create_buffer(
            device,
            BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            bytes.len() as u64,
        );
        renderer.queue.write_buffer(&buffer, 0, bytes);
        buffer
    };
    let lighting = filled(bytemuck::bytes_of(&Lighting::new(scene, size)));
    let pass = |offset| {
        let mut pass = Pass::new(&renderer.camera, size, offset);
        pass.evaluations = evaluations;
        filled(bytemuck::bytes_of(&pass))
    };

    let compute = ShaderStages::COMPUTE;
    let shading_layout = group_layout(
        device,
        &[
            (compute, uniform_binding()),
            (compute, uniform_binding()),
            (compute, texture_binding()),
            (compute, texture_binding()),
            (compute, storage_texture_binding()),
        ],
    );
    let layers = Samples::Sixteen.count();
    let read = TextureUsages::TEXTURE_BINDING;
    let colors = create_layered(device, size, layers, COLOR, TextureUsages::STORAGE_BINDING | read);
    let main = [&renderer.resources.normal_depth, &renderer.resources.color_material].map(full_view);
    let places = Samples::ALL.map(|samples| {
        let place = |(layer, offset): (usize, &glam::Vec2)| {
            let pass = pass(*offset);
            let bindings = [
                pass.as_entire_binding(),
                lighting.as_entire_binding(),
                wgpu::BindingResource::TextureView(&main[0]),
                wgpu::BindingResource::TextureView(&main[1]),
                wgpu::BindingResource::TextureView(&layer_view(&colors, layer)),
            ];
            Place {
                geometry: create_bind_group(device, &renderer.pipelines.geometry_layout, &bindings[..1]),
                shading: create_bind_group(device, &shading_layout, &bindings),
            }
        };
        samples.offsets().iter().enumerate().map(place).collect()
    });

    let auxiliary_depth = create_layered(device, size, layers, DEPTH, TextureUsages::RENDER_ATTACHMENT);
    let auxiliary_normal = create_layered(device, size, layers, NORMAL, TextureUsages::RENDER_ATTACHMENT);
    let auxiliary = Drawn {
        label: "straightline auxiliary geometry",
        layouts: renderer.pipelines.drawing_layouts(),
        module: &module,
        entries: ["corner", "auxiliary"],
        targets: &[DEPTH, NORMAL],
        samples: 1,
        behind: false,
    };
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT;
    let targets = Targets {
        deferred: compute_pipeline(device, &shading_layout, &module, "deferred"),
        auxiliary: auxiliary.create_pipeline(device),
        auxiliary_views: (0..layers as usize)
            .map(|layer| {
                [
                    layer_view(&auxiliary_depth, layer),
                    layer_view(&auxiliary_normal, layer),
                ]
            })
            .collect(),
        auxiliary_depth,
        auxiliary_normal,
        multisampled: Multisampled::new(device, size, &renderer.pipelines),
        picture: create_layered(device, size, 1, COLOR, usage),
    };
    let means = Samples::ALL.map(|samples| create_mean(device, samples.count(), &colors, &targets.picture));
    let pass = pass(glam::Vec2::ZERO);
    let forward = create_forward(
        device,
        size,
        &module,
        &renderer.pipelines.texture_layout,
        &[pass.as_entire_binding(), lighting.as_entire_binding()],
    );
    FramePasses {
        places,
        means,
        targets,
        forward,
        renderer,
    }
}

fn create_forward(
    device: &wgpu::Device,
    size: UVec2,
    module: &wgpu::ShaderModule,
    texture_layout: &wgpu::BindGroupLayout,
    bindings: &[wgpu::BindingResource<'_>],
) -> Forward {
    let seen = ShaderStages::VERTEX_FRAGMENT;
    let layout = group_layout(device, &[(seen, uniform_binding()), (seen, uniform_binding())]);
    let surfaces = Drawn {
        label: "straightline forward",
        layouts: [&layout, texture_layout],
        module,
        entries: ["corner", "forward"],
        targets: &[COLOR],
        samples: multisampled::SAMPLES,
        behind: false,
    };
    let sky = Drawn {
        label: "straightline forward sky",
        entries: ["behind", "forward_sky"],
        behind: true,
        ..surfaces
    };
    Forward {
        surfaces: surfaces.create_pipeline(device),
        sky: sky.create_pipeline(device),
        group: create_bind_group(device, &layout, bindings),
        color: multisampled_target(device, size, COLOR, TextureUsages::empty()),
        tested: multisampled_target(device, size, DEPTH_FORMAT, TextureUsages::empty()),
    }
}

/// The mean of the first layers of `colors`: as straight as SRAA's own shaders are.
fn create_mean(device: &wgpu::Device, samples: u32, colors: &wgpu::Texture, picture: &wgpu::Texture) -> Mean {
    let reads: String = (0..samples)
        .map(|k| format!("    sum += textureLoad(colors, id.xy, {k}u, 0);\n"))
        .collect();
    let text = format!(
        "@group(0) @binding(0) var colors: texture_2d_array<f32>;\n\
         @group(0) @binding(1) var picture: texture_storage_2d<rgba16float, write>;\n\
         @compute @workgroup_size(8, 8)\n\
         fn mean(@builtin(global_invocation_id) id: vec3u) {{\n    \
             if any(id.xy >= textureDimensions(picture)) {{ return; }}\n    \
             var sum = vec4f(0.0);\n\
             {reads}    \
             textureStore(picture, id.xy, sum / {samples}.0);\n\
         }}\n"
    );
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("straightline mean"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let read = BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    let layout = group_layout(
        device,
        &[
            (ShaderStages::COMPUTE, read),
            (ShaderStages::COMPUTE, storage_texture_binding()),
        ],
    );
    let all = colors.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let bindings = [
        wgpu::BindingResource::TextureView(&all),
        wgpu::BindingResource::TextureView(&full_view(picture)),
    ];
    Mean {
        pipeline: compute_pipeline(device, &layout, &module, "mean"),
        group: create_bind_group(device, &layout, &bindings),
    }
}

fn compute_pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    module: &wgpu::ShaderModule,
    entry: &'static str,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("straightline frame"),
        layout: Some(&pipeline_layout(device, &[layout])),
        module,
        entry_point: Some(entry),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}

/// A texture of colours that is written.
fn storage_texture_binding() -> BindingType {
    BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format: COLOR,
        view_dimension: wgpu::TextureViewDimension::D2,
    }
}

/// A texture of several layers, which can be read back.
fn create_layered(
    device: &wgpu::Device,
    size: UVec2,
    layers: u32,
    format: TextureFormat,
    usage: TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("straightline frame"),
        size: wgpu::Extent3d {
            width: size.x,
            height: size.y,
            depth_or_array_layers: layers,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// Returns a view of one layer.
fn layer_view(texture: &wgpu::Texture, layer: usize) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer as u32,
        array_layer_count: Some(1),
        ..Default::default()
    })
}
