//! Ranges, as values, as indices and in loops.

use super::{COUNTED, Lower};
use crate::front::tree::{Bounds, ExprKind};
use syn::spanned::Spanned;

impl Lower {
    /// The ends of a slice; as an index alone a range may lack an end.
    pub(super) fn lower_bounds(&mut self, range: &syn::ExprRange) -> Bounds {
        let mut end = |of: &Option<Box<syn::Expr>>| of.as_ref().map(|end| self.boxed(end));
        Bounds {
            start: end(&range.start),
            end: end(&range.end),
            inclusive: matches!(range.limits, syn::RangeLimits::Closed(_)),
        }
    }

    pub(super) fn lower_range(&mut self, e: &syn::ExprRange) -> ExprKind {
        match (&e.start, &e.end) {
            (Some(start), Some(end)) => {
                let inclusive = matches!(e.limits, syn::RangeLimits::Closed(_));
                ExprKind::Range(self.boxed(start), self.boxed(end), inclusive)
            }
            (Some(start), None) => ExprKind::Call(vec![COUNTED.to_owned()], Vec::new(), vec![self.lower_expr(start)]),
            _ => {
                self.note_unsupported(e.span(), "a range without a start", "write both ends: `0..n`");
                ExprKind::Tuple(Vec::new())
            }
        }
    }
    /// `for k in start.. { .. }`: a `loop` that counts.
    pub(super) fn lower_open_for(&mut self, e: &syn::ExprForLoop, start: &syn::Expr) -> ExprKind {
        let (attrs, label, pattern, body) = (&e.attrs, &e.label, &e.pat, &e.body.stmts);
        let next = quote::format_ident!("__next", span = e.expr.span());
        let block = quote::quote! {{
            let mut #next = #start;
            #(#attrs)* #label loop { let #pattern = #next; #next += 1; #(#body)* }
        }};
        match syn::parse2(block) {
            Ok(block) => ExprKind::Block(self.lower_block(&block)),
            Err(_) => ExprKind::Tuple(Vec::new()),
        }
    }
}

/// The range that an index is, in parentheses or not.
pub(super) fn range_in_brackets(index: &syn::Expr) -> Option<&syn::ExprRange> {
    match index {
        syn::Expr::Range(range) => Some(range),
        syn::Expr::Paren(inner) => range_in_brackets(&inner.expr),
        syn::Expr::Group(inner) => range_in_brackets(&inner.expr),
        _ => None,
    }
}

/// Start of a range without an end, in parentheses or not.
pub(super) fn open_start(over: &syn::Expr) -> Option<&syn::Expr> {
    let range = range_in_brackets(over)?;
    range.start.as_deref().filter(|_| range.end.is_none())
}
