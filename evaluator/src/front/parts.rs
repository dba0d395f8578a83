//! Patterns where a statement takes them apart: assignments to several places at once, and parameters.

use super::expr::Lower;
use super::tree::{Block, Expr, ExprKind, Param, Pattern, Statement, Type};
use crate::diagnostic::Span;
use syn::spanned::Spanned;

/// Returns whether the left side of an assignment is a pattern of places, not a place.
pub fn takes_apart(left: &syn::Expr) -> bool {
    match left {
        syn::Expr::Tuple(_) | syn::Expr::Array(_) | syn::Expr::Infer(_) | syn::Expr::Struct(_) => true,
        // Of a tuple structure: no call is a place.
        syn::Expr::Call(e) => matches!(&*e.func, syn::Expr::Path(_)),
        syn::Expr::Paren(e) => takes_apart(&e.expr),
        _ => false,
    }
}

impl Lower {
    /// `(a, b) = value`: the parts of the value are given to the places in order, after all of it has been computed.
    pub fn lower_destructuring(&mut self, e: &syn::ExprAssign) -> ExprKind {
        let span = self.token_span(e.span());
        let mut places = Vec::new();
        let pattern = self.collect_places(&e.left, &mut places);
        let value = self.lower_expr(&e.right);
        let mut statements = vec![Statement::Let(pattern, None, Some(value), span)];
        for (k, place) in places.into_iter().enumerate() {
            let at = place.span;
            let part = Expr {
                kind: ExprKind::Path(vec![hidden_name(k)]),
                span: at,
            };
            statements.push(Statement::Expr(Expr {
                kind: ExprKind::Assign(Box::new(place), None, Box::new(part)),
                span: at,
            }));
        }
        ExprKind::Block(Block {
            statements,
            value: None,
            exact: false,
        })
    }

    /// A pattern that names the parts that places are given, and the places.
    fn collect_places(&mut self, left: &syn::Expr, out: &mut Vec<Expr>) -> Pattern {
        let span = self.token_span(left.span());
        match left {
            syn::Expr::Paren(e) => self.collect_places(&e.expr, out),
            syn::Expr::Infer(_) => Pattern::Wild,
            syn::Expr::Range(e) if e.start.is_none() && e.end.is_none() => Pattern::Rest,
            syn::Expr::Call(e) if takes_apart(left) => {
                let path = match &*e.func {
                    syn::Expr::Path(path) => self.path_segments(&path.path),
                    _ => Vec::new(),
                };
                let rest =
                    matches!(e.args.last(), Some(syn::Expr::Range(last)) if last.start.is_none() && last.end.is_none());
                let parts = e.args.iter().take(e.args.len() - usize::from(rest)).enumerate();
                let parts = parts.map(|(k, part)| (k.to_string().into(), self.collect_places(part, out)));
                let parts = parts.collect();
                Pattern::Struct(path, parts, span)
            }
            syn::Expr::Struct(e) => {
                let path = self.path_segments(&e.path);
                let mut fields = Vec::new();
                for field in &e.fields {
                    fields.push((
                        super::expr::member_name(&field.member),
                        self.collect_places(&field.expr, out),
                    ));
                }
                Pattern::Struct(path, fields, span)
            }
            syn::Expr::Tuple(e) => {
                let parts = e.elems.iter().map(|part| self.collect_places(part, out));
                Pattern::Tuple(parts.collect(), span)
            }
            syn::Expr::Array(e) => {
                let parts = e.elems.iter().map(|part| self.collect_places(part, out));
                Pattern::Array(parts.collect(), span)
            }
            place => {
                let place = self.lower_expr(place);
                out.push(place);
                Pattern::Name(hidden_name(out.len() - 1).into(), false, span)
            }
        }
    }

    /// Lowers a parameter that is a pattern: a parameter with a hidden name, and the `let` that destructures it.
    pub fn pattern_parameter(&mut self, pattern: &syn::Pat, ty: Type, position: usize) -> (Param, Statement) {
        let span = self.token_span(pattern.span());
        let name = hidden_name(position);
        let value = Expr {
            kind: ExprKind::Path(vec![name.clone()]),
            span,
        };
        let pattern = self.lower_pattern(pattern);
        let param = Param {
            name: name.into(),
            ty,
            mutable: false,
            span,
        };
        (param, Statement::Let(pattern, None, Some(value), span))
    }
}

/// Name of a variable that no source text can contain.
fn hidden_name(k: usize) -> String {
    format!("#{k}")
}

/// Adds statements before those of a block.
pub fn prepend_statements(statements: Vec<Statement>, block: Block, span: Span) -> Block {
    if statements.is_empty() {
        return block;
    }
    let body = Expr {
        kind: ExprKind::Block(block),
        span,
    };
    Block {
        statements,
        value: Some(Box::new(body)),
        exact: false,
    }
}
