//! Drawing triangles with an emitted fragment shader: what its quads do at the edges of triangles, and forward passes.

use super::{Bench, ExecuteError, Inputs, Work};
use glam::{UVec2, Vec4};
use std::time::Duration;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, Stage};
use straightline_kernels::prelude::Frame;
use straightline_manifest::{BindingKind, Dimension, Manifest, SampleType, SamplerType};
use straightline_runtime::Timer;
use wgpu::{CommandEncoder, TextureFormat};

/// A corner of a triangle: its position in clip space, and the shader's varyings in the order of their locations.
#[derive(Clone, Debug)]
pub struct Corner {
    /// x right, y up, z 0 to 1 after division by w.
    pub position: Vec4,
    /// As many components of each as the shader takes.
    pub varyings: Vec<Vec4>,
}

/// A shader that draws triangles, with what it reads.
#[derive(Debug)]
pub struct Forward {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    vertices: wgpu::Buffer,
    corners: u32,
    size: UVec2,
    target: wgpu::Texture,
    depth: wgpu::Texture,
}

impl Bench {
    /// Prepares to draw `corners`, three to a triangle, nearer ones before farther ones, with a kernel's fragment shader.
    /// `discard`, a condition in WGSL on `pixel`, has fragments discarded once their colour is computed; what is not
    /// drawn stays 0. `rewrite` may change the text: to ask what another shader would do.
    ///
    /// # Errors
    ///
    /// If the kernel cannot be emitted, an input is missing, or the device refuses something.
    pub fn forward(
        &self,
        compiled: &Compiled,
        inputs: &Inputs,
        corners: &[Corner],
        discard: Option<&str>,
        rewrite: impl Fn(String) -> String,
    ) -> Result<Forward, ExecuteError> {
        let emitted = compiled.emit(&self.options(Stage::Fragment))?;
        let text = emitted.files.get(&Target::Wgsl).map(|b| String::from_utf8_lossy(b));
        let mut text = rewrite(text.unwrap_or_default().into_owned());
        if let Some(condition) = discard {
            // After the last message, where a lane that goes takes nothing from the others.
            text = text.replacen("    return ", "    let colour = ", 1);
            let end = text.rfind('}').unwrap_or(text.len());
            text.insert_str(
                end,
                &format!("    if {condition} {{\n        discard;\n    }}\n    return colour;\n"),
            );
        }
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let forward = self.prepare(&emitted.manifest, &text, inputs, corners);
        match pollster::block_on(scope.pop()) {
            None => forward,
            Some(error) => Err(ExecuteError::Device {
                doing: "preparing a forward pass",
                message: error.to_string(),
            }),
        }
    }

