//! What the source says to the generator alone: `#[cfg_attr(false, unroll(4))]`, which rustc never sees.

use super::cfg::as_written;
use super::expr::Lower;
use crate::diagnostic::Diagnostic;
use crate::policy::{Branches, Unroll};
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

/// What may stand before loops.
const UNROLL: &str = "write `unroll(full)`, `unroll(none)` or `unroll(4)`";

impl Lower {
    /// `unroll(full)`, `unroll(none)` or `unroll(4)` before a loop.
    pub fn unroll_attribute(&mut self, attrs: &[syn::Attribute]) -> Option<Unroll> {
        let mut found = None;
        for meta in self.attributes(attrs) {
            if let syn::Meta::List(list) = &meta
                && list.path.is_ident("unroll")
            {
                found = self.unroll(list).or(found);
            } else {
                let text = as_written(&meta);
                self.bad_attribute(meta.span(), format!("a loop takes no attribute `{text}`"), UNROLL);
            }
        }
        found
    }

    /// The same before a function, where other attributes are not looked at here.
    pub fn unroll_of_function(&mut self, attrs: &[syn::Attribute]) -> Option<Unroll> {
        let all = self.attributes(attrs);
        let lists = all.iter().filter_map(|meta| meta.require_list().ok());
        lists
            .filter(|list| list.path.is_ident("unroll"))
            .filter_map(|list| self.unroll(list))
            .next_back()
    }

    fn unroll(&mut self, list: &syn::MetaList) -> Option<Unroll> {
        let unroll = list.tokens.to_string().parse();
        unroll
            .map_err(|error| self.bad_attribute(list.span(), error, UNROLL))
            .ok()
    }

    /// `branch` or `select` before an `if`.
    pub fn branch_attribute(&mut self, attrs: &[syn::Attribute]) -> Option<Branches> {
        let mut found = None;
        for meta in self.attributes(attrs) {
            match &meta {
                syn::Meta::Path(path) if path.is_ident("branch") => found = Some(Branches::Keep),
                syn::Meta::Path(path) if path.is_ident("select") => found = Some(Branches::Select),
                other => {
                    let text = as_written(other);
                    self.bad_attribute(
                        other.span(),
                        format!("a condition takes no attribute `{text}`"),
                        "write `branch` or `select`",
                    );
                }
            }
        }
        found
    }

    /// The attributes inside `cfg_attr(false, ...)`. Others are rustc's.
    fn attributes(&mut self, attrs: &[syn::Attribute]) -> Vec<syn::Meta> {
        let mut found = Vec::new();
        for attr in attrs.iter().filter(|a| a.path().is_ident("cfg_attr")) {
            let parse = Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated;
            let Ok(parts) = attr.parse_args_with(parse) else {
                continue;
            };
            let off =
                matches!(parts.first(), Some(syn::Expr::Lit(lit)) if matches!(&lit.lit, syn::Lit::Bool(b) if !b.value));
            if !off {
                continue;
            }
            for part in parts.iter().skip(1) {
                match syn::parse2(part.to_token_stream()) {
                    Ok(meta) => found.push(meta),
                    Err(error) => {
                        self.bad_attribute(part.span(), error.to_string(), "see the kernel language's attributes")
                    }
                }
            }
        }
        found
    }

    fn bad_attribute(&mut self, span: proc_macro2::Span, message: String, help: &str) {
        let span = self.span(span);
        self.errors
            .push(Diagnostic::at(span, message).label("not understood").help(help));
    }
}
