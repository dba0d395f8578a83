//! Attributes: which of them remove text, which rustc and the generator may pass over, and which are refused.
//!
//! `#[cfg(..)]` is evaluated as far as a source text by itself allows. What depends on how a crate is built is refused.

use super::expr::Lower;
use crate::diagnostic::{Code, Diagnostic};
use crate::suggest::suggest_name;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::spanned::Spanned;

/// Syntax that attributes stand before, which determines the generator's own attributes that it accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// `for`, `while` or `loop`: `unroll(..)`, `bound(..)`, `exact`.
    Loop,
    /// `if` or `match`: `branch`, `select`, `exact`.
    Branch,
    /// A function: `unroll(..)`, which is said of all loops in it, `exact` and `half`.
    Function,
    /// A block: `exact`.
    Statement,
    /// `let`: `exact`, `half`, and with the value of an `if` or `match` (true) `branch` and `select`.
    Let(bool),
    /// Anything else.
    Other,
}

impl Carrier {
    /// Returns whether one of the generator's own attributes may stand before this syntax. Attributes that only loops or only conditions
    /// accept are checked when these are lowered.
    fn accepts_attribute(self, attribute: &str) -> bool {
        match self {
            Carrier::Loop | Carrier::Branch => attribute != HALF,
            Carrier::Let(true) => true,
            Carrier::Let(false) => [EXACT, HALF].contains(&attribute),
            Carrier::Function => ["unroll", EXACT, HALF].contains(&attribute),
            Carrier::Statement => attribute == EXACT,
            Carrier::Other => false,
        }
    }
}

/// The generator's own attributes.
const OWN: [&str; 6] = ["unroll", "bound", "branch", "select", EXACT, HALF];

const EXACT: &str = "exact";

const HALF: &str = "half";

/// Attributes that neither remove nor change the code after them.
const INERT: [&str; 26] = [
    "allow",
    "automatically_derived",
    "cold",
    "clippy",
    "default",
    "deny",
    "deprecated",
    "derive",
    "diagnostic",
    "doc",
    "expect",
    "feature",
    "forbid",
    "inline",
    "macro_export",
    "macro_use",
    "must_use",
    "no_std",
    "non_exhaustive",
    "recursion_limit",
    "repr",
    "rustfmt",
    "target_feature",
    "track_caller",
    "type_length_limit",
    "warn",
];

impl Lower {
    /// Returns whether `cfg` keeps text with these attributes. Attributes that are true are removed; those that cannot be decided, or that
    /// change the text after them in other ways, are errors.
    pub fn keeps_by_cfg(&mut self, attrs: &mut Vec<syn::Attribute>, carrier: Carrier) -> bool {
        let mut kept = true;
        attrs.retain(|attr| {
            if !attr.path().is_ident("cfg") {
                return true;
            }
            let tokens = match &attr.meta {
                syn::Meta::List(list) => list.tokens.clone(),
                _ => TokenStream::new(),
            };
            match eval_predicate(tokens.clone()) {
                Some(true) => {}
                Some(false) => kept = false,
                None => self.note_undecided_cfg(attr.span(), &tokens),
            }
            false
        });
        if kept {
            for attr in attrs.iter() {
                if attr.path().is_ident("cfg_attr") {
                    self.check_cfg_attr(attr, carrier);
                } else {
                    self.check_attribute(attr.path(), attr.span());
                }
            }
        }
        kept
    }

    /// As [`Lower::keeps`], where nothing can be left out.
    pub fn keeps_always(&mut self, attrs: &mut Vec<syn::Attribute>, carrier: Carrier) {
        let span = attrs.first().map(Spanned::span);
        if !self.keeps_by_cfg(attrs, carrier)
            && let Some(span) = span
        {
            self.note_unsupported(
                span,
                "`#[cfg(..)]` on a part of an expression",
                "put it before a statement, an arm, a field or an item",
            );
        }
    }

    fn note_undecided_cfg(&mut self, span: proc_macro2::Span, predicate: &TokenStream) {
        let span = self.token_span(span);
        self.errors.push(
            Diagnostic::error_at(
                Code::Configuration,
                span,
                format!("`cfg({})` depends on how the crate is built", as_written(predicate)),
            )
            .label("not known from the source alone")
            .help("remove it, or make it an option of the kernel (`options!`) and an `if`"),
        );
    }

