//! Drawing the scene: pipelines and passes of any targets.

use super::pipelines::pipeline_layout;
use super::resources::{DEPTH_FORMAT, Resources};
use crate::scene::Vertex;
use wgpu::{CompareFunction, TextureFormat, TextureView};

/// A pipeline that draws the scene's triangles, or the background.
pub(super) struct Drawn<'a> {
    pub label: &'static str,
    /// Layouts of a view, and of textures.
    pub layouts: [&'a wgpu::BindGroupLayout; 2],
    pub module: &'a wgpu::ShaderModule,
    /// Entry points of vertices and fragments.
    pub entries: [&'static str; 2],
    pub targets: &'a [TextureFormat],
    /// Samples of a pixel.
    pub samples: u32,
    /// `true` for the background, drawn without vertices where nothing else was drawn.
    pub behind: bool,
}

impl Drawn<'_> {
    pub fn create_pipeline(&self, device: &wgpu::Device) -> wgpu::RenderPipeline {
        let [vertex, fragment] = self.entries;
        let attributes = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Uint32, 4 => Float32x2, 5 => Uint32, 6 => Float32
        ];
        let corners = [Some(wgpu::VertexBufferLayout {
            array_stride: size_of::<Vertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        })];
        let targets: Vec<_> = self.targets.iter().map(|format| Some((*format).into())).collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&pipeline_layout(device, &self.layouts)),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: if self.behind { &[] } else { &corners },
            },
            // Both sides are drawn; counter-clockwise is the front.
            primitive: wgpu::PrimitiveState::default(),
            // The nearest surface, by the reciprocal of depth. Cleared to 0: the background.
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(!self.behind),
                depth_compare: Some(match self.behind {
                    true => CompareFunction::Equal,
                    false => CompareFunction::Greater,
                }),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: self.samples,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: self.module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// Target that a pass draws into.
pub(super) struct ColorTarget<'a> {
    view: &'a TextureView,
    clear: wgpu::Color,
    /// Texture for the mean of each pixel's samples, which then are not kept.
    resolved: Option<&'a TextureView>,
}

impl<'a> ColorTarget<'a> {
    /// Cleared to `clear`, and kept.
    pub fn cleared(view: &'a TextureView, clear: wgpu::Color) -> Self {
        ColorTarget {
            view,
            clear,
            resolved: None,
        }
    }

    /// Writes the mean of the target's samples to `mean`.
    pub fn resolved(self, mean: &'a TextureView) -> Self {
        ColorTarget {
            resolved: Some(mean),
            ..self
        }
    }

    fn attachment(&self) -> wgpu::RenderPassColorAttachment<'_> {
        wgpu::RenderPassColorAttachment {
            view: self.view,
            depth_slice: None,
            resolve_target: self.resolved,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(self.clear),
                store: match self.resolved {
                    Some(_) => wgpu::StoreOp::Discard,
                    None => wgpu::StoreOp::Store,
                },
            },
        }
    }
}

/// A pass that draws the whole scene.
pub(super) struct Drawing<'a> {
    pub label: &'static str,
    pub pipeline: &'a wgpu::RenderPipeline,
    pub group: &'a wgpu::BindGroup,
    pub targets: &'a [ColorTarget<'a>],
    /// For the depth test.
    pub tested: &'a TextureView,
    /// Pipeline of the background, with the same group.
    pub behind: Option<&'a wgpu::RenderPipeline>,
    pub timestamps: Option<wgpu::RenderPassTimestampWrites<'a>>,
}

impl Drawing<'_> {
    pub fn record(self, encoder: &mut wgpu::CommandEncoder, resources: &Resources) {
        let attachments: Vec<_> = self.targets.iter().map(|target| Some(target.attachment())).collect();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: self.tested,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: self.timestamps,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(self.pipeline);
        pass.set_bind_group(0, self.group, &[]);
        pass.set_bind_group(1, &resources.texture_group, &[]);
        pass.set_vertex_buffer(0, resources.vertices.slice(..));
        pass.set_index_buffer(resources.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..resources.index_count, 0, 0..1);
        if let Some(behind) = self.behind {
            pass.set_pipeline(behind);
            pass.draw(0..3, 0..1);
        }
    }
}

/// All of a texture.
pub(super) fn full_view(texture: &wgpu::Texture) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
