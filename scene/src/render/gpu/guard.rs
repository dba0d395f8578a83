//! wgpu's errors as values.

use crate::render::RenderError;
use std::future::Future;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

/// Runs `work`, and returns wgpu's error during it, if any.
///
/// Without a scope wgpu passes errors to the device's own handler, which by default panics.
///
/// # Errors
///
/// [`RenderError::Device`] with `doing` and wgpu's message.
pub fn with_error_scope<T>(
    device: &wgpu::Device,
    doing: &'static str,
    work: impl FnOnce() -> T,
) -> Result<T, RenderError> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let value = work();
    let errors = [
        at_once(validation.pop()),
        at_once(internal.pop()),
        at_once(memory.pop()),
    ];
    match errors.into_iter().flatten().next() {
        Some(error) => Err(device_error(doing, error)),
        None => Ok(value),
    }
}

/// That the device failed.
pub(super) fn device_error(doing: &'static str, error: impl std::fmt::Display) -> RenderError {
    RenderError::Device {
        doing,
        description: error.to_string().trim().to_owned(),
    }
}

/// The result of popping a scope, which native backends have ready.
fn at_once(future: impl Future<Output = Option<wgpu::Error>>) -> Option<wgpu::Error> {
    match pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(error) => error,
        Poll::Pending => None,
    }
}
