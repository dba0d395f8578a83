//! A user who presses Ctrl-C.

use straightline_study::progress::Progress;

/// Asks to stop after so many steps.
#[derive(Clone, Copy, Debug)]
pub struct StopsAfter(pub usize);

impl Progress for StopsAfter {
    fn begin(&mut self, _: &str, _: usize) {}

    fn step(&mut self) {
        self.0 = self.0.saturating_sub(1);
    }

    fn is_stopped(&self) -> bool {
        self.0 == 0
    }
}
