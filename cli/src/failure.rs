//! Failure of the command line: one clear error on stderr, exit status 2 for bad use and 1 for all else.

use crate::output;
use std::fmt::Display;
use std::io::IsTerminal;
use std::process::ExitCode;
use straightline_codegen::diagnostic::{Code, Errors};

/// Why a command ended without doing what it was asked.
#[derive(Debug)]
pub enum Failure {
    /// The request is wrong or names something that does not exist.
    Usage(String),
    /// The command could not do its work.
    Failed(String),
    /// The kernel, or a setting of it, is wrong.
    Kernel(Errors),
}

impl Failure {
    /// A failure of any error value.
    pub fn from_error(error: impl Display) -> Failure {
        Failure::Failed(error.to_string())
    }

    /// Prints the failure and gives the exit status.
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
            Failure::Kernel(errors) => {
                // An unknown kernel, option or value is in no file: a mistake of the command line's. Built-in kernels have no
                // places in emission, whose codes begin with E07.
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

/// A number with its noun: `1 error`, `2 errors`.
pub fn format_count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

impl From<Errors> for Failure {
    fn from(errors: Errors) -> Self {
        Failure::Kernel(errors)
    }
}
