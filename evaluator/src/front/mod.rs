//! From Rust text to the tree of the supported subset. Knows nothing of targets.
//!
//! Every error of the files is reported, not the first. A function that the kernel does not reach may hold
//! anything.

mod attribute;
mod block;
mod cfg;
pub mod chain;
mod check;
mod choice;
mod closure;
mod depth;
mod derived;
mod expr;
mod foreign;
#[cfg(test)]
mod fuzz;
pub mod glam;
mod inner;
pub mod instead;
mod items;
mod kernels;
mod library;
mod literal;
mod looping;
mod macros;
pub mod methods;
pub mod name;
mod names;
mod odd;
mod options;
mod parts;
mod pattern;
mod purposes;
mod raw;
mod reach;
mod receivers;
mod recursive;
mod rust_traits;
mod scan;
pub mod std;
mod targets;
pub mod testing;
pub mod textures;
mod traits;
pub mod tree;
mod whiles;

use crate::diagnostic::{Code, Diagnostic, Errors, File, Span};
use ::std::borrow::Cow;
use ::std::collections::BTreeSet;
use ::std::sync::Arc;

pub use expr::{COUNTED, INFERRED};
pub use foreign::{is_by_last, is_prelude_type, is_resource};
pub use kernels::kernel_of;
pub use library::Library;
pub use looping::looping_statements;
pub use raw::{raw_name, unraw};
pub use rust_traits::is_of_rust;
pub use scan::{child_exprs, has_break, mentioned_in, scan_effects};
pub use whiles::guard_body;

/// Methods of arrays in the library that change their receiver.
pub const CHANGING: [&str; 23] = [
    "chunks_exact_mut",
    "chunks_mut",
    "clone_from_slice",
    "copy_from_slice",
    "fill",
    "fill_with",
    "first_mut",
    "get_mut",
    "last_mut",
    "reverse",
    "rotate_left",
    "rotate_right",
    "sort",
    "sort_by",
    "sort_by_key",
    "sort_unstable",
    "sort_unstable_by",
    "sort_unstable_by_key",
    "split_at_mut",
    "split_first_mut",
    "split_last_mut",
    "swap",
    "swap_with_slice",
];

/// Functions of the prelude that take a float or a vector and give one of its type, and do for a closure by their names.
pub const UNARY: [&str; 5] = ["fract", "inverse_sqrt", "round", "saturate", "sign"];

/// Functions of the prelude, in the order of their names.
pub const FUNCTIONS: [&str; 12] = [
    "fract",
    "inverse_sqrt",
    "lane_position",
    "mix",
    "quad_select",
    "quad_vector",
    "round",
    "saturate",
    "sign",
    "smoothstep",
    "step",
    "tally",
];

/// Definitions in the files of a kernel.
#[derive(Debug)]
pub struct Parsed {
    /// All of it.
    pub library: Library,
    /// Items that the kernel reaches: the others may hold anything.
    pub reached: BTreeSet<String>,
    /// Functions and constants of the files that it does not reach and that are of the kernel language.
    pub others: BTreeSet<String>,
    /// `true` if the files may use names that they do not show.
    pub unknown_names: bool,
    /// Errors in what the kernel reaches. Items that have one, or mention a type that has one, are not among `reached`.
    pub errors: Vec<Diagnostic>,
}

/// Reads all files and lowers what `entry` reaches.
///
/// # Errors
///
/// A file is not Rust, or its items contradict each other. Errors within items are [`Parsed::errors`], so that inference can
/// find more in the others.
pub fn parse(files: &Arc<Vec<File>>, entry: &str) -> Result<Parsed, Errors> {
    let items = read_items(files)?;
    let lowered = items.lower_reached(&raw_name(entry));
    let mut parsed = lowered.map_err(|found| Errors::new(found, files))?;
    parsed.library.purposes = purposes::function_purposes(&parsed.library);
    Ok(parsed)
}

