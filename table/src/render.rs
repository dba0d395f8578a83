//! The renderings of a table.

use crate::{Cell, Column, Table};
use std::fmt::Write;

impl Table {
    /// Formats the columns for programs as CSV (RFC 4180).
    pub fn to_csv(&self) -> String {
        let heads = self.columns.iter().flat_map(|column| &column.names);
        let mut text = csv_line(heads.map(String::as_str));
        for row in &self.rows {
            let cells = self.columns.iter().zip(row).flat_map(|(column, cell)| {
                let values = (0..column.names.len()).map(|k| cell.exact.get(k));
                values.map(|value| value.map_or("", String::as_str))
            });
            text += &csv_line(cells);
        }
        text
    }

    /// Formats the columns for readers as plain text, each as wide as its widest cell.
    pub fn to_text(&self) -> String {
        let (columns, rows) = self.for_readers("");
        let width = |k: usize| {
            let cells = rows.iter().map(|row| row[k].as_str()).chain([title(columns[k])]);
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns.len()).map(width).collect();
        let line = |cells: Vec<&str>| {
            let padded = cells.iter().zip(&widths).enumerate().map(|(k, (cell, width))| {
                if is_left(k, columns[k]) {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
            padded.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
        };
        let rule: Vec<String> = widths.iter().map(|width| "-".repeat(*width)).collect();
        let mut text = line(columns.iter().map(|column| title(column)).collect()) + &rule.join("  ") + "\n";
        rows.iter()
            .for_each(|row| text += &line(row.iter().map(String::as_str).collect()));
        text
    }

    /// Formats the columns for readers as a table of Markdown.
    pub fn to_markdown(&self) -> String {
        let (columns, rows) = self.for_readers("–");
        let line = |cells: Vec<&str>| format!("| {} |\n", cells.join(" | "));
        let rule = columns.iter().enumerate();
        let rule = rule.map(|(k, column)| if is_left(k, column) { "---" } else { "--:" });
        let mut text = line(columns.iter().map(|column| title(column)).collect());
        text += &line(rule.collect());
        rows.iter()
            .for_each(|row| text += &line(row.iter().map(String::as_str).collect()));
        text
    }

    /// Formats the columns for readers as a table of HTML, in a block that scrolls by itself if the table is wide.
    pub fn to_html(&self) -> String {
        let shown = |k: &usize| self.columns[*k].title.is_some();
        let shown: Vec<usize> = (0..self.columns.len()).filter(shown).collect();
        let is_matrix = self.columns.iter().any(|column| column.is_turned);
        let mut text = format!(
            "<div class=\"wide\"><table{}>\n<tr>",
            if is_matrix { " class=\"matrix\"" } else { "" }
        );
        for k in &shown {
            let column = &self.columns[*k];
            let name = escape_html(title(column));
            text += &match column.is_turned {
                true => format!("<th class=\"turned\"><span>{name}</span>"),
                false => format!("<th>{name}"),
            };
        }
        text += "</tr>\n";
        for (row, class) in self.rows.iter().zip(&self.classes) {
            let _ = write!(text, "<tr{}>", html_attribute("class", class));
            for (k, place) in shown.iter().enumerate() {
                let (column, cell) = (&self.columns[*place], &row[*place]);
                let is_marked = k > 0 && column.is_left && cell.class.is_empty();
                let class = if is_marked { "left" } else { cell.class };
                let shown = cell.shown.as_deref().unwrap_or(if is_matrix { "" } else { "–" });
                let code = if cell.is_code && !shown.is_empty() {
                    ["<code>", "</code>"]
                } else {
                    ["", ""]
                };
                let (class, hint) = (html_attribute("class", class), html_attribute("title", &cell.hint));
                let _ = write!(text, "<td{class}{hint}>{}{}{}", code[0], escape_html(shown), code[1]);
            }
            text += "</tr>\n";
        }
        text + "</table></div>"
    }

    /// Columns and texts for readers, with `missing` for absent values.
    fn for_readers(&self, missing: &str) -> (Vec<&Column>, Vec<Vec<String>>) {
        let columns = self.columns.iter().filter(|column| column.title.is_some());
        let shown = |cell: &Cell| cell.shown.clone().unwrap_or_else(|| missing.to_owned());
        let rows = self.rows.iter().enumerate().map(|(at, row)| {
            let cells = self.columns.iter().zip(row).enumerate();
            let cells = cells.filter(|(_, (column, _))| column.title.is_some());
            let cells = cells.map(|(k, (column, cell))| {
                let is_repeated = at > 0 && self.rows[at - 1][k] == *cell;
                if column.is_grouped && is_repeated {
                    String::new()
                } else {
                    shown(cell)
                }
            });
            cells.collect()
        });
        (columns.collect(), rows.collect())
    }
}

fn title(column: &Column) -> &str {
    column.title.as_deref().unwrap_or_default()
}

/// Returns whether a column has its cells at the left.
fn is_left(index: usize, column: &Column) -> bool {
    index == 0 || column.is_left
}

fn csv_line<'c>(cells: impl Iterator<Item = &'c str>) -> String {
    let quoted = cells.map(|cell| match cell.contains(['"', ',', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    });
    quoted.collect::<Vec<_>>().join(",") + "\n"
}

fn html_attribute(name: &str, value: &str) -> String {
    match value.is_empty() {
        true => String::new(),
        false => format!(" {name}=\"{}\"", escape_html(value)),
    }
}

/// Escapes the characters that HTML gives a meaning.
fn escape_html(text: &str) -> String {
    let pairs = [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;")];
    pairs
        .iter()
        .fold(text.to_owned(), |text, (from, to)| text.replace(*from, to))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        Table::of([
            ("a, \"b\"", Some(1.0), true),
            ("a, \"b\"", None, false),
            ("<i>", Some(3e-7), true),
        ])
        .column(Column::new("name").titled("Name").grouped(), |row| row.0)
        .column(Column::exact("flag"), |row| row.2)
        .column(Column::interval("ratio"), |row| {
            row.1.map(|ratio| Cell::interval([ratio, 0.5 * ratio, 2.0 * ratio], 1))
        })
        .column(Column::shown("note").left(), |row| {
            Cell::code(if row.2 { "x" } else { "" })
        })
        .class("chosen", |row| !row.2)
        .finish()
    }

    #[test]
    fn programs_have_every_value_in_full() {
        let expected = "name,flag,ratio,ratio_low,ratio_high\n\"a, \"\"b\"\"\",true,1,0.5,2\n\
                        \"a, \"\"b\"\"\",false,,,\n<i>,true,3e-7,1.5e-7,6e-7\n";
        assert_eq!(table().to_csv(), expected);
    }

    #[test]
    fn readers_have_rounded_values_in_every_rendering() {
        let text = "Name               ratio  note\n------  ----------------  ----\n\
                    a, \"b\"  1.0 (0.5 to 2.0)  x\n\n<i>     0.0 (0.0 to 0.0)  x\n";
        assert_eq!(table().to_text(), text);
        let markdown = "| Name | ratio | note |\n| --- | --: | --- |\n| a, \"b\" | 1.0 (0.5 to 2.0) | x |\n\
                        |  | – |  |\n| <i> | 0.0 (0.0 to 0.0) | x |\n";
        assert_eq!(table().to_markdown(), markdown);
        let html = "<div class=\"wide\"><table>\n<tr><th>Name<th>ratio<th>note</tr>\n\
                    <tr><td>a, &quot;b&quot;<td>1.0 (0.5 to 2.0)<td class=\"left\"><code>x</code></tr>\n\
                    <tr class=\"chosen\"><td>a, &quot;b&quot;<td>–<td class=\"left\"></tr>\n\
                    <tr><td>&lt;i&gt;<td>0.0 (0.0 to 0.0)<td class=\"left\"><code>x</code></tr>\n</table></div>";
        assert_eq!(table().to_html(), html);
    }

    #[test]
    fn columns_are_left_out_by_name() {
        let csv = table().without(&["ratio", "note"]).to_csv();
        assert!(csv.starts_with("name,flag\n"), "{csv}");
    }
}
