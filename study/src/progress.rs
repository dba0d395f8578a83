//! How far a study is, and whether to stop it.

/// Is told how far a study is, and says whether to stop.
pub trait Progress {
    /// `steps` steps of `what` come next.
    fn begin(&mut self, what: &str, steps: usize);
    /// One of them is done.
    fn step(&mut self);
    /// Whether to stop at once, and keep what was measured.
    fn stopped(&self) -> bool;
}

/// Shows nothing and never stops a study.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&mut self, _: &str, _: usize) {}
    fn step(&mut self) {}
    fn stopped(&self) -> bool {
        false
    }
}
