//! Finding chains among the functions of a file.

use super::signature::returns_pictures;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::{depth, raw, token_span, unraw, without_head};

/// Returns the function `name` and the index of its file.
pub fn find_function<'s>(syntax: &'s [(u32, syn::File)], name: &str) -> Option<(u32, &'s syn::ItemFn)> {
    syntax
        .iter()
        .find_map(|(file, parsed)| functions(parsed).find(|f| f.sig.ident == name).map(|f| (*file, f)))
}

/// Functions of a file, outside of modules.
fn functions(file: &syn::File) -> impl Iterator<Item = &syn::ItemFn> {
    file.items.iter().filter_map(|item| match item {
        syn::Item::Fn(function) => Some(function),
        _ => None,
    })
}

/// Returns the name of the chain that a text is meant to have: the function `named`, if it draws; without a name, the public one with
/// the name `stem`, or the only public one. `None` if a kernel is meant.
///
/// # Errors
///
/// If several chains could be meant. `path` is that of the file, for the help.
pub fn chain_of(text: &str, named: Option<&str>, stem: &str, path: &str) -> Result<Option<String>, Box<Diagnostic>> {
    let text = without_head(text);
    // Text that is no Rust is reported with its place when it is read.
    if depth::check_depth(0, &text).is_err() {
        return Ok(None);
    }
    let Ok(file) = raw::parse_file(&text) else {
        return Ok(None);
    };
    let is = |function: &syn::ItemFn, name: &str| unraw(&function.sig.ident.to_string()) == name;
    let wanted = named.unwrap_or(stem);
    if let Some(function) = functions(&file).find(|function| is(function, wanted)) {
        return Ok(returns_pictures(&function.sig).then(|| wanted.to_owned()));
    }
    if named.is_some() {
        return Ok(None);
    }
    let public: Vec<&syn::ItemFn> = functions(&file)
        .filter(|function| matches!(function.vis, syn::Visibility::Public(_)) && returns_pictures(&function.sig))
        .collect();
    match public.as_slice() {
        [] => Ok(None),
        [only] => Ok(Some(unraw(&only.sig.ident.to_string()).to_owned())),
        [first, others @ ..] => {
            let names: Vec<String> = public.iter().map(|f| format!("`{}`", f.sig.ident)).collect();
            let what = format!("`{path}` has several chains: {}", names.join(", "));
            let mut error = Diagnostic::error_at(Code::UnknownKernel, token_span(0, first.sig.ident.span()), what)
                .label("one of them")
                .help(format!("name one of them: `{path}::{}`", first.sig.ident));
            for other in others {
                error = error.label_at(token_span(0, other.sig.ident.span()), "another");
            }
            Err(Box::new(error))
        }
    }
}
