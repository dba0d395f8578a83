//! Tables and paragraphs of plain text.

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

/// Formats columns under headings, each as wide as its widest cell; the first column is left-aligned, the others
/// right-aligned.
pub fn render_table(headings: &[&str], rows: &[Vec<String>]) -> String {
    let width = |k: usize| {
        let cells = rows
            .iter()
            .filter_map(|row| row.get(k))
            .map(|cell| cell.chars().count());
        cells.chain([headings[k].chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..headings.len()).map(width).collect();
    let line = |cells: &[String]| {
        let padded = cells.iter().zip(&widths).enumerate().map(|(k, (cell, width))| {
            if k == 0 {
                format!("{cell:<width$}")
            } else {
                format!("{cell:>width$}")
            }
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let head: Vec<String> = headings.iter().map(|h| (*h).to_owned()).collect();
    let rule = widths.iter().map(|w| "-".repeat(*w)).collect::<Vec<_>>().join("  ");
    let mut text = format!("{}\n{rule}\n", line(&head));
    for row in rows {
        text.push_str(&line(row));
        text.push('\n');
    }
    text
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
