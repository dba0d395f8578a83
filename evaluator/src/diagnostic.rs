//! Diagnostics of a kernel: message, location and help.

mod code;
mod view;

pub use crate::ir::Span;
pub use code::Code;
use codespan_reporting::diagnostic::Label;
use std::fmt;
use std::sync::Arc;
use view::{Views, printable_message, written_out};

/// A source file, kept to show the code around an error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Path as given.
    pub path: String,
    /// Contents.
    pub text: String,
}

/// An error, or a remark on a kernel without errors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Code of the error; `None` for a remark.
    code: Option<Code>,
    /// Statement of the problem, naming the item concerned.
    pub message: String,
    /// Location in a source file, if there is one.
    pub span: Option<Span>,
    /// Short label at the location.
    pub label: String,
    /// Other relevant locations, each with a short label.
    pub others: Vec<(Span, String)>,
    /// Reasons, where they are not obvious.
    pub notes: Vec<String>,
    /// Suggested fix.
    pub help: Option<String>,
    /// Underlying system error.
    cause: Option<Cause>,
}

#[derive(Clone, Debug)]
struct Cause(Arc<dyn std::error::Error + Send + Sync>);

// A cause is only displayed: no panic leaves it half changed.
impl std::panic::UnwindSafe for Cause {}
impl std::panic::RefUnwindSafe for Cause {}

/// Compares by identity, because system errors are not comparable.
impl PartialEq for Cause {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for Cause {}

impl Diagnostic {
    /// Returns an error at a location.
    pub fn error_at(code: Code, span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            span: Some(span),
            ..Diagnostic::without_place(Some(code), message.into())
        }
    }

    /// Returns an error without a location, for example about an option.
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Diagnostic::without_place(Some(code), message.into())
    }

    /// Returns a remark at a location. A remark is not an error and is shown as a note.
    pub fn remark_at(span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            span: Some(span),
            ..Diagnostic::without_place(None, message.into())
        }
    }

    fn without_place(code: Option<Code>, message: String) -> Self {
        Diagnostic {
            code,
            message,
            span: None,
            label: String::new(),
            others: Vec::new(),
            notes: Vec::new(),
            help: None,
            cause: None,
        }
    }

    /// Code of the error; `None` for a remark.
    pub fn code(&self) -> Option<Code> {
        self.code
    }

    /// Moves an error inside a library function to the call site, because users do not see the library's source.
    pub fn called_at(self, span: Span, function: &str) -> Self {
        if self.span.is_some_and(|at| at.file != Span::LIBRARY) {
            return self;
        }
        let inside = format!("inside of `{function}`");
        let label = if self.label.is_empty() { inside } else { self.label };
        Diagnostic {
            span: Some(span),
            label,
            others: Vec::new(),
            ..self
        }
    }

    /// Returns the error with another code and message, at the same location.
    pub fn restated(self, code: Code, message: String) -> Self {
        Diagnostic {
            code: Some(code),
            message,
            ..self
        }
    }

    /// Sets the label at the location.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds another relevant location.
    pub fn label_at(mut self, span: Span, label: impl Into<String>) -> Self {
        self.others.push((span, label.into()));
        self
    }

    /// Adds a reason.
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Sets the suggested fix.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Sets the underlying system error.
    pub fn caused_by(mut self, cause: impl std::error::Error + Send + Sync + 'static) -> Self {
        self.cause = Some(Cause(Arc::new(cause)));
        self
    }
}

/// All errors found in a kernel, with its source files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Errors {
    /// The errors in order of location; never empty.
    pub diagnostics: Vec<Diagnostic>,
    /// The kernel's files.
    pub files: Arc<Vec<File>>,
}

impl Errors {
    /// Maximum number of errors shown.
    pub const MOST: usize = 50;

    /// Code of the first error.
    pub fn first_code(&self) -> Option<Code> {
        self.diagnostics.first().and_then(Diagnostic::code)
    }

