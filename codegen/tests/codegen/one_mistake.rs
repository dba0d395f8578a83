//! A mistake in a kernel is reported once: uses of the item that has it add no errors.

use proc_macro2::Span;
use std::path::{Path, PathBuf};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::{Kernel, Settings};

/// The kernels of others: those of the gallery, and the filters that come with Straightline.
fn kernels() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = ["examples/gallery", "kernels/filters"].map(|folder| root.join(folder));
    let files = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).expect("a folder"));
    let files = files.map(|entry| entry.expect("an entry").path());
    files
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect()
}

/// A place in a text where a mistake can stand.
enum Place {
    /// After the brace that opens a function's body.
    Body(usize),
    /// Before the brace that closes a structure.
    Fields(usize),
    /// The value of a constant.
    Value(std::ops::Range<usize>),
}

fn places(text: &str) -> Vec<Place> {
    let file = syn::parse_file(text).expect("a kernel is Rust");
    let body = |block: &syn::Block| Place::Body(block.brace_token.span.open().byte_range().end);
    let mut found = Vec::new();
    for item in &file.items {
        match item {
            syn::Item::Fn(function) => found.push(body(&function.block)),
            syn::Item::Impl(items) => found.extend(items.items.iter().filter_map(|item| match item {
                syn::ImplItem::Fn(function) => Some(body(&function.block)),
                _ => None,
            })),
            syn::Item::Struct(syn::ItemStruct {
                fields: syn::Fields::Named(fields),
                ..
            }) => {
                found.push(Place::Fields(fields.brace_token.span.close().byte_range().start));
            }
            syn::Item::Const(constant) => {
                let tokens = quote::ToTokens::to_token_stream(&constant.expr).into_iter();
                let spans: Vec<Span> = tokens.map(|token| token.span()).collect();
                let (first, last) = (spans.first().expect("a token"), spans.last().expect("a token"));
                found.push(Place::Value(first.byte_range().start..last.byte_range().end));
            }
            _ => {}
        }
    }
    found
}

/// The text with mistakes at a place, each with the code of its error.
fn mistaken(text: &str, place: &Place) -> Vec<(String, Code)> {
    let inserted = |at: usize, mistake: &str| format!("{}{mistake}{}", &text[..at], &text[at..]);
    match place {
        Place::Body(at) => vec![
            (inserted(*at, " let _said = format!(\"x\"); "), Code::NotInLanguage),
            (inserted(*at, " let _counted: i32 = 1.5; "), Code::MismatchedTypes),
            (inserted(*at, " let _lost = nowhere_to_be_found; "), Code::UnknownName),
            (
                inserted(*at, " let _called = nowhere_to_be_called(1.0); "),
                Code::UnknownFunction,
            ),
        ],
        Place::Fields(at) => {
            let comma = if text[..*at].trim_end().ends_with([',', '{']) {
                ""
            } else {
                ","
            };
            vec![(inserted(*at, &format!("{comma} said: String ")), Code::UnknownType)]
        }
        Place::Value(range) => {
            let value = format!("{}format!(\"x\"){}", &text[..range.start], &text[range.end..]);
            vec![(value, Code::NotInLanguage)]
        }
    }
}

#[test]
fn one_mistake_is_one_error() {
    let (mut tried, mut found, mut wrong) = (0, 0, Vec::new());
    for path in kernels() {
        let text = std::fs::read_to_string(&path).expect("a text");
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        for place in places(&text) {
            for (mistaken, code) in mistaken(&text, &place) {
                tried += 1;
                let compiled = Kernel::from_text(&format!("{name}.rs"), &mistaken, &name).compile(&Settings::new());
                // Items that the kernel does not reach may hold anything.
                let Err(errors) = compiled else { continue };
                found += 1;
                let codes: Vec<_> = errors.diagnostics.iter().map(|error| error.code()).collect();
                if codes != [Some(code)] {
                    wrong.push(errors.render(false));
                }
            }
        }
    }
    assert!(tried > 300 && found * 10 > tried * 9, "{found} errors of {tried}");
    assert!(
        wrong.is_empty(),
        "{} of {tried}:\n{}",
        wrong.len(),
        wrong.join("\n----\n")
    );
}
