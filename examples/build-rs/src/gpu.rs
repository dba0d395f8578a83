//! Runs one picture through one pass. Apart from the lines of `glow`, everything here is the caller's own wgpu code.

use crate::shaders::glow;
use straightline_kernels::prelude::*;
use straightline_runtime::{Choices, PassOptions, wgpu};
use wgpu::{TextureFormat, TextureUsages};

type Failure = Box<dyn std::error::Error>;

/// Returns the picture with its glow.
pub fn glow(picture: &Frame<Vec4>, strength: f32, choices: &mut Choices) -> Result<Frame<Vec4>, Failure> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;

    let size = picture.size();
    let input = texture(&device, size, TextureFormat::Rgba32Float, TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST);
    let bytes: Vec<u8> = picture.texels().iter().flat_map(|c| c.to_array()).flat_map(f32::to_le_bytes).collect();
    let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(size.x * 16), rows_per_image: None };
    queue.write_texture(input.as_image_copy(), &bytes, rows, input.size());
    let output = texture(&device, size, TextureFormat::Rgba16Float, TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC);
    let (color, target) = (view(&input), view(&output));

    // The fastest candidate on this device: the remembered one, or else all are timed.
    let (inputs, parameters) = (glow::Inputs { color: &color }, glow::Parameters { strength, ..Default::default() });
    let options = PassOptions::default();
    let pass = glow::Pass::choose((&device, &queue), choices, &options, &inputs, &parameters, &target)?;
    let bound = pass.bind(&inputs, &parameters, &target)?;
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    bound.encode(&mut encoder);

    let row = (size.x * 8).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row * size.y),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let copy = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(output.as_image_copy(), copy, output.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let bytes = buffer.get_mapped_range(..)?;
    let texels = bytes.chunks_exact(row as usize).flat_map(|line| line[..size.x as usize * 8].chunks_exact(8).map(texel));
    Ok(Frame::new(size, texels.collect()))
}

fn texture(device: &wgpu::Device, size: UVec2, format: TextureFormat, usage: TextureUsages) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Decodes a texel of four halves.
fn texel(bytes: &[u8]) -> Vec4 {
    let half = |k: usize| {
        let bits = u16::from_le_bytes([bytes[2 * k], bytes[2 * k + 1]]);
        let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
        let size = if exponent == 0 { mantissa * 2f32.powi(-24) } else { (1024.0 + mantissa) * 2f32.powi(exponent - 25) };
        if bits >> 15 == 1 { -size } else { size }
    };
    vec4(half(0), half(1), half(2), half(3))
}
