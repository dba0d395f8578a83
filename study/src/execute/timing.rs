//! Times of several shaders, measured in turn (A B C A B C ...) in one run, so that a drifting clock hits all alike.

use super::{Bench, Bound, ExecuteError};
use glam::UVec2;
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

/// A pass with what it reads and the size of what it writes.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The shader.
    pub pass: &'a Pass,
    /// Its inputs.
    pub bound: &'a Bound,
    /// Width and height of its output.
    pub size: UVec2,
}

impl Bench {
    /// Runs every job once a round, in turn, after one round that is not counted. `tick` is called after each round.
    ///
    /// # Errors
    ///
    /// If a pass cannot be encoded, or the device fails.
    pub fn interleaved(
        &self,
        jobs: &[Job<'_>],
        rounds: u32,
        mut tick: impl FnMut(u32),
    ) -> Result<(Vec<Times>, Clock), ExecuteError> {
        let view = |job: &Job<'_>| {
            self.target(job.size, job.pass.target_format())
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        let views: Vec<wgpu::TextureView> = jobs.iter().map(view).collect();
        let mut timer = match self.timestamps {
            true => Some(Timer::new(&self.device, &self.queue, 1)?),
            false => None,
        };
        let mut times: Vec<Vec<Duration>> = vec![Vec::new(); jobs.len()];
        for round in 0..=rounds.max(1) {
            for (k, job) in jobs.iter().enumerate() {
                let took = self.once(job, &views[k], timer.as_mut())?;
                if round > 0 {
                    times[k].push(took);
                }
            }
            tick(round);
        }
        let clock = match timer {
            Some(_) => Clock::GpuTimestamps,
            None => Clock::WallClock,
        };
        Ok((times.iter().filter_map(|t| Times::of(t)).collect(), clock))
    }

    fn once(
        &self,
        job: &Job<'_>,
        target: &wgpu::TextureView,
        timer: Option<&mut Timer>,
    ) -> Result<Duration, ExecuteError> {
        let resources = job.bound.resources();
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        match timer {
            Some(timer) => {
                job.pass.encode_timed(&mut encoder, &resources, target, timer)?;
                timer.resolve(&mut encoder)?;
                self.queue.submit([encoder.finish()]);
                Ok(timer.read()?.first().copied().unwrap_or_default())
            }
            None => {
                job.pass.encode(&mut encoder, &resources, target)?;
                let start = Instant::now();
                self.queue.submit([encoder.finish()]);
                self.wait()?;
                Ok(start.elapsed())
            }
        }
    }
}
