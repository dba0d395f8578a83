//! What is wrong with a kernel, where, and what to do about it.

use std::fmt;
use std::sync::Arc;

/// A stretch of a source file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// Index of the file in [`Errors::files`].
    pub file: u32,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Line of the first byte, from 1.
    pub line: u32,
    /// Column of the first byte in characters, from 1.
    pub column: u32,
}

/// A source file, for showing where an error is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Path as given.
    pub path: String,
    /// Contents.
    pub text: String,
}

/// One error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, naming the thing.
    pub message: String,
    /// Where, if it is in a file.
    pub span: Option<Span>,
    /// A few words at the place.
    pub label: String,
    /// The way out.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error at a place.
    pub fn at(span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            message: message.into(),
            span: Some(span),
            label: String::new(),
            help: None,
        }
    }

    /// An error that is in no file: an option, say.
    pub fn new(message: impl Into<String>) -> Self {
        Diagnostic {
            message: message.into(),
            span: None,
            label: String::new(),
            help: None,
        }
    }

    /// With a few words at the place.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// With the way out.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// Every error that was found, with the files that they are in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Errors {
    /// In order of place; at least one.
    pub diagnostics: Vec<Diagnostic>,
    /// The kernel's files.
    pub files: Arc<Vec<File>>,
}

impl Errors {
    /// One error that is in no file.
    pub fn of(diagnostic: Diagnostic) -> Self {
        Errors {
            diagnostics: vec![diagnostic],
            files: Arc::default(),
        }
    }

    /// Errors in `files`, sorted by place.
    pub fn new(mut diagnostics: Vec<Diagnostic>, files: &Arc<Vec<File>>) -> Self {
        diagnostics.sort_by_key(|d| d.span);
        diagnostics.dedup();
        Errors {
            diagnostics,
            files: files.clone(),
        }
    }
}

impl fmt::Display for Errors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, diagnostic) in self.diagnostics.iter().enumerate() {
            if k > 0 {
                f.write_str("\n")?;
            }
            if let Some(span) = diagnostic.span
                && let Some(file) = self.files.get(span.file as usize)
            {
                write!(f, "{}:{}:{}: ", file.path, span.line, span.column)?;
            }
            f.write_str(&diagnostic.message)?;
            if !diagnostic.label.is_empty() {
                write!(f, " ({})", diagnostic.label)?;
            }
            if let Some(help) = &diagnostic.help {
                write!(f, "\n  help: {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Errors {}
