//! `match`, and what is written in other ways and means one: `if let`, `while let`, `let ... else`, `matches!`.

use super::expr::{Lower, label};
use super::name::Name;
use super::targets::Kind;
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
    pub fn match_(&mut self, e: &syn::ExprMatch) -> ExprKind {
        let subject = self.boxed(&e.expr);
        let mut arms = Vec::new();
        for arm in &e.arms {
            let (pattern, guard) = self.guarded(&arm.pat);
            let body = self.expr(&arm.body);
            arms.push(Arm { pattern, guard, body });
        }
        ExprKind::Match(subject, arms, self.branch_attribute(&e.attrs))
    }

    /// A pattern of an arm, and the guard after it.
    fn guarded(&mut self, pattern: &syn::Pat) -> (Pattern, Option<Expr>) {
        match pattern {
            syn::Pat::Guard(p) => (self.pattern(&p.pat), Some(self.expr(&p.guard))),
            other => (self.pattern(other), None),
        }
    }

    /// `if let pattern = value && guard { .. } else { .. }`.
    pub fn if_let(&mut self, e: &syn::ExprIf) -> ExprKind {
        let (subject, pattern, guard) = self.let_condition(&e.cond);
        let then = ExprKind::Block(self.block(&e.then_branch));
        let then = self.at(then, e.then_branch.span());
        let otherwise = match &e.else_branch {
            Some((_, other)) => *self.link(other),
            None => self.at(ExprKind::Tuple(Vec::new()), e.span()),
        };
        let attribute = self.branch_attribute(&e.attrs);
        ExprKind::Match(
            Box::new(subject),
            vec![taken(pattern, guard, then), taken(Pattern::Wild, None, otherwise)],
            attribute,
        )
    }

    /// `while let pattern = value { .. }`: a loop that ends where the pattern does not take the value.
    pub fn while_let(&mut self, e: &syn::ExprWhile) -> ExprKind {
        let (subject, pattern, guard) = self.let_condition(&e.cond);
        let name = label(e.label.as_ref().map(|l| &l.name));
        let (body, _) = self.inside(name.clone(), Kind::Other("while"), |lower| lower.block(&e.body));
        let body = self.at(ExprKind::Block(body), e.body.span());
        let end = self.at(ExprKind::Break(None), e.while_token.span());
        let arms = vec![taken(pattern, guard, body), taken(Pattern::Wild, None, end)];
        let choice = self.at(ExprKind::Match(Box::new(subject), arms, None), e.span());
        let always = self.at(ExprKind::Bool(true), e.while_token.span());
        let block = Block {
            statements: vec![Statement::Expr(choice)],
            value: None,
            exact: false,
        };
        self.while_(always, block, name, &e.attrs)
    }

    /// The value, the pattern and the guard of a condition that begins with `let`.
    fn let_condition(&mut self, condition: &syn::Expr) -> (Expr, Pattern, Option<Expr>) {
        match condition {
            syn::Expr::Let(e) => (self.expr(&e.expr), self.pattern(&e.pat), None),
            syn::Expr::Binary(e) => {
                let (subject, pattern, guard) = self.let_condition(&e.left);
                let right = self.expr(&e.right);
                let guard = match guard {
                    Some(left) => {
                        let both = ExprKind::Lazy(true, Box::new(left), Box::new(right));
                        self.at(both, e.span())
                    }
                    None => right,
                };
                (subject, pattern, Some(guard))
            }
            other => {
                self.unsupported(
                    other.span(),
                    "a condition before a `let`",
                    "write the `let` first, or an `if` around the `if let`",
                );
                let nothing = self.at(ExprKind::Tuple(Vec::new()), other.span());
                (nothing, Pattern::Wild, None)
            }
        }
    }

    /// `let pattern: ty = value else { .. }`: the names of the pattern are those of a tuple that a `match` gives.
    pub fn let_else(&mut self, pattern: Pattern, ty: Option<Type>, value: Expr, other: Expr, span: Span) -> Statement {
        const VALUE: &str = "value";
        let mut names = Vec::new();
        bound(&pattern, &mut names);
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
            taken(pattern, None, Expr { kind: parts, span }),
            taken(Pattern::Wild, None, other),
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
            self.unsupported(
                call.span(),
                "this `matches!`",
                "give a value and a pattern: `matches!(x, 1 | 2)`",
            );
            return ExprKind::Tuple(Vec::new());
        };
        let subject = self.boxed(&value);
        let pattern = self.pattern(&pattern);
        let guard = guard.map(|e| self.expr(&e));
        let (yes, no) = (
            self.at(ExprKind::Bool(true), call.span()),
            self.at(ExprKind::Bool(false), call.span()),
        );
        let arms = vec![taken(pattern, guard, yes), taken(Pattern::Wild, None, no)];
        ExprKind::Match(subject, arms, None)
    }

    pub fn at(&self, kind: ExprKind, span: proc_macro2::Span) -> Expr {
        Expr {
            kind,
            span: self.span(span),
        }
    }
}

fn taken(pattern: Pattern, guard: Option<Expr>, body: Expr) -> Arm {
    Arm { pattern, guard, body }
}

/// The names that a pattern binds, each once.
fn bound(pattern: &Pattern, out: &mut Vec<(Name, bool, Span)>) {
    let mut name = |name: &Name, mutable: bool, at: Span| {
        if out.iter().all(|(known, ..)| known != name) {
            out.push((name.clone(), mutable, at));
        }
    };
    match pattern {
        Pattern::Name(n, mutable, at) => name(n, *mutable, *at),
        Pattern::At(n, mutable, inner, at) => {
            name(n, *mutable, *at);
            bound(inner, out);
        }
        Pattern::Tuple(parts, _) | Pattern::Array(parts, _) | Pattern::Or(parts) => {
            parts.iter().for_each(|part| bound(part, out));
        }
        Pattern::Struct(_, fields, _) => fields.iter().for_each(|(_, part)| bound(part, out)),
        Pattern::Ref(inner, _) => bound(inner, out),
        Pattern::Wild | Pattern::Rest | Pattern::Value(_) | Pattern::Range(..) => {}
    }
}