    fn prepare(
        &self,
        manifest: &Manifest,
        text: &str,
        inputs: &Inputs,
        corners: &[Corner],
    ) -> Result<Forward, ExecuteError> {
        let (layout, group) = self.group(manifest, inputs)?;
        let vertex = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("vertices"),
            source: wgpu::ShaderSource::Wgsl(vertex_shader(manifest).into()),
        });
        let fragment = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&manifest.kernel),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let count = 1 + manifest.varyings.len();
        let attributes: Vec<wgpu::VertexAttribute> = (0..count as u32)
            .map(|k| wgpu::VertexAttribute {
                format: wgpu::VertexFormat::Float32x4,
                offset: u64::from(k) * 16,
                shader_location: k,
            })
            .collect();
        let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&manifest.kernel),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &vertex,
                entry_point: Some("corner"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: count as u64 * 16,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &attributes,
                })],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: TextureFormat::Depth32Float,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::LessEqual),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &fragment,
                entry_point: Some(&manifest.entry_point),
                compilation_options: Default::default(),
                targets: &[Some(TextureFormat::Rgba32Float.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let lanes = corners.iter().flat_map(|corner| {
            let varyings = (0..count - 1).map(|k| corner.varyings.get(k).copied().unwrap_or(Vec4::ZERO));
            std::iter::once(corner.position)
                .chain(varyings)
                .flat_map(|lanes| lanes.to_array())
        });
        let bytes: Vec<u8> = lanes.flat_map(f32::to_le_bytes).collect();
        let vertices = self.filled(&bytes, wgpu::BufferUsages::VERTEX);
        let depth = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: inputs.size.x,
                height: inputs.size.y,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::Depth32Float,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        Ok(Forward {
            pipeline,
            group,
            vertices,
            corners: corners.len() as u32,
            size: inputs.size,
            target: self.target(inputs.size, TextureFormat::Rgba32Float),
            depth,
        })
    }

    fn group(
        &self,
        manifest: &Manifest,
        inputs: &Inputs,
    ) -> Result<(wgpu::BindGroupLayout, wgpu::BindGroup), ExecuteError> {
        let missing = |name: &str| ExecuteError::Input(format!("nothing is given for `{name}`"));
        let (mut entries, mut owned) = (Vec::new(), Vec::new());
        for binding in &manifest.bindings {
            let name = binding.name.as_str();
            let (ty, resource) = match &binding.kind {
                BindingKind::Texture {
                    dimension,
                    sample_type,
                    components,
                    ..
                } => {
                    let layers = Inputs::find(&inputs.images, name).ok_or_else(|| missing(name))?;
                    let smaller = Inputs::find(&inputs.smaller, name).map_or(&[][..], Vec::as_slice);
                    let view = self.levels(layers, smaller, *dimension, *sample_type, *components)?;
                    (texture_type(*dimension, *sample_type), Owned::Texture(view))
                }
                BindingKind::Sampler { sampler } => {
                    let state = Inputs::find(&inputs.samplers, name).copied().unwrap_or_default();
                    let compares = *sampler == SamplerType::Comparison;
                    let ty = match compares {
                        true => wgpu::SamplerBindingType::Comparison,
                        false => wgpu::SamplerBindingType::Filtering,
                    };
                    (
                        wgpu::BindingType::Sampler(ty),
                        Owned::Sampler(self.sampler(state, compares)),
                    )
                }
                BindingKind::Buffer {
                    element,
                    stride,
                    fields,
                    ..
                } => {
                    let elements = Inputs::find(&inputs.buffers, name).ok_or_else(|| missing(name))?;
                    let ty = wgpu::BufferBindingType::Storage { read_only: true };
                    let buffer = self.buffer(elements, element, fields, *stride);
                    (buffer_type(ty), Owned::Buffer(buffer))
                }
                BindingKind::Uniform { size, fields, .. } => {
                    let mut bytes = vec![0; *size as usize];
                    for field in fields {
                        let default = [field.default.unwrap_or(0.0)];
                        let lanes = Inputs::find(&inputs.uniforms, &field.name).map_or(&default[..], Vec::as_slice);
                        let element = std::array::from_fn(|k| *lanes.get(k).unwrap_or(&lanes[0]));
                        let field_bytes = super::convert::element_bytes(&[element], field.ty);
                        bytes[field.offset as usize..][..field_bytes.len()].copy_from_slice(&field_bytes);
                    }
                    let buffer = self.filled(&bytes, wgpu::BufferUsages::UNIFORM);
                    (buffer_type(wgpu::BufferBindingType::Uniform), Owned::Buffer(buffer))
                }
            };
            entries.push(wgpu::BindGroupLayoutEntry {
                binding: binding.binding,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty,
                count: None,
            });
            owned.push((binding.binding, resource));
        }
        let layout = self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        });
        let bound: Vec<wgpu::BindGroupEntry<'_>> = owned
            .iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: match resource {
                    Owned::Texture(view) => wgpu::BindingResource::TextureView(view),
                    Owned::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                    Owned::Buffer(buffer) => buffer.as_entire_binding(),
                },
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &bound,
        });
        Ok((layout, group))
    }

    fn filled(&self, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: (bytes.len() as u64).max(16),
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }

    /// Draws and reads the picture back.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn picture(&self, forward: &Forward) -> Result<Frame<Vec4>, ExecuteError> {
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        forward.encode(&mut encoder, None)?;
        self.queue.submit([encoder.finish()]);
        self.download(&forward.target)
    }

    /// The draw, to be timed with others, repeated as [`timed_for`](Self::timed_for) says.
    ///
    /// # Errors
    ///
    /// If the device cannot be asked for the time.
    pub fn draw_work<'a>(&self, forward: &'a Forward, least: Duration) -> Result<Work<'a>, ExecuteError> {
        self.recorded(1, least, |encoder, timer| forward.encode(encoder, timer))
    }
}

impl Forward {
    /// Width and height of the picture.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    fn encode(&self, encoder: &mut CommandEncoder, timer: Option<&mut Timer>) -> Result<(), ExecuteError> {
        let span = timer.map(Timer::span).transpose()?;
        let [view, depth] = [&self.target, &self.depth].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("straightline forward"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: span.as_ref().map(|span| span.render_writes()),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..self.corners, 0..1);
        Ok(())
    }
}

enum Owned {
    Texture(wgpu::TextureView),
    Sampler(wgpu::Sampler),
    Buffer(wgpu::Buffer),
}

fn texture_type(dimension: Dimension, sample_type: SampleType) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: match sample_type {
            SampleType::Depth => wgpu::TextureSampleType::Depth,
            SampleType::Filterable => wgpu::TextureSampleType::Float { filterable: true },
            SampleType::Unfilterable => wgpu::TextureSampleType::Float { filterable: false },
            SampleType::Sint => wgpu::TextureSampleType::Sint,
            SampleType::Uint => wgpu::TextureSampleType::Uint,
        },
        view_dimension: match dimension {
            Dimension::D2Array => wgpu::TextureViewDimension::D2Array,
            Dimension::D3 => wgpu::TextureViewDimension::D3,
            Dimension::Cube => wgpu::TextureViewDimension::Cube,
            Dimension::D2 | Dimension::D2Multisampled => wgpu::TextureViewDimension::D2,
        },
        multisampled: dimension == Dimension::D2Multisampled,
    }
}

fn buffer_type(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

/// Passes positions and varyings on.
fn vertex_shader(manifest: &Manifest) -> String {
    let (mut inputs, mut outputs, mut copies) = (String::new(), String::new(), String::new());
    for v in &manifest.varyings {
        let (name, ty, k) = (&v.name, &v.ty, v.location);
        let lanes = [".x", ".xy", ".xyz", ""][usize::from(ty.components()) - 1];
        inputs += &format!(", @location({}) {name}: vec4f", k + 1);
        outputs += &format!("    @location({k}) {name}: {ty},\n");
        copies += &format!("    out.{name} = {name}{lanes};\n");
    }
    format!(
        "struct Out {{\n    @builtin(position) position: vec4f,\n{outputs}}}\n\n@vertex\nfn corner(@location(0) position: \
         vec4f{inputs}) -> Out {{\n    var out: Out;\n    out.position = position;\n{copies}    return out;\n}}\n"
    )
}
