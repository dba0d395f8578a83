//! Failure of the command line: one error on stderr; exit status 2 for wrong usage, 130 for an interrupt and 1 for everything
//! else.

use crate::output;
use std::fmt::Display;
use std::io::IsTerminal;
use std::process::ExitCode;
use straightline_codegen::diagnostic::{Code, Errors};

/// Exit status of an interrupted program, by the convention of shells.
pub const INTERRUPTED: u8 = 130;

/// Reason why a command could not do what was requested.
#[derive(Debug)]
pub enum Failure {
    /// The request is wrong, or names something that does not exist.
    Usage(String),
    /// The command failed at its work.
    Failed(String),
    /// An interrupt ended the work early; results until then are kept.
    #[cfg(feature = "study")]
    Interrupted(String),
    /// The kernel, or one of its settings, is wrong.
    Kernel(Errors),
}

impl Failure {
    /// Creates a failure from any error value.
    pub fn from_error(error: impl Display) -> Failure {
        Failure::Failed(error.to_string())
    }

    /// Prints the failure and returns the exit status.
    pub fn report(self) -> ExitCode {
        match self {
            Failure::Usage(message) => {
                errln!("error: {}", output::limit_lines(&message));
                ExitCode::from(2)
            }
            Failure::Failed(message) => {
                errln!("error: {}", output::limit_lines(&message));
                ExitCode::from(1)
            }
            #[cfg(feature = "study")]
            Failure::Interrupted(message) => {
                errln!("error: {}", output::limit_lines(&message));
                ExitCode::from(INTERRUPTED)
            }
            Failure::Kernel(errors) => {
                // An unknown kernel, option or value has no source file: a usage error. Emission errors (codes beginning
                // with E07) of built-in kernels have no span either, but are not usage errors.
                let usage = errors
                    .diagnostics
                    .iter()
                    .all(|d| d.span.is_none() && d.code() < Some(Code::VisibleLoss));
                output::note(format_args!(
                    "{}",
                    output::limit_lines(&errors.render(std::io::stderr().is_terminal()))
                ));
                ExitCode::from(if usage { 2 } else { 1 })
            }
        }
    }
}

/// Formats a count with its noun: `1 error`, `2 errors`.
pub fn format_count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

impl From<Errors> for Failure {
    fn from(errors: Errors) -> Self {
        Failure::Kernel(errors)
    }
}
