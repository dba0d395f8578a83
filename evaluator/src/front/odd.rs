//! Characters that no token of Rust begins with, and that editors do not show.

use crate::diagnostic::{Code, Diagnostic, Span};

/// Error for a text that could not be read beyond a place: names a character there that Rust does not accept, or else the first character
/// of the text that editors hide. `None` if the text has neither.
pub fn character_error(file: u32, text: &str, reached: Span) -> Option<Diagnostic> {
    let from = reached.start as usize;
    let rest = text.get(from..)?;
    let there = rest
        .chars()
        .next()
        .filter(|c| !c.is_ascii() || c.is_ascii_control() && !c.is_ascii_whitespace());
    let (at, c) = match there {
        Some(c) => (from, c),
        None => find_hidden_char(text)?,
    };
    let (what, help) = match c {
        '\0' => ("a NUL byte".to_owned(), "save the file as UTF-8"),
        '\u{feff}' => (
            "a byte order mark inside of the text".to_owned(),
            "delete it: it may only be the first character",
        ),
        '\r' => (
            "a carriage return without a line feed".to_owned(),
            "save the file with line ends of LF or CRLF, as rustc reads it",
        ),
        c if c.is_control() || c.is_whitespace() => (
            format!("the character U+{:04X}", u32::from(c)),
            "delete it, or write a space",
        ),
        c => (
            format!("the character `{c}` (U+{:04X})", u32::from(c)),
            "write it in ASCII, or inside of a comment",
        ),
    };
    let span = at_byte(file, text, at, c.len_utf8());
    Some(
        Diagnostic::error_at(Code::Syntax, span, format!("not valid Rust: {what}"))
            .label("here")
            .help(help),
    )
}

/// The first character that editors hide and that Rust does not take everywhere.
fn find_hidden_char(text: &str) -> Option<(usize, char)> {
    let mut before = None;
    for (at, c) in text.char_indices() {
        if let Some((at, '\r')) = before
            && c != '\n'
        {
            return Some((at, '\r'));
        }
        if c == '\0' || c == '\u{feff}' {
            return Some((at, c));
        }
        before = Some((at, c));
    }
    before.filter(|(_, c)| *c == '\r')
}

fn at_byte(file: u32, text: &str, at: usize, len: usize) -> Span {
    let before = &text[..at];
    let line = before.rfind('\n').map_or(0, |end| end + 1);
    Span {
        file,
        start: at as u32,
        end: (at + len) as u32,
        line: before.matches('\n').count() as u32 + 1,
        column: before[line..].chars().count() as u32 + 1,
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::File;
    use std::sync::Arc;

    /// The first error of a text: its place and its message.
    fn first_error(text: &str) -> Option<(u32, u32, String)> {
        let file = File {
            path: "k.rs".to_owned(),
            text: text.to_owned(),
        };
        let errors = crate::front::parse(&Arc::new(vec![file]), "k").err()?;
        let first = &errors.diagnostics[0];
        first.span.map(|span| (span.line, span.column, first.message.clone()))
    }

    #[test]
    fn what_editors_hide_is_named_with_its_place() {
        let kernel = "pub fn k(pixel: IVec2) -> f32 {\n    1.0\n}\n";
        assert_eq!(first_error(kernel), None);
        assert_eq!(first_error(&kernel.replace('\n', "\r\n")), None);
        let wrong = |text: String, place: (u32, u32), what: &str| {
            let (line, column, message) = first_error(&text).expect("an error");
            assert_eq!((line, column), place, "{message}");
            assert_eq!(message, format!("not valid Rust: {what}"));
        };
        wrong(kernel.replace("1.0", "1.0\0"), (2, 8), "a NUL byte");
        wrong(
            kernel.replace("1.0", "\u{feff}1.0"),
            (2, 5),
            "a byte order mark inside of the text",
        );
        wrong(
            kernel.replace("1.0", "1.0 \u{201c}"),
            (2, 9),
            "the character `\u{201c}` (U+201C)",
        );
        wrong(
            kernel.replace('\n', "\r") + "/// a\rb\nfn",
            (1, 32),
            "a carriage return without a line feed",
        );
    }
}
