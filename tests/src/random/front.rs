//! Robustness of the generator against arbitrary text.

use super::forms::is_internal;
use std::sync::mpsc;
use std::time::Duration;
use straightline_codegen::{Kernel, Settings};

/// Longest that one text may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// Compiles a text that may be anything. Gives whether it is a kernel.
///
/// # Errors
///
/// A panic, or a text that takes longer than ten seconds (which then goes on in a thread of its own).
pub fn survives(text: &str, function: &str) -> Result<bool, String> {
    let kernel = Kernel::from_text("mutated.rs", text, function);
    let (send, receive) = mpsc::channel();
    std::thread::spawn(move || {
        let outcome = std::panic::catch_unwind(|| kernel.compile(&Settings::default()).map(|_| ()));
        // The receiver is gone if the text took too long.
        let _ = send.send(outcome);
    });
    match receive.recv_timeout(PATIENCE) {
        Ok(Ok(Ok(()))) => Ok(true),
        Ok(Ok(Err(errors))) if is_internal(&errors) => Err(errors.to_string()),
        Ok(Ok(Err(_))) => Ok(false),
        Ok(Err(_)) => Err("it panicked".to_owned()),
        Err(_) => Err(format!("it takes longer than {PATIENCE:?}")),
    }
}