    /// Message of the first error.
    pub fn first_message(&self) -> &str {
        self.diagnostics.first().map_or("refused", |first| &first.message)
    }

    /// Returns a single error without a location.
    pub fn from_diagnostic(diagnostic: Diagnostic) -> Self {
        Errors {
            diagnostics: vec![diagnostic],
            files: Arc::default(),
        }
    }

    /// Returns the errors in `files`, sorted by location. Only the first [`Errors::MOST`] are kept; the last of them notes
    /// how many more there are.
    pub fn new(mut diagnostics: Vec<Diagnostic>, files: &Arc<Vec<File>>) -> Self {
        diagnostics.sort_by_key(|d| d.span);
        diagnostics.dedup();
        let more = diagnostics.len().saturating_sub(Self::MOST);
        if more > 0 {
            diagnostics.truncate(Self::MOST);
            let note = match more {
                1 => "1 further error is not shown".to_owned(),
                _ => format!("{more} further errors are not shown"),
            };
            diagnostics.last_mut().expect("as many as are shown").notes.push(note);
        }
        Errors {
            diagnostics,
            files: files.clone(),
        }
    }
}

impl Errors {
    /// Renders the errors with their source in the style of rustc; in colour for a terminal.
    pub fn render(&self, colour: bool) -> String {
        use codespan_reporting::term::{self, termcolor};
        let mut out = if colour {
            termcolor::Buffer::ansi()
        } else {
            termcolor::Buffer::no_color()
        };
        for diagnostic in &self.diagnostics {
            let places: Vec<Span> = diagnostic
                .span
                .into_iter()
                .chain(diagnostic.others.iter().map(|(span, _)| *span))
                .collect();
            let files = Views::new(&self.files, &places);
            let shown = to_codespan(diagnostic, &files);
            if term::emit_to_write_style(&mut out, &term::Config::default(), &files, &shown).is_err() {
                // The location lies outside its file: print the message without it.
                return self
                    .diagnostics
                    .iter()
                    .map(|d| format!("{}: {}\n", message_prefix(d), printable_message(&d.message)))
                    .collect();
            }
        }
        String::from_utf8_lossy(out.as_slice()).trim_end().to_owned() + "\n"
    }
}

/// First word of an error or a remark, as codespan writes it.
fn message_prefix(diagnostic: &Diagnostic) -> String {
    diagnostic
        .code
        .map_or_else(|| "note".to_owned(), |code| format!("error[{code}]"))
}

fn to_codespan(diagnostic: &Diagnostic, files: &Views) -> codespan_reporting::diagnostic::Diagnostic<usize> {
    use codespan_reporting::diagnostic::Diagnostic as Shown;
    let shown = match diagnostic.code {
        Some(code) => Shown::error().with_code(code.number()),
        None => Shown::note(),
    };
    let mut shown = shown.with_message(printable_message(&diagnostic.message));
    let place = |span: Span| files.shown_range(span).map(|range| (span.file as usize, range));
    if let Some((file, range)) = diagnostic.span.and_then(place) {
        shown = shown.with_label(Label::primary(file, range).with_message(printable_message(&diagnostic.label)));
    }
    for (span, label) in &diagnostic.others {
        if let Some((file, range)) = place(*span) {
            shown = shown.with_label(Label::secondary(file, range).with_message(printable_message(label)));
        }
    }
    for note in &diagnostic.notes {
        shown = shown.with_note(format!("note: {}", printable_message(note)));
    }
    if let Some(help) = &diagnostic.help {
        shown = shown.with_note(format!("help: {}", written_out(help)));
    }
    shown
}

impl fmt::Display for Errors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.render(false).trim_end())
    }
}

impl std::error::Error for Errors {
    /// The first underlying system error, such as that of a file that cannot be read.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        let cause = self.diagnostics.iter().find_map(|diagnostic| diagnostic.cause.as_ref());
        cause.map(|cause| &*cause.0 as &(dyn std::error::Error + 'static))
    }
}
