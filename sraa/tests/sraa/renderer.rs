//! A renderer of one scene, with and without SRAA.

use straightline_sraa::{COLOR, DEPTH, GeometryPass, Projection, Sraa, wgpu};
use wgpu::{TextureUsages, TextureView};

/// Corners of the scene's triangles.
const CORNERS: u32 = 3 * 60;

const BACKGROUND: wgpu::Color = wgpu::Color {
    r: 0.1,
    g: 0.2,
    b: 0.4,
    a: 1.0,
};

pub struct Renderer {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    shader: wgpu::ShaderModule,
}

/// Colours of a picture, row by row.
pub type Picture = Vec<[f32; 3]>;

impl Renderer {
    pub fn new() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .unwrap_or_else(|error| {
                panic!("these tests need a GPU adapter; without a GPU, install Debian's mesa-vulkan-drivers: {error}")
            });
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))
            .unwrap_or_else(|error| panic!("the adapter {:?} gives no device: {error}", adapter.get_info()));
        let shader = device.create_shader_module(wgpu::include_wgsl!("scene.wgsl"));
        Renderer { device, queue, shader }
    }

    /// The scene with SRAA.
    pub fn antialiased(&self, sraa: &Sraa, projection: &Projection) -> Picture {
        let mut encoder = self.encoder();
        let fragment = match sraa.geometry_targets().len() {
            0 => None,
            1 => Some("normals"),
            _ => Some("guided"),
        };
        for pass in sraa.geometry().chain([sraa.centre()]) {
            let pipeline = self.pipeline(fragment, &sraa.geometry_targets(), pass.sample_count, projection);
            self.draw(&mut pass.begin(&mut encoder), &pipeline, pass.matrix());
        }
        sraa.encode_placing(&mut encoder);
        match sraa.place() {
            None => self.shade(&mut encoder, sraa.color(), [0.0; 2], (projection, sraa.size())),
            Some(place) => self.shade_placed(&mut encoder, sraa, place, projection),
        }
        sraa.encode(&mut encoder);
        self.read(encoder, sraa.resolved())
    }

    /// The scene shaded once a pixel, at `offset` from its centre.
    pub fn shaded(&self, size: [u32; 2], offset: [f32; 2], projection: &Projection) -> Picture {
        let mut encoder = self.encoder();
        let target = self.layers(size, 1, TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC);
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        self.shade(&mut encoder, &view, offset, (projection, size));
        self.read(encoder, &view)
    }

    fn encoder(&self) -> wgpu::CommandEncoder {
        self.device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    fn layers(&self, [width, height]: [u32; 2], layers: u32, usage: TextureUsages) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: COLOR,
            usage,
            view_formats: &[],
        })
    }

    fn pipeline(
        &self,
        fragment: Option<&str>,
        targets: &[Option<wgpu::ColorTargetState>],
        samples: u32,
        projection: &Projection,
    ) -> wgpu::RenderPipeline {
        let depth_compare = match projection.is_reversed() {
            true => wgpu::CompareFunction::Greater,
            false => wgpu::CompareFunction::Less,
        };
        self.render_pipeline("corner", fragment, targets, samples, Some(depth_compare))
    }

    fn render_pipeline(
        &self,
        vertex: &str,
        fragment: Option<&str>,
        targets: &[Option<wgpu::ColorTargetState>],
        samples: u32,
        depth_compare: Option<wgpu::CompareFunction>,
    ) -> wgpu::RenderPipeline {
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &self.shader,
                entry_point: Some(vertex),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: depth_compare.map(|compare| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(compare),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: samples,
                ..Default::default()
            },
            fragment: fragment.map(|entry| wgpu::FragmentState {
                module: &self.shader,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, matrix: [[f32; 4]; 4]) {
        let camera = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bytes: Vec<u8> = matrix
            .as_flattened()
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        self.queue.write_buffer(&camera, 0, &bytes);
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: camera.as_entire_binding(),
            }],
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..CORNERS, 0..1);
    }

    /// Shades into a view, with a depth buffer of its own.
    fn shade(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: &TextureView,
        offset: [f32; 2],
        (projection, size): (&Projection, [u32; 2]),
    ) {
        let depth = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH,
            usage: TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let color = wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(BACKGROUND),
                store: wgpu::StoreOp::Store,
            },
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(color)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth.create_view(&wgpu::TextureViewDescriptor::default()),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(projection.clear_depth()),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        let pipeline = self.pipeline(Some("shaded"), &[Some(COLOR.into())], 1, projection);
        self.draw(&mut pass, &pipeline, projection.matrix_at(offset, size));
    }

    /// Shades each pixel where `place` says: here, by choosing among pictures of all places.
    fn shade_placed(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        sraa: &Sraa,
        place: &TextureView,
        projection: &Projection,
    ) {
        let offsets = sraa.options().samples.offsets();
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let pictures = self.layers(sraa.size(), offsets.len() as u32 + 1, usage);
        for (k, offset) in (0..).zip(offsets.iter().chain([&[0.0; 2]])) {
            let layer = pictures.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: k,
                array_layer_count: Some(1),
                ..Default::default()
            });
            self.shade(encoder, &layer, *offset, (projection, sraa.size()));
        }
        let pipeline = self.render_pipeline("cover", Some("chosen"), &[Some(COLOR.into())], 1, None);
        let entry = |binding, view| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        };
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                entry(1, &pictures.create_view(&wgpu::TextureViewDescriptor::default())),
                entry(2, place),
            ],
        });
        let color = wgpu::RenderPassColorAttachment {
            view: sraa.color(),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(color)],
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Submits, and reads a picture in halves.
    pub fn read(&self, mut encoder: wgpu::CommandEncoder, view: &TextureView) -> Picture {
        let texture = view.texture();
        let row = (8 * texture.width()).next_multiple_of(256);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * texture.height()),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        let into = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("it can be read"));
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device works");
        let bytes = buffer.get_mapped_range(..).expect("mapped");
        let half = |texel: &[u8], k: usize| half::f16::from_le_bytes([texel[2 * k], texel[2 * k + 1]]).to_f32();
        let rows = bytes.chunks_exact(row as usize);
        let texels = rows.flat_map(|row| row[..8 * texture.width() as usize].chunks_exact(8));
        texels.map(|texel| [0, 1, 2].map(|k| half(texel, k))).collect()
    }
}

/// Mean of pictures.
pub fn mean(pictures: &[Picture]) -> Picture {
    let count = pictures.len() as f32;
    let pixel = |at: usize| [0, 1, 2].map(|k| pictures.iter().map(|picture| picture[at][k]).sum::<f32>() / count);
    (0..pictures[0].len()).map(pixel).collect()
}

/// Mean square of the differences of two pictures.
pub fn error(a: &Picture, b: &Picture) -> f32 {
    let differences = a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a - b);
    differences.map(|d| d * d).sum::<f32>() / (3 * a.len()) as f32
}

/// Draws nothing into a pass: what is left is cleared.
pub fn clear(pass: GeometryPass<'_>, encoder: &mut wgpu::CommandEncoder) {
    drop(pass.begin(encoder));
}
