//! Results of tests.

use straightline_evaluator::diagnostic::Errors;

/// Result of a test.
#[derive(Debug)]
pub enum Verdict {
    /// All assertions hold.
    Passed(Passed),
    /// An assertion fails, or the test could not be run.
    Failed(Box<Failure>),
}

/// A test that holds.
#[derive(Debug)]
pub struct Passed {
    /// Cases that `assume` did not pass over.
    pub cases: usize,
    /// A remark if an assertion fails in `f64` alone.
    pub note: Option<Errors>,
}

/// A test that fails.
#[derive(Debug)]
pub struct Failure {
    /// The failure with its place.
    pub errors: Errors,
    /// The runner on which it fails; `None` if it could not be run.
    pub runner: Option<String>,
    /// The minimised arguments, or the pixel, as Rust statements.
    pub inputs: Vec<String>,
    /// The assertion's values, left and right, as Rust text.
    pub values: [Option<String>; 2],
    /// Their distance in units of the last place.
    pub ulps: Option<u32>,
    /// Ratio of peak signal to noise of a picture that differs, in decibels.
    pub psnr: Option<f64>,
}

impl Failure {
    /// A test that could not be run, or fails without values.
    pub fn from_errors(errors: Errors) -> Failure {
        Failure {
            errors,
            runner: None,
            inputs: Vec::new(),
            values: [None, None],
            ulps: None,
            psnr: None,
        }
    }
}
