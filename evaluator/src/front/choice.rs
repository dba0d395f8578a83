//! `match`, and what is written in other ways and means one: `if let`, `while let`, `let ... else`, `matches!`.

use super::expr::{Lower, label_name};
use super::name::Name;
use super::targets::BreakKind;
use super::tree::{Arm, Block, Expr, ExprKind, Pattern, Statement, Type};
use crate::diagnostic::Span;
use syn::parse::{Parse, ParseStream};
use syn::spanned::Spanned;

/// Arguments of `matches!(value, pattern if guard)`.
pub struct MatchesSyntax {
    /// The value.
    pub value: syn::Expr,
    /// Pattern that the value is compared with.
    pub pattern: syn::Pat,
    /// Additional condition.
    pub guard: Option<syn::Expr>,
}

impl Parse for MatchesSyntax {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let value = input.parse()?;
        input.parse::<syn::Token![,]>()?;
        let pattern = syn::Pat::parse_multi_with_leading_vert(input)?;
        let guard = match input.parse::<Option<syn::Token![if]>>()? {
            Some(_) => Some(input.parse()?),
            None => None,
        };
        input.parse::<Option<syn::Token![,]>>()?;
        Ok(MatchesSyntax { value, pattern, guard })
    }
}

/// Returns whether a condition has a `let` that is not in parentheses.
pub fn has_let(condition: &syn::Expr) -> bool {
    match condition {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(e) if matches!(e.op, syn::BinOp::And(_)) => has_let(&e.left) || has_let(&e.right),
        _ => false,
    }
}

impl Lower {
    /// `match`.
    pub fn lower_match(&mut self, e: &syn::ExprMatch) -> ExprKind {
        let subject = self.boxed(&e.expr);
        let mut arms = Vec::new();
        for arm in &e.arms {
            let (pattern, guard) = self.lower_arm_pattern(&arm.pat);
            let body = self.lower_expr(&arm.body);
            arms.push(Arm { pattern, guard, body });
        }
        ExprKind::Match(subject, arms, self.branch_attribute(&e.attrs))
    }

    /// A pattern of an arm, and the guard after it.
    fn lower_arm_pattern(&mut self, pattern: &syn::Pat) -> (Pattern, Option<Expr>) {
        match pattern {
            syn::Pat::Guard(p) => (self.lower_pattern(&p.pat), Some(self.lower_expr(&p.guard))),
            other => (self.lower_pattern(other), None),
        }
    }

    /// `if let pattern = value && guard { .. } else { .. }`.
    pub fn if_let(&mut self, e: &syn::ExprIf) -> ExprKind {
        let (subject, pattern, guard) = self.let_condition(&e.cond);
        let then = ExprKind::Block(self.lower_block(&e.then_branch));
        let then = self.expr_at(then, e.then_branch.span());
        let otherwise = match &e.else_branch {
            Some((_, other)) => *self.lower_link(other),
            None => self.expr_at(ExprKind::Tuple(Vec::new()), e.span()),
        };
        let attribute = self.branch_attribute(&e.attrs);
        ExprKind::Match(
            Box::new(subject),
            vec![make_arm(pattern, guard, then), make_arm(Pattern::Wild, None, otherwise)],
            attribute,
        )
    }

    /// `while let pattern = value { .. }`: a loop that ends where the pattern does not take the value.
    pub fn while_let(&mut self, e: &syn::ExprWhile) -> ExprKind {
        let (subject, pattern, guard) = self.let_condition(&e.cond);
        let name = label_name(e.label.as_ref().map(|l| &l.name));
        let (body, _) = self.with_target(name.clone(), BreakKind::Other("while"), |lower| {
            lower.lower_block(&e.body)
        });
        let body = self.expr_at(ExprKind::Block(body), e.body.span());
        let end = self.expr_at(ExprKind::Break(None), e.while_token.span());
        let arms = vec![make_arm(pattern, guard, body), make_arm(Pattern::Wild, None, end)];
        let choice = self.expr_at(ExprKind::Match(Box::new(subject), arms, None), e.span());
        let always = self.expr_at(ExprKind::Bool(true), e.while_token.span());
        let block = Block {
            statements: vec![Statement::Expr(choice)],
            value: None,
            exact: false,
        };
        self.lower_while(always, block, name, &e.attrs)
    }

