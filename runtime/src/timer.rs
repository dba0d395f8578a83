//! Time on the GPU, from timestamp queries at the borders of passes.

use crate::Error;
use crate::guard::{LossProbe, run_guarded};
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use wgpu::{CommandEncoder, Device, Queue};

/// Bytes of one timestamp.
const TICK: u64 = wgpu::QUERY_SIZE as u64;

/// Measures spans of GPU time: of passes recorded with [`Bound::encode_timed`](crate::Bound::encode_timed), or of any
/// pass that is given the writes of a [`Span`].
///
/// Record timed passes, call [`resolve`](Self::resolve) on the same encoder, submit it, then [`read`](Self::read).
/// Several resolves may be under way at once; they are read in the same order.
#[derive(Debug)]
pub struct Timer {
    device: Device,
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    capacity: u32,
    /// Nanoseconds a tick.
    period: f32,
    used: u32,
    batches: VecDeque<Batch>,
    loss_probe: LossProbe,
}

/// Timestamps on their way back.
#[derive(Debug)]
struct Batch {
    /// A separate buffer, so that spans never submitted still read as zeros. `None` without spans.
    readback: Option<wgpu::Buffer>,
    /// The device's answer to the request to map the buffer, still empty while the device works; `None` before the request.
    mapping: Option<Answer>,
}

/// Filled by the callback of a mapping.
type Answer = Arc<Mutex<Option<Result<(), wgpu::BufferAsyncError>>>>;

/// Two timestamps that will be written where a pass begins and ends.
#[derive(Debug)]
pub struct Span<'t> {
    queries: &'t wgpu::QuerySet,
    begin: u32,
}

impl Span<'_> {
    /// For [`wgpu::ComputePassDescriptor::timestamp_writes`].
    pub fn compute_writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: self.queries,
            beginning_of_pass_write_index: Some(self.begin),
            end_of_pass_write_index: Some(self.begin + 1),
        }
    }

    /// For [`wgpu::RenderPassDescriptor::timestamp_writes`].
    pub fn render_writes(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: self.queries,
            beginning_of_pass_write_index: Some(self.begin),
            end_of_pass_write_index: Some(self.begin + 1),
        }
    }
}

impl Timer {
    /// The most spans that a timer can hold.
    pub const MAX_CAPACITY: u32 = wgpu::QUERY_SET_MAX_QUERIES / 2;

