//! Filters that templates have beside those of tera: how a text becomes part of another language.

use std::collections::HashMap;
use tera::{Error, Result, Tera, Value};

/// Adds the filters.
pub fn register(tera: &mut Tera) {
    tera.register_filter("template_literal", text(template_literal));
    tera.register_filter("c_string", text(c_string));
    tera.register_filter("python_string", text(python_string));
    tera.register_filter("comment", comment);
}

/// A filter of texts.
fn text(of: fn(&str) -> String) -> impl Fn(&Value, &HashMap<String, Value>) -> Result<Value> {
    move |value, _| Ok(of(as_text(value)?).into())
}

fn as_text(value: &Value) -> Result<&str> {
    value.as_str().ok_or_else(|| Error::msg("the filter is for texts"))
}

/// Between the backquotes of JavaScript.
fn template_literal(text: &str) -> String {
    text.replace('\\', "\\\\").replace('`', "\\`").replace("${", "\\${")
}

/// As string literals of C, a line each.
fn c_string(text: &str) -> String {
    let line = |line: &str| {
        format!(
            "    \"{}\\n\"",
            line.replace('\\', "\\\\").replace('"', "\\\"").replace('?', "\\?")
        )
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Between three quotation marks of Python.
fn python_string(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}

/// Every line behind a mark: `{{ text | comment(mark="//") }}`.
fn comment(value: &Value, args: &HashMap<String, Value>) -> Result<Value> {
    let mark = args.get("mark").and_then(Value::as_str).unwrap_or("//");
    let lines = as_text(value)?
        .lines()
        .map(|line| format!("{mark} {line}").trim_end().to_owned());
    Ok(lines.collect::<Vec<_>>().join("\n").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_what_they_are() {
        assert_eq!(template_literal("a `b` ${c} \\d"), "a \\`b\\` \\${c} \\\\d");
        assert_eq!(python_string("a \"\"\"b\"\nc\\d"), "a \\\"\\\"\\\"b\\\"\nc\\\\d");
        assert_eq!(c_string("a \"b\"\nc??/"), "    \"a \\\"b\\\"\\n\"\n    \"c\\?\\?/\\n\"");
    }
}
