//! A frame without a window, as bytes.

use crate::renderer::Renderer;
use crate::{Failure, Size};
use straightline_runtime::wgpu;
use wgpu::TextureFormat;

/// What one can say about a machine on which there is no adapter.
pub const NO_ADAPTER: &str = "no GPU adapter: install a Vulkan driver (a software one is in Debian's mesa-vulkan-drivers)";

/// The frame at `time` seconds: four bytes a pixel, sRGB, rows from the top.
pub fn draw(size: Size, time: f32, sraa: bool) -> Result<Vec<u8>, Failure> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
        .map_err(|error| format!("{NO_ADAPTER}: {error}"))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
    let mut renderer = Renderer::new(&device, &queue, size, FORMAT)?;
    frame(&device, &queue, &mut renderer, size, time, sraa)
}

const FORMAT: TextureFormat = TextureFormat::Rgba8UnormSrgb;

/// Draws a frame and reads it back.
fn frame(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    renderer: &mut Renderer,
    [width, height]: Size,
    time: f32,
    sraa: bool,
) -> Result<Vec<u8>, Failure> {
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    renderer.draw(time, sraa, &target.create_view(&wgpu::TextureViewDescriptor::default()))?;

    let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let copy = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(target.as_image_copy(), copy, target.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let mapped = buffer.get_mapped_range(..)?;
    Ok(mapped.chunks_exact(row as usize).flat_map(|line| line[..width as usize * 4].to_vec()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels whose colour differs from that of the pixel to the right by more than a little.
    fn steps(pixels: &[u8], width: u32) -> usize {
        let rows = pixels.chunks_exact(width as usize * 4);
        let differs = |pair: &[u8]| (0..3).any(|k| pair[k].abs_diff(pair[k + 4]) > 24);
        rows.map(|row| (0..width as usize - 1).filter(|x| differs(&row[x * 4..x * 4 + 8])).count()).sum()
    }

    #[test]
    fn one_renderer_draws_frames_of_changing_size_with_and_without() {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
        let adapter = adapter.unwrap_or_else(|error| panic!("{NO_ADAPTER}: {error}"));
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).unwrap();
        let mut renderer = Renderer::new(&device, &queue, [320, 180], FORMAT).unwrap();
        for size in [[320, 180], [201, 133], [1, 1], [320, 180]] {
            let [with, without] = [true, false].map(|sraa| frame(&device, &queue, &mut renderer, size, 2.0, sraa).unwrap());
            assert_eq!(with.len(), (size[0] * size[1] * 4) as usize);
            assert!(size == [1, 1] || with != without, "SRAA changes nothing at {size:?}");
            let (smooth, hard) = (steps(&with, size[0]), steps(&without, size[0]));
            assert!(size == [1, 1] || hard > 500, "an empty picture at {size:?}: {hard} edges");
            assert!(smooth > hard / 2 || size == [1, 1], "SRAA blurs {hard} edges to {smooth} at {size:?}");
        }
        // The scene turns.
        let [now, later] = [2.0, 2.5].map(|time| frame(&device, &queue, &mut renderer, [320, 180], time, true).unwrap());
        assert!(now != later);
    }
}
