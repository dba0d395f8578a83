//! Words of a kernel's author in strings and READMEs. In comments they are harmless by themselves: see
//! [`comment`](straightline_codegen::emit::comment).

/// The longest beginning of a text that ends with a word and has at most `bytes` bytes, `...` included where something is cut.
pub fn shorten_text(text: &str, bytes: usize) -> String {
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
pub fn escape_markdown(text: &str) -> String {
    // In an odd number of backquotes, the last one opens no code.
    let has_code = text.matches('`').count().is_multiple_of(2);
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
    fn what_is_too_long_ends_with_a_word() {
        assert_eq!(shorten_text("short", 63), "short");
        assert_eq!(shorten_text("one two, three", 13), "one two...");
        assert_eq!(shorten_text("äääääääää", 9), "äää...");
        for length in 0..40 {
            assert!(shorten_text("one two three four five six seven", length).len() <= length.max(3));
        }
    }

    #[test]
    fn markdown_has_no_live_tags() {
        assert_eq!(
            escape_markdown("a < b, `<T>` </script><img>"),
            "a < b, `<T>` &lt;/script>&lt;img>"
        );
        assert_eq!(escape_markdown("` <img>"), "` &lt;img>");
    }
}
