//! Progress of a study, with the time left; and Ctrl-C, which ends it and keeps what was measured.

use crate::interrupt;
use crate::scene;
use indicatif::ProgressBar;
use straightline_study::progress::Progress;

/// A bar on stderr, and whether Ctrl-C was pressed.
pub struct ProgressBars {
    bar: ProgressBar,
}

impl ProgressBars {
    /// From now on the first Ctrl-C asks the study to stop, and a second one ends the program.
    pub fn new() -> ProgressBars {
        interrupt::defer_interrupt();
        ProgressBars {
            bar: ProgressBar::hidden(),
        }
    }
}

impl ProgressBars {
    /// Takes the bar away, before something is printed.
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
