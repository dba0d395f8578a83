//! Times of shaders of ours in turn with work that others submit.

use super::{Bench, Clock, ExecuteError, Job, Timed};
use std::time::Duration;
use straightline_runtime::Timer;

/// Does its work once, and says how long that took.
pub type Work<'a> = Box<dyn FnMut() -> Result<Duration, ExecuteError> + 'a>;

impl Bench {
    /// A pass to be timed with others.
    ///
    /// # Errors
    ///
    /// If the device cannot be asked for the time.
    pub fn work<'a>(&self, job: Job<'a>) -> Result<Work<'a>, ExecuteError> {
        let bench = self.clone();
        let view = self
            .target(job.size, job.pass.target_format())
            .create_view(&wgpu::TextureViewDescriptor::default());
        let mut timer = match self.timestamps {
            true => Some(Timer::new(&self.device, &self.queue, 1)?),
            false => None,
        };
        Ok(Box::new(move || bench.once(&job, &view, 1, timer.as_mut())))
    }

    /// As [`timed`](Self::timed), of any work. Each must take its time as this bench does: by [`clock`](Self::clock). Every other
    /// round runs them in reverse.
    ///
    /// # Errors
    ///
    /// Those of the work.
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

    /// What passes are timed with.
    pub fn clock(&self) -> Clock {
        match self.timestamps {
            true => Clock::GpuTimestamps,
            false => Clock::WallClock,
        }
    }
}
