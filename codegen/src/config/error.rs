//! Errors of a build.

use crate::files::WriteError;
use std::fmt;
use straightline_evaluator::diagnostic::Errors;

/// All errors of a build.
pub struct Error {
    pub(super) problems: Vec<Problem>,
}

/// A problem with one shader or with the output.
#[derive(Debug, thiserror::Error)]
pub(super) enum Problem {
    #[error(transparent)]
    Kernel(Errors),
    #[error("with {0}:\n{1}")]
    Variant(String, #[source] Errors),
    #[error("variants of `{0}`: {1}")]
    Variants(String, String),
    #[error("in the candidate `{0}`:\n{1}")]
    Candidate(String, #[source] Errors),
    #[error("candidates for `{0}`: {1}")]
    Candidates(String, String),
    #[error("`{0}` is a chain, a set of variants or of candidates, and one shader is wanted: generate it by `Config`")]
    Several(String),
    #[error(transparent)]
    Write(WriteError),
    #[error("`{0}` is built in and has one function: leave `.function(...)` out")]
    Function(String),
    #[error("`{0}` cannot name a module: give the shader another name with `.name(\"...\")`")]
    Name(String),
    #[error("two shaders are called `{0}`: give one of them another name with `.name(\"...\")`")]
    Twice(String),
    #[error(
        "the folder to write to is empty: say `.out_dir(\".\")` for the folder that the build runs in, or leave it out"
    )]
    EmptyFolder,
    #[error("OUT_DIR is not set: call this from build.rs, or say where to write with `.out_dir(...)`")]
    NoFolder,
}

impl Error {
    pub(super) fn from_problem(problem: Problem) -> Self {
        Error {
            problems: vec![problem],
        }
    }

    pub(super) fn from_errors(errors: Errors) -> Self {
        Self::from_problem(Problem::Kernel(errors))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, problem) in self.problems.iter().enumerate() {
            let gap = if k > 0 { "\n" } else { "" };
            write!(f, "{gap}{problem}")?;
        }
        Ok(())
    }
}

/// As `Display`, because `fn main() -> Result<...>` in a `build.rs` prints errors with `Debug`.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Error {
    /// Returns the system's error for the first file that could not be read or written, if there is one.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.problems.iter().find_map(std::error::Error::source)
    }
}
