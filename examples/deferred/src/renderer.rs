//! A frame in five steps: geometry, once for each of its four samples and the centre; where each pixel is shaded; shading, once a
//! pixel; SRAA; and to the screen.

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

/// Where in a pixel geometry is sampled, from its centre in pixels, y down: the kernel's pattern `latin4`, and the centre.
const SAMPLES: [Vec2; 5] = [
    vec2(-0.125, -0.375),
    vec2(0.375, -0.125),
    vec2(-0.375, 0.125),
    vec2(0.125, 0.375),
    Vec2::ZERO,
];

/// Linear depth, so that the kernel needs to know nothing of the projection.
const DEPTH: TextureFormat = TextureFormat::R32Float;
const NORMAL: TextureFormat = TextureFormat::Rgba16Float;
const ALBEDO: TextureFormat = TextureFormat::Rgba8Unorm;
const PLACE: TextureFormat = TextureFormat::R32Uint;
const COLOR: TextureFormat = TextureFormat::Rgba16Float;
const Z_BUFFER: TextureFormat = TextureFormat::Depth32Float;

/// Linear depth where there is nothing.
const SKY: f64 = 1.0e6;

/// A difference between surfaces that none exceeds: as a threshold, it turns off what begins there.
const NEVER: f32 = 16.0;

/// Which of a frame's passes are SRAA's: placing and the filter.
const OF_SRAA: [usize; 2] = [SAMPLES.len(), SAMPLES.len() + 2];

/// Bytes of the uniforms of `scene.wgsl`.
const UNIFORMS: usize = 160;

/// Passes, and what lies between them.
pub struct Renderer {
    queue: wgpu::Queue,
    passes: Passes,
    kernels: Kernels,
    targets: Targets,
    /// What the frames cost.
    pub clock: Clock,
}

/// Where each pixel is shaded, and the filter.
struct Kernels {
    place: sraa_place::Pass,
    sraa: sraa::Pass,
}

/// Pipelines and what does not change with the size.
struct Passes {
    device: wgpu::Device,
    corners: wgpu::Buffer,
    count: u32,
    /// One for each sample.
    uniforms: Vec<wgpu::Buffer>,
    geometry: wgpu::RenderPipeline,
    shading: wgpu::RenderPipeline,
    present: wgpu::RenderPipeline,
}

/// What does change with the size.
struct Targets {
    size: Size,
    /// Depth, normal and albedo: a layer for each sample.
    geometry: [wgpu::Texture; 3],
    z_buffer: wgpu::TextureView,
    /// At which sample each pixel is shaded.
    place: wgpu::TextureView,
    /// Shaded once a pixel, and what of that does not follow the albedo.
    shaded: [wgpu::TextureView; 2],
    /// The same, antialiased.
    resolved: wgpu::TextureView,
    /// From geometry to `place`.
    placing: sraa_place::Bound,
    /// From these to `resolved`.
    sraa: sraa::Bound,
}

