//! A device, fixtures and pictures for the tests.
#![allow(dead_code, reason = "each test file uses its part")]

pub mod chains;
mod kernels;

use straightline_runtime::wgpu;
use wgpu::TextureFormat;

/// The default adapter with a device that has `features` and `limits`.
pub struct Gpu {
    adapter: wgpu::Adapter,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    pub fn new() -> Self {
        Self::with(wgpu::Features::empty(), wgpu::Limits::default())
    }

    pub fn with(required_features: wgpu::Features, required_limits: wgpu::Limits) -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .unwrap_or_else(|error| {
                panic!("these tests need a GPU adapter; without a GPU, install Debian's mesa-vulkan-drivers: {error}")
            });
        Self::of(adapter, required_features, required_limits)
    }

    /// A device with `bytes` of immediates.
    pub fn with_immediates(bytes: u32) -> Self {
        let limits = wgpu::Limits {
            max_immediate_size: bytes,
            ..wgpu::Limits::default()
        };
        Self::with(wgpu::Features::IMMEDIATES, limits)
    }

    /// Another device of the same adapter. wgpu could not distinguish views of a device from another instance.
    pub fn sibling(&self) -> Self {
        Self::of(self.adapter.clone(), wgpu::Features::empty(), wgpu::Limits::default())
    }

    fn of(adapter: wgpu::Adapter, required_features: wgpu::Features, required_limits: wgpu::Limits) -> Self {
        let descriptor = wgpu::DeviceDescriptor {
            required_features,
            required_limits,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .unwrap_or_else(|error| panic!("the adapter {:?} gives no device: {error}", adapter.get_info()));
        Gpu { adapter, device, queue }
    }

    pub fn texture(
        &self,
        size: [u32; 2],
        layers: u32,
        format: TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// A texture of one layer with `sample_count` samples a texel.
    pub fn multisampled(&self, size: [u32; 2], sample_count: u32, format: TextureFormat) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        })
    }

    /// A storage buffer that holds `words`.
    pub fn storage(&self, words: &[f32]) -> wgpu::Buffer {
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let buffer = self.buffer(bytes.len() as u64, usage);
        self.queue.write_buffer(&buffer, 0, &bytes);
        buffer
    }

    pub fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// A linear sampler, of comparisons if there is something to `compare`.
    pub fn sampler(&self, compare: Option<wgpu::CompareFunction>) -> wgpu::Sampler {
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare,
            ..Default::default()
        })
    }

    /// An `rgba32float` texture that holds `pixels`, layer after layer.
    pub fn upload(&self, size: [u32; 2], layers: u32, pixels: &[[f32; 4]]) -> wgpu::Texture {
        assert_eq!(pixels.len(), (size[0] * size[1] * layers) as usize);
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = self.texture(size, layers, TextureFormat::Rgba32Float, usage);
        let bytes: Vec<u8> = pixels.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size[0] * 16),
            rows_per_image: Some(size[1]),
        };
        self.queue
            .write_texture(texture.as_image_copy(), &bytes, layout, texture.size());
        texture
    }

    /// A target of either stage that can be downloaded.
    pub fn target(&self, size: [u32; 2]) -> wgpu::Texture {
        let usage = wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::TEXTURE_BINDING;
        self.texture(size, 1, TextureFormat::Rgba32Float, usage)
    }

    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    pub fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.queue.submit([encoder.finish()]);
    }

    /// Bytes of level 0 and layer 0, row by row, without padding.
    pub fn download_bytes(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let texel = texture.format().block_copy_size(None).expect("a colour format");
        let row = texture.width() * texel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(padded * texture.height()),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded),
            rows_per_image: None,
        };
        let size = wgpu::Extent3d {
            width: texture.width(),
            height: texture.height(),
            depth_or_array_layers: 1,
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            size,
        );
        self.submit(encoder);
        buffer.map_async(wgpu::MapMode::Read, .., |result| result.expect("a buffer to read"));
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device to finish");
        let mapped = buffer.get_mapped_range(..).expect("a mapped buffer");
        mapped
            .chunks(padded as usize)
            .flat_map(|padded| padded[..row as usize].to_vec())
            .collect()
    }

    /// Pixels of an `rgba32float` texture.
    pub fn download(&self, texture: &wgpu::Texture) -> Vec<[f32; 4]> {
        assert_eq!(texture.format(), TextureFormat::Rgba32Float);
        let value = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().expect("four bytes"));
        let pixel = |bytes: &[u8]| [0, 4, 8, 12].map(|i| value(&bytes[i..i + 4]));
        self.download_bytes(texture).chunks_exact(16).map(pixel).collect()
    }
}

