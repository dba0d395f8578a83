//! Purposes of functions, from their documentation: printed as comments in the emitted text.

use super::Library;
use crate::ir::Purpose;
use std::sync::Arc;

/// Purposes of a library's functions, in order of their places.
pub fn function_purposes(library: &Library) -> Arc<[Purpose]> {
    let each = library.functions.values().filter(|f| f.span.file != super::std::FILE);
    let each = each.map(|function| Purpose {
        file: function.span.file,
        line: function.span.line,
        words: purpose(&function.docs),
    });
    let mut all: Vec<Purpose> = each.collect();
    all.sort();
    all.into()
}

/// The first few words of a documentation that say something by themselves.
fn purpose(docs: &str) -> String {
    const LONGEST: usize = 60;
    let sentence = docs.trim().split(". ").next().unwrap_or_default().trim_end_matches('.');
    let sentence = sentence.split_whitespace().collect::<Vec<_>>().join(" ");
    let words = sentence.split([':', ';', ',']).next().unwrap_or_default();
    let words = if sentence.chars().count() <= LONGEST {
        &sentence
    } else {
        words
    };
    if words.chars().count() > LONGEST {
        return String::new();
    }
    let mut chars = words.chars();
    match chars.next() {
        // A word in capitals stays one.
        Some(first) if chars.clone().next().is_none_or(|second| !second.is_uppercase()) => {
            first.to_lowercase().chain(chars).collect()
        }
        _ => words.to_owned(),
    }
}
