//! Values and textures in the form that a shader asks for.

use glam::UVec2;
use straightline_manifest::{Scalar, UniformField, ValueType};
use straightline_runtime::UniformValue;
use wgpu::{TextureFormat, TextureUsages};

/// Makes textures that no copy can fill: depths, and several samples a texel.
pub struct Converters<'a> {
    device: &'a wgpu::Device,
    queue: &'a wgpu::Queue,
}

const SHADER: &str = "
@group(0) @binding(0) var flat_image: texture_2d<f32>;
@group(0) @binding(0) var layers: texture_2d_array<f32>;

@vertex
fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, k == 1u), select(-1.0, 3.0, k == 2u), 0.0, 1.0);
}

@fragment
fn depth(@builtin(position) at: vec4f) -> @builtin(frag_depth) f32 {
    return textureLoad(flat_image, vec2i(at.xy), 0).x;
}

@fragment
fn samples(@builtin(position) at: vec4f, @builtin(sample_index) k: u32) -> @location(0) vec4f {
    return textureLoad(layers, vec2i(at.xy), k, 0);
}
";

impl<'a> Converters<'a> {
    pub fn new(device: &'a wgpu::Device, queue: &'a wgpu::Queue) -> Self {
        Converters { device, queue }
    }

    /// The first components of images as the layers of a texture of depths.
    pub fn create_depths(&self, sources: &[wgpu::TextureView], size: UVec2) -> wgpu::Texture {
        self.draw_layers(sources, size, 1, TextureFormat::Depth32Float, "depth")
    }

    /// Layers as the samples of an image: single numbers in full precision, more in half, which every device can
    /// multisample.
    pub fn create_multisampled(
        &self,
        source: &wgpu::TextureView,
        size: UVec2,
        samples: u32,
        components: u8,
    ) -> wgpu::TextureView {
        let format = match components {
            1 => TextureFormat::R32Float,
            _ => TextureFormat::Rgba16Float,
        };
        let sources = std::slice::from_ref(source);
        let target = self.draw_layers(sources, size, samples, format, "samples");
        target.create_view(&wgpu::TextureViewDescriptor::default())
    }

    fn draw_layers(
        &self,
        sources: &[wgpu::TextureView],
        size: UVec2,
        samples: u32,
        format: TextureFormat,
        entry: &str,
    ) -> wgpu::Texture {
        let target = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size.x,
                height: size.y,
                depth_or_array_layers: sources.len() as u32,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let is_depth = format.is_depth_stencil_format();
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let targets = [Some(wgpu::ColorTargetState {
            format,
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
        })];
        let pipeline = self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: is_depth.then(|| wgpu::DepthStencilState {
                format,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets: if is_depth { &[] } else { &targets },
            }),
            multiview_mask: None,
            cache: None,
        });
        for (layer, source) in (0..).zip(sources) {
            self.draw_layer(&pipeline, source, &target, layer);
        }
        target
    }

    fn draw_layer(
        &self,
        pipeline: &wgpu::RenderPipeline,
        source: &wgpu::TextureView,
        target: &wgpu::Texture,
        layer: u32,
    ) {
        let is_depth = target.format().is_depth_stencil_format();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(source),
            }],
        });
        let view = target.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        let colour = wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        };
        let colours = [Some(colour)];
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: if is_depth { &[] } else { &colours },
            depth_stencil_attachment: is_depth.then_some(wgpu::RenderPassDepthStencilAttachment {
                view: &view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        self.queue.submit([encoder.finish()]);
    }
}

/// A uniform of numbers; a single number is for every component.
pub fn uniform_value(ty: ValueType, numbers: &[f64]) -> UniformValue {
    let number = |k: usize| numbers.get(k).or(numbers.first()).copied().unwrap_or(0.0);
    let words: Vec<_> = (0..ty.size() as usize / 4)
        .map(|k| scalar_bytes(ty.scalar(), number(k)))
        .collect();
    UniformValue::from_words(ty, &words).expect("as many words as the type has")
}

/// The bits of a number, as a shader has it.
pub fn scalar_bytes(scalar: Scalar, number: f64) -> [u8; 4] {
    match scalar {
        Scalar::F32 => (number as f32).to_le_bytes(),
        Scalar::I32 => (number as i32).to_le_bytes(),
        Scalar::U32 => (number as u32).to_le_bytes(),
    }
}

/// Structures as they lie in a buffer: their numbers and vectors are one after the other, those of an array too.
pub fn structure_bytes(values: &[[f64; 4]], fields: &[UniformField], stride: u32) -> Vec<u8> {
    let each: u32 = fields.iter().map(|field| field.ty.parts()).sum();
    let mut bytes = Vec::new();
    for element in values.chunks_exact(each as usize) {
        let (start, mut rest) = (bytes.len(), element);
        bytes.resize(start + stride as usize, 0);
        for field in fields {
            let count = field.ty.parts();
            let (own, others) = rest.split_at(count as usize);
            rest = others;
            let room = field.size / count;
            for (k, value) in (0..).zip(own) {
                let at = start + (field.offset + k * room) as usize;
                let part = element_bytes(std::slice::from_ref(value), field.ty.part());
                bytes[at..at + part.len()].copy_from_slice(&part);
            }
        }
    }
    bytes
}

/// Elements of a buffer, numbers or vectors, as they lie in it.
pub fn element_bytes(elements: &[[f64; 4]], ty: ValueType) -> Vec<u8> {
    let numbers = elements.iter().flat_map(|e| &e[..ty.components().into()]);
    numbers.flat_map(|number| scalar_bytes(ty.scalar(), *number)).collect()
}

/// The elements, numbers or vectors, that lie in the bytes of a buffer, each in as many lanes as it has.
pub fn decode_elements(bytes: &[u8], ty: ValueType) -> Vec<[f64; 4]> {
    let number = |word: &[u8]| {
        let word = [word[0], word[1], word[2], word[3]];
        match ty.scalar() {
            Scalar::F32 => f64::from(f32::from_le_bytes(word)),
            Scalar::I32 => f64::from(i32::from_le_bytes(word)),
            Scalar::U32 => f64::from(u32::from_le_bytes(word)),
        }
    };
    let element = |bytes: &[u8]| {
        let mut lanes = bytes.chunks_exact(4).map(number);
        std::array::from_fn(|_| lanes.next().unwrap_or(0.0))
    };
    bytes
        .chunks_exact(4 * usize::from(ty.components()))
        .map(element)
        .collect()
}
