//! Name of the entry point.

use super::own_words::is_own;
use super::refusal::Refusal;
use super::words::{LONGEST, Words, is_among, to_identifier};
use crate::spec::{EmitOptions, Target};
use straightline_evaluator::shorten;

/// Returns the name of a kernel's entry point or function: the requested one, or else the kernel's, adjusted for shading
/// languages.
///
/// # Errors
///
/// If the requested name is invalid in a requested language.
pub fn resolve_entry_name(kernel: &str, options: &EmitOptions) -> Result<String, Refusal> {
    let Some(name) = &options.entry else {
        return Ok(entry_point(kernel, options));
    };
    match why_not(name, options) {
        None => Ok(name.clone()),
        Some(why) => Err(Refusal::entry_name(kernel, &shorten(name), &why)),
    }
}

/// Returns the entry point of a kernel: its name, adjusted if a shading language or an engine would reject it.
fn entry_point(kernel: &str, options: &EmitOptions) -> String {
    let name = to_identifier(kernel);
    let is_word = |name: &str| {
        let languages = [Words::Wgsl, Words::Glsl, Words::Hlsl];
        is_own(name) || is_among(&options.reserved, name) || languages.iter().any(|language| language.is_reserved(name))
    };
    match is_word(&name) {
        true => format!("{name}_kernel"),
        false => name,
    }
}

fn why_not(name: &str, options: &EmitOptions) -> Option<String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if name.is_empty() || !name.chars().all(is_plain) || !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return Some("is not a letter with letters, digits and underscores after it".to_owned());
    }
    if name.contains("__") {
        return Some("has two underscores in a row, which GLSL keeps for itself".to_owned());
    }
    if name.len() > LONGEST {
        return Some(format!(
            "is longer than the {LONGEST} letters that every compiler takes"
        ));
    }
    let whole = !options.is_function();
    // Every text is validated as WGSL. A whole GLSL shader always has `main`; naga checks names for MSL.
    let is_written = |target: Target| options.targets.contains(&target);
    let languages = [
        (true, Words::Wgsl.is_reserved(name), "WGSL"),
        (
            !whole && Target::ALL.into_iter().any(|t| t.is_glsl() && is_written(t)),
            Words::Glsl.is_reserved(name),
            "GLSL",
        ),
        (is_written(Target::Hlsl), Words::Hlsl.is_reserved(name), "HLSL"),
    ];
    if let Some((.., language)) = languages.into_iter().find(|(written, is_word, _)| *written && *is_word) {
        return Some(format!("is a word of {language}"));
    }
    // Only GLSL uses `main`, as the name of its entry point.
    if is_own(name) && !(name == "main" && whole) {
        return Some("is a name that the shader itself has a use for".to_owned());
    }
    None
}
