//! A frame in seven steps: geometry, once for each of its four samples and for the shading position; placing of the shading;
//! shading, once a pixel; motion since earlier frames; SRAA; inputs for later frames; and presenting.

use crate::clock::Clock;
use crate::options::Parts;
use crate::shaders::{sraa, sraa_place};
use crate::{Failure, Size, scene};
use glam::camera::rh::proj::directx::perspective_infinite_reverse;
use glam::camera::rh::view::look_at_mat4;
use glam::{Mat4, Vec2, Vec3, vec2, vec3};
use straightline_runtime::{Bound, Span, wgpu};
use web_time::Instant;
use wgpu::{TextureFormat, TextureUsages, TextureViewDimension};

/// Positions of the geometry samples, from the pixel's centre in pixels, y down: the kernel's pattern `latin4`.
const SAMPLES: [Vec2; 4] = [
    vec2(-0.125, -0.375),
    vec2(0.375, -0.125),
    vec2(-0.375, 0.125),
    vec2(0.125, 0.375),
];

/// Layers of the G-buffer: one for each geometry sample, and one for the shading position.
const LAYERS: usize = SAMPLES.len() + 1;

/// Shading sample of each frame, in turn: together with `EARLIER` others, all are covered. Without history, frames
/// are shaded at the centre.
const TURNS: [usize; 4] = [0, 3, 2, 1];

/// Number of earlier frames that are kept: the kernel's `history`.
pub const EARLIER: usize = 3;

/// Linear depth, so that the kernel does not depend on the projection.
const DEPTH: TextureFormat = TextureFormat::R32Float;
const NORMAL: TextureFormat = TextureFormat::Rgba16Float;
const ALBEDO: TextureFormat = TextureFormat::Rgba8Unorm;
const PLACE: TextureFormat = TextureFormat::R32Uint;
const COLOR: TextureFormat = TextureFormat::Rgba16Float;
/// A normal and linear depth.
const SURFACE: TextureFormat = TextureFormat::Rgba32Float;
const MOTION: TextureFormat = TextureFormat::Rgba16Float;
const Z_BUFFER: TextureFormat = TextureFormat::Depth32Float;

/// Linear depth of the background.
const SKY: f64 = 1.0e6;

/// A difference between surfaces that is never exceeded. As a threshold, it turns a part off.
const NEVER: f32 = 16.0;

/// Indices of the frame's SRAA passes: placing and the filter.
const OF_SRAA: [usize; 2] = [LAYERS, LAYERS + 3];

/// Size of the uniforms of `scene.wgsl`, in bytes.
const UNIFORMS: usize = 192 + EARLIER * 80;

/// Passes, and the textures between them.
pub struct Renderer {
    queue: wgpu::Queue,
    passes: Passes,
    kernels: Kernels,
    targets: Targets,
    past: Past,
    /// Frame times.
    pub clock: Clock,
}

/// Placing of the shading, and the filter.
struct Kernels {
    place: sraa_place::Pass,
    sraa: sraa::Pass,
}

/// Pipelines, and everything else that does not depend on the size.
struct Passes {
    device: wgpu::Device,
    corners: wgpu::Buffer,
    count: u32,
    /// Uniforms of each layer.
    uniforms: Vec<wgpu::Buffer>,
    geometry: wgpu::RenderPipeline,
    shading: wgpu::RenderPipeline,
    motion: wgpu::RenderPipeline,
    keeping: wgpu::RenderPipeline,
    present: wgpu::RenderPipeline,
}

/// Textures and bindings that depend on the size.
struct Targets {
    size: Size,
    /// Depth, normal and albedo: a layer for each geometry sample, and one for the shading position.
    geometry: [wgpu::Texture; 3],
    z_buffer: wgpu::TextureView,
    /// Shading sample of each pixel.
    place: wgpu::TextureView,
    /// Shaded colour, one a pixel, and the part of it that does not depend on the albedo.
    shaded: [wgpu::TextureView; 2],
    /// Light, the part that does not depend on the albedo, and surfaces: a layer for each earlier frame.
    kept: [wgpu::Texture; 3],
    /// Motion of each pixel's surface since each of the earlier frames.
    motion: wgpu::Texture,
    /// Antialiased colour.
    resolved: wgpu::TextureView,
    /// Pass from geometry to `place`.
    placing: sraa_place::Bound,
    /// Pass from all of these to `resolved`.
    sraa: sraa::Bound,
}

