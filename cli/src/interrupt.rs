//! Ctrl-C and termination signals: no unfinished file is left on the disk.

use crate::failure::{Failure, INTERRUPTED};
use std::sync::atomic::{AtomicBool, Ordering};
use straightline_codegen::files;

/// `true` if the first Ctrl-C only requests a stop, because the running command keeps its measurements.
static ASKS: AtomicBool = AtomicBool::new(false);

/// `true` after Ctrl-C requested a stop.
static PRESSED: AtomicBool = AtomicBool::new(false);

/// Installs the handler for the lifetime of the program. Unless [`defer_interrupt`] was called, an interrupt removes
/// unfinished files and ends the program.
pub fn listen_for_interrupt() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        if ASKS.load(Ordering::SeqCst) && !PRESSED.swap(true, Ordering::SeqCst) {
            errln!("\nstopping; what was measured is kept (Ctrl-C again ends at once)");
            return;
        }
        files::remove_unfinished();
        std::process::exit(INTERRUPTED.into());
    })
    .map_err(|error| Failure::Failed(format!("cannot listen to Ctrl-C: {error}")))
}

/// Makes the first interrupt only request a stop.
#[cfg(feature = "study")]
pub fn defer_interrupt() {
    ASKS.store(true, Ordering::SeqCst);
}

/// Returns whether Ctrl-C requested a stop.
#[cfg(feature = "study")]
pub fn is_stop_requested() -> bool {
    PRESSED.load(Ordering::SeqCst)
}
