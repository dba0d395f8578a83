//! SMAA 1x (Jimenez et al. 2012) by the crate `smaa`, preset High, edges by luma: three passes.

use super::copy::Copy;
use super::transfer::Transfer;
use glam::{UVec2, Vec4};
use smaa::{SmaaMode, SmaaTarget};
use std::sync::mpsc;
use std::time::{Duration, Instant};
use straightline_bench::execute::{Bench, Clock, ExecuteError, texture_bytes};
use straightline_kernels::prelude::Frame;
use straightline_manifest::{Dimension, SampleType};
use straightline_scene::render::{RenderError, with_error_scope};
use wgpu::TextureFormat;

/// Format of the input and output pictures: more than 8 bits, so that rounding adds no error, and filterable on every
/// device.
const FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// Bytes per pixel of the textures between the passes: edges in rg8unorm, weights in rgba8unorm.
const BETWEEN: u64 = 2 + 4;

/// SMAA on pictures of one size.
pub struct Smaa {
    bench: Bench,
    transfer: Transfer,
    target: SmaaTarget,
    output: wgpu::Texture,
    copy_in: Copy,
    copy_out: Copy,
}

impl Smaa {
    /// Creates the passes on the bench's device, for pictures of `size` pixels.
    ///
    /// # Errors
    ///
    /// If the device refuses them.
    pub fn new(bench: &Bench, size: UVec2, transfer: Transfer) -> Result<Smaa, ExecuteError> {
        let (device, queue) = (bench.device(), bench.queue());
        let made = with_error_scope(device, "making SMAA's passes", || {
            let mode = SmaaMode::Smaa1X;
            let target = SmaaTarget::new(device, queue, size.x, size.y, FORMAT, mode);
            let output = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("SMAA's output"),
                size: wgpu::Extent3d {
                    width: size.x,
                    height: size.y,
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            Smaa {
                bench: bench.clone(),
                transfer,
                target,
                output,
                copy_in: Copy::new(device, FORMAT),
                copy_out: Copy::new(device, TextureFormat::Rgba32Float),
            }
        });
        made.map_err(of_device)
    }

    /// Returns the antialiased picture; input and output are linear.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn run(&mut self, picture: &Frame<Vec4>) -> Result<Frame<Vec4>, ExecuteError> {
        let bench = self.bench.clone();
        let given = self.transfer.encode_picture(picture);
        let given = bench.create_texture(&[given], Dimension::D2, SampleType::Unfilterable, 4)?;
        let result = bench.create_target(picture.size(), TextureFormat::Rgba32Float);
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let output = view(&self.output);
        let ran = with_error_scope(bench.device(), "running SMAA", || {
            let frame = self.target.start_frame(bench.device(), bench.queue(), &output);
            self.copy_in.submit(&bench, &given, &frame);
            frame.resolve();
            self.copy_out.submit(&bench, &output, &view(&result));
        });
        ran.map_err(of_device)?;
        Ok(self.transfer.decode_picture(&bench.download(&result)?))
    }

    /// Runs the three passes once more on the picture of the last [`run`](Self::run), and returns their duration.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn time_passes(&mut self) -> Result<Duration, ExecuteError> {
        let bench = self.bench.clone();
        let output = self.output.create_view(&wgpu::TextureViewDescriptor::default());
        let frame = self.target.start_frame(bench.device(), bench.queue(), &output);
        match bench.clock() {
            Clock::WallClock => {
                let start = Instant::now();
                frame.resolve();
                bench.wait()?;
                Ok(start.elapsed())
            }
            Clock::GpuTimestamps => between_stamps(&bench, || frame.resolve()),
        }
    }

    /// Returns the bytes that the passes read and write: picture, edges, weights, output.
    pub fn traffic_bytes(&self) -> u64 {
        let texels = u64::from(self.output.width()) * u64::from(self.output.height());
        2 * texture_bytes(&self.output) + BETWEEN * texels
    }
}

fn of_device(error: RenderError) -> ExecuteError {
    match error {
        RenderError::Device { doing, description } => device_error(doing, description),
        other => device_error("running SMAA", other),
    }
}

fn device_error(doing: &'static str, error: impl ToString) -> ExecuteError {
    ExecuteError::Device {
        doing,
        message: error.to_string(),
    }
}

/// Returns the duration of `submit` by the device's own clock: empty passes before and after it hold the timestamps, since its
/// passes have
/// no place for them.
fn between_stamps(bench: &Bench, submit: impl FnOnce()) -> Result<Duration, ExecuteError> {
    let (device, queue) = (bench.device(), bench.queue());
    let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
        label: None,
        ty: wgpu::QueryType::Timestamp,
        count: 4,
    });
    let buffer = |usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 32,
            usage,
            mapped_at_creation: false,
        })
    };
    let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
    let read = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let stamp = |encoder: &mut wgpu::CommandEncoder, first: u32| {
        encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: None,
            timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                query_set: &queries,
                beginning_of_pass_write_index: Some(first),
                end_of_pass_write_index: Some(first + 1),
            }),
        });
    };
    let mut before = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    stamp(&mut before, 0);
    queue.submit([before.finish()]);
    submit();
    let mut after = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    stamp(&mut after, 2);
    after.resolve_query_set(&queries, 0..4, &resolved, 0);
    after.copy_buffer_to_buffer(&resolved, 0, &read, 0, 32);
    queue.submit([after.finish()]);
    let doing = "timing SMAA";
    let (sender, receiver) = mpsc::channel();
    read.map_async(wgpu::MapMode::Read, .., move |result| {
        // Sending fails only if waiting failed, and then the result is of no use.
        let _ = sender.send(result);
    });
    bench.wait()?;
    match receiver.try_recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(device_error(doing, error)),
        Err(error) => return Err(device_error(doing, error)),
    }
    let bytes = read.get_mapped_range(..).map_err(|error| device_error(doing, error))?;
    let ticks: Vec<u64> = bytes
        .as_chunks::<8>()
        .0
        .iter()
        .map(|t| u64::from_le_bytes(*t))
        .collect();
    let (end_before, begin_after) = (ticks[1], ticks[2]);
    let seconds = begin_after.saturating_sub(end_before) as f64 * f64::from(queue.get_timestamp_period()) * 1e-9;
    Ok(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX))
}