    /// The value, the pattern and the guard of a condition that begins with `let`.
    fn let_condition(&mut self, condition: &syn::Expr) -> (Expr, Pattern, Option<Expr>) {
        match condition {
            syn::Expr::Let(e) => (self.lower_expr(&e.expr), self.lower_pattern(&e.pat), None),
            syn::Expr::Binary(e) => {
                let (subject, pattern, guard) = self.let_condition(&e.left);
                let right = self.lower_expr(&e.right);
                let guard = match guard {
                    Some(left) => {
                        let both = ExprKind::Lazy(true, Box::new(left), Box::new(right));
                        self.expr_at(both, e.span())
                    }
                    None => right,
                };
                (subject, pattern, Some(guard))
            }
            other => {
                self.note_unsupported(
                    other.span(),
                    "a condition before a `let`",
                    "write the `let` first, or an `if` around the `if let`",
                );
                let nothing = self.expr_at(ExprKind::Tuple(Vec::new()), other.span());
                (nothing, Pattern::Wild, None)
            }
        }
    }

    /// `let pattern: ty = value else { .. }`: the names of the pattern are those of a tuple that a `match` gives.
    pub fn let_else(&mut self, pattern: Pattern, ty: Option<Type>, value: Expr, other: Expr, span: Span) -> Statement {
        const VALUE: &str = "value";
        let mut names = Vec::new();
        collect_bindings(&pattern, &mut names);
        let part = |name: &Name| Expr {
            kind: ExprKind::Path(vec![name.to_string()]),
            span,
        };
        let parts = ExprKind::Tuple(names.iter().map(|(name, ..)| part(name)).collect());
        let subject = match ty {
            None => value,
            // The type is that of the value, not of what is taken out of it.
            Some(_) => {
                let name = Pattern::Name(VALUE.into(), false, span);
                let at = value.span;
                let block = Block {
                    statements: vec![Statement::Let(name, ty, Some(value), span)],
                    value: Some(Box::new(part(&VALUE.into()))),
                    exact: false,
                };
                Expr {
                    kind: ExprKind::Block(block),
                    span: at,
                }
            }
        };
        let arms = vec![
            make_arm(pattern, None, Expr { kind: parts, span }),
            make_arm(Pattern::Wild, None, other),
        ];
        let choice = Expr {
            kind: ExprKind::Match(Box::new(subject), arms, None),
            span,
        };
        let names = names
            .into_iter()
            .map(|(name, mutable, at)| Pattern::Name(name, mutable, at));
        Statement::Let(Pattern::Tuple(names.collect(), span), None, Some(choice), span)
    }

    /// `matches!(value, pattern if guard)`.
    pub fn matches_macro(&mut self, call: &syn::Macro) -> ExprKind {
        let Ok(MatchesSyntax { value, pattern, guard }) = call.parse_body() else {
            self.note_unsupported(
                call.span(),
                "this `matches!`",
                "give a value and a pattern: `matches!(x, 1 | 2)`",
            );
            return ExprKind::Tuple(Vec::new());
        };
        let subject = self.boxed(&value);
        let pattern = self.lower_pattern(&pattern);
        let guard = guard.map(|e| self.lower_expr(&e));
        let (yes, no) = (
            self.expr_at(ExprKind::Bool(true), call.span()),
            self.expr_at(ExprKind::Bool(false), call.span()),
        );
        let arms = vec![make_arm(pattern, guard, yes), make_arm(Pattern::Wild, None, no)];
        ExprKind::Match(subject, arms, None)
    }

    pub fn expr_at(&self, kind: ExprKind, span: proc_macro2::Span) -> Expr {
        Expr {
            kind,
            span: self.token_span(span),
        }
    }
}

fn make_arm(pattern: Pattern, guard: Option<Expr>, body: Expr) -> Arm {
    Arm { pattern, guard, body }
}

/// The names that a pattern binds, each once.
pub fn collect_bindings(pattern: &Pattern, out: &mut Vec<(Name, bool, Span)>) {
    let mut name = |name: &Name, mutable: bool, at: Span| {
        if out.iter().all(|(known, ..)| known != name) {
            out.push((name.clone(), mutable, at));
        }
    };
    match pattern {
        Pattern::Name(n, mutable, at) => name(n, *mutable, *at),
        Pattern::At(n, mutable, inner, at) => {
            name(n, *mutable, *at);
            collect_bindings(inner, out);
        }
        Pattern::Tuple(parts, _) | Pattern::Array(parts, _) | Pattern::Or(parts) => {
            parts.iter().for_each(|part| collect_bindings(part, out));
        }
        Pattern::Struct(_, fields, _) => fields.iter().for_each(|(_, part)| collect_bindings(part, out)),
        Pattern::Ref(inner, _) => collect_bindings(inner, out),
        Pattern::Wild | Pattern::Rest | Pattern::Value(_) | Pattern::Range(..) => {}
    }
}
