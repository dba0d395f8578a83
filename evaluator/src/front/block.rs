//! Blocks: their statements, and the constants that hold in all of one.

use super::choice::collect_bindings;
use super::expr::Lower;
use super::mentioned_in;
use super::tree::{Block, Const, Expr, ExprKind, Pattern, Statement, Type};
use crate::diagnostic::{Code, Diagnostic, Span};
use std::collections::{BTreeSet, HashMap};
use syn::spanned::Spanned;

impl Lower {
    /// A block.
    pub fn lower_block(&mut self, block: &syn::Block) -> Block {
        // A constant holds in all of its block, before its line too.
        let mut constants = Vec::new();
        let mut statements = Vec::new();
        let mut value = None;
        for (k, statement) in block.stmts.iter().enumerate() {
            match statement {
                syn::Stmt::Local(local) => match self.lower_let(local) {
                    Statement::Let(pattern @ Pattern::Tuple(..), ty, None, span) => {
                        declare_deferred(pattern, ty, span, &mut statements);
                    }
                    statement => statements.push(statement),
                },
                syn::Stmt::Expr(expr, None) if k + 1 == block.stmts.len() => {
                    value = Some(Box::new(self.lower_statement(expr)));
                }
                syn::Stmt::Expr(expr, _) => {
                    let lowered = self.lower_statement(expr);
                    statements.push(Statement::Expr(lowered));
                }
                syn::Stmt::Item(syn::Item::Const(item)) => constants.push(self.lower_constant(item)),
                syn::Stmt::Item(syn::Item::Use(_)) => {}
                syn::Stmt::Item(item) => {
                    self.note_unsupported(
                        item.span(),
                        "an item inside an expression",
                        "move it to the top of the file",
                    );
                }
                syn::Stmt::Macro(m) => {
                    let kind = self.macro_call(&m.mac);
                    let span = self.token_span(m.span());
                    statements.push(Statement::Expr(Expr { kind, span }));
                }
            }
        }
        statements.splice(0..0, in_order(constants).into_iter().map(Statement::Const));
        Block {
            statements,
            value,
            exact: false,
        }
    }

    /// An expression that stands where a statement does.
    fn lower_statement(&mut self, expr: &syn::Expr) -> Expr {
        let exact = statement_attributes(expr).is_some_and(|attrs| self.exact_attribute(attrs));
        let lowered = self.lower_expr(expr);
        if exact { wrap_exact(lowered) } else { lowered }
    }

    fn lower_let(&mut self, local: &syn::Local) -> Statement {
        let span = self.token_span(local.span());
        let (pattern, ty) = match &local.pat {
            syn::Pat::Type(typed) => (self.lower_pattern(&typed.pat), Some(self.lower_type(&typed.ty))),
            other => (self.lower_pattern(other), None),
        };
        if self.half_attribute(&local.attrs) {
            let mut names = Vec::new();
            collect_bindings(&pattern, &mut names);
            self.half.extend(names.iter().map(|(name, ..)| name.to_string()));
        }
        if let Some(init) = &local.init
            && let Some((_, other)) = &init.diverge
        {
            let mut value = self.lower_expr(&init.expr);
            if self.exact_attribute(&local.attrs) {
                value = wrap_exact(value);
            }
            let other = self.lower_expr(other);
            return self.let_else(pattern, ty, value, other, span);
        }
        let init = local.init.as_ref().map(|init| {
            let mut value = self.lower_expr(&init.expr);
            if let ExprKind::If(_, _, _, branches) | ExprKind::Match(_, _, branches) = &mut value.kind {
                *branches = branches.or(self.branch_attribute(&local.attrs));
            }
            match self.exact_attribute(&local.attrs) {
                true => wrap_exact(value),
                false => value,
            }
        });
        Statement::Let(pattern, ty, init, span)
    }

    /// A constant that belongs to no type.
    pub fn lower_constant(&mut self, item: &syn::ItemConst) -> Const {
        if self.names().is_alias(&item.ident.to_string()) {
            let name = &item.ident;
            let error = Diagnostic::error_at(
                Code::DefinedTwice,
                self.token_span(name.span()),
                format!("`{name}` is a name that stands for something else"),
            )
            .label("defined again")
            .help("give it another name");
            self.errors.push(error);
        }
        Const {
            generics: Vec::new(),
            of: None,
            bounds: HashMap::new(),
            default_of: None,
            name: item.ident.to_string(),
            value: self.lower_expr(&item.expr),
            ty: self.lower_type(&item.ty),
        }
    }
}

/// `let (a, b);`: each of the variables, without a value.
fn declare_deferred(pattern: Pattern, ty: Option<Type>, span: Span, out: &mut Vec<Statement>) {
    let Pattern::Tuple(parts, _) = pattern else {
        if !matches!(pattern, Pattern::Wild) {
            out.push(Statement::Let(pattern, ty, None, span));
        }
        return;
    };
    let mut types = match ty {
        Some(Type::Tuple(types)) if types.len() == parts.len() => types.into_iter().map(Some).collect(),
        _ => vec![None; parts.len()],
    };
    for (part, ty) in parts.into_iter().zip(types.drain(..)) {
        declare_deferred(part, ty, span, out);
    }
}

/// A value whose operations on floats are exact.
fn wrap_exact(value: Expr) -> Expr {
    let span = value.span;
    let block = Block {
        statements: Vec::new(),
        value: Some(Box::new(value)),
        exact: true,
    };
    Expr {
        kind: ExprKind::Block(block),
        span,
    }
}

/// The attributes of an expression that rustc lets have some where it is a statement.
fn statement_attributes(expr: &syn::Expr) -> Option<&[syn::Attribute]> {
    match expr {
        syn::Expr::Block(e) => Some(&e.attrs),
        syn::Expr::If(e) => Some(&e.attrs),
        syn::Expr::Match(e) => Some(&e.attrs),
        syn::Expr::ForLoop(e) => Some(&e.attrs),
        syn::Expr::While(e) => Some(&e.attrs),
        syn::Expr::Loop(e) => Some(&e.attrs),
        _ => None,
    }
}

/// Constants so that each stands after those that it is made of. Those that need each other stay as they are, and are not found.
fn in_order(mut constants: Vec<Const>) -> Vec<Const> {
    let mut ordered = Vec::new();
    while !constants.is_empty() {
        let needs = |c: &Const| {
            let mut names = BTreeSet::new();
            mentioned_in(&c.value, &mut names);
            constants.iter().any(|other| names.contains(&other.name))
        };
        let next = constants.iter().position(|c| !needs(c)).unwrap_or(0);
        ordered.push(constants.remove(next));
    }
    ordered
}
