//! Shows a picture through a lens: `cargo run -- PICTURE.png OUT.png [STRENGTH]`. With `--features reload`, it goes on and
//! writes the picture again whenever the kernel's file changes.

#[cfg(feature = "reload")]
mod watch;

use std::error::Error;
use straightline_runtime::{Bound, wgpu};
use wgpu::{TextureFormat, TextureUsages};

/// The kernel as Rust, for the editor and for `cargo test`. `build.rs` reads the same file.
#[allow(dead_code, clippy::pedantic, reason = "it runs as a shader")]
mod kernels {
    pub mod lens;
}

/// Output of `build.rs`: a module for each kernel.
mod shaders {
    straightline_runtime::include_shaders!();
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let (Some(from), Some(to)) = (words.next(), words.next()) else {
        return Err("usage: own-kernel PICTURE.png OUT.png [STRENGTH]".into());
    };
    let strength: f32 = words.next().map_or(Ok(1.0), |word| word.parse())?;
    let picture = image::open(from)?.to_rgba8();
    let (width, height) = picture.dimensions();

    // A device and two textures. Your renderer already has them.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
    let texture = |format, usage| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    };
    let input = texture(TextureFormat::Rgba8UnormSrgb, TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST);
    let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
    queue.write_texture(input.as_image_copy(), &picture, rows, input.size());
    // The shader writes to a storage texture, which cannot be sRGB. A copy of it is encoded below.
    let output = texture(TextureFormat::Rgba16Float, TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC);

    // The kernel.
    let lens = shaders::lens::Pass::new(&device)?;
    let linear = device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let whole = wgpu::TextureViewDescriptor::default();
    let (image, target) = (input.create_view(&whole), output.create_view(&whole));
    let inputs = shaders::lens::Inputs { image: &image, linear: &linear };
    let bound = lens.bind(&inputs, &shaders::lens::Parameters::new(strength), &target)?;
    write(&to, &device, &queue, &output, bound.inner())?;
    #[cfg(feature = "reload")]
    watch::watch(&device, &inputs, strength, &target, |bound| write(&to, &device, &queue, &output, bound))?;
    Ok(())
}

/// Runs the kernel, and writes its output to a file.
fn write(
    to: &str,
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    output: &wgpu::Texture,
    kernel: &Bound,
) -> Result<(), Box<dyn Error>> {
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    kernel.encode(&mut encoder);

    // Read back from the device.
    let (width, height) = (output.width(), output.height());
    let row = (8 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row) * u64::from(height),
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
    let lines = bytes.chunks_exact(row as usize).map(|line| &line[..8 * width as usize]);
    let shown: Vec<u8> = lines.flat_map(|line| line.chunks_exact(2)).enumerate().map(encode).collect();
    image::save_buffer(to, &shown, width, height, image::ColorType::Rgba8)?;
    Ok(())
}

/// Converts a half of a colour to a byte of an sRGB picture. Every fourth is alpha, which is linear.
fn encode((k, half): (usize, &[u8])) -> u8 {
    let bits = u16::from_le_bytes([half[0], half[1]]);
    let (exponent, mantissa) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
    let size = if exponent == 0 { mantissa * 2f32.powi(-24) } else { (1024.0 + mantissa) * 2f32.powi(exponent - 25) };
    let linear = if bits >> 15 == 1 { 0.0 } else { size.min(1.0) };
    let shown = match (k % 4, linear) {
        (3, alpha) => alpha,
        (_, dark) if dark <= 0.003_130_8 => 12.92 * dark,
        (_, light) => 1.055 * light.powf(1.0 / 2.4) - 0.055,
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and 255
    let byte = (shown * 255.0).round() as u8;
    byte
}
