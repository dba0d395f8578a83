//! What frames cost: the thread that records them, and the device that runs them.

use std::collections::VecDeque;
use std::fmt;
use std::time::Duration;
use straightline_runtime::{Error, Span, Timer, wgpu};

/// Passes of a frame: five of geometry, placing, shading, motion, SRAA, one that keeps, and to the screen.
const PASSES: u32 = 11;

/// Frames whose timestamps are waited for at most; those beyond are not timed on the device.
const UNDER_WAY: usize = 8;

/// Times of frames, added up until somebody asks.
pub struct Clock {
    /// None where the device has no timestamps.
    timer: Option<Timer>,
    /// Of each frame that the device has not told about yet, which of its passes are SRAA's.
    under_way: VecDeque<&'static [usize]>,
    recorded: Sum,
    device: Sum,
    sraa: Sum,
}

#[derive(Default)]
struct Sum(Duration, u32);

impl Sum {
    fn add(&mut self, time: Duration) {
        self.0 += time;
        self.1 += 1;
    }

    /// The mean, from which on the sum starts anew.
    fn take(&mut self) -> Option<Duration> {
        let Sum(total, count) = std::mem::take(self);
        total.checked_div(count)
    }
}

/// Means over some frames.
pub struct Costs {
    /// Of the thread: to record a frame and to submit it.
    pub recorded: Duration,
    /// Of the device, by its timestamps: all passes of a frame, and SRAA alone. None where it has none.
    pub device: Option<(Duration, Option<Duration>)>,
}

impl fmt::Display for Costs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        write!(f, "{:.2} ms to record", ms(self.recorded))?;
        match self.device {
            Some((all, Some(sraa))) => write!(f, ", {:.2} ms on the GPU, {:.2} ms of them SRAA", ms(all), ms(sraa)),
            Some((all, None)) => write!(f, ", {:.2} ms on the GPU", ms(all)),
            None => Ok(()),
        }
    }
}

impl Clock {
    /// Uses timestamps where the device was created with them.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self, Error> {
        let timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        Ok(Clock {
            timer: timed.then(|| Timer::new(device, queue, PASSES)).transpose()?,
            under_way: VecDeque::new(),
            recorded: Sum::default(),
            device: Sum::default(),
            sraa: Sum::default(),
        })
    }

    fn running(&mut self) -> Option<&mut Timer> {
        self.timer.as_mut().filter(|_| self.under_way.len() < UNDER_WAY)
    }

    /// What the next pass of the frame is timed with.
    pub fn span(&mut self) -> Result<Option<Span<'_>>, Error> {
        self.running().map(Timer::span).transpose()
    }

    /// The same for a pass of the runtime, which takes its span itself.
    pub fn timer(&mut self) -> Option<&mut Timer> {
        self.running()
    }

    /// Ends the frame's part of `encoder`.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder, sraa: &'static [usize]) -> Result<(), Error> {
        if let Some(timer) = self.running() {
            timer.resolve(encoder)?;
            self.under_way.push_back(sraa);
        }
        Ok(())
    }

    /// Adds a frame, once it is submitted, and what the device has said meanwhile.
    pub fn add(&mut self, recorded: Duration) -> Result<(), Error> {
        self.recorded.add(recorded);
        self.collect()
    }

    fn collect(&mut self) -> Result<(), Error> {
        let Some(timer) = &mut self.timer else { return Ok(()) };
        while let Some(sraa) = self.under_way.front() {
            let Some(spans) = timer.try_read()? else { break };
            self.device.add(spans.iter().sum());
            if !sraa.is_empty() {
                self.sraa.add(sraa.iter().filter_map(|pass| spans.get(*pass)).sum());
            }
            self.under_way.pop_front();
        }
        Ok(())
    }

    /// Means since the last call. None if there was no frame, or the device has told of none of them yet.
    pub fn take(&mut self) -> Result<Option<Costs>, Error> {
        self.collect()?;
        if self.timer.is_some() && self.device.1 == 0 {
            return Ok(None);
        }
        let device = self.device.take().map(|all| (all, self.sraa.take()));
        Ok(self.recorded.take().map(|recorded| Costs { recorded, device }))
    }
}
