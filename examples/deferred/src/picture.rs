//! Renders a frame without a window, as bytes.

use crate::gpu::Gpu;
use crate::options::Parts;
use crate::renderer::{EARLIER, Renderer};
use crate::{Failure, Size};
use std::future::poll_fn;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Poll, Waker};
use straightline_runtime::wgpu;
use wgpu::TextureFormat;

pub const FORMAT: TextureFormat = TextureFormat::Rgba8UnormSrgb;

/// Seconds between frames.
const STEP: f32 = 1.0 / 60.0;

/// Draws the frame at `time` seconds, after as many as it remembers. Returns four bytes a pixel, sRGB, rows from the top.
pub async fn draw(
    gpu: &Gpu,
    renderer: &mut Renderer,
    size: Size,
    time: f32,
    parts: Parts,
) -> Result<Vec<u8>, Failure> {
    let target = target(gpu, size);
    let earlier = if parts.history { EARLIER } else { 0 };
    for before in (0..=earlier).rev() {
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        renderer.draw(time - STEP * before as f32, parts, &view)?;
    }

    let [width, height] = size;
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

    /// Counts the pixels whose colour clearly differs from that of the pixel to the right.
    fn steps(pixels: &[u8], width: u32) -> usize {
        let rows = pixels.chunks_exact(width as usize * 4);
        let differs = |pair: &[u8]| (0..3).any(|k| pair[k].abs_diff(pair[k + 4]) > 24);
        rows.map(|row| (0..width as usize - 1).filter(|x| differs(&row[x * 4..x * 4 + 8])).count()).sum()
    }

    #[test]
    fn one_renderer_draws_frames_of_changing_size_with_and_without() {
        let gpu = pollster::block_on(Gpu::headless(false)).unwrap();
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, [320, 180], FORMAT).unwrap();
        let mut frame = |size, time, sraa| {
            let parts = Parts { sraa, ..Parts::ALL };
            pollster::block_on(draw(&gpu, &mut renderer, size, time, parts)).unwrap()
        };
        for size in [[320, 180], [201, 133], [1, 1], [320, 180]] {
            let [with, without] = [true, false].map(|sraa| frame(size, 2.0, sraa));
            assert_eq!(with.len(), (size[0] * size[1] * 4) as usize);
            assert!(size == [1, 1] || with != without, "SRAA changes nothing at {size:?}");
            let (smooth, hard) = (steps(&with, size[0]), steps(&without, size[0]));
            assert!(size == [1, 1] || hard > 500, "an empty picture at {size:?}: {hard} edges");
            assert!(smooth > hard / 2 || size == [1, 1], "SRAA blurs {hard} edges to {smooth} at {size:?}");
        }
        // The scene rotates.
        let [now, later] = [2.0, 2.5].map(|time| frame([320, 180], time, true));
        assert!(now != later);
    }

    /// Mean squared difference of 8-bit colours.
    fn error(picture: &[u8], reference: &[f64]) -> f64 {
        let squares = picture.iter().zip(reference).map(|(a, b)| (f64::from(*a) - b).powi(2));
        squares.sum::<f64>() / reference.len() as f64
    }

    /// Compared with a picture shaded sixteen times a pixel: the same scene at four times the size.
    #[test]
    fn each_part_brings_the_picture_nearer_to_supersampling() {
        const OFF: Parts = Parts { sraa: false, placing: false, searching: false, demodulating: false, history: false };
        let gpu = pollster::block_on(Gpu::headless(false)).unwrap();
        let mut renderer = Renderer::new(&gpu.device, &gpu.queue, [320, 180], FORMAT).unwrap();
        let mut frame = |size, parts| pollster::block_on(draw(&gpu, &mut renderer, size, 2.0, parts)).unwrap();
        let linear = |byte: u8| (f64::from(byte) / 255.0).powf(2.2);
        let large = frame([1280, 720], OFF);
        let shaded_often = (0..320 * 180 * 4).map(|k| {
            let (x, y, channel) = (k / 4 % 320, k / 4 / 320, k % 4);
            let at = |j: usize| large[((y * 4 + j / 4) * 1280 + x * 4 + j % 4) * 4 + channel];
            255.0 * ((0..16).map(|j| linear(at(j))).sum::<f64>() / 16.0).powf(1.0 / 2.2)
        });
        let reference: Vec<f64> = shaded_often.collect();
        let alone = Parts { sraa: true, ..OFF };
        let helped = [
            Parts { placing: true, ..alone },
            Parts { searching: true, ..alone },
            Parts { demodulating: true, ..alone },
            Parts { history: true, ..alone },
        ];
        let mut off = |parts| error(&frame([320, 180], parts), &reference);
        let (without, by_sraa, by_all) = (off(OFF), off(alone), off(Parts::ALL));
        println!("{without:.1} without, {by_sraa:.1} by SRAA, {by_all:.1} by all");
        assert!(by_sraa < 0.5 * without && by_all < 0.7 * by_sraa);
        let without_history = off(Parts { history: false, ..Parts::ALL });
        println!("{without_history:.2} by all but history, {by_all:.2} with it");
        // The other parts have found nearly all surfaces. The rest is the difference between four and sixteen samples a pixel.
        assert!(by_all < 1.02 * without_history);
        for parts in helped {
            let found = off(parts);
            println!("{parts}: {found:.1}");
            assert!(found < 0.97 * by_sraa, "{parts}: {found} of {by_sraa}");
        }
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
            for sraa in [true, false] {
                // More than the limit on pending frames.
                for _ in 0..12 {
                    let parts = Parts { sraa, ..Parts::ALL };
                    pollster::block_on(draw(&gpu, &mut renderer, [320, 180], 2.0, parts)).unwrap();
                }
                let costs = renderer.clock.take().unwrap().unwrap();
                assert!(!costs.recorded.is_zero());
                assert_eq!(costs.device.is_some(), timestamps);
                if let Some((all, of_sraa)) = costs.device {
                    assert_eq!(of_sraa.is_some(), sraa);
                    assert!(of_sraa.is_none_or(|part| part <= all), "{costs}");
                }
            }
        }
    }
}
