//! Paragraphs of plain text.

/// Wraps text to lines of at most `width` characters, except for longer words. The first line begins with `first`, the
/// others with `next`.
pub fn wrap_text(text: &str, width: usize, first: &str, next: &str) -> String {
    let mut lines = vec![first.to_owned()];
    let (mut length, mut empty) = (first.chars().count(), true);
    for word in text.split_whitespace() {
        let count = word.chars().count();
        if !empty && length + 1 + count > width {
            lines.push(next.to_owned());
            (length, empty) = (next.chars().count(), true);
        }
        if let Some(line) = lines.last_mut() {
            let gap = if empty { "" } else { " " };
            *line += gap;
            *line += word;
            length += gap.len() + count;
        }
        empty = false;
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::wrap_text;

    #[test]
    fn lines_hold_whole_words() {
        assert_eq!(wrap_text("größe is a word", 8, "", "  "), "größe is\n  a word");
        assert_eq!(wrap_text("unbreakable a", 4, "- ", "  "), "- unbreakable\n  a");
    }
}
