//! Times of several shaders, measured in turn (A B C A B C ...) in one run, so that a drifting clock hits all alike.

use super::work::Record;
use super::{Bench, ExecuteError, Uploaded};
use glam::UVec2;
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};
use straightline_runtime::{Pass, Timer};
use straightline_scene::render::Timestamps;

/// Times of one shader over all rounds, in milliseconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The middle of all rounds.
    pub median_ms: f64,
    /// The fastest round.
    pub min_ms: f64,
    /// The slowest round.
    pub max_ms: f64,
    /// Rounds, after one that is not counted.
    pub rounds: usize,
    /// Time of each round; none in records from before it was introduced.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rounds_ms: Vec<f64>,
}

impl Times {
    /// Median and extremes; `None` of no times.
    pub fn from_durations(times: &[Duration]) -> Option<Times> {
        let rounds_ms: Vec<f64> = times.iter().map(|t| t.as_secs_f64() * 1e3).collect();
        let mut sorted = rounds_ms.clone();
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
            rounds_ms,
        })
    }
}

/// Times of several shaders that ran in turn, round by round.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// Clock that took the times.
    pub clock: Clock,
    /// For each shader, the time of each round.
    pub rounds: Vec<Vec<Duration>>,
}

impl Timed {
    /// Returns the milliseconds of each shader, round by round.
    pub fn rounds_ms(&self) -> Vec<Vec<f64>> {
        let milliseconds = |rounds: &Vec<Duration>| rounds.iter().map(|time| time.as_secs_f64() * 1e3).collect();
        self.rounds.iter().map(milliseconds).collect()
    }

    /// Median and extremes of a shader; `None` if there is no such shader.
    pub fn times(&self, shader: usize) -> Option<Times> {
        Times::from_durations(self.rounds.get(shader)?)
    }
}

/// Clock that takes a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// The GPU's own timestamps around each pass.
    GpuTimestamps,
    /// Wall clock around submission and completion: the driver's overhead is in it.
    WallClock,
}

/// The next `passes` spans of `timer`, for passes of a renderer; none without a timer.
///
/// # Errors
///
/// [`TimerFull`](straightline_runtime::Error::TimerFull).
pub fn next_timestamps(timer: Option<&mut Timer>, passes: u32) -> Result<Vec<Timestamps>, ExecuteError> {
    let Some(timer) = timer else {
        return Ok(Vec::new());
    };
    let spans = (0..passes).map(|_| {
        let span = timer.span()?;
        let writes = span.compute_writes();
        Ok(Timestamps {
            queries: writes.query_set.clone(),
            begin: writes.beginning_of_pass_write_index,
            end: writes.end_of_pass_write_index,
        })
    });
    spans.collect()
}

/// A pass with what it reads and the size of what it writes.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The shader.
    pub pass: &'a Pass,
    /// Resources that the shader reads.
    pub uploaded: &'a Uploaded,
    /// Width and height of its output.
    pub size: UVec2,
}

impl Bench {
    /// Median and extremes of what [`time_jobs`](Self::time_jobs) measures, and its clock. `tick` is called after each round.
    ///
    /// # Errors
    ///
    /// If a pass cannot be bound, or the device fails.
    pub fn time_interleaved(
        &self,
        jobs: &[Job<'_>],
        rounds: u32,
        mut tick: impl FnMut(u32),
    ) -> Result<(Vec<Times>, Clock), ExecuteError> {
        let timed = self.time_jobs(jobs, rounds, |round| {
            tick(round);
            true
        })?;
        Ok((
            timed.rounds.iter().filter_map(|t| Times::from_durations(t)).collect(),
            timed.clock,
        ))
    }

    /// Runs every job once a round, in turn, after one round that is not counted. `tick` is called after each round, and
    /// ends it by answering `false`.
    ///
    /// # Errors
    ///
    /// If a pass cannot be bound, or the device fails.
    pub fn time_jobs(
        &self,
        jobs: &[Job<'_>],
        rounds: u32,
        tick: impl FnMut(u32) -> bool,
    ) -> Result<Timed, ExecuteError> {
        self.timed_for(jobs, rounds, Duration::ZERO, tick)
    }

    /// As [`time_jobs`](Self::time_jobs), but a job that is done sooner than `least` is run several times in a row, in one
    /// submission: as often as it takes, up to 64 times. A time is that of one of them. What else the machine does, and
    /// what a submission costs by itself, then matters less. Every other round runs the jobs in reverse, so that none
    /// always follows the same.
    ///
    /// # Errors
    ///
    /// If a pass cannot be bound, or the device fails.
    pub fn timed_for(
        &self,
        jobs: &[Job<'_>],
        rounds: u32,
        least: Duration,
        tick: impl FnMut(u32) -> bool,
    ) -> Result<Timed, ExecuteError> {
        let works: Result<Vec<_>, _> = jobs.iter().map(|job| self.job_work(*job, least)).collect();
        self.in_turn(&mut works?, rounds, tick)
    }

    /// The time of one of `repeats` recordings in one submission.
    pub(super) fn time_once(
        &self,
        record: &Record<'_>,
        repeats: u32,
        timer: Option<&mut Timer>,
    ) -> Result<Duration, ExecuteError> {
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        match timer {
            Some(timer) => {
                for _ in 0..repeats {
                    record(&mut encoder, Some(&mut *timer))?;
                }
                timer.resolve(&mut encoder)?;
                self.queue.submit([encoder.finish()]);
                Ok(timer.read()?.iter().sum::<Duration>() / repeats)
            }
            None => {
                for _ in 0..repeats {
                    record(&mut encoder, None)?;
                }
                let commands = encoder.finish();
                let start = Instant::now();
                self.queue.submit([commands]);
                self.wait()?;
                Ok(start.elapsed() / repeats)
            }
        }
    }
}
