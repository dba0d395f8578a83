//! Work in turn: shaders of ours, and what others submit.

use super::{Bench, Clock, ExecuteError, Job, Timed};
use std::time::Duration;
use straightline_runtime::{Bound, Region, Timer};
use wgpu::CommandEncoder;

/// Runs of a pass in one submission, at most.
const MOST_REPEATS: u32 = 64;

/// Does its work once, and says how long that took. The first time is not counted: it may compile, and find out how often to
/// repeat.
pub type Work<'a> = Box<dyn FnMut() -> Result<Duration, ExecuteError> + 'a>;

/// Records passes, with spans of the timer if there is one.
pub(super) type Record<'a> = dyn Fn(&mut CommandEncoder, Option<&mut Timer>) -> Result<(), ExecuteError> + 'a;

impl Bench {
    /// A pass to be timed with others, repeated as [`timed_for`](Self::timed_for) says.
    ///
    /// # Errors
    ///
    /// If the pass cannot be bound, or the device cannot be asked for the time.
    pub fn job_work<'a>(&self, job: Job<'a>, least: Duration) -> Result<Work<'a>, ExecuteError> {
        let bound = self.bind_job(job)?;
        self.recorded_work(1, least, move |encoder, timer| {
            match timer {
                Some(timer) => bound.encode_timed(encoder, timer)?,
                None => bound.encode(encoder),
            }
            Ok(())
        })
    }

    /// Passes that follow on each other, in one submission, to be timed with others: their times are added up.
    ///
    /// # Errors
    ///
    /// If a pass cannot be bound, or the device cannot be asked for the time.
    pub fn sequence_work<'a>(&self, jobs: &[Job<'_>]) -> Result<Work<'a>, ExecuteError> {
        let bound: Vec<Bound> = jobs.iter().map(|job| self.bind_job(*job)).collect::<Result<_, _>>()?;
        self.recorded_work(bound.len() as u32, Duration::ZERO, move |encoder, mut timer| {
            for bound in &bound {
                match &mut timer {
                    Some(timer) => bound.encode_timed(encoder, timer)?,
                    None => bound.encode(encoder),
                }
            }
            Ok(())
        })
    }

    /// Returns a function that records a pass among others.
    ///
    /// # Errors
    ///
    /// If the pass cannot be bound.
    pub fn pass_recorder(&self, job: Job<'_>) -> Result<impl Fn(&mut CommandEncoder) + use<>, ExecuteError> {
        let bound = self.bind_job(job)?;
        Ok(move |encoder: &mut CommandEncoder| bound.encode(encoder))
    }

    fn bind_job(&self, job: Job<'_>) -> Result<Bound, ExecuteError> {
        let view = |format| {
            let target = self.create_target(job.size, format);
            target.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let views: Vec<_> = job.pass.targets().map(|(name, format)| (name, view(format))).collect();
        let named: Vec<_> = views.iter().map(|(name, view)| (*name, view)).collect();
        Ok(match job.pass.filters_regions() {
            // From the upper left pixel on.
            true => job
                .uploaded
                .bind_region(job.pass, &named[..], Region::at([0, 0], job.size.to_array()))?,
            false => job.uploaded.bind(job.pass, &named[..])?,
        })
    }

    /// Makes work of `record`, to be timed with others: up to `passes` passes, each with a span of the timer around it where
    /// there is one. Their times are added up. Repeated as [`timed_for`](Self::timed_for) says.
    ///
    /// # Errors
    ///
    /// If the device cannot be asked for the time.
    pub fn recorded_work<'a>(
        &self,
        passes: u32,
        least: Duration,
        record: impl Fn(&mut CommandEncoder, Option<&mut Timer>) -> Result<(), ExecuteError> + 'a,
    ) -> Result<Work<'a>, ExecuteError> {
        let bench = self.clone();
        let most = if least.is_zero() { 1 } else { MOST_REPEATS };
        let mut timer = match self.timestamps {
            true => Some(Timer::new(&self.device, &self.queue, most * passes)?),
            false => None,
        };
        let mut repeats = None;
        Ok(Box::new(move || {
            if let Some(repeats) = repeats {
                return bench.time_once(&record, repeats, timer.as_mut());
            }
            let mut took = bench.time_once(&record, 1, timer.as_mut())?;
            if !least.is_zero() {
                // The first time has the driver's compiling in it.
                took = bench.time_once(&record, 1, timer.as_mut())?;
            }
            let wanted = least.as_secs_f64() / took.as_secs_f64().max(1e-9);
            repeats = Some((wanted.ceil() as u32).clamp(1, most));
            Ok(took)
        }))
    }

    /// As [`time_jobs`](Self::time_jobs), of any work. Each must take its time as this bench does: by
    /// [`clock`](Self::clock). Every other round runs them in reverse.
    ///
    /// # Errors
    ///
    /// Errors of the work.
    pub fn in_turn(
        &self,
        works: &mut [Work<'_>],
        rounds: u32,
        mut tick: impl FnMut(u32) -> bool,
    ) -> Result<Timed, ExecuteError> {
        let mut times: Vec<Vec<Duration>> = vec![Vec::new(); works.len()];
        for round in 0..=rounds.max(1) {
            for turn in 0..works.len() {
                let k = if round % 2 == 0 { turn } else { works.len() - 1 - turn };
                let took = works[k]()?;
                if round > 0 {
                    times[k].push(took);
                }
            }
            if !tick(round) && round > 0 {
                break;
            }
        }
        Ok(Timed {
            clock: self.clock(),
            rounds: times,
        })
    }

    /// Returns the clock that passes are timed with.
    pub fn clock(&self) -> Clock {
        match self.timestamps {
            true => Clock::GpuTimestamps,
            false => Clock::WallClock,
        }
    }
}
