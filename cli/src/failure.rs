//! How the command line fails: one clear error on stderr, exit status 2 for bad use and 1 for all else.

use codespan_reporting::diagnostic::{Diagnostic, Label};
use codespan_reporting::files::SimpleFiles;
use codespan_reporting::term::{self, termcolor};
use std::fmt::Display;
use std::io::IsTerminal;
use std::process::ExitCode;
use straightline_codegen::diagnostic::Errors;

/// Why a command ended without doing what it was asked.
#[derive(Debug)]
pub enum Failure {
    /// It was asked for something that there is not.
    Usage(String),
    /// It could not do it.
    Failed(String),
    /// The kernel, or a setting of it, is wrong.
    Kernel(Errors),
}

impl Failure {
    /// A failure of any error value.
    pub fn of(error: impl Display) -> Failure {
        Failure::Failed(error.to_string())
    }

    /// Prints the failure and gives the exit status.
    pub fn report(self) -> ExitCode {
        match self {
            Failure::Usage(message) => {
                eprintln!("error: {message}");
                ExitCode::from(2)
            }
            Failure::Failed(message) => {
                eprintln!("error: {message}");
                ExitCode::from(1)
            }
            Failure::Kernel(errors) => {
                // An unknown kernel, option or value is in no file: a mistake of the command line's.
                let usage = errors.diagnostics.iter().all(|d| d.span.is_none());
                render(&errors);
                ExitCode::from(if usage { 2 } else { 1 })
            }
        }
    }
}

impl From<Errors> for Failure {
    fn from(errors: Errors) -> Self {
        Failure::Kernel(errors)
    }
}

/// Prints errors as rustc does, with the source.
fn render(errors: &Errors) {
    let mut files = SimpleFiles::new();
    let ids: Vec<usize> = errors
        .files
        .iter()
        .map(|f| files.add(f.path.as_str(), f.text.as_str()))
        .collect();
    // `Auto` looks at the environment, not at whether anybody sees it.
    let color = if std::io::stderr().is_terminal() {
        termcolor::ColorChoice::Auto
    } else {
        termcolor::ColorChoice::Never
    };
    let mut out = termcolor::StandardStream::stderr(color);
    for error in &errors.diagnostics {
        let mut shown = Diagnostic::error().with_message(&error.message);
        if let Some(span) = error.span
            && let Some(id) = ids.get(span.file as usize)
        {
            let label = Label::primary(*id, span.start as usize..span.end as usize).with_message(&error.label);
            shown = shown.with_label(label);
        }
        if let Some(help) = &error.help {
            shown = shown.with_note(format!("help: {help}"));
        }
        let rendered = term::emit_to_write_style(&mut out, &term::Config::default(), &files, &shown);
        if rendered.is_err() {
            eprintln!("error: {errors}");
            return;
        }
    }
}
