//! Blocks and their statements, with the exits that target the end of a block.

use super::departures::{Tail, has_exits};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::eval::Evaluator;
use crate::eval::loops::RestartPoints;
use crate::eval::value::{Eval, Exit, Jump, Value};
use crate::front::tree::{Block, Expr, ExprKind, Pattern, Statement};

impl Evaluator<'_> {
    /// Evaluates a block in its own scope. An error in one statement does not hide errors in later ones.
    pub fn eval_block(&mut self, block: &Block) -> Eval {
        self.block_in(block, Tail::Open)
    }

    /// Evaluates a block in tail position: exits that target its end fall through.
    pub fn block_in(&mut self, block: &Block, tail: Tail<'_>) -> Eval {
        let mark = self.scope.enter();
        let around = self.builder.is_exact();
        self.builder.set_exact(around || block.exact);
        let result = self.eval_statements(block, 0, tail);
        self.builder.set_exact(around);
        self.scope.leave(mark);
        result
    }

    /// Evaluates a block starting at a statement. If a constant depends on a loop of the block, evaluation goes back to the
    /// statement with the loop.
    fn eval_statements(&mut self, block: &Block, mut from: usize, tail: Tail<'_>) -> Eval {
        let noted = self.report.error_count();
        let mut points = RestartPoints::default();
        loop {
            let outcome = self.statements_from(block, from, tail, noted, &mut points);
            match self.with_deferred(outcome, &mut points) {
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
        points: &mut RestartPoints,
    ) -> Eval {
        for (k, statement) in block.statements.iter().enumerate().skip(from) {
            let since = self.control.early_exits.len();
            self.add_restart_point(points, k, statement.span());
            match statement {
                Statement::Expr(Expr {
                    kind: ExprKind::If(condition, then, otherwise, attribute),
                    span,
                }) if self.keeps_exits(*attribute) && has_exits(then, otherwise.as_deref()) => {
                    let parts = (&**condition, then, otherwise.as_deref());
                    let outcome =
                        self.eval_guard_clause(parts, tail, *span, &mut |e| e.eval_statements(block, k + 1, tail));
                    let failed = self.report.error_count() > noted;
                    return if failed { outcome.and(Err(Exit::Noted)) } else { outcome };
                }
                Statement::Let(pattern, ty, init, span) => {
                    self.count_step(*span)?;
                    let value = match init {
                        Some(init) => match self
                            .expecting(init, ty.as_ref())
                            .and_then(|v| self.ascribe_type(v, ty.as_ref(), init.span))
                            .and_then(|v| waits_for_nothing(v, init.span))
                        {
                            Ok(value) => value,
                            // An error in the library belongs to the call.
                            Err(exit @ Exit::Error(_)) if span.file == crate::front::std::FILE => return Err(exit),
                            Err(exit @ (Exit::Error(_) | Exit::Noted)) => {
                                self.record_error(exit);
                                Value::Poison
                            }
                            Err(Exit::Demand(needs)) => {
                                self.defer_demands(needs, statement, points)?;
                                Value::Poison
                            }
                            Err(leave) => return Err(leave),
                        },
                        // The value of a `break` is defined wherever it is read.
                        None if matches!(pattern, Pattern::Name(name, ..) if name.starts_with('#')) => Value::Undef,
                        None => Value::Unset,
                    };
                    self.bind_pattern(pattern, value, *span)?;
                }
                Statement::Expr(expr) => match self.eval_expr(expr) {
                    Ok(_) => {}
                    Err(exit @ Exit::Error(_)) if expr.span.file == crate::front::std::FILE => return Err(exit),
                    Err(exit @ (Exit::Error(_) | Exit::Noted)) => {
                        self.record_error(exit);
                    }
                    Err(Exit::Demand(needs)) => self.defer_demands(needs, statement, points)?,
                    Err(leave) => return Err(leave),
                },
                Statement::Const(constant) => {
                    let value = self.eval_expr(&constant.value)?;
                    let value = self.ascribe_type(value, Some(&constant.ty), constant.value.span)?;
                    self.scope.bind(&constant.name, value);
                }
            }
            if self.control.early_exits.len() > since && self.keeps_exits(None) {
                return self.eval_if_live(since, tail, statement.span(), |e| e.eval_statements(block, k + 1, tail));
            }
        }
        if self.report.error_count() > noted {
            return Err(Exit::Noted);
        }
        let Some(value) = &block.value else {
            return Ok(Value::unit());
        };
        self.add_restart_point(points, block.statements.len(), value.span);
        self.expr_in(value, tail)
    }

    /// Evaluates a block that a `break` with its label leaves.
    pub fn eval_labelled_block(&mut self, label: &str, block: &Block, span: Span) -> Eval {
        let (mark, since) = (self.scope.enter(), self.control.early_exits.len());
        let outcome = self.eval_block(block);
        let leads_here = |way: &Jump| matches!(way, Jump::Break(Some(of)) if of == label);
        self.merge_exits(since, outcome, mark, &leads_here, span)
    }

    /// Evaluates an expression in tail position.
    pub fn expr_in(&mut self, expr: &Expr, tail: Tail<'_>) -> Eval {
        match (&expr.kind, tail) {
            (_, Tail::Open) => self.eval_expr(expr),
            (ExprKind::Block(block), _) => self.block_in(block, tail),
            (ExprKind::If(condition, then, otherwise, attribute), _) => {
                self.count_step(expr.span)?;
                self.eval_if(condition, then, otherwise.as_deref(), *attribute, tail, expr.span)
            }
            (ExprKind::Match(subject, arms, attribute), _) => {
                self.count_step(expr.span)?;
                self.eval_match(subject, arms, *attribute, tail, expr.span)
            }
            _ => self.eval_expr(expr),
        }
    }
}

/// Refuses an array whose elements would be computed later, by a closure that changes variables now.
fn waits_for_nothing(value: Value, span: Span) -> Eval {
    match &value {
        Value::Elements(f) if f.changes_variables() => Err(Diagnostic::error_at(
            Code::TypeNeeded,
            span,
            "the length of this array is not known where its closure changes variables",
        )
        .label("of which length?")
        .help("state the type of the variable: `let x: [f32; 4] = ...`")
        .into()),
        _ => Ok(value),
    }
}
