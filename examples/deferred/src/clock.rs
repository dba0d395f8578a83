//! Frame times: of the thread that records the frames, and of the device that runs them.

use std::collections::VecDeque;
use std::fmt;
use std::time::Duration;
use straightline_sraa::runtime::{Error, Span, Timer};
use straightline_sraa::wgpu;

/// Passes of a frame at most: five of geometry, shading, presenting, and six kernels of SRAA.
const PASSES: u32 = 13;

/// Upper limit on frames with pending timestamps. Frames beyond it are not timed on the device.
const UNDER_WAY: usize = 8;

/// Part of a frame that a pass belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Scene,
    Sraa,
}

/// Frame times, accumulated until they are read.
pub struct Clock {
    /// `None` if the device has no timestamps.
    timer: Option<Timer>,
    /// Passes of the frame that is being recorded.
    passes: Vec<Part>,
    /// Passes of each frame with pending timestamps.
    under_way: VecDeque<Vec<Part>>,
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

    /// Returns the mean and resets the sum.
    fn take(&mut self) -> Option<Duration> {
        let Sum(total, count) = std::mem::take(self);
        total.checked_div(count)
    }
}

/// Mean times over some frames.
pub struct Costs {
    /// Time on the thread to record a frame and to submit it.
    pub recorded: Duration,
    /// Time on the device, from its timestamps: all passes of a frame, and SRAA alone. `None` without timestamps.
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
    /// Creates a clock. Uses timestamps if the device was created with them.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self, Error> {
        let timed = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        Ok(Clock {
            timer: timed.then(|| Timer::new(device, queue, PASSES)).transpose()?,
            passes: Vec::new(),
            under_way: VecDeque::new(),
            recorded: Sum::default(),
            device: Sum::default(),
            sraa: Sum::default(),
        })
    }

    /// Returns the timer for the next pass of the frame. A kernel of the runtime takes its span itself.
    pub fn timer(&mut self, part: Part) -> Option<&mut Timer> {
        let timer = self.timer.as_mut().filter(|_| self.under_way.len() < UNDER_WAY)?;
        self.passes.push(part);
        Some(timer)
    }

    /// Returns the timestamp span for the next pass of the frame.
    pub fn span(&mut self, part: Part) -> Result<Option<Span<'_>>, Error> {
        self.timer(part).map(Timer::span).transpose()
    }

    /// Resolves the frame's timestamps in `encoder`.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
        if let Some(timer) = self.timer.as_mut().filter(|_| self.under_way.len() < UNDER_WAY) {
            timer.resolve(encoder)?;
            self.under_way.push_back(std::mem::take(&mut self.passes));
        }
        Ok(())
    }

    /// Adds a submitted frame, and reads the timestamps that have arrived in the meantime.
    pub fn add(&mut self, recorded: Duration) -> Result<(), Error> {
        self.recorded.add(recorded);
        self.collect()
    }

    fn collect(&mut self) -> Result<(), Error> {
        let Some(timer) = &mut self.timer else { return Ok(()) };
        while !self.under_way.is_empty()
            && let Some(spans) = timer.try_read()?
            && let Some(passes) = self.under_way.pop_front()
        {
            self.device.add(spans.iter().sum());
            if passes.contains(&Part::Sraa) {
                let of_sraa = spans.iter().zip(&passes).filter(|(_, part)| **part == Part::Sraa);
                self.sraa.add(of_sraa.map(|(span, _)| *span).sum());
            }
        }
        Ok(())
    }

    /// Discards the times of earlier frames. Timestamps that have not arrived yet still count.
    #[cfg(any(feature = "window", target_arch = "wasm32"))]
    pub fn clear(&mut self) {
        (self.recorded, self.device, self.sraa) = Default::default();
    }

    /// Returns means since the last call. `None` if there was no frame, or no timestamps have arrived yet.
    pub fn take(&mut self) -> Result<Option<Costs>, Error> {
        self.collect()?;
        if self.timer.is_some() && self.device.1 == 0 {
            return Ok(None);
        }
        let device = self.device.take().map(|all| (all, self.sraa.take()));
        Ok(self.recorded.take().map(|recorded| Costs { recorded, device }))
    }
}
