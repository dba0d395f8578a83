//! Input tests of quad filters, and the promise that replaces them.

/// Tests for inputs that are NaN, infinite, or too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guards {
    /// Inputs are tested. The result is always finite, and a lane with a bad input does not affect the others.
    Inline,
    /// No tests. This is a promise that inputs are finite and in the ranges that the filter's description states.
    None,
}