/// State of earlier frames.
#[derive(Default)]
struct Past {
    /// Number of earlier frames.
    frames: usize,
    /// Parts that were enabled.
    parts: Option<Parts>,
    /// Kept frames, layer by layer: their transform from model space to clip space, and their shading position.
    layers: [Option<(Mat4, Vec2)>; EARLIER],
}

impl Renderer {
    /// Creates a renderer for pictures of `size` into targets of `format`, which converts to sRGB.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, size: Size, format: TextureFormat) -> Result<Self, Failure> {
        let shader = device.create_shader_module(wgpu::include_wgsl!("scene.wgsl"));
        let corners = scene::corners();
        let numbers = corners.as_flattened().iter().flat_map(Vec3::to_array);
        let kernels = Kernels { place: sraa_place::Pass::new(device)?, sraa: sraa::Pass::new(device)? };
        let passes = Passes {
            corners: buffer(device, queue, wgpu::BufferUsages::VERTEX, &bytes(numbers)),
            count: corners.len() as u32,
            uniforms: (0..LAYERS)
                .map(|_| buffer(device, queue, wgpu::BufferUsages::UNIFORM, &[0; UNIFORMS]))
                .collect(),
            geometry: pipeline(device, &shader, ["corner", "surface"], &[DEPTH, NORMAL, ALBEDO], true),
            shading: pipeline(device, &shader, ["cover", "shade"], &[COLOR, COLOR], false),
            motion: pipeline(device, &shader, ["cover", "motion"], &[MOTION; EARLIER], false),
            keeping: pipeline(device, &shader, ["cover", "keep"], &[COLOR, COLOR, SURFACE], false),
            present: pipeline(device, &shader, ["cover", "present"], &[format], false),
            device: device.clone(),
        };
        Ok(Renderer {
            queue: queue.clone(),
            passes,
            targets: Targets::new(device, size, &kernels)?,
            kernels,
            past: Past::default(),
            clock: Clock::new(device, queue)?,
        })
    }

    /// Records and submits the frame at `time` seconds with the enabled parts. If the target's size differs from
    /// the last one, the textures between the passes are recreated and SRAA is bound to them. This, and toggling a part, discards
    /// earlier frames.
    pub fn draw(&mut self, time: f32, parts: Parts, target: &wgpu::TextureView) -> Result<(), Failure> {
        let begun = Instant::now();
        let size = [target.texture().width(), target.texture().height()];
        if size != self.targets.size || self.past.parts != Some(parts) {
            self.past = Past { parts: Some(parts), ..Past::default() };
        }
        if size != self.targets.size {
            self.targets = Targets::new(&self.passes.device, size, &self.kernels)?;
        }
        let Renderer { queue, passes, targets, past, clock, .. } = self;
        let remembers = parts.sraa && parts.history;
        let jitter = if remembers { SAMPLES[TURNS[past.frames % TURNS.len()]] } else { Vec2::ZERO };
        // A floor of 1 makes every albedo count as white.
        let albedo_floor = if parts.demodulating { 0.04 } else { 1.0 };
        let view = View::new(size, time);
        for (sample, uniforms) in SAMPLES.iter().chain([&jitter]).zip(&passes.uniforms) {
            queue.write_buffer(uniforms, 0, &view.uniforms(*sample, jitter, albedo_floor, &past.layers));
        }
        // Without SRAA no pixel borrows, so each needs the colour of its centre.
        targets.placing.set_unseen(queue, if parts.sraa && parts.placing { 0.01 } else { NEVER });
        targets.sraa.set_search_threshold(queue, if parts.searching { 0.05 } else { NEVER });
        targets.sraa.set_albedo_floor(queue, albedo_floor);
        targets.sraa.set_jitter(queue, jitter);

        let mut encoder = passes.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for layer in 0..LAYERS {
            passes.draw_geometry(&mut encoder, targets, layer as u32, clock.span()?);
        }
        record(targets.placing.inner(), &mut encoder, clock)?;
        let [depth, normal, albedo] = targets.geometry.each_ref().map(all_layers);
        let surfaces = [&depth, &normal, &albedo, &targets.place];
        let uniforms = Some(&passes.uniforms[0]);
        let shaded = targets.shaded.each_ref();
        passes.cover(&mut encoder, &passes.shading, (uniforms, &surfaces), &shaded, clock.span()?);
        if parts.sraa {
            let motions: [_; EARLIER] = std::array::from_fn(|k| layer(&targets.motion, k as u32));
            let seen = [&depth, &targets.place];
            passes.cover(&mut encoder, &passes.motion, (uniforms, &seen), &motions.each_ref(), clock.span()?);
            record(targets.sraa.inner(), &mut encoder, clock)?;
        }
        if remembers {
            let slot = past.frames % EARLIER;
            let kept = targets.kept.each_ref().map(|texture| layer(texture, slot as u32));
            let seen = [&surfaces[..], &shaded[..]].concat();
            passes.cover(&mut encoder, &passes.keeping, (uniforms, &seen), &kept.each_ref(), clock.span()?);
            past.layers[slot] = Some((view.to_clip(jitter), jitter));
            past.frames += 1;
        }
        let shown = if parts.sraa { &targets.resolved } else { shaded[0] };
        passes.cover(&mut encoder, &passes.present, (None, &[shown]), &[target], clock.span()?);
        clock.resolve(&mut encoder, if parts.sraa { &OF_SRAA } else { &[] })?;
        queue.submit([encoder.finish()]);
        clock.add(begun.elapsed())?;
        Ok(())
    }
}

