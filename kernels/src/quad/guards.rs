//! The promise by which filters of quads leave out their tests of inputs.

/// Tests of inputs that are no numbers, infinite, or too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guards {
    /// Inputs are tested: the result is finite whatever comes, and a lane with a bad input spoils no other.
    Inline,
    /// No tests: a promise that inputs are finite and in the ranges that the filter's description states.
    None,
}
