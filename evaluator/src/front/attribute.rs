//! Attributes for the generator alone: `#[cfg_attr(false, unroll(4))]`, which rustc never sees.

use super::cfg::as_written;
use super::expr::Lower;
use crate::diagnostic::{Code, Diagnostic};
use crate::policy::{Branches, Unroll};
use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

/// Help that lists the attributes of loops.
const UNROLL: &str = "write `unroll(full)`, `unroll(none)` or `unroll(4)`";

/// Iterations that a bound may state.
const LARGEST_BOUND: u32 = 1 << 16;

/// Attributes of a loop.
#[derive(Default)]
pub struct OfLoop {
    /// Unroll policy, if an attribute sets one.
    pub unroll: Option<Unroll>,
    /// Iterations after which it has ended, with the place.
    pub bound: Option<(u32, proc_macro2::Span)>,
}

impl Lower {
    /// `unroll(full)`, `unroll(none)` or `unroll(4)` before a `for`.
    pub fn unroll_attribute(&mut self, attrs: &[syn::Attribute]) -> Option<Unroll> {
        let said = self.loop_attributes(attrs);
        if let Some((_, at)) = said.bound {
            self.bad_attribute(
                at,
                "a `for` takes no `bound`: what it runs over bounds it".to_owned(),
                UNROLL,
            );
        }
        said.unroll
    }

    /// `unroll` as before a `for`, and `bound(64)`, before a `while` or a `loop`.
    pub fn loop_attributes(&mut self, attrs: &[syn::Attribute]) -> OfLoop {
        let mut said = OfLoop::default();
        for meta in self.hidden_attributes(attrs) {
            match &meta {
                syn::Meta::List(list) if list.path.is_ident("unroll") => {
                    said.unroll = self.parse_unroll(list).or(said.unroll);
                }
                syn::Meta::List(list) if list.path.is_ident("bound") => {
                    said.bound = self.parse_bound(list).or(said.bound);
                }
                meta if is_exact(meta) => {}
                _ => {
                    let text = as_written(&meta);
                    self.bad_attribute(meta.span(), format!("a loop takes no attribute `{text}`"), UNROLL);
                }
            }
        }
        said
    }

    fn parse_bound(&mut self, list: &syn::MetaList) -> Option<(u32, proc_macro2::Span)> {
        let bound = list
            .parse_args::<syn::LitInt>()
            .and_then(|n| n.base10_parse().map(|n: u32| n));
        match bound {
            Ok(n) if (1..=LARGEST_BOUND).contains(&n) => Some((n, list.span())),
            _ => {
                let text = as_written(&syn::Meta::List(list.clone()));
                let help = format!("write a number of iterations from 1 to {LARGEST_BOUND}: `bound(64)`");
                self.bad_attribute(list.span(), format!("`{text}` bounds no loop"), &help);
                None
            }
        }
    }

    /// `unroll` before a function, whose other attributes are checked elsewhere.
    pub fn unroll_of_function(&mut self, attrs: &[syn::Attribute]) -> Option<Unroll> {
        let all = self.hidden_attributes(attrs);
        let lists = all.iter().filter_map(|meta| meta.require_list().ok());
        lists
            .filter(|list| list.path.is_ident("unroll"))
            .filter_map(|list| self.parse_unroll(list))
            .next_back()
    }

    fn parse_unroll(&mut self, list: &syn::MetaList) -> Option<Unroll> {
        let unroll = list.tokens.to_string().parse();
        unroll
            .map_err(|error| self.bad_attribute(list.span(), error, UNROLL))
            .ok()
    }

    /// `branch` or `select` before an `if`.
    pub fn branch_attribute(&mut self, attrs: &[syn::Attribute]) -> Option<Branches> {
        let mut found = None;
        for meta in self.hidden_attributes(attrs) {
            match &meta {
                syn::Meta::Path(path) if path.is_ident("branch") => found = Some(Branches::Keep),
                syn::Meta::Path(path) if path.is_ident("select") => found = Some(Branches::Select),
                meta if is_exact(meta) || is_half(meta) => {}
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

    /// `exact` before a function, a `let`, a block, a condition or a loop: every operation on floats in it is rounded by itself.
    pub fn exact_attribute(&mut self, attrs: &[syn::Attribute]) -> bool {
        // Errors in other attributes are reported where those are read, once.
        let noted = self.errors.len();
        let exact = self.hidden_attributes(attrs).iter().any(is_exact);
        self.errors.truncate(noted);
        exact
    }

    /// `half` before a function or a `let`: its values are computed in half precision.
    pub fn half_attribute(&mut self, attrs: &[syn::Attribute]) -> bool {
        let noted = self.errors.len();
        let half = self.hidden_attributes(attrs).iter().any(is_half);
        self.errors.truncate(noted);
        half
    }

    /// The attributes inside `cfg_attr(false, ...)`. Others are rustc's.
    fn hidden_attributes(&mut self, attrs: &[syn::Attribute]) -> Vec<syn::Meta> {
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
        let span = self.token_span(span);
        self.errors.push(
            Diagnostic::error_at(Code::Attribute, span, message)
                .label("not understood")
                .help(help),
        );
    }
}

fn is_half(meta: &syn::Meta) -> bool {
    matches!(meta, syn::Meta::Path(path) if path.is_ident("half"))
}

fn is_exact(meta: &syn::Meta) -> bool {
    matches!(meta, syn::Meta::Path(path) if path.is_ident("exact"))
}
