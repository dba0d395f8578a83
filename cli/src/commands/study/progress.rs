//! Progress of a study with the time left. Ctrl-C ends the study and keeps the measurements.

use crate::interrupt;
use crate::scene;
use indicatif::ProgressBar;
use straightline_study::progress::Progress;

/// Progress bar on stderr, and the state of Ctrl-C.
pub struct ProgressBars {
    bar: ProgressBar,
}

impl ProgressBars {
    /// Starts listening: the first Ctrl-C asks the study to stop, a second one ends the program.
    pub fn new() -> ProgressBars {
        interrupt::defer_interrupt();
        ProgressBars {
            bar: ProgressBar::hidden(),
        }
    }
}

impl ProgressBars {
    /// Removes the bar before other output.
    pub fn clear_bar(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for ProgressBars {
    fn begin(&mut self, what: &str, steps: usize) {
        self.bar.finish_and_clear();
        self.bar = scene::progress_bar(what);
        self.bar.set_length(steps as u64);
    }

    fn step(&mut self) {
        self.bar.inc(1);
    }

    fn is_stopped(&self) -> bool {
        interrupt::is_stop_requested()
    }
}

impl Drop for ProgressBars {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
