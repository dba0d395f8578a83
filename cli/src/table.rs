//! Tables of text, for people.

/// Columns under headings, each as wide as its widest cell; the first column left, the others right.
pub fn render(headings: &[&str], rows: &[Vec<String>]) -> String {
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
