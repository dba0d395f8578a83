//! Ctrl-C, and the signals by which a system ends programs: nothing unfinished is left on the disk.

use crate::failure::Failure;
use std::sync::atomic::{AtomicBool, Ordering};
use straightline_codegen::files;

/// True if a first Ctrl-C only asks to stop: set while something runs that keeps what it has measured.
static ASKS: AtomicBool = AtomicBool::new(false);

/// True once Ctrl-C asked to stop.
static PRESSED: AtomicBool = AtomicBool::new(false);

/// Exit status of a program that was interrupted, as shells have it.
const INTERRUPTED: i32 = 130;

/// Listens for the program's whole life. Where nothing asks to be stopped, an interrupt removes unfinished files and ends
/// the program.
pub fn listen_for_interrupt() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        if ASKS.load(Ordering::SeqCst) && !PRESSED.swap(true, Ordering::SeqCst) {
            errln!("\nstopping; what was measured is kept (Ctrl-C again ends at once)");
            return;
        }
        files::remove_unfinished();
        std::process::exit(INTERRUPTED);
    })
    .map_err(|error| Failure::Failed(format!("cannot listen to Ctrl-C: {error}")))
}

/// From now on a first interrupt only asks to stop.
#[cfg(feature = "study")]
pub fn defer_interrupt() {
    ASKS.store(true, Ordering::SeqCst);
}

/// Returns whether Ctrl-C asked to stop.
#[cfg(feature = "study")]
pub fn is_stop_requested() -> bool {
    PRESSED.load(Ordering::SeqCst)
}
