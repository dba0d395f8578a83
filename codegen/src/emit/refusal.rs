//! Reasons why a kernel cannot be emitted: errors without a source location yet.

use crate::compiled::Compiled;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors};

/// An error of emission, created without access to the kernel's source. [`Compiled::locate_error`] adds the location.
#[derive(Debug)]
pub struct Refusal(Box<Parts>);

#[derive(Debug)]
struct Parts {
    diagnostic: Diagnostic,
    /// Name of the input that the error concerns.
    input: Option<String>,
}

impl Refusal {
    /// Creates an error about the kernel.
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Refusal(Box::new(Parts {
            diagnostic: Diagnostic::new(code, message),
            input: None,
        }))
    }

    /// Creates the error for an emitted text that a validator rejects: a bug of the emitter.
    pub fn invalid_text(kernel: &str, target: &str, message: &str) -> Self {
        Refusal::new(
            Code::InvalidText,
            format!("the {target} text of `{kernel}` is not valid"),
        )
        .note(message)
        .help("this is a mistake in Straightline, not in the kernel: please report it with the kernel's source")
    }

    /// Creates the error for an entry point or function with an invalid name, with the reason.
    pub fn entry_name(kernel: &str, name: &str, why: &str) -> Self {
        Refusal::new(
            Code::EntryName,
            format!("the entry point of `{kernel}` cannot be called `{name}`, which {why}"),
        )
        .help("give it another name")
    }

    /// Creates the error for an invalid binding number, register or group.
    pub fn invalid_binding(kernel: &str, what: &str, help: impl Into<String>) -> Self {
        Refusal::new(Code::Binding, format!("`{kernel}` cannot be bound so: {what}")).help(help)
    }

    /// Creates the error for a kernel that cannot be a function, with the reason.
    pub fn no_function_form(kernel: &str, why: &str, help: impl Into<String>) -> Self {
        Refusal::new(Code::FunctionForm, format!("`{kernel}` cannot be a function: {why}")).help(help)
    }

    /// Names the input that the error concerns.
    pub fn about_input(mut self, input: &str) -> Self {
        self.0.input = Some(input.to_owned());
        self
    }

    /// Adds the help.
    pub fn help(self, help: impl Into<String>) -> Self {
        self.map_diagnostic(|diagnostic| diagnostic.help(help))
    }

    /// Adds a reason.
    pub fn note(self, note: impl Into<String>) -> Self {
        self.map_diagnostic(|diagnostic| diagnostic.note(note))
    }

    fn map_diagnostic(self, change: impl FnOnce(Diagnostic) -> Diagnostic) -> Self {
        let Parts { diagnostic, input } = *self.0;
        let diagnostic = change(diagnostic);
        Refusal(Box::new(Parts { diagnostic, input }))
    }

    /// Returns the error with its source location.
    pub fn into_errors(self, compiled: &Compiled) -> Errors {
        compiled.locate_error(self.0.diagnostic, self.0.input.as_deref())
    }
}

impl Compiled {
    /// Returns an error about the compiled kernel, located at `input`, or else at the kernel's name.
    ///
    /// `input` is the name of a parameter, or of a part of a structure or array, such as `light_color`. A kernel without
    /// source has no locations.
    pub fn locate_error(&self, mut error: Diagnostic, input: Option<&str>) -> Errors {
        let named = input.and_then(|input| {
            // Parts of structures and arrays have the names of the parameter and the part.
            let is_part = |name: &str| {
                input
                    .strip_prefix(name)
                    .is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
            };
            let inputs = self.places.inputs.iter().filter(|(name, _)| is_part(name));
            inputs.max_by_key(|(name, _)| name.len()).map(|(_, span)| *span)
        });
        let label = if named.is_some() { "this input" } else { "this kernel" };
        if let Some(span) = named.or(self.places.kernel) {
            error.span = Some(span);
            error.label = label.to_owned();
        }
        Errors {
            diagnostics: vec![error],
            files: Arc::clone(&self.places.files),
        }
    }
}