/// Records a kernel, timed if the frame is.
fn record(kernel: &Bound, encoder: &mut wgpu::CommandEncoder, clock: &mut Clock) -> Result<(), Failure> {
    match clock.timer() {
        Some(timer) => kernel.encode_timed(encoder, timer)?,
        None => kernel.encode(encoder),
    }
    Ok(())
}

impl Passes {
    /// Draws the scene into one layer of the G-buffer.
    fn draw_geometry(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        sample: u32,
        span: Option<Span<'_>>,
    ) {
        let [depth, normal, albedo] = targets.geometry.each_ref().map(|texture| layer(texture, sample));
        let cleared = |view, [r, g, b]: [f64; 3]| attachment(view, wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 0.0 }));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("geometry"),
            color_attachments: &[
                cleared(&depth, [SKY, 0.0, 0.0]),
                // Any unit vector, the same everywhere.
                cleared(&normal, [0.0, 0.0, 1.0]),
                // Albedo 1: the sky's full colour can be borrowed.
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
        pass.set_bind_group(0, &self.bind(&self.geometry, Some(&self.uniforms[sample as usize]), &[]), &[]);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.draw(0..self.count, 0..1);
    }

    /// Draws one triangle that covers all of `targets`.
    fn cover(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        (uniforms, inputs): (Option<&wgpu::Buffer>, &[&wgpu::TextureView]),
        targets: &[&wgpu::TextureView],
        span: Option<Span<'_>>,
    ) {
        let attachments = targets.iter().map(|target| attachment(target, wgpu::LoadOp::Clear(wgpu::Color::BLACK)));
        let attachments: Vec<_> = attachments.collect();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("cover"),
            color_attachments: &attachments,
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

/// Camera and scene at one time.
struct View {
    size: Vec2,
    eye: Vec3,
    to_world: Mat4,
    to_view: Mat4,
}

/// Vertical field of view, in radians.
const FOV: f32 = 0.75;

impl View {
    /// Creates the view for a picture of `size` at `time` seconds.
    fn new(size: Size, time: f32) -> View {
        let distance = 5.4 + 1.0 * (0.4 * time).sin();
        let eye = vec3(0.0, 0.45, 1.0).normalize() * distance;
        View {
            size: Vec2::from(size.map(|side| side as f32)),
            eye,
            to_world: Mat4::from_rotation_y(0.5 * time),
            to_view: look_at_mat4(eye, vec3(0.0, -0.4, 0.0), Vec3::Y),
        }
    }

    /// Transform from model space to clip space for one sample of each pixel.
    fn to_clip(&self, sample: Vec2) -> Mat4 {
        // To sample right of the centre, move everything left.
        let shift = Mat4::from_translation((vec2(-sample.x, sample.y) * 2.0 / self.size).extend(0.0));
        shift * perspective_infinite_reverse(FOV, self.size.x / self.size.y, 0.1) * self.to_view * self.to_world
    }

    /// Uniforms of `scene.wgsl` for one sample, in a frame that is shaded at `jitter`.
    fn uniforms(&self, sample: Vec2, jitter: Vec2, albedo_floor: f32, earlier: &[Option<(Mat4, Vec2)>]) -> Vec<u8> {
        let half = (0.5 * FOV).tan() * vec2(self.size.x / self.size.y, 1.0);
        // Rays of the shading pass: the camera's axes in world space, scaled to the extent of the picture.
        let axes = self.to_view.transpose();
        let matrices = [self.to_clip(sample), self.to_world].into_iter().flat_map(|m| m.to_cols_array());
        let camera = [axes.x_axis * half.x, axes.y_axis * half.y, self.eye.extend(0.0)];
        let camera = camera.into_iter().flat_map(|axis| axis.truncate().extend(0.0).to_array());
        let then = earlier.iter().flat_map(|frame| {
            let (to_clip, jitter) = frame.unwrap_or_default();
            let known = if frame.is_some() { 1.0 } else { 0.0 };
            to_clip.to_cols_array().into_iter().chain([jitter.x, jitter.y, known, 0.0])
        });
        bytes(matrices.chain(camera).chain([jitter.x, jitter.y, albedo_floor, 0.0]).chain(then))
    }
}

impl Targets {
    fn new(device: &wgpu::Device, size: Size, kernels: &Kernels) -> Result<Self, Failure> {
        let texture = |format, layers, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let drawn = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let stored = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
        let geometry = [DEPTH, NORMAL, ALBEDO].map(|format| texture(format, LAYERS as u32, drawn));
        let earlier = |format| texture(format, EARLIER as u32, drawn);
        let (kept, motion) = ([COLOR, COLOR, SURFACE].map(earlier), earlier(MOTION));
        let one = |format, usage| layer(&texture(format, 1, usage), 0);
        let (place, resolved) = (one(PLACE, stored), one(COLOR, stored));
        let shaded = [one(COLOR, drawn), one(COLOR, drawn)];
        let [depth, normal, albedo] = &geometry.each_ref().map(all_layers);
        let seen = sraa_place::Inputs { depth, normal };
        let [history_color, history_rest, history_surface] = &kept.each_ref().map(all_layers);
        let inputs = sraa::Inputs {
            depth,
            normal,
            albedo,
            place: &place,
            color: &shaded[0],
            rest: &shaded[1],
            history_color,
            history_rest,
            history_surface,
            history_motion: &all_layers(&motion),
        };
        Ok(Targets {
            size,
            placing: kernels.place.bind(&seen, &sraa_place::Parameters::default(), &place)?,
            sraa: kernels.sraa.bind(&inputs, &sraa::Parameters::new(0.05, 0.04, [0.0; 2]), &resolved)?,
            geometry,
            z_buffer: one(Z_BUFFER, TextureUsages::RENDER_ATTACHMENT),
            place,
            shaded,
            kept,
            motion,
            resolved,
        })
    }
}

/// Returns one layer as a plain texture.
fn layer(texture: &wgpu::Texture, at: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2),
        base_array_layer: at,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

/// Returns all layers, as read by the kernel.
fn all_layers(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor { dimension: Some(TextureViewDimension::D2Array), ..Default::default() })
}

fn attachment(view: &wgpu::TextureView, load: wgpu::LoadOp<wgpu::Color>) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    })
}

/// Creates a pipeline of two functions of the shader, with the layout that they require.
fn pipeline(
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

fn bytes(numbers: impl Iterator<Item = f32>) -> Vec<u8> {
    numbers.flat_map(f32::to_le_bytes).collect()
}
