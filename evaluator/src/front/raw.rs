//! Raw identifiers: `r#type` is the name `type`, and `r#x` the name `x`.

use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use std::borrow::Cow;

/// Prefix of a raw identifier.
const MARK: &str = "r#";

/// The syntax of a file, in which only keywords are raw identifiers.
///
/// # Errors
///
/// The text is not valid Rust.
pub fn parse_file(text: &str) -> syn::Result<syn::File> {
    if !text.contains(MARK) {
        return syn::parse_file(text);
    }
    let tokens: TokenStream = syn::parse_str(text)?;
    syn::parse2(unraw_tokens(tokens))
}

/// Tokens in which only keywords are raw identifiers.
fn unraw_tokens(tokens: TokenStream) -> TokenStream {
    let each = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) => {
            let mut other = Group::new(group.delimiter(), unraw_tokens(group.stream()));
            other.set_span(group.span());
            TokenTree::Group(other)
        }
        TokenTree::Ident(ident) => {
            let text = ident.to_string();
            match text.strip_prefix(MARK).filter(|name| !is_keyword(name)) {
                Some(name) => TokenTree::Ident(Ident::new(name, ident.span())),
                None => TokenTree::Ident(ident),
            }
        }
        other => other,
    });
    each.collect()
}

/// Returns whether a name is an identifier only in raw form.
fn is_keyword(name: &str) -> bool {
    syn::parse_str::<Ident>(name).is_err()
}

/// A name as the kernel's files have it: of a keyword, the raw identifier.
pub fn raw_name(name: &str) -> Cow<'_, str> {
    let marked = || format!("{MARK}{name}");
    match is_keyword(name) && syn::parse_str::<Ident>(&marked()).is_ok() {
        true => Cow::Owned(marked()),
        false => Cow::Borrowed(name),
    }
}

/// A name without the mark of a raw identifier.
pub fn unraw(name: &str) -> &str {
    name.strip_prefix(MARK).unwrap_or(name)
}
