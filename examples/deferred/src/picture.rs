//! Renders a frame without a window, as bytes.

use crate::antialiasing::Antialiasing;
use crate::gpu::Gpu;
use crate::renderer::Renderer;
use crate::{Failure, Size};
use std::future::poll_fn;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Poll, Waker};
use straightline_sraa::wgpu;
use wgpu::TextureFormat;

pub const FORMAT: TextureFormat = TextureFormat::Rgba8UnormSrgb;

/// Draws the frame at `time` seconds. Returns four bytes a pixel, sRGB, rows from the top.
pub async fn draw(
    gpu: &Gpu,
    renderer: &mut Renderer,
    size: Size,
    time: f32,
    antialiasing: Antialiasing,
) -> Result<Vec<u8>, Failure> {
    let target = target(gpu, size);
    renderer.draw(time, antialiasing, &target.create_view(&wgpu::TextureViewDescriptor::default()))?;
    read(gpu, &target).await
}

/// Reads a target back, as `draw` returns it.
pub async fn read(gpu: &Gpu, target: &wgpu::Texture) -> Result<Vec<u8>, Failure> {
    let [width, height] = [target.width(), target.height()];
    let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let copy = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(target.as_image_copy(), copy, target.size());
    gpu.queue.submit([encoder.finish()]);
    map(gpu, &buffer).await?;
    let mapped = buffer.get_mapped_range(..)?;
    Ok(mapped.chunks_exact(row as usize).flat_map(|line| line[..width as usize * 4].to_vec()).collect())
}

/// Creates a render target that can be read back.
pub fn target(gpu: &Gpu, [width, height]: Size) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// Result from the device, and the waiting task.
type Answer = Arc<Mutex<(Option<Result<(), wgpu::BufferAsyncError>>, Option<Waker>)>>;

/// Maps a buffer for reading. With threads, this one waits in `poll`; a browser continues in the meantime.
async fn map(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<(), Failure> {
    let answer = Answer::default();
    let told = Arc::clone(&answer);
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
        told.0 = Some(result);
        if let Some(waker) = told.1.take() {
            waker.wake();
        }
    });
    gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
    let mapped = poll_fn(|context| {
        let mut answer = answer.lock().unwrap_or_else(PoisonError::into_inner);
        match answer.0.take() {
            Some(result) => Poll::Ready(result),
            None => {
                answer.1 = Some(context.waker().clone());
                Poll::Pending
            }
        }
    });
    Ok(mapped.await?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::antialiasing::Preset;

    /// Counts the pixels whose colour clearly differs from that of the pixel to the right.
    fn steps(pixels: &[u8], width: u32) -> usize {
        let rows = pixels.chunks_exact(width as usize * 4);
        let differs = |pair: &[u8]| (0..3).any(|k| pair[k].abs_diff(pair[k + 4]) > 24);
        rows.map(|row| (0..width as usize - 1).filter(|x| differs(&row[x * 4..x * 4 + 8])).count()).sum()
    }

    #[test]
    fn one_renderer_draws_every_choice_at_changing_sizes() {
        let gpu = pollster::block_on(Gpu::headless(false)).unwrap();
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, [320, 180], FORMAT).unwrap();
        let mut frame =
            |size, time, antialiasing| pollster::block_on(draw(&gpu, &mut renderer, size, time, antialiasing)).unwrap();
        for size in [[320, 180], [201, 133], [1, 1], [320, 180]] {
            let drawn = Antialiasing::ALL.map(|(antialiasing, _)| frame(size, 2.0, antialiasing));
            let hard = steps(&drawn[0], size[0]);
            assert!(size == [1, 1] || hard > 500, "an empty picture at {size:?}: {hard} edges");
            for (k, (antialiasing, _)) in Antialiasing::ALL.into_iter().enumerate() {
                assert_eq!(drawn[k].len(), (size[0] * size[1] * 4) as usize);
                if size != [1, 1] {
                    assert!(!drawn[..k].contains(&drawn[k]), "{antialiasing} changes nothing at {size:?}");
                    let smooth = steps(&drawn[k], size[0]);
                    assert!(smooth > hard / 2, "{antialiasing} blurs {hard} edges to {smooth} at {size:?}");
                }
            }
        }
        // The scene rotates.
        let [now, later] = [2.0, 2.5].map(|time| frame([320, 180], time, Antialiasing::Sraa(Preset::Full)));
        assert!(now != later);
    }

    /// On a device with timestamps, reliable or not, and on a software device without.
    #[test]
    fn frames_are_timed() {
        let devices = [false, true].map(|always| pollster::block_on(Gpu::headless(always)).unwrap());
        assert!(devices[1].device.features().contains(wgpu::Features::TIMESTAMP_QUERY), "every Vulkan driver has them");
        for gpu in devices {
            let timestamps = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
            let mut renderer = Renderer::new(&gpu.device, &gpu.queue, [320, 180], FORMAT).unwrap();
            assert!(renderer.clock.take().unwrap().is_none(), "nothing was drawn");
            for (antialiasing, _) in Antialiasing::ALL {
                // More than the limit on pending frames.
                for _ in 0..12 {
                    pollster::block_on(draw(&gpu, &mut renderer, [320, 180], 2.0, antialiasing)).unwrap();
                }
                let costs = renderer.clock.take().unwrap().unwrap();
                assert!(!costs.recorded.is_zero());
                assert_eq!(costs.device.is_some(), timestamps);
                if let Some((all, of_sraa)) = costs.device {
                    assert_eq!(of_sraa.is_some(), matches!(antialiasing, Antialiasing::Sraa(_)));
                    assert!(of_sraa.is_none_or(|part| part <= all), "{costs}");
                }
            }
        }
    }
}
