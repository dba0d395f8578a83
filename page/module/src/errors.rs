//! Errors of a kernel, as the page shows them: places are in UTF-16, as a text area counts.

use serde::Serialize;
use straightline_codegen::diagnostic::{Code, Diagnostic, Errors, File, Span};

/// Reason why nothing was produced.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Refusal {
    /// All of it, as a terminal would have it.
    pub text: String,
    /// The single errors.
    pub errors: Vec<Error>,
}

/// An error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Error {
    /// Code of the error, such as `E0301`.
    pub code: Option<&'static str>,
    /// Statement of the error.
    pub message: String,
    /// A few words at the place.
    pub label: String,
    /// Place of the error, if it is in a file.
    pub place: Option<Place>,
    /// Other places that matter.
    pub others: Vec<(Place, String)>,
    /// Reasons.
    pub notes: Vec<String>,
    /// Suggestion of other code.
    pub help: Option<String>,
}

/// A stretch of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Index of the file among the kernel's.
    pub file: usize,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// First UTF-16 unit of the file's text.
    pub from: usize,
    /// UTF-16 unit after the last.
    pub to: usize,
}

impl Refusal {
    /// For one reason that is in no file.
    pub fn from_message(message: &str) -> Refusal {
        Refusal {
            text: format!("error: {message}"),
            errors: vec![Error {
                code: None,
                message: message.to_owned(),
                label: String::new(),
                place: None,
                others: Vec::new(),
                notes: Vec::new(),
                help: None,
            }],
        }
    }
}

impl From<Errors> for Refusal {
    fn from(errors: Errors) -> Refusal {
        let one = |diagnostic: &Diagnostic| Error {
            code: diagnostic.code().map(Code::number),
            message: diagnostic.message.clone(),
            label: diagnostic.label.clone(),
            place: diagnostic.span.and_then(|span| find_place(&errors.files, span)),
            others: diagnostic
                .others
                .iter()
                .filter_map(|(span, label)| Some((find_place(&errors.files, *span)?, label.clone())))
                .collect(),
            notes: diagnostic.notes.clone(),
            help: diagnostic.help.clone(),
        };
        Refusal {
            text: errors.render(false),
            errors: errors.diagnostics.iter().map(one).collect(),
        }
    }
}

/// Converts a span to a place; `None` if it is in none of the files, such as the generator's own.
fn find_place(files: &[File], span: Span) -> Option<Place> {
    let text = &files.get(span.file as usize)?.text;
    let units = |byte: u32| Some(text.get(..byte as usize)?.encode_utf16().count());
    Some(Place {
        file: span.file as usize,
        line: span.line,
        column: span.column,
        from: units(span.start)?,
        to: units(span.end)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_codegen::{Kernel, Settings};

    #[test]
    fn places_count_as_a_text_area_does() {
        let text = "// 𝛕 is tau\npub fn k(pixel: IVec2) -> Vec4 { nothing() }";
        let kernel = Kernel::from_text("k.rs", text, "k");
        let refusal = Refusal::from(kernel.compile(&Settings::default()).expect_err("no such function"));
        let place = refusal.errors[0].place.clone().expect("a place");
        let units: Vec<u16> = text.encode_utf16().collect();
        let found = String::from_utf16(&units[place.from..place.to]).expect("text");
        assert!(found.starts_with("nothing"), "{found}");
        assert_eq!((place.line, place.file), (2, 0));
    }
}
