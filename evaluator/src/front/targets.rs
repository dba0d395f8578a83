//! `break` with a value, of a `loop` or a block with a label: what it gives is a variable that the `break` assigns.

use super::expr::{Lower, label_name};
use super::scan::has_break;
use super::tree::{Block, Expr, ExprKind, Pattern, Statement};
use crate::diagnostic::{Code, Diagnostic, Span};
use syn::spanned::Spanned;

/// A loop or labelled block that a `break` may leave.
pub struct BreakTarget {
    label: Option<String>,
    kind: BreakKind,
    /// `true` if a `break` out of it has a value.
    valued: bool,
}

/// Kinds of what a `break` may lead out of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum BreakKind {
    /// `loop`.
    Loop,
    /// `for`, `while`, which give no value.
    Other(&'static str),
    /// A block with a label.
    Block,
}

impl Lower {
    /// Lowers what stands in a loop or in a block with a label; tells whether a `break` of it has a value.
    pub fn with_target<T>(
        &mut self,
        label: Option<String>,
        kind: BreakKind,
        lower: impl FnOnce(&mut Self) -> T,
    ) -> (T, bool) {
        self.targets.push(BreakTarget {
            label,
            kind,
            valued: false,
        });
        let lowered = lower(self);
        let valued = self.targets.pop().is_some_and(|target| target.valued);
        (lowered, valued)
    }

    /// The name of the variable that a `break` of the innermost target assigns, once that is left.
    fn name_within(&self, depth: usize) -> String {
        format!("#break{depth}")
    }

    /// `loop`.
    pub fn lower_loop(&mut self, e: &syn::ExprLoop) -> ExprKind {
        let name = label_name(e.label.as_ref().map(|l| &l.name));
        let span = self.token_span(e.span());
        let always = Expr {
            kind: ExprKind::Bool(true),
            span: self.token_span(e.loop_token.span()),
        };
        let (body, valued) = self.with_target(name.clone(), BreakKind::Loop, |lower| lower.lower_block(&e.body));
        let ends = !valued && has_break(&body, name.as_deref());
        let kind = self.lower_while(always, body, name, &e.attrs);
        if matches!(kind, ExprKind::For(_)) && !ends {
            let error = Diagnostic::error_at(
                Code::Attribute,
                span,
                "a `loop` that ends with a value takes no `bound`",
            )
            .label("only a `return` or a `break` with a value ends it")
            .help("end it by `break`, and give the value behind it");
            self.errors.push(error);
        }
        match valued {
            true => self.wrap_break_value(Expr { kind, span }),
            false => kind,
        }
    }

    /// `'label: { .. }`.
    pub fn lower_labelled(&mut self, e: &syn::ExprBlock) -> ExprKind {
        let name = label_name(e.label.as_ref().map(|l| &l.name)).unwrap_or_default();
        let span = self.token_span(e.span());
        let (mut body, valued) = self.with_target(Some(name.clone()), BreakKind::Block, |lower| {
            lower.lower_block(&e.block)
        });
        if valued && let Some(value) = body.value.take() {
            let at = value.span;
            let assigned = self.assign_break_value(self.targets.len(), *value, at);
            body.statements.push(Statement::Expr(assigned));
        }
        let kind = ExprKind::Labelled(name, body);
        match valued {
            true => self.wrap_break_value(Expr { kind, span }),
            false => kind,
        }
    }

    /// Wraps a loop or block that is left with a value: the result is the variable that the `break` assigns.
    fn wrap_break_value(&self, left: Expr) -> ExprKind {
        let (span, name) = (left.span, self.name_within(self.targets.len()));
        let value = Expr {
            kind: ExprKind::Path(vec![name.clone()]),
            span,
        };
        ExprKind::Block(Block {
            statements: vec![
                Statement::Let(Pattern::Name(name.into(), true, span), None, None, span),
                Statement::Expr(left),
            ],
            value: Some(Box::new(value)),
            exact: false,
        })
    }

    fn assign_break_value(&self, depth: usize, value: Expr, span: Span) -> Expr {
        let place = Expr {
            kind: ExprKind::Path(vec![self.name_within(depth)]),
            span,
        };
        Expr {
            kind: ExprKind::Assign(Box::new(place), None, Box::new(value)),
            span,
        }
    }

    /// `break`, with a value or without.
    pub fn lower_break(&mut self, e: &syn::ExprBreak) -> ExprKind {
        let name = label_name(e.label.as_ref());
        let leave = ExprKind::Break(name.clone());
        let Some(value) = &e.expr else { return leave };
        let value = self.lower_expr(value);
        let span = self.token_span(e.span());
        let found = self.targets.iter().rposition(|target| match &name {
            Some(_) => target.label == name,
            None => target.kind != BreakKind::Block,
        });
        // That there is none is said by inference.
        let Some(depth) = found else { return leave };
        if let BreakKind::Other(word) = self.targets[depth].kind {
            self.errors.push(
                Diagnostic::error_at(
                    Code::Leaving,
                    span,
                    format!("`break` with a value from a `{word}` loop"),
                )
                .label("only `loop` and blocks with a label have a value")
                .help("assign the value to a variable before, or write `loop`"),
            );
            return leave;
        }
        self.targets[depth].valued = true;
        let assigned = self.assign_break_value(depth, value, span);
        let leave = Expr { kind: leave, span };
        ExprKind::Block(Block {
            statements: vec![Statement::Expr(assigned)],
            value: Some(Box::new(leave)),
            exact: false,
        })
    }
}
