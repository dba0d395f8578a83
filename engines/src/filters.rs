//! Template filters in addition to tera's, which quote a text for another language.

use crate::spelling::spelled_out;
use crate::words;
use tera::{Kwargs, State, Tera, TeraResult};

/// Adds the filters.
pub fn register_filters(tera: &mut Tera) {
    tera.register_filter("template_literal", |text: &str, _: Kwargs, _: &State| {
        template_literal(text)
    });
    tera.register_filter("c_string", |text: &str, _: Kwargs, _: &State| c_string(text));
    tera.register_filter("python_string", |text: &str, _: Kwargs, _: &State| python_string(text));
    tera.register_filter("comment", comment);
    tera.register_filter("js_key", |name: &str, _: Kwargs, _: &State| js_key(name));
    tera.register_filter("rust_name", |name: &str, _: Kwargs, _: &State| rust_name(name));
    tera.register_filter("identifier", |name: &str, _: Kwargs, _: &State| identifier(name));
    tera.register_filter("quoted", |text: &str, _: Kwargs, _: &State| quoted(text));
    tera.register_filter("parameter", |text: &str, _: Kwargs, _: &State| parameter(text));
    tera.register_filter("markdown", |text: &str, _: Kwargs, _: &State| {
        words::escape_markdown(text)
    });
}

/// Between the quotation marks of C, HLSL, C# or JavaScript, on one line.
fn quoted(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace("??", "?\\?")
}

/// Between the quotation marks of libretro's `#pragma parameter`, which has no escapes; of a longer text than 63 bytes its reader
/// drops the whole parameter.
fn parameter(text: &str) -> String {
    words::shorten_text(text.trim_end_matches('.'), 63).replace('"', "'")
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

/// Returns a name as a key of a JavaScript object. Every name is valid except the one that sets the prototype.
fn js_key(name: &str) -> String {
    match name {
        "__proto__" => "[\"__proto__\"]".to_owned(),
        other => other.to_owned(),
    }
}

/// Keywords of Rust, of which none but `Self`, `self`, `super` and `crate` cannot be a name of a kernel's.
const KEYWORDS: [&str; 48] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn", "else", "enum",
    "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod", "move",
    "mut", "override", "priv", "pub", "ref", "return", "static", "struct", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// A name as Rust writes it: `r#type`.
fn rust_name(name: &str) -> String {
    match KEYWORDS.contains(&name) {
        true => format!("r#{name}"),
        false => name.to_owned(),
    }
}

/// A name of files as an identifier of C.
fn identifier(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    spelled_out(name).chars().map(letter).collect()
}

/// Prefixes every line with a mark: `{{ text | comment(mark="//") }}`.
fn comment(text: &str, arguments: Kwargs, _: &State) -> TeraResult<String> {
    let mark = arguments.get::<&str>("mark")?.unwrap_or("//");
    let lines = text.lines().map(|line| format!("{mark} {line}").trim_end().to_owned());
    Ok(lines.collect::<Vec<_>>().join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_what_they_are() {
        assert_eq!(template_literal("a `b` ${c} \\d"), "a \\`b\\` \\${c} \\\\d");
        assert_eq!(python_string("a \"\"\"b\"\nc\\d"), "a \\\"\\\"\\\"b\\\"\nc\\\\d");
        assert_eq!(c_string("a \"b\"\nc??/"), "    \"a \\\"b\\\"\\n\"\n    \"c\\?\\?/\\n\"");
        assert_eq!(quoted("a \"b\" c:\\d ??("), "a \\\"b\\\" c:\\\\d ?\\?(");
        assert_eq!(parameter("The \"look\"."), "The 'look'");
    }
}