    /// `#[cfg_attr(predicate, attributes)]`.
    fn check_cfg_attr(&mut self, attr: &syn::Attribute, carrier: Carrier) {
        let syn::Meta::List(list) = &attr.meta else {
            return self.note_unsupported(attr.span(), "this `cfg_attr`", "write `cfg_attr(false, unroll(none))`");
        };
        let mut parts = split_at_commas(list.tokens.clone()).into_iter();
        let condition = parts.next().unwrap_or_default();
        let known = eval_predicate(condition.clone());
        let literal = condition.to_string() == "false";
        if known.is_none() && parts.len() == 0 {
            return self.note_undecided_cfg(attr.span(), &condition);
        }
        for part in parts {
            let name = first_word(&part);
            let own = OWN.contains(&name.as_str());
            match known {
                _ if own && !literal => self.note_unsupported(
                    attr.span(),
                    &format!("`{name}` under another condition than `false`"),
                    &format!("write `#[cfg_attr(false, {})]`", as_written(&part)),
                ),
                Some(false) if own && !carrier.accepts_attribute(&name) => {
                    let (of, help) = match name.as_str() {
                        "unroll" => (
                            "a loop or a function",
                            "put it right before a `for`, `while`, `loop` or `fn`",
                        ),
                        "bound" => ("a `while` or `loop`", "put it right before a `while` or `loop`"),
                        EXACT => (
                            "a function, a statement or a block",
                            "put it right before a `fn`, a `let`, a block, an `if`, a `match` or a loop",
                        ),
                        HALF => ("a function or a `let`", "put it right before a `fn` or a `let`"),
                        _ => (
                            "an `if`",
                            "put it right before an `if`, or before the `let` that takes its value",
                        ),
                    };
                    let span = self.token_span(attr.span());
                    self.errors.push(
                        Diagnostic::error_at(Code::Attribute, span, format!("`{name}` is an attribute of {of}"))
                            .label(format!("not before {of}"))
                            .help(help),
                    );
                }
                // Loops and conditions look at theirs where they are lowered.
                Some(false)
                    if literal && !own && !INERT.contains(&name.as_str()) && !carrier.accepts_attribute(&name) =>
                {
                    let span = self.token_span(attr.span());
                    let what = format!("there is no attribute `{name}`");
                    let help = suggest_name(&name, &OWN, "the generator has");
                    self.errors.push(
                        Diagnostic::error_at(Code::Attribute, span, what)
                            .label("not understood")
                            .help(help),
                    );
                }
                Some(false) => {}
                Some(true) => match syn::parse2::<syn::Meta>(part.clone()) {
                    Ok(meta) => self.check_attribute(meta.path(), attr.span()),
                    Err(_) => {
                        self.note_unsupported(attr.span(), "this `cfg_attr`", "write attributes after the condition")
                    }
                },
                None if INERT.contains(&name.as_str()) => {}
                None => self.note_undecided_cfg(attr.span(), &condition),
            }
        }
    }

    /// An attribute that applies.
    fn check_attribute(&mut self, path: &syn::Path, span: proc_macro2::Span) {
        let name = path.segments.first().map(|s| s.ident.to_string()).unwrap_or_default();
        match name.as_str() {
            known if INERT.contains(&known) => {}
            own if OWN.contains(&own) => {
                let shown = match own {
                    "unroll" => "unroll(none)",
                    "bound" => "bound(64)",
                    _ => own,
                };
                self.note_unsupported(
                    span,
                    &format!("the attribute `{name}` as rustc sees it"),
                    &format!("hide it from rustc: `#[cfg_attr(false, {shown})]`"),
                );
            }
            _ => {
                let path = as_written(path);
                self.note_unsupported(
                    span,
                    &format!("the attribute `{path}`"),
                    "remove it; `doc`, `derive`, `inline` and lints may stay",
                );
            }
        }
    }
}

/// Returns whether a function is a test, which no kernel is.
pub fn is_test(attrs: &[syn::Attribute]) -> bool {
    attrs
        .iter()
        .any(|a| ["test", "bench"].iter().any(|name| a.path().is_ident(name)))
}

/// Evaluates a `cfg` predicate as it is when a kernel is read, if the text alone decides it: `test` is false.
fn eval_predicate(tokens: TokenStream) -> Option<bool> {
    let mut parts = split_at_commas(tokens);
    let trees: Vec<TokenTree> = match parts.len() {
        1 => parts.remove(0).into_iter().collect(),
        _ => return None,
    };
    match trees.as_slice() {
        [TokenTree::Ident(word)] => match word.to_string().as_str() {
            "true" => Some(true),
            "false" | "test" => Some(false),
            _ => None,
        },
        [TokenTree::Ident(word), TokenTree::Group(group)] if group.delimiter() == Delimiter::Parenthesis => {
            let inner: Vec<Option<bool>> = split_at_commas(group.stream())
                .into_iter()
                .map(eval_predicate)
                .collect();
            match word.to_string().as_str() {
                "not" if inner.len() == 1 => inner[0].map(|b| !b),
                "all" if inner.contains(&Some(false)) => Some(false),
                "all" if inner.iter().all(Option::is_some) => Some(true),
                "any" if inner.contains(&Some(true)) => Some(true),
                "any" if inner.iter().all(Option::is_some) => Some(false),
                _ => None,
            }
        }
        _ => None,
    }
}

/// Parts between commas; one after the last comma only if there is something.
fn split_at_commas(tokens: TokenStream) -> Vec<TokenStream> {
    let mut parts = vec![TokenStream::new()];
    for token in tokens {
        match &token {
            TokenTree::Punct(p) if p.as_char() == ',' => parts.push(TokenStream::new()),
            _ => parts.last_mut().expect("never empty").extend([token]),
        }
    }
    if parts.last().is_some_and(TokenStream::is_empty) {
        parts.pop();
    }
    parts
}

/// Text as it stands in the file.
pub fn as_written(tokens: &impl ToTokens) -> String {
    let text = tokens.span().source_text();
    text.unwrap_or_else(|| tokens.to_token_stream().to_string())
}

fn first_word(tokens: &TokenStream) -> String {
    match tokens.clone().into_iter().next() {
        Some(TokenTree::Ident(word)) => word.to_string(),
        _ => String::new(),
    }
}
