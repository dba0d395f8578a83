//! Who looks on while a study runs.

/// Who is told how far a study is, and says whether to stop.
pub trait Watch {
    /// `steps` steps of `what` come next.
    fn begin(&mut self, what: &str, steps: usize);
    /// One of them is done.
    fn step(&mut self);
    /// Whether to stop at once, and keep what was measured.
    fn stopped(&self) -> bool;
}

/// Nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn begin(&mut self, _: &str, _: usize) {}
    fn step(&mut self) {}
    fn stopped(&self) -> bool {
        false
    }
}
