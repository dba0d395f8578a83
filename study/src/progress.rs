//! Progress of a study, and requests to stop it.

/// Receives the progress of a study, and can ask it to stop.
pub trait Progress {
    /// Announces the next `steps` steps of `what`.
    fn begin(&mut self, what: &str, steps: usize);
    /// Reports that a step is done.
    fn step(&mut self);
    /// Returns whether to stop at once, keeping the results so far.
    fn is_stopped(&self) -> bool;
}

/// Progress that shows nothing and never stops a study.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&mut self, _: &str, _: usize) {}
    fn step(&mut self) {}
    fn is_stopped(&self) -> bool {
        false
    }
}