    /// A timer for up to `capacity` spans between two calls of [`resolve`](Self::resolve).
    ///
    /// # Errors
    ///
    /// [`Error::MissingFeature`] unless `device` was created with [`wgpu::Features::TIMESTAMP_QUERY`];
    /// [`Error::TimerCapacity`] for 0 or more than [`MAX_CAPACITY`](Self::MAX_CAPACITY); [`Error::TimerPeriod`];
    /// [`Error::DeviceLost`] and [`Error::OutOfMemory`].
    pub fn new(device: &Device, queue: &Queue, capacity: u32) -> Result<Self, Error> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Err(Error::MissingFeature {
                purpose: "a timer",
                feature: "TIMESTAMP_QUERY",
            });
        }
        if !(1..=Self::MAX_CAPACITY).contains(&capacity) {
            return Err(Error::TimerCapacity {
                asked: capacity,
                max: Self::MAX_CAPACITY,
            });
        }
        let period = queue.get_timestamp_period();
        if !(period.is_finite() && period > 0.0) {
            return Err(Error::TimerPeriod { period });
        }
        let doing = "making a timer";
        let loss_probe = LossProbe::new(device, doing)?;
        let (queries, resolved) = run_guarded(device, doing, timer_error, || {
            let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("straightline timer"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * capacity,
            });
            let resolved = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("straightline timer"),
                size: 2 * TICK * u64::from(capacity),
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            });
            (queries, resolved)
        })?;
        loss_probe.check(device, doing)?;
        let batches = VecDeque::new();
        Ok(Timer {
            device: device.clone(),
            queries,
            resolved,
            capacity,
            period,
            used: 0,
            batches,
            loss_probe,
        })
    }

    /// Checks that there is room for `spans` more.
    pub(crate) fn check_room(&self, spans: usize) -> Result<(), Error> {
        match spans <= (self.capacity - self.used) as usize {
            true => Ok(()),
            false => Err(Error::TimerFull {
                capacity: self.capacity,
            }),
        }
    }

    /// The next span, for one pass. It must be recorded: a span that is taken and never written is an error to read.
    ///
    /// # Errors
    ///
    /// [`Error::TimerFull`].
    pub fn span(&mut self) -> Result<Span<'_>, Error> {
        if self.used == self.capacity {
            return Err(Error::TimerFull {
                capacity: self.capacity,
            });
        }
        let begin = 2 * self.used;
        self.used += 1;
        Ok(Span {
            queries: &self.queries,
            begin,
        })
    }

    /// Records the collection of all spans since the last call into `encoder`, after the passes they time.
    ///
    /// # Errors
    ///
    /// [`Error::DeviceLost`] and [`Error::OutOfMemory`]. Nothing has been recorded then, and the spans are kept.
    pub fn resolve(&mut self, encoder: &mut CommandEncoder) -> Result<(), Error> {
        let doing = "resolving a timer";
        self.loss_probe.check(&self.device, doing)?;
        let spans = self.used;
        let readback = match spans {
            0 => None,
            _ => {
                let size = 2 * TICK * u64::from(spans);
                let buffer = run_guarded(&self.device, doing, timer_error, || {
                    self.device.create_buffer(&wgpu::BufferDescriptor {
                        label: Some("straightline timestamps"),
                        size,
                        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                        mapped_at_creation: false,
                    })
                })?;
                encoder.resolve_query_set(&self.queries, 0..2 * spans, &self.resolved, 0);
                encoder.copy_buffer_to_buffer(&self.resolved, 0, &buffer, 0, size);
                Some(buffer)
            }
        };
        self.batches.push_back(Batch {
            readback,
            mapping: None,
        });
        self.used = 0;
        Ok(())
    }

    /// Returns the duration of each span of the oldest unread [`resolve`](Self::resolve), in the order in which they were
    /// recorded.
    /// Waits until the device has run them. In a browser nothing waits: see [`try_read`](Self::try_read).
    ///
    /// A timestamp is as fine as the device makes it; a span too short for it is zero.
    ///
    /// # Errors
    ///
    /// [`Error::TimerNotResolved`] if there is nothing to read; [`Error::TimerNotSubmitted`] if the encoder was not
    /// submitted yet, after which reading can be tried again; [`Error::DeviceLost`]; [`Error::TimerRead`].
    /// If the driver loses the device during the very wait, wgpu 30 panics in `Device::poll`.
    pub fn read(&mut self) -> Result<Vec<Duration>, Error> {
        match self.read_after(wgpu::PollType::wait_indefinitely())? {
            Some(durations) => Ok(durations),
            None => {
                self.forget_mapping();
                Err(timer_error("the buffer was not mapped".to_owned()))
            }
        }
    }

    /// [`read`](Self::read) without waiting: `None` as long as the device has not run the spans. Call it once a frame, say,
    /// after the encoder that was given to [`resolve`](Self::resolve) is submitted, not before: from the first call on,
    /// wgpu refuses to submit it.
    ///
    /// # Errors
    ///
    /// Those of [`read`](Self::read).
    pub fn try_read(&mut self) -> Result<Option<Vec<Duration>>, Error> {
        self.read_after(wgpu::PollType::Poll)
    }

    /// Asks for the oldest batch, lets the device work, and takes the batch if it has come.
    fn read_after(&mut self, poll: wgpu::PollType) -> Result<Option<Vec<Duration>>, Error> {
        let doing = "reading a timer";
        self.loss_probe.check(&self.device, doing)?;
        let batch = self.batches.front_mut().ok_or(Error::TimerNotResolved)?;
        let Some(buffer) = batch.readback.clone() else {
            self.batches.pop_front();
            return Ok(Some(Vec::new()));
        };
        let answer = match &batch.mapping {
            Some(answer) => Arc::clone(answer),
            None => {
                let answer = Answer::default();
                let told = Arc::clone(&answer);
                run_guarded(&self.device, doing, timer_error, || {
                    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
                        *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
                    });
                })?;
                batch.mapping = Some(Arc::clone(&answer));
                answer
            }
        };
        if let Err(error) = self.device.poll(poll) {
            self.forget_mapping();
            return Err(timer_error(error.to_string()));
        }
        let answered = answer.lock().unwrap_or_else(PoisonError::into_inner).take();
        match answered {
            None => return Ok(None),
            Some(Ok(())) => {}
            Some(Err(error)) => {
                self.forget_mapping();
                self.loss_probe.check(&self.device, doing)?;
                return Err(timer_error(error.to_string()));
            }
        }
        let ticks = read_ticks(&buffer);
        self.forget_mapping();
        let ticks = ticks?;
        if ticks.contains(&[0, 0]) {
            return Err(Error::TimerNotSubmitted);
        }
        self.batches.pop_front();
        let durations = ticks
            .into_iter()
            .map(|[begin, end]| self.ticks_to_duration(end.saturating_sub(begin)));
        Ok(Some(durations.collect()))
    }

    /// Unmaps the oldest batch, so that it can be submitted, or asked for again.
    fn forget_mapping(&mut self) {
        if let Some(batch) = self.batches.front_mut()
            && let Some(buffer) = &batch.readback
            && batch.mapping.take().is_some()
        {
            buffer.unmap();
        }
    }

    fn ticks_to_duration(&self, ticks: u64) -> Duration {
        let seconds = ticks as f64 * f64::from(self.period) * 1e-9;
        // Out of range only for a nonsensical difference of centuries.
        Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
    }
}

/// Begin and end of each span in a mapped buffer, in ticks.
fn read_ticks(buffer: &wgpu::Buffer) -> Result<Vec<[u64; 2]>, Error> {
    let bytes = buffer
        .get_mapped_range(..)
        .map_err(|error| timer_error(error.to_string()))?;
    let (words, _) = bytes.as_chunks::<8>();
    let ticks: Vec<u64> = words.iter().map(|word| u64::from_le_bytes(*word)).collect();
    let (pairs, _) = ticks.as_chunks::<2>();
    Ok(pairs.to_vec())
}

fn timer_error(description: String) -> Error {
    Error::TimerRead { description }
}
