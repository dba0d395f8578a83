//! Turns wgpu's two silent or fatal ways of failing into values: error scopes, and a lost device.

use crate::Error;
use std::future::Future;
use std::pin::pin;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Waker};

/// Runs `work` and returns wgpu's error during it, if any.
///
/// Without a scope, wgpu passes errors to the device's handler, which by default panics; and the handler is the caller's.
/// Scopes are kept per thread, so other threads' errors do not end up here.
pub(crate) fn run_scoped<T>(device: &wgpu::Device, work: impl FnOnce() -> T) -> Result<T, wgpu::Error> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let value = work();
    // All are popped, innermost first, before the first error is returned.
    let errors = [
        at_once(validation.pop()),
        at_once(internal.pop()),
        at_once(memory.pop()),
    ];
    match errors.into_iter().flatten().next() {
        Some(error) => Err(error),
        None => Ok(value),
    }
}

/// Runs `work` as [`run_scoped`] does. Out-of-memory becomes [`Error::OutOfMemory`]; `describe` makes the error of all else.
pub(crate) fn run_guarded<T>(
    device: &wgpu::Device,
    doing: &str,
    describe: impl FnOnce(String) -> Error,
    work: impl FnOnce() -> T,
) -> Result<T, Error> {
    run_scoped(device, work).map_err(|error| match error {
        wgpu::Error::OutOfMemory { .. } => Error::OutOfMemory {
            doing: doing.to_owned(),
        },
        other => describe(other.to_string().trim().to_owned()),
    })
}

/// The result of popping a scope. Native backends have it ready; where it is not, the error goes unseen rather
/// than blocking a thread that must not block.
fn at_once(future: impl Future<Output = Option<wgpu::Error>>) -> Option<wgpu::Error> {
    match pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(error) => error,
        Poll::Pending => None,
    }
}

/// Tells whether a device still works.
///
/// wgpu announces a lost device only to the callback of `set_device_lost_callback`, of which there is one and it
/// belongs to the caller. Everything else keeps quiet: creating a resource on a lost device succeeds and yields a
/// dead object. The exception is a request to map a buffer, whose own callback is refused at once. So this keeps
/// four bytes to ask with; no command ever touches them, and the mapping is withdrawn again.
#[derive(Debug)]
pub(crate) struct LossProbe {
    buffer: Mutex<wgpu::Buffer>,
}

/// wgpu's response to a request to map a buffer.
enum Answer {
    /// The buffer will be mapped.
    Accepted,
    /// Refused without a word: the device is lost, which is checked before the state of the buffer.
    Silent,
    /// Refused with an error about the buffer.
    Explained,
}

impl LossProbe {
    /// A loss_probe of `device`, or [`Error::DeviceLost`] if it has none already.
    pub(crate) fn new(device: &wgpu::Device, doing: &str) -> Result<Self, Error> {
        let lost = || Error::DeviceLost {
            doing: doing.to_owned(),
        };
        let buffer = run_guarded(
            device,
            doing,
            |_| lost(),
            || {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("straightline loss_probe"),
                    size: wgpu::COPY_BUFFER_ALIGNMENT,
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            },
        )?;
        match try_mapping(device, &buffer) {
            Answer::Accepted => Ok(LossProbe {
                buffer: Mutex::new(buffer),
            }),
            // No other code uses the buffer, so any refusal means that it was created invalid: the device was lost by then.
            Answer::Silent | Answer::Explained => Err(lost()),
        }
    }

    /// [`Error::DeviceLost`] if `device` is lost or was destroyed.
    pub(crate) fn check(&self, device: &wgpu::Device, doing: &str) -> Result<(), Error> {
        // The lock admits one question at a time: while wgpu believes the buffer to be mapped, it answers without asking the
        // device.
        let buffer = self.buffer.lock().unwrap_or_else(PoisonError::into_inner);
        match try_mapping(device, &buffer) {
            // Explained: another thread's submission carried out an earlier mapping just when it was withdrawn.
            Answer::Accepted | Answer::Explained => Ok(()),
            Answer::Silent => Err(Error::DeviceLost {
                doing: doing.to_owned(),
            }),
        }
    }
}

/// Asks for a mapping and withdraws it.
fn try_mapping(device: &wgpu::Device, buffer: &wgpu::Buffer) -> Answer {
    let refused = Arc::new(AtomicBool::new(false));
    let answer = Arc::clone(&refused);
    let request = run_scoped(device, || {
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            if result.is_err() {
                answer.store(true, Ordering::Release);
            }
        });
        // Read before withdrawing, which itself refuses a mapping that is still waiting.
        refused.load(Ordering::Acquire)
    });
    // There may be nothing to withdraw, which wgpu thinks an error.
    let _ = run_scoped(device, || buffer.unmap());
    match request {
        Ok(false) => Answer::Accepted,
        Ok(true) => Answer::Silent,
        Err(_) => Answer::Explained,
    }
}