impl Renderer {
    /// A renderer of pictures of `size` into targets of `format`, which converts to sRGB.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, size: Size, format: TextureFormat) -> Result<Self, Failure> {
        let shader = device.create_shader_module(wgpu::include_wgsl!("scene.wgsl"));
        let corners = scene::corners();
        let numbers = corners.as_flattened().iter().flat_map(Vec3::to_array);
        let kernels = Kernels { place: sraa_place::Pass::new(device)?, sraa: sraa::Pass::new(device)? };
        let passes = Passes {
            corners: buffer(device, queue, wgpu::BufferUsages::VERTEX, &bytes(numbers)),
            count: corners.len() as u32,
            uniforms: SAMPLES
                .iter()
                .map(|_| buffer(device, queue, wgpu::BufferUsages::UNIFORM, &[0; UNIFORMS]))
                .collect(),
            geometry: pipeline(device, &shader, ["corner", "surface"], &[DEPTH, NORMAL, ALBEDO], true),
            shading: pipeline(device, &shader, ["cover", "shade"], &[COLOR, COLOR], false),
            present: pipeline(device, &shader, ["cover", "present"], &[format], false),
            device: device.clone(),
        };
        Ok(Renderer {
            queue: queue.clone(),
            passes,
            targets: Targets::new(device, size, &kernels)?,
            kernels,
            clock: Clock::new(device, queue)?,
        })
    }

    /// Records and submits the frame at `time` seconds, with the parts that are on. Where the target has another size than
    /// the last one, what lies between the passes is made anew, and SRAA bound to it.
    pub fn draw(&mut self, time: f32, parts: Parts, target: &wgpu::TextureView) -> Result<(), Failure> {
        let begun = Instant::now();
        let size = [target.texture().width(), target.texture().height()];
        if size != self.targets.size {
            self.targets = Targets::new(&self.passes.device, size, &self.kernels)?;
        }
        let distance = 5.4 + 1.0 * (0.4 * time).sin();
        let Renderer { queue, passes, targets, clock, .. } = self;
        for (sample, uniforms) in SAMPLES.iter().zip(&passes.uniforms) {
            queue.write_buffer(uniforms, 0, &view(size, time, distance, *sample));
        }
        // Without SRAA nobody borrows, and each pixel needs the colour of its centre.
        targets.placing.set_unseen(queue, if parts.sraa && parts.placing { 0.01 } else { NEVER })?;
        targets.sraa.set_search_threshold(queue, if parts.searching { 0.05 } else { NEVER })?;
        // All paint counts as white at least: of one colour.
        targets.sraa.set_albedo_floor(queue, if parts.demodulating { 0.04 } else { 1.0 })?;

        let mut encoder = passes.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for sample in 0..SAMPLES.len() {
            passes.draw_geometry(&mut encoder, targets, sample as u32, clock.span()?);
        }
        record(targets.placing.inner(), &mut encoder, clock)?;
        let [depth, normal, albedo] = targets.geometry.each_ref().map(all_layers);
        let surfaces = [&depth, &normal, &albedo, &targets.place];
        let uniforms = Some(&passes.uniforms[0]);
        let shaded = targets.shaded.each_ref();
        passes.cover(&mut encoder, &passes.shading, (uniforms, &surfaces), &shaded, clock.span()?);
        if parts.sraa {
            record(targets.sraa.inner(), &mut encoder, clock)?;
        }
        let shown = if parts.sraa { &targets.resolved } else { shaded[0] };
        passes.cover(&mut encoder, &passes.present, (None, &[shown]), &[target], clock.span()?);
        clock.resolve(&mut encoder, if parts.sraa { &OF_SRAA } else { &[] })?;
        queue.submit([encoder.finish()]);
        clock.add(begun.elapsed())?;
        Ok(())
    }
}

/// Records a kernel, timed if frames are.
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
                // All of the sky's colour is borrowed.
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

    /// Draws one triangle over all of `targets`.
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

    /// Uniforms at binding 0, textures from 1 on.
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

/// The uniforms of `scene.wgsl` for one sample of a picture of `size`.
fn view(size: Size, time: f32, distance: f32, sample: Vec2) -> Vec<u8> {
    let size = Vec2::from(size.map(|side| side as f32));
    let to_world = Mat4::from_rotation_y(0.5 * time);
    let eye = vec3(0.0, 0.45, 1.0).normalize() * distance;
    let to_view = look_at_mat4(eye, vec3(0.0, -0.4, 0.0), Vec3::Y);
    // To sample right of the centre, everything moves left.
    let shift = Mat4::from_translation((vec2(-sample.x, sample.y) * 2.0 / size).extend(0.0));
    let fov: f32 = 0.75;
    let to_clip = shift * perspective_infinite_reverse(fov, size.x / size.y, 0.1) * to_view * to_world;
    let half = (0.5 * fov).tan() * vec2(size.x / size.y, 1.0);
    // Rays of the shading pass: the camera's axes in the world, as far as its picture reaches.
    let axes = to_view.transpose();
    let matrices = [to_clip, to_world].into_iter().flat_map(|m| m.to_cols_array());
    let camera = [axes.x_axis * half.x, axes.y_axis * half.y].into_iter().flat_map(|axis| axis.truncate().extend(0.0).to_array());
    bytes(matrices.chain(camera))
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
        let samples = SAMPLES.len() as u32;
        let geometry = [DEPTH, NORMAL, ALBEDO].map(|format| texture(format, samples, drawn));
        let one = |format, usage| layer(&texture(format, 1, usage), 0);
        let (place, resolved) = (one(PLACE, stored), one(COLOR, stored));
        let shaded = [one(COLOR, drawn), one(COLOR, drawn)];
        let [depth, normal, albedo] = &geometry.each_ref().map(all_layers);
        let seen = sraa_place::Inputs { depth, normal };
        let inputs = sraa::Inputs { depth, normal, albedo, place: &place, color: &shaded[0], rest: &shaded[1] };
        Ok(Targets {
            size,
            placing: kernels.place.bind(&seen, &sraa_place::Parameters::default(), &place)?,
            sraa: kernels.sraa.bind(&inputs, &sraa::Parameters::default(), &resolved)?,
            geometry,
            z_buffer: one(Z_BUFFER, TextureUsages::RENDER_ATTACHMENT),
            place,
            shaded,
            resolved,
        })
    }
}

/// One layer, as a plain texture.
fn layer(texture: &wgpu::Texture, at: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2),
        base_array_layer: at,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

/// All layers, as the kernel reads them.
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

/// A pipeline of two functions of the shader, with the layout that they ask for.
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
            // The reciprocal of depth: 1 is near.
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
