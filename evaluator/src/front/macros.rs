//! Macros: assertions and `unreachable!()`. `matches!` is in `choice.rs`.

use super::cfg::as_written;
use super::expr::Lower;
use super::tree::ExprKind;
use crate::shorten;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

impl Lower {
    /// `matches!(value, pattern)`, assertions and `unreachable!()`; there are no other macros.
    pub fn macro_call(&mut self, call: &syn::Macro) -> ExprKind {
        if call.path.is_ident("matches") {
            return self.matches_macro(call);
        }
        let name = call.path.get_ident().map(ToString::to_string).unwrap_or_default();
        if is_assertion(&name) {
            return self.assertion(call, &name);
        }
        if name == "unreachable" {
            return ExprKind::Unreachable;
        }
        let instead = match name.as_str() {
            "panic" | "todo" | "unimplemented" => "give a value: a shader has no way to fail",
            _ => "write out what it stands for",
        };
        self.note_unsupported(call.span(), "a macro other than assertions and `matches!`", instead);
        ExprKind::Tuple(Vec::new())
    }

    /// `assert!`, `assert_eq!`, `assert_ne!`, and those of debug builds.
    fn assertion(&mut self, call: &syn::Macro, name: &str) -> ExprKind {
        let parser = Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated;
        let parts = call
            .parse_body_with(parser)
            .map(|parts| parts.into_iter().collect::<Vec<_>>());
        let parts = parts.unwrap_or_default();
        let (kind, only_debug) = match name.strip_prefix("debug_") {
            Some(kind) => (kind, true),
            None => (name, false),
        };
        let (condition, message) = match (kind, parts.as_slice()) {
            ("assert", [condition, message @ ..]) => (condition.clone(), message),
            ("assert_eq", [a, b, message @ ..]) => (syn::parse_quote!(#a == #b), message),
            ("assert_ne", [a, b, message @ ..]) => (syn::parse_quote!(#a != #b), message),
            _ => {
                self.note_unsupported(
                    call.span(),
                    "an assertion without a condition",
                    "write `assert!(radius > 0)`",
                );
                return ExprKind::Tuple(Vec::new());
            }
        };
        let message = match message {
            [] => format!("assertion failed: `{}`", shorten(&as_written(&condition))),
            [
                syn::Expr::Lit(syn::ExprLit {
                    lit: syn::Lit::Str(message),
                    ..
                }),
            ] if !message.value().contains(['{', '}']) => message.value(),
            _ => {
                let instead = "give a message without values: `assert!(radius > 0, \"no radius\")`";
                self.note_unsupported(call.span(), "a message with values", instead);
                return ExprKind::Tuple(Vec::new());
            }
        };
        let condition = self.boxed(&condition);
        ExprKind::Assert {
            condition,
            message,
            only_debug,
        }
    }
}

/// Returns whether a macro of this name is an assertion.
pub fn is_assertion(name: &str) -> bool {
    matches!(
        name.strip_prefix("debug_").unwrap_or(name),
        "assert" | "assert_eq" | "assert_ne"
    )
}
