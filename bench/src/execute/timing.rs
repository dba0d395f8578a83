//! Times of several shaders, measured in turn (A B C A B C ...) in one run, so that a drifting clock hits all alike.

use super::work::Record;
use super::{Bench, ExecuteError, Uploaded};
use glam::UVec2;
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};
use straightline_runtime::{Pass, Timer};
use straightline_scene::render::Timestamps;

/// Times of one shader over all rounds, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
    pub fn from_durations(times: &[Duration]) -> Option<Times> {
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

/// The speedup of one shader over another, from rounds in which both ran.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    /// The middle of the ratios of all rounds.
    pub median: f64,
    /// A tenth of the rounds were below this.
    pub low: f64,
    /// A tenth of the rounds were above this.
    pub high: f64,
}

impl Ratio {
    /// Speedup over `base` of what took `times`, round by round; `None` of no rounds.
    pub fn from_durations(base: &[Duration], times: &[Duration]) -> Option<Ratio> {
        let ratio = |(base, time): (&Duration, &Duration)| base.as_secs_f64() / time.as_secs_f64().max(1e-9);
        let ratios: Vec<f64> = base.iter().zip(times).map(ratio).collect();
        let [low, median, high] = find_quantiles(&ratios, [0.1, 0.5, 0.9])?;
        Some(Ratio { median, low, high })
    }
}

/// Median and quartiles of what several rounds gave, in their unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quartiles {
    /// A quarter of the rounds were below this.
    pub lower: f64,
    /// The middle of all rounds.
    pub median: f64,
    /// A quarter of the rounds were above this.
    pub upper: f64,
}

impl Quartiles {
    /// Of the values of all rounds; `None` of none.
    pub fn from_values(values: &[f64]) -> Option<Quartiles> {
        let [lower, median, upper] = find_quantiles(values, [0.25, 0.5, 0.75])?;
        Some(Quartiles { lower, median, upper })
    }

    /// Of a sum whose parts were measured apart: each quartile is the sum of the parts', as if a slow round slowed all of them.
    pub fn sum(parts: impl IntoIterator<Item = Quartiles>) -> Quartiles {
        let zero = Quartiles {
            lower: 0.0,
            median: 0.0,
            upper: 0.0,
        };
        parts.into_iter().fold(zero, |sum, part| Quartiles {
            lower: sum.lower + part.lower,
            median: sum.median + part.median,
            upper: sum.upper + part.upper,
        })
    }
}

/// The values below which these shares of all lie, interpolated; `None` of no values.
fn find_quantiles<const N: usize>(values: &[f64], shares: [f64; N]) -> Option<[f64; N]> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    Some(shares.map(|share| {
        let place = share * last as f64;
        let below = sorted[place as usize];
        below + (sorted[(place as usize + 1).min(last)] - below) * place.fract()
    }))
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
    /// Median and extremes of a shader; `None` if there is no such shader.
    pub fn times(&self, shader: usize) -> Option<Times> {
        Times::from_durations(self.rounds.get(shader)?)
    }

    /// Speedup of a shader over `base`; `None` if one of them is not there.
    pub fn ratio(&self, base: usize, shader: usize) -> Option<Ratio> {
        Ratio::from_durations(self.rounds.get(base)?, self.rounds.get(shader)?)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_taken_round_by_round() {
        let ms = |times: &[u64]| times.iter().map(|t| Duration::from_millis(*t)).collect::<Vec<_>>();
        // The second round was slow for both: their ratio is not.
        let ratio = Ratio::from_durations(&ms(&[40, 400, 44]), &ms(&[10, 100, 10])).unwrap();
        assert_eq!(ratio.median, 4.0);
        assert!(
            (ratio.low - 4.0).abs() < 1e-12 && (ratio.high - 4.32).abs() < 1e-12,
            "{ratio:?}"
        );
        assert_eq!(Ratio::from_durations(&[], &[]), None);
    }

    #[test]
    fn quartiles_are_interpolated_and_add_up() {
        let quartiles = Quartiles::from_values(&[5.0, 1.0, 2.0, 3.0]).unwrap();
        assert_eq!(
            quartiles,
            Quartiles {
                lower: 1.75,
                median: 2.5,
                upper: 3.5
            }
        );
        assert_eq!(Quartiles::sum([quartiles, quartiles]).upper, 7.0);
        assert_eq!(Quartiles::from_values(&[]), None);
    }
}
