//! `while`, with a bound or without.

use super::expr::Lower;
use super::tree::{Block, Expr, ExprKind, ForLoop, Pattern, Statement};
use crate::ir::UnaryOp;

impl Lower {
    /// `while`, or `loop` with the condition `true`; with a bound, a `for` of so many iterations that the condition may end.
    pub fn lower_while(
        &mut self,
        condition: Expr,
        body: Block,
        label: Option<String>,
        attrs: &[syn::Attribute],
    ) -> ExprKind {
        let said = self.loop_attributes(attrs);
        let Some((bound, at)) = said.bound else {
            return ExprKind::While(Box::new(condition), body, label, said.unroll);
        };
        let number = |n: i64| Box::new(self.expr_at(ExprKind::Int(n, None), at));
        let range = ExprKind::Range(number(0), number(bound.into()), false);
        ExprKind::For(Box::new(ForLoop {
            label,
            unroll: said.unroll,
            pattern: Pattern::Wild,
            over: self.expr_at(range, at),
            body: guard_body(&condition, &body),
            bounded: true,
        }))
    }
}

/// `if !condition { break; }`, and the body: what an iteration does that looks first whether it is one.
pub fn guard_body(condition: &Expr, block: &Block) -> Block {
    let at = |kind| Expr {
        kind,
        span: condition.span,
    };
    let leave = Block {
        statements: vec![Statement::Expr(at(ExprKind::Break(None)))],
        value: None,
        exact: false,
    };
    let ends = at(ExprKind::Unary(UnaryOp::Not, Box::new(condition.clone())));
    let test = Statement::Expr(at(ExprKind::If(Box::new(ends), leave, None, None)));
    Block {
        statements: std::iter::once(test).chain(block.statements.iter().cloned()).collect(),
        value: block.value.clone(),
        exact: block.exact,
    }
}
