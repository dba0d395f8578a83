//! Source text as shown next to an error: control characters are escaped, and lines that are too long are cut to the part
//! around the error.

use super::{File, Span};
use codespan_reporting::files::{Error, Files};
use std::ops::Range;

/// Maximum number of characters shown of a line.
const WIDTH: usize = 120;

/// Maximum number of these characters before the location of the error.
const BEFORE: usize = 40;

/// Maximum number of characters shown of a message.
const MESSAGE: usize = 500;

/// The source files of one error.
pub struct Views(Vec<View>);

struct View {
    path: String,
    text: String,
    /// Byte in `text` at which each line begins.
    lines: Vec<usize>,
    /// Lines whose shown text differs from the source.
    changed: Vec<Changed>,
}

/// A line whose shown text differs from the source.
struct Changed {
    line: usize,
    /// Byte in `View::text` for each byte of the original line.
    bytes: Vec<usize>,
    original: String,
}

impl Views {
    /// Returns the files for an error at the given locations.
    pub fn new(files: &[File], places: &[Span]) -> Self {
        let views = files.iter().enumerate().map(|(k, file)| {
            let used = places.iter().filter(|p| p.file as usize == k);
            let mut used: Vec<&Span> = used.collect();
            used.sort();
            View::new(file, &used)
        });
        Views(views.collect())
    }

    /// Byte range in the shown text that a location covers.
    pub fn shown_range(&self, place: Span) -> Option<Range<usize>> {
        let view = self.0.get(place.file as usize)?;
        let (start, end) = (
            view.shown_offset(place.start as usize),
            view.shown_offset(place.end as usize),
        );
        Some(start..end.max(start))
    }
}

impl View {
    fn new(file: &File, places: &[&Span]) -> Self {
        let mut view = View {
            path: written_out(&file.path),
            text: String::with_capacity(if places.is_empty() { 0 } else { file.text.len() }),
            lines: Vec::new(),
            changed: Vec::new(),
        };
        if places.is_empty() {
            return view;
        }
        let mut start = 0;
        for (line, text) in file.text.split_inclusive('\n').enumerate() {
            view.lines.push(view.text.len());
            let body = text.trim_end_matches(['\n', '\r']);
            let plain = body.len() <= WIDTH && !body.chars().any(is_unprintable);
            if plain && body.len() + 1 >= text.len() && !text.ends_with("\r\n") {
                view.text += text;
            } else {
                let at = places
                    .iter()
                    .flat_map(|p| [p.start as usize, p.end as usize])
                    .find(|at| (start..start + text.len()).contains(at))
                    .map(|at| at - start);
                view.push_changed_line(line, text, body, at.unwrap_or(0));
            }
            start += text.len();
        }
        // As in codespan's `line_starts`: a line also begins after the last line break.
        if file.text.is_empty() || file.text.ends_with('\n') {
            view.lines.push(view.text.len());
        }
        view
    }

    /// Adds a line that is too long or contains characters to escape. `at` is the byte of the error in the line.
    fn push_changed_line(&mut self, line: usize, text: &str, body: &str, at: usize) {
        let before = body.get(..at).map_or(usize::MAX, |text| text.chars().count());
        let before = if before == usize::MAX { 0 } else { before };
        let long = body.chars().count() > WIDTH;
        let first = if long { before.saturating_sub(BEFORE) } else { 0 };
        let mut bytes = Vec::with_capacity(text.len() + 1);
        let mut width = 0;
        let mut cut = false;
        if first > 0 {
            self.text.push('…');
        }
        for (k, c) in body.chars().enumerate() {
            let at = self.text.len();
            bytes.extend(std::iter::repeat_n(at, c.len_utf8()));
            if k < first {
                continue;
            }
            if long && width >= WIDTH {
                if !cut {
                    self.text.push('…');
                    cut = true;
                }
                continue;
            }
            if is_unprintable(c) {
                let shown = c.escape_unicode().to_string();
                width += shown.len();
                self.text += &shown;
            } else {
                width += 1;
                self.text.push(c);
            }
        }
        // The line's end, and one past it.
        bytes.extend(std::iter::repeat_n(self.text.len(), text.len() - body.len() + 1));
        if text.ends_with('\n') {
            self.text.push('\n');
        }
        self.changed.push(Changed {
            line,
            bytes,
            original: text.to_owned(),
        });
    }

    /// Converts a byte offset in the file to one in the shown text.
    fn shown_offset(&self, byte: usize) -> usize {
        // Only changed lines have another length in the shown text.
        let mut moved: isize = 0;
        for changed in &self.changed {
            let start = self.lines[changed.line];
            let original = (start as isize - moved) as usize;
            if byte < original {
                break;
            }
            if byte < original + changed.original.len() {
                return changed.bytes[byte - original];
            }
            let end = self.lines.get(changed.line + 1).copied().unwrap_or(self.text.len());
            moved = end as isize - (original + changed.original.len()) as isize;
        }
        ((byte as isize + moved).max(0) as usize).min(self.text.len())
    }
}

impl<'a> Files<'a> for Views {
    type FileId = usize;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: usize) -> Result<&'a str, Error> {
        self.0.get(id).map(|v| v.path.as_str()).ok_or(Error::FileMissing)
    }

    fn source(&'a self, id: usize) -> Result<&'a str, Error> {
        self.0.get(id).map(|v| v.text.as_str()).ok_or(Error::FileMissing)
    }

    fn line_index(&'a self, id: usize, byte: usize) -> Result<usize, Error> {
        let view = self.0.get(id).ok_or(Error::FileMissing)?;
        Ok(view.lines.partition_point(|start| *start <= byte).saturating_sub(1))
    }

    fn column_number(&'a self, id: usize, line: usize, byte: usize) -> Result<usize, Error> {
        let view = self.0.get(id).ok_or(Error::FileMissing)?;
        let start = view.lines.get(line).copied().unwrap_or(byte);
        if let Some(changed) = view.changed.iter().find(|c| c.line == line) {
            let original = changed.bytes.partition_point(|at| *at < byte);
            let chars = changed.original.char_indices().take_while(|(at, _)| *at < original);
            return Ok(chars.count() + 1);
        }
        Ok(view.text.get(start..byte).map_or(0, |text| text.chars().count()) + 1)
    }

    fn line_range(&'a self, id: usize, line: usize) -> Result<Range<usize>, Error> {
        let view = self.0.get(id).ok_or(Error::FileMissing)?;
        let start = view.lines.get(line).copied().ok_or(Error::LineTooLarge {
            given: line,
            max: view.lines.len().saturating_sub(1),
        })?;
        Ok(start..view.lines.get(line + 1).copied().unwrap_or(view.text.len()))
    }
}

/// Returns whether a terminal or an editor acts on a character instead of showing it: controls, line ends other than a line
/// feed, marks that change the writing direction, and zero-width characters.
fn is_unprintable(c: char) -> bool {
    (c.is_control() && c != '\t')
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// Escapes the characters of a text that a terminal would act on.
pub fn written_out(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_unprintable(c) && c != '\n' {
            shown.extend(c.escape_unicode());
        } else {
            shown.push(c);
        }
    }
    shown
}

/// Escapes a message and shortens long ones to their beginning and end.
pub fn printable_message(text: &str) -> String {
    let shown = written_out(text);
    let count = shown.chars().count();
    if count <= MESSAGE {
        return shown;
    }
    let head: String = shown.chars().take(MESSAGE * 3 / 4).collect();
    let tail: String = shown.chars().skip(count - MESSAGE / 4).collect();
    format!("{head} … {tail}")
}
