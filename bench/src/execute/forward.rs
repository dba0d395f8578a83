//! Drawing triangles with an emitted fragment shader: what its quads do at the edges of triangles, and forward passes.

use super::{Bench, ExecuteError, Inputs, Work};
use glam::{UVec2, Vec4};
use std::time::Duration;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, Stage};
use straightline_kernels::prelude::Frame;
use straightline_manifest::Manifest;
use straightline_runtime::{BoundDraw, Draw, DrawOptions, Timer};
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
    bound: BoundDraw,
    vertices: wgpu::Buffer,
    corners: u32,
    size: UVec2,
    target: wgpu::Texture,
    depth: wgpu::Texture,
}

impl Bench {
    /// Prepares to draw `corners`, three to a triangle, nearer ones before farther ones, with a kernel's fragment shader. What is
    /// not drawn stays 0.
    ///
    /// # Errors
    ///
    /// If the kernel cannot be emitted, an input is missing, or the device refuses something.
    pub fn prepare_forward(
        &self,
        compiled: &Compiled,
        inputs: &Inputs,
        corners: &[Corner],
    ) -> Result<Forward, ExecuteError> {
        let emitted = compiled.emit(&self.emit_options(Stage::Fragment))?;
        let text = emitted.files.get(&Target::Wgsl).map(|b| String::from_utf8_lossy(b));
        self.forward_by(&emitted.manifest, &text.unwrap_or_default(), inputs, corners)
    }

    /// [`prepare_forward`](Self::prepare_forward) with any fragment shader that `manifest` describes: to ask what another
    /// one would do.
    ///
    /// # Errors
    ///
    /// If an input is missing, or the device refuses something.
    pub fn forward_by(
        &self,
        manifest: &Manifest,
        wgsl: &str,
        inputs: &Inputs,
        corners: &[Corner],
    ) -> Result<Forward, ExecuteError> {
        let count = 1 + manifest.varyings.len();
        let attributes: Vec<wgpu::VertexAttribute> = (0..count as u32)
            .map(|k| wgpu::VertexAttribute {
                format: wgpu::VertexFormat::Float32x4,
                offset: u64::from(k) * 16,
                shader_location: k,
            })
            .collect();
        let buffers = [Some(wgpu::VertexBufferLayout {
            array_stride: count as u64 * 16,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        })];
        let passing_on = vertex_shader(manifest);
        let options =
            DrawOptions::new(&passing_on, "corner")
                .buffers(&buffers)
                .depth_stencil(wgpu::DepthStencilState {
                    format: TextureFormat::Depth32Float,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(wgpu::CompareFunction::LessEqual),
                    stencil: Default::default(),
                    bias: Default::default(),
                });
        let draw = Draw::new(&self.device, manifest, wgsl, &options)?;
        let bound = self.upload(manifest, inputs)?.bind_draw(&draw)?;
        let lanes = corners.iter().flat_map(|corner| {
            let varyings = (0..count - 1).map(|k| corner.varyings.get(k).copied().unwrap_or(Vec4::ZERO));
            std::iter::once(corner.position)
                .chain(varyings)
                .flat_map(|lanes| lanes.to_array())
        });
        let bytes: Vec<u8> = lanes.flat_map(f32::to_le_bytes).collect();
        let vertices = self.create_vertex_buffer(&bytes, wgpu::BufferUsages::VERTEX);
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
            bound,
            vertices,
            corners: corners.len() as u32,
            size: inputs.size,
            target: self.create_target(inputs.size, TextureFormat::Rgba32Float),
            depth,
        })
    }

    fn create_vertex_buffer(&self, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
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
    pub fn draw_forward(&self, forward: &Forward) -> Result<Frame<Vec4>, ExecuteError> {
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
        self.recorded_work(1, least, |encoder, timer| forward.encode(encoder, timer))
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
        self.bound.set(&mut pass);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..self.corners, 0..1);
        Ok(())
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
