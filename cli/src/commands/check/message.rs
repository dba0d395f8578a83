//! Errors in the format of cargo and rustc with `--message-format=json`.
//!
//! The fields follow <https://doc.rust-lang.org/cargo/reference/external-tools.html> and
//! <https://doc.rust-lang.org/rustc/json.html>: lines and columns count from 1, columns in characters, bytes from 0.

use serde_json::{Value, json};
use std::path::Path;
use straightline_codegen::diagnostic::{Code, Diagnostic, Errors, File, Span};

/// Returns the message for the first of `errors`, in one line.
pub fn message_json(kernel: &str, errors: &Errors) -> Value {
    let Some(diagnostic) = errors.diagnostics.first() else {
        return Value::Null;
    };
    // An unreadable file has no entry, only a name.
    let path = match errors.files.first() {
        Some(file) => absolute_path(&file.path),
        None => std::path::absolute(kernel).map_or_else(|_| kernel.to_owned(), |path| path.display().to_string()),
    };
    json!({
        "reason": "compiler-message",
        // Not a cargo package: no package can have this name.
        "package_id": format!("straightline+file://{path}"),
        "manifest_path": path,
        "target": {
            "kind": ["custom-build"],
            "crate_types": ["bin"],
            "name": kernel,
            "src_path": path,
            "edition": "2024",
            "doc": false,
            "doctest": false,
            "test": false,
        },
        "message": diagnostic_json(diagnostic, errors),
    })
}

/// Returns the final message of a run.
pub fn finished_json(success: bool) -> Value {
    json!({ "reason": "build-finished", "success": success })
}

/// Converts an error or a remark to rustc's JSON, at its level `error` or `note`.
fn diagnostic_json(diagnostic: &Diagnostic, errors: &Errors) -> Value {
    let primary = diagnostic.span.map(|at| (at, diagnostic.label.as_str(), true));
    let others = diagnostic.others.iter().map(|(at, label)| (*at, label.as_str(), false));
    let places = primary.into_iter().chain(others);
    let spans: Vec<Value> = places
        .filter_map(|(at, label, is_primary)| span_json(errors.files.get(at.file as usize)?, at, label, is_primary))
        .collect();
    // Editors show the children of an error, but not its label.
    let label = Some(&diagnostic.label).filter(|label| !label.is_empty());
    let notes = label
        .into_iter()
        .chain(&diagnostic.notes)
        .map(|note| child_json("note", note));
    let help = diagnostic.help.as_deref().map(|help| child_json("help", help));
    json!({
        "$message_type": "diagnostic",
        "message": diagnostic.message,
        "code": diagnostic.code().map(code_json),
        "level": if diagnostic.code().is_some() { "error" } else { "note" },
        "spans": spans,
        "children": notes.chain(help).collect::<Vec<_>>(),
        "rendered": errors.render(false),
    })
}

/// Prefixes the code with the tool's name, as clippy does. Without it editors would show rustc's explanation of the code.
fn code_json(code: Code) -> Value {
    json!({ "code": format!("straightline::{code}"), "explanation": code.explanation() })
}

fn child_json(level: &str, message: &str) -> Value {
    json!({ "message": message, "code": null, "level": level, "spans": [], "children": [], "rendered": null })
}

fn span_json(file: &File, at: Span, label: &str, is_primary: bool) -> Option<Value> {
    let (start, end) = (at.start as usize, (at.end as usize).max(at.start as usize));
    // A span outside its file would put the editor's mark in an arbitrary place.
    file.text.get(start..end)?;
    let (line_start, column_start) = line_and_column(&file.text, start);
    let (line_end, column_end) = line_and_column(&file.text, end);
    let lines = file.text.lines().enumerate().skip(line_start - 1);
    let text: Vec<Value> = lines
        .take(line_end - line_start + 1)
        .map(|(index, line)| {
            let line = line.trim_start_matches('\u{feff}');
            let first = if index + 1 == line_start { column_start } else { 1 };
            let last = if index + 1 == line_end {
                column_end
            } else {
                line.chars().count() + 1
            };
            json!({ "text": line, "highlight_start": first, "highlight_end": last })
        })
        .collect();
    Some(json!({
        "file_name": absolute_path(&file.path),
        "byte_start": start,
        "byte_end": end,
        "line_start": line_start,
        "line_end": line_end,
        "column_start": column_start,
        "column_end": column_end,
        "is_primary": is_primary,
        "text": text,
        "label": if label.is_empty() { Value::Null } else { json!(label) },
        "suggested_replacement": null,
        "suggestion_applicability": null,
        "expansion": null,
    }))
}

/// Returns line and column of a byte, from 1, columns in characters. A byte order mark takes no column.
fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..byte];
    let line = before.rfind('\n').map_or(0, |at| at + 1);
    let column = before[line..].trim_start_matches('\u{feff}').chars().count() + 1;
    (before.matches('\n').count() + 1, column)
}

/// Returns an absolute path for a file; the name of a text that is not a file is returned unchanged.
fn absolute_path(path: &str) -> String {
    match std::path::absolute(path) {
        Ok(whole) if Path::new(path).exists() => whole.display().to_string(),
        _ => path.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::line_and_column;

    #[test]
    fn columns_are_characters() {
        let text = "\u{feff}a\r\n// größer 🦀 x\n";
        let at = |what: &str| line_and_column(text, text.find(what).expect("it is there"));
        assert_eq!(
            (at("a"), at("x"), line_and_column(text, text.len())),
            ((1, 1), (2, 13), (3, 1))
        );
    }
}
