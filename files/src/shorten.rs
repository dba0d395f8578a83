//! Values and texts from outside, in a form that fits into a message.

/// Most characters of a value that a message repeats.
const LONGEST: usize = 100;

/// Characters of a long value's end that are shown.
const END: usize = 12;

/// `text` as a message can repeat it: its beginning and end where it is longer than 100 characters, with the number of
/// characters that were left out between them; control characters escaped.
pub fn shorten(text: &str) -> String {
    let count = text.chars().count();
    if count <= LONGEST {
        return escape_controls(text);
    }
    let head: String = text.chars().take(LONGEST - END).collect();
    let tail: String = text.chars().skip(count - END).collect();
    format!(
        "{}[{} characters]{}",
        escape_controls(&head),
        count - LONGEST,
        escape_controls(&tail)
    )
}

/// `text` with every character escaped that a terminal would act on or that would begin a new line.
fn escape_controls(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}') {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_values_are_repeated_and_long_ones_shortened() {
        assert_eq!(shorten("1.5"), "1.5");
        assert_eq!(shorten("é\u{1b}[31m\n"), "é\\u{1b}[31m\\n");
        let long = shorten(&("x".repeat(100_000) + "end"));
        assert!(long.chars().count() < 150 && long.ends_with("end"), "{long}");
        assert!(long.contains("[99903 characters]"), "{long}");
    }
}
