//! Code of a text without its comments and strings, by the strictest reading that any of the engines' languages has.

/// Ends of a line in some language: WGSL and JavaScript know more than C.
const LINE_ENDS: [char; 7] = ['\n', '\r', '\u{b}', '\u{c}', '\u{85}', '\u{2028}', '\u{2029}'];

/// The code, with `""` for strings that follow each other and one blank for white space.
///
/// # Errors
///
/// A comment that goes on behind its line or begins another, a string over several lines: some language reads it otherwise.
pub fn without_words(file: &str, text: &str) -> Result<String, String> {
    match file.rsplit('.').next() {
        Some("py") => Reader::new(text, "#", &["\"\"\"", "\"", "'"]).read(),
        // Lifetimes and characters, of which there are none with words.
        Some("rs") => Reader::new(text, "//", &["\""]).read(),
        // A shader between backquotes is read as the code around it: its comments are comments.
        _ => Reader::new(text, "//", &["\"", "'"]).read(),
    }
}

struct Reader<'t> {
    rest: &'t str,
    comment: &'static str,
    quotes: &'static [&'static str],
    code: String,
}

impl<'t> Reader<'t> {
    fn new(text: &'t str, comment: &'static str, quotes: &'static [&'static str]) -> Reader<'t> {
        Reader {
            rest: text,
            comment,
            quotes,
            code: String::new(),
        }
    }

    fn read(mut self) -> Result<String, String> {
        while let Some(c) = self.rest.chars().next() {
            if let Some(comment) = self.rest.strip_prefix(self.comment) {
                let end = comment.find(LINE_ENDS).unwrap_or(comment.len());
                self.comment(&comment[..end])?;
                self.rest = &comment[end..];
            } else if self.comment == "//" && self.rest.starts_with("/*") {
                let (comment, rest) = self.rest[2..].split_once("*/").ok_or("a comment without an end")?;
                self.comment(comment)?;
                self.rest = rest;
            } else if let Some(quote) = self.quotes.iter().find(|quote| self.rest.starts_with(**quote)) {
                self.string(quote)?;
            } else {
                self.code.push(c);
                self.rest = &self.rest[c.len_utf8()..];
            }
        }
        // A longer comment has more lines, also as lines of a string.
        let mut words: Vec<&str> = self.code.split_whitespace().collect();
        words.dedup_by(|word, before| word == before && *word == "\"\"");
        Ok(words.join(" "))
    }

    fn comment(&mut self, text: &str) -> Result<(), String> {
        let line = text.trim_end();
        if line.ends_with('\\') || line.ends_with("??/") {
            return Err(format!("a comment goes on in the next line: {line}"));
        }
        if text.contains("/*") || text.contains("*/") {
            return Err(format!("a comment ends, or begins another: {text}"));
        }
        self.code.push(' ');
        Ok(())
    }

    fn string(&mut self, quote: &str) -> Result<(), String> {
        let text = &self.rest[quote.len()..];
        let mut escaped = false;
        for (at, c) in text.char_indices() {
            if escaped {
                escaped = false;
            } else if c == '\\' {
                escaped = true;
            } else if text[at..].starts_with(quote) {
                self.code += "\"\"";
                self.rest = &text[at + quote.len()..];
                return Ok(());
            } else if quote.len() == 1 && LINE_ENDS.contains(&c) {
                return Err(format!("a string goes over a line: {}", &text[..at]));
            }
        }
        Err("a string without an end".to_owned())
    }
}
