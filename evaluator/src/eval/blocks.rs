//! Blocks and their statements, with what ends where they end.

use super::Evaluator;
use super::departures::{Tail, has_exits};
use super::points::Points;
use super::value::{Eval, Exit, Value, Way};
use crate::diagnostic::Span;
use crate::front::tree::{Block, Expr, ExprKind, Pattern, Statement};

impl Evaluator<'_> {
    /// A block in a scope of its own. An error in one statement does not hide those in the next.
    pub fn block(&mut self, block: &Block) -> Eval {
        self.block_in(block, Tail::Open)
    }

    /// A block, and what ends with it.
    pub fn block_in(&mut self, block: &Block, tail: Tail<'_>) -> Eval {
        let mark = self.scope.enter();
        let around = self.builder.is_exact();
        self.builder.set_exact(around || block.exact);
        let result = self.statements(block, 0, tail);
        self.builder.set_exact(around);
        self.scope.leave(mark);
        result
    }

    /// A block from a statement on. Where what follows a loop of it needs a constant that the loop assigns, evaluation goes back to
    /// the statement with the loop.
    fn statements(&mut self, block: &Block, mut from: usize, tail: Tail<'_>) -> Eval {
        let noted = self.errors.len();
        let mut points = Points::default();
        loop {
            let outcome = self.statements_from(block, from, tail, noted, &mut points);
            match self.with_put_off(outcome, &mut points) {
                Err(Exit::Demand(needs)) => from = self.go_back(needs, &mut points)?,
                outcome => return outcome,
            }
        }
    }

    fn statements_from(
        &mut self,
        block: &Block,
        from: usize,
        tail: Tail<'_>,
        noted: usize,
        points: &mut Points,
    ) -> Eval {
        for (k, statement) in block.statements.iter().enumerate().skip(from) {
            let since = self.departed.len();
            self.point(points, k, statement.span());
            match statement {
                Statement::Expr(Expr {
                    kind: ExprKind::If(condition, then, otherwise, attribute),
                    span,
                }) if self.keeps_exits(*attribute) && has_exits(then, otherwise.as_deref()) => {
                    let parts = (&**condition, then, otherwise.as_deref());
                    let outcome = self.guarded(parts, tail, *span, &mut |e| e.statements(block, k + 1, tail));
                    let failed = self.errors.len() > noted;
                    return if failed { outcome.and(Err(Exit::Noted)) } else { outcome };
                }
                Statement::Let(pattern, ty, init, span) => {
                    self.step(*span)?;
                    let value = match init {
                        Some(init) => match self
                            .expecting(init, ty.as_ref())
                            .and_then(|v| self.ascribe(v, ty.as_ref(), init.span))
                        {
                            Ok(value) => value,
                            Err(exit @ (Exit::Error(_) | Exit::Noted)) => {
                                self.note(exit);
                                Value::Poison
                            }
                            Err(Exit::Demand(needs)) => {
                                self.put_off(needs, statement, points)?;
                                Value::Poison
                            }
                            Err(leave) => return Err(leave),
                        },
                        // What a `break` gives: it has a value wherever it is looked at.
                        None if matches!(pattern, Pattern::Name(name, ..) if name.starts_with('#')) => Value::Blank,
                        None => Value::Unset,
                    };
                    self.bind(pattern, value, *span)?;
                }
                Statement::Expr(expr) => match self.expr(expr) {
                    Ok(_) => {}
                    Err(exit @ (Exit::Error(_) | Exit::Noted)) => {
                        self.note(exit);
                    }
                    Err(Exit::Demand(needs)) => self.put_off(needs, statement, points)?,
                    Err(leave) => return Err(leave),
                },
                Statement::Const(constant) => {
                    let value = self.expr(&constant.value)?;
                    let value = self.ascribe(value, Some(&constant.ty), constant.value.span)?;
                    self.scope.bind(&constant.name, value);
                }
            }
            if self.departed.len() > since && self.keeps_exits(None) {
                return self.unless_departed(since, tail, statement.span(), |e| e.statements(block, k + 1, tail));
            }
        }
        if self.errors.len() > noted {
            return Err(Exit::Noted);
        }
        let Some(value) = &block.value else {
            return Ok(Value::unit());
        };
        self.point(points, block.statements.len(), value.span);
        self.expr_in(value, tail)
    }

    /// A block that a `break` of its label leaves.
    pub fn labelled(&mut self, label: &str, block: &Block, span: Span) -> Eval {
        let (mark, since) = (self.scope.enter(), self.departed.len());
        let outcome = self.block(block);
        let leads_here = |way: &Way| matches!(way, Way::Break(Some(of)) if of == label);
        self.arrive(since, outcome, mark, &leads_here, span)
    }

    /// An expression at the end of a block.
    pub fn expr_in(&mut self, expr: &Expr, tail: Tail<'_>) -> Eval {
        match (&expr.kind, tail) {
            (_, Tail::Open) => self.expr(expr),
            (ExprKind::Block(block), _) => self.block_in(block, tail),
            (ExprKind::If(condition, then, otherwise, attribute), _) => {
                self.step(expr.span)?;
                self.if_(condition, then, otherwise.as_deref(), *attribute, tail, expr.span)
            }
            (ExprKind::Match(subject, arms, attribute), _) => {
                self.step(expr.span)?;
                self.match_(subject, arms, *attribute, tail, expr.span)
            }
            _ => self.expr(expr),
        }
    }
}
