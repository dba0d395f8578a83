//! Times of several shaders, measured in turn (A B C A B C ...) in one run, so that a drifting clock hits all alike.

use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::resolve::Uploaded;
use serde::Serialize;
use std::time::{Duration, Instant};
use straightline_runtime::{Pass, Timer};

/// Times of one shader over all rounds, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Times {
    /// The middle of all rounds.
    pub median_ms: f64,
    /// The fastest round.
    pub min_ms: f64,
    /// The slowest round.
    pub max_ms: f64,
    /// Rounds, after one that is not counted.
    pub rounds: usize,
}

impl Times {
    /// Median and extremes; `None` of no times.
    pub fn of(times: &[Duration]) -> Option<Times> {
        let mut sorted: Vec<f64> = times.iter().map(|t| t.as_secs_f64() * 1e3).collect();
        sorted.sort_by(f64::total_cmp);
        let (min, max) = (*sorted.first()?, *sorted.last()?);
        let middle = sorted.len() / 2;
        let median = if sorted.len() % 2 == 1 {
            sorted[middle]
        } else {
            (sorted[middle - 1] + sorted[middle]) / 2.0
        };
        Some(Times {
            median_ms: median,
            min_ms: min,
            max_ms: max,
            rounds: sorted.len(),
        })
    }
}

/// What a time was taken with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// The GPU's own timestamps around each pass.
    GpuTimestamps,
    /// Wall clock around submission and completion: the driver's overhead is in it.
    WallClock,
}

/// Runs every pass once a round, in turn, after one round that is not counted. `tick` is called after each round.
pub fn interleaved(
    gpu: &Gpu,
    passes: &[&Pass],
    inputs: &Uploaded,
    rounds: u32,
    mut tick: impl FnMut(u32),
) -> Result<(Vec<Times>, Clock), Failure> {
    let views: Vec<wgpu::TextureView> = passes
        .iter()
        .map(|pass| {
            gpu.target(inputs.size, pass.target_format())
                .create_view(&wgpu::TextureViewDescriptor::default())
        })
        .collect();
    let mut timer = if gpu.timestamps {
        Some(Timer::new(&gpu.device, &gpu.queue, 1).map_err(Failure::of)?)
    } else {
        None
    };
    let mut times: Vec<Vec<Duration>> = vec![Vec::new(); passes.len()];
    for round in 0..=rounds {
        for (k, pass) in passes.iter().enumerate() {
            let bound = inputs.for_pass(pass);
            let mut encoder = gpu
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let took = match &mut timer {
                Some(timer) => {
                    pass.encode_timed(&mut encoder, &bound, &views[k], timer)
                        .map_err(Failure::of)?;
                    timer.resolve(&mut encoder).map_err(Failure::of)?;
                    gpu.queue.submit([encoder.finish()]);
                    timer.read().map_err(Failure::of)?.first().copied().unwrap_or_default()
                }
                None => {
                    pass.encode(&mut encoder, &bound, &views[k]).map_err(Failure::of)?;
                    let start = Instant::now();
                    gpu.queue.submit([encoder.finish()]);
                    gpu.wait()?;
                    start.elapsed()
                }
            };
            if round > 0 {
                times[k].push(took);
            }
        }
        tick(round);
    }
    let clock = if timer.is_some() {
        Clock::GpuTimestamps
    } else {
        Clock::WallClock
    };
    let times: Option<Vec<Times>> = times.iter().map(|t| Times::of(t)).collect();
    Ok((
        times.ok_or_else(|| Failure::Usage("at least one round is needed".to_owned()))?,
        clock,
    ))
}