/// Reads all files and lowers what they hold, for the types of what `entry` does not reach. In the library, names that the
/// files import or that have errors count as broken.
///
/// # Errors
///
/// As of [`parse`].
pub fn parse_whole(files: &Arc<Vec<File>>, entry: &str) -> Result<Parsed, Errors> {
    let items = read_items(files)?;
    let lowered = items.lower_whole(&raw_name(entry));
    lowered.map_err(|found| Errors::new(found, files))
}

/// Reads the items of all files and of the library.
fn read_items(files: &Arc<Vec<File>>) -> Result<items::Items, Errors> {
    let mut syntax = read_syntax(files)?;
    let mut items = collect_items(&mut syntax);
    add_library(&mut items, files)?;
    Ok(items)
}

/// Reads the syntax of all files, each with its index.
fn read_syntax(files: &Arc<Vec<File>>) -> Result<Vec<(u32, syn::File)>, Errors> {
    let mut errors = Vec::new();
    let mut syntax = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let text = without_head(&file.text);
        if let Err(error) = depth::check_depth(index as u32, &text) {
            errors.push(*error);
            continue;
        }
        match raw::parse_file(&text) {
            Ok(parsed) => syntax.push((index as u32, parsed)),
            Err(error) => errors.push(syntax_error(index as u32, &text, &error)),
        }
    }
    match errors.is_empty() {
        true => Ok(syntax),
        false => Err(Errors::new(errors, files)),
    }
}

/// Collects the items of files.
fn collect_items(syntax: &mut [(u32, syn::File)]) -> items::Items {
    for (_, parsed) in syntax.iter_mut() {
        inner::take_all(&mut parsed.items);
    }
    let mut items = items::Items::new(syntax);
    for (file, parsed) in syntax {
        items.add_file(*file, parsed);
    }
    items
}

/// Adds what the library has of the names that `files` mention.
fn add_library(items: &mut items::Items, files: &[File]) -> Result<(), Errors> {
    items.add_file(std::FILE, &mut read_library(files)?);
    Ok(())
}

/// Reads the functions of the library that `files` may call.
fn read_library(files: &[File]) -> Result<syn::File, Errors> {
    syn::parse_file(&std::text(files)).map_err(|error| Errors::from_diagnostic(syntax_error(std::FILE, "", &error)))
}

/// The text with blanks for a byte order mark and a first line `#!/...`, so that what follows stays in its place.
fn without_head(text: &str) -> Cow<'_, str> {
    let mark = if text.starts_with('\u{feff}') {
        '\u{feff}'.len_utf8()
    } else {
        0
    };
    let rest = &text[mark..];
    let script = rest.strip_prefix("#!").is_some_and(|after| {
        let after = after.trim_start();
        !after.starts_with('[') && !after.starts_with("//") && !after.starts_with("/*")
    });
    let line = if script {
        rest.find('\n').unwrap_or(rest.len())
    } else {
        0
    };
    match mark + line {
        0 => Cow::Borrowed(text),
        blank => Cow::Owned(format!("{}{}", " ".repeat(blank), &text[blank..])),
    }
}

fn syntax_error(file: u32, text: &str, error: &syn::Error) -> Diagnostic {
    let span = token_span(file, error.span());
    let said = error.to_string();
    if said.contains("token stream") {
        if let Some(odd) = odd::character_error(file, text, span) {
            return odd;
        }
        return Diagnostic::error_at(
            Code::Syntax,
            span,
            "not valid Rust: a bracket or a quote has no partner",
        )
        .label("this one, or one before")
        .help("count the brackets, or let `rustfmt` find the place");
    }
    Diagnostic::error_at(Code::Syntax, span, format!("not valid Rust: {said}"))
        .label("the parser stopped here")
        .help("rustc, which compiles the same file, says more")
}

/// The place of a token.
fn token_span(file: u32, span: proc_macro2::Span) -> Span {
    let bytes = span.byte_range();
    let start = span.start();
    Span {
        file,
        start: bytes.start as u32,
        end: bytes.end as u32,
        line: start.line as u32,
        column: start.column as u32 + 1,
    }
}