pub fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

pub fn array_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

pub fn clear_depth(encoder: &mut wgpu::CommandEncoder, view: &wgpu::TextureView, format: TextureFormat, depth: f32) {
    let store = wgpu::StoreOp::Store;
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(depth),
                store,
            }),
            stencil_ops: format.has_stencil_aspect().then_some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0),
                store,
            }),
        }),
        ..Default::default()
    });
}

/// A picture in which every component of every pixel is different.
pub fn ramp(size: [u32; 2], layers: u32) -> Vec<[f32; 4]> {
    (0..size[0] * size[1] * layers)
        .map(|i| [0, 1, 2, 3].map(|c| (4 * i + c) as f32 + 0.25))
        .collect()
}

#[allow(unused_imports, reason = "each test file uses its part")]
pub use kernels::*;
pub use straightline_runtime::manifest::Stage;
pub const STAGES: [Stage; 2] = [Stage::Compute, Stage::Fragment];

/// A small kernel as the generator would emit it: `declarations`, and an expression of `pixel` for the result.
pub struct Fixture {
    pub manifest: String,
    pub wgsl: String,
}

/// The parts of one emitted body.
pub struct Kernel<'k> {
    pub name: &'k str,
    /// JSON objects of the manifest's `bindings`.
    pub bindings: &'k [&'k str],
    /// WGSL declarations of the same.
    pub declarations: &'k str,
    /// WGSL expression of type `vec4f` that may use `pixel: vec2i`.
    pub result: &'k str,
}

impl Kernel<'_> {
    pub fn emit(&self, stage: Stage) -> Fixture {
        let Kernel {
            name,
            bindings,
            declarations,
            result,
        } = self;
        let (output, workgroup, wgsl) = match stage {
            Stage::Compute => (
                r#"{"name": "output", "group": 0, "binding": 15, "access": "write-only", "view_dimension": "2d", "format": "rgba32float"}"#,
                r#""workgroup_size": [8, 8, 1],"#,
                format!(
                    "{declarations}
                    @group(0) @binding(15) var output: texture_storage_2d<rgba32float, write>;
                    @compute @workgroup_size(8, 8, 1)
                    fn {name}(@builtin(global_invocation_id) id: vec3u) {{
                        if any(id.xy >= textureDimensions(output)) {{ return; }}
                        let pixel = vec2i(id.xy);
                        textureStore(output, pixel, {result});
                    }}"
                ),
            ),
            Stage::Fragment => (
                r#"{"name": "output", "location": 0, "access": "write-only", "view_dimension": "2d", "format": "rgba32float"}"#,
                "",
                format!(
                    "{declarations}
                    @fragment
                    fn {name}(@builtin(position) position: vec4f) -> @location(0) vec4f {{
                        let pixel = vec2i(position.xy);
                        return {result};
                    }}"
                ),
            ),
        };
        let stage = stage.name();
        let manifest = format!(
            r#"{{"schema": 3, "generator": "by hand", "kernel": "{name}", "stage": "{stage}", "unroll": "full",
                "entry_point": "{name}", {workgroup} "bindings": [{}], "output": {output}, "options": {{}},
                "counts": {{"basic_blocks": 1, "loops": 0, "texture_reads": 0, "colour_reads": 1, "reads": {{}},
                    "tallies": {{}}, "transcendentals": 0, "alu": 0, "statements": 1, "max_live": 4}}}}"#,
            bindings.join(", ")
        );
        Fixture { manifest, wgsl }
    }
}
