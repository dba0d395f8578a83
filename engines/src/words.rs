//! Words of a kernel's author in the texts of other languages: the one place where documentation is made harmless.
//!
//! [`comment`] runs on every text of [`Context`](crate::context::Context) that an author wrote, so that a template is safe in a comment without a
//! filter. Inside a string literal or a README a template adds the filter of that place ([`filters`](crate::filters)).

/// A text as one line that ends no comment and starts none, in any language that templates write.
///
/// | in the text | in the line | because of |
/// | --- | --- | --- |
/// | line ends of any kind, control characters | one space | a `//` or `#` comment ends there: U+0085, U+2028 and U+2029 too in WGSL and JavaScript |
/// | marks of writing direction, byte order marks | nothing | a reader would see another text than the compiler; rustc refuses them |
/// | `*/`, `/*` | `* /`, `/ *` | comments of C, JavaScript and C#, which nest in Rust and WGSL |
/// | `\` at the end | `/` | the next line would be part of the comment in C, GLSL and HLSL |
/// | `??/` | `?? /` | the trigraph of `\` in C |
pub fn comment(text: &str) -> String {
    let spaced = text.chars().filter(|c| !is_invisible(*c));
    let spaced: String = spaced.map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut line = String::with_capacity(spaced.len());
    for word in spaced.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        for c in word.chars() {
            let opens_or_ends = matches!((line.chars().next_back(), c), (Some('*'), '/') | (Some('/'), '*'));
            if opens_or_ends || (c == '/' && line.ends_with("??")) {
                line.push(' ');
            }
            line.push(c);
        }
    }
    let kept = line.trim_end_matches('\\').len();
    let ends = "/".repeat(line.len() - kept);
    line.truncate(kept);
    // A slash behind a star would end a comment after all.
    if !ends.is_empty() && line.ends_with('*') {
        line.push(' ');
    }
    line + &ends
}

/// Marks of writing direction and byte order, which show nothing.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{61c}' | '\u{feff}')
}

/// The longest beginning of a text that ends with a word and has at most `bytes` bytes, `...` included where something is cut.
pub fn shortened(text: &str, bytes: usize) -> String {
    const CUT: &str = "...";
    if text.len() <= bytes {
        return text.to_owned();
    }
    let room = bytes.saturating_sub(CUT.len());
    let end = (0..=room).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
    let end = text[..end].rfind(' ').unwrap_or(end);
    text[..end].trim_end_matches([' ', ',', ';', ':', '.']).to_owned() + CUT
}

/// Markdown in which no HTML is live: `<` that would open a tag outside of code is escaped.
pub fn markdown(text: &str) -> String {
    // Of an odd number of backquotes one opens no code.
    let has_code = text.matches('`').count() % 2 == 0;
    let mut in_code = false;
    let mut out = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        in_code ^= c == '`' && has_code;
        let opens = c == '<'
            && chars
                .peek()
                .is_some_and(|next| next.is_alphabetic() || "/!?".contains(*next));
        if opens && !in_code { out += "&lt;" } else { out.push(c) }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_is_one_line_that_nothing_ends() {
        for (text, line) in [
            ("Blurs.", "Blurs."),
            (
                "a\nb\r\nc\u{2028}d\u{2029}e\u{85}f\u{b}g\u{c}h\u{0}i",
                "a b c d e f g h i",
            ),
            ("from dark*/bright /* nested", "from dark* /bright / * nested"),
            ("/*/ **/", "/ * / ** /"),
            ("C:\\new\\", "C:\\new/"),
            ("ends *\\", "ends * /"),
            ("ends \\\\", "ends //"),
            ("trigraph ??/", "trigraph ?? /"),
            ("\u{feff}right \u{202e}tfel", "right tfel"),
            ("", ""),
        ] {
            assert_eq!(comment(text), line, "{text:?}");
            assert_eq!(comment(line), line, "twice: {text:?}");
        }
    }

    #[test]
    fn what_is_too_long_ends_with_a_word() {
        assert_eq!(shortened("short", 63), "short");
        assert_eq!(shortened("one two, three", 13), "one two...");
        assert_eq!(shortened("äääääääää", 9), "äää...");
        for length in 0..40 {
            assert!(shortened("one two three four five six seven", length).len() <= length.max(3));
        }
    }

    #[test]
    fn markdown_has_no_live_tags() {
        assert_eq!(
            markdown("a < b, `<T>` </script><img>"),
            "a < b, `<T>` &lt;/script>&lt;img>"
        );
        assert_eq!(markdown("` <img>"), "` &lt;img>");
    }
}
