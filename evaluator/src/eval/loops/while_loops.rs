//! `while` and `loop`.

use super::causes::exit_condition;
use super::for_loops::{LoopBody, LoopOutcome, LoopRequest};
use super::partial::LoopCount;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::eval::Evaluator;
use crate::eval::control::Tail;
use crate::eval::scope::Scope;
use crate::eval::value::{Eval, Exit, Value};
use crate::front::tree::{Block, Expr, ExprKind, Statement};
use crate::front::{child_exprs, guard_body, has_break, scan_effects};
use crate::ir::NodeId;
use crate::policy::{Asked, Unroll};
use std::collections::BTreeSet;

/// Trip count of a `while`, if it is known, and the constants of variables after it, by slot.
type CountedWhile = (Option<u64>, Vec<(usize, Value)>);

/// Extent to which a `while` could be unrolled.
enum WhileEnd {
    /// To its end, or to an unconditional exit.
    Ended(Eval),
    /// Not at all: its end is a runtime value.
    Open {
        /// Loops left in the shader that the end depends on.
        loops: BTreeSet<Span>,
        /// The value, its place and the inputs that it depends on.
        reason: String,
    },
}

impl Evaluator<'_> {
    pub fn eval_while(
        &mut self,
        condition: &Expr,
        block: &Block,
        label: Option<&str>,
        attribute: Option<Unroll>,
        span: Span,
    ) -> Eval {
        let function = self.report.function();
        let asked = self.policy.requested_unroll(&function, "while", attribute);
        let made = self.builder.graph().nodes.len();
        self.loops.tracker.enter_loop(&function, "while", span, made);
        let outcome = self.run_while(condition, block, label, asked, span);
        let made = self.builder.graph().nodes.len();
        let became = match &outcome {
            Ok((unroll, _)) => *unroll,
            Err(_) => Unroll::Full,
        };
        self.loops.tracker.leave_loop(became, made);
        let (_, ends) = outcome?;
        ends
    }

    /// Runs a `while` as requested, or as far as possible. If the condition is constant in every iteration, the trip count
    /// is known and a counted loop is left in the shader. Otherwise the body exits the loop.
    ///
    /// Returns the unroll mode used, and the outcome of the loop.
    fn run_while(
        &mut self,
        condition: &Expr,
        block: &Block,
        label: Option<&str>,
        asked: Asked,
        span: Span,
    ) -> Eval<(Unroll, Eval)> {
        let body = LoopBody {
            block,
            pattern: None,
            counter: None,
            label,
            stages: &[],
            written: Vec::new(),
            breaks_here: true,
        };
        let guarded = guard_body(condition, block);
        let until = LoopBody {
            block: &guarded,
            written: Vec::new(),
            ..body
        };
        let mut refused = None;
        if asked.unroll != Unroll::Full && !self.loops.unrolls_all {
            let (iterations, after) = self.count_iterations(condition, &body, span)?;
            let wish = LoopRequest {
                asked,
                iterations: iterations.unwrap_or(u64::MAX),
                span,
                head: condition.span,
            };
            let granted = match iterations {
                Some(n) => self.try_keep_loop(&body, &wish, |_| Ok(LoopCount::Times(n as u32)))?,
                None => self.try_keep_loop(&until, &wish, |_| Ok(LoopCount::Unknown))?,
            };
            refused = match granted {
                LoopOutcome::Kept(unroll) => {
                    // Variables whose values are constant without the loop stay constants after it.
                    for (slot, value) in after {
                        if self.scope.name_and_value(slot).1 != &value {
                            self.scope.set_value(slot, value);
                        }
                    }
                    return Ok((unroll, self.finish_loop(condition, block, label)));
                }
                LoopOutcome::Unrolled(refused) => refused,
            };
        }
        let before = self.take_checkpoint();
        let (loops, reason) = match self.unroll_while(condition, &body, &mut 0, span)? {
            WhileEnd::Ended(outcome) => {
                return match refused {
                    Some(error) => Err(error.into()),
                    None => Ok((Unroll::Full, outcome.map(|_| Value::unit()))),
                };
            }
            WhileEnd::Open { loops, reason } => (loops, reason),
        };
        self.return_to(before);
        if asked.by_name && asked.unroll == Unroll::Full {
            let error = Diagnostic::error_at(
                Code::CannotUnroll,
                condition.span,
                "this loop cannot be unrolled: its end is a runtime value",
            )
            .label("its trip count is a runtime value")
            .help("leave out that it is to be unrolled, or bound it: `#[cfg_attr(false, bound(64))]`");
            return Err(self.demand_unrolling(loops, error));
        }
        self.loops.structured.record_end_causes(span, loops.clone());
        self.keep_loop(&until, &LoopCount::Unknown, Unroll::None, span)
            .map_err(|exit| match exit {
                Exit::Error(error) => self.demand_unrolling(loops, *error),
                other => other,
            })?;
        self.loops.tracker.record_reason(span, reason);
        Ok((Unroll::None, self.finish_loop(condition, block, label)))
    }

    /// Outcome after a loop left in the shader: an exit, if only `return` or an outer loop's `break` ends the loop.
    fn finish_loop(&mut self, condition: &Expr, block: &Block, label: Option<&str>) -> Eval {
        let endless = matches!(condition.kind, ExprKind::Bool(true)) && !has_break(block, label);
        match endless.then(|| self.control.pop_exit()).flatten() {
            None => Ok(Value::unit()),
            Some(last) => {
                self.scope = last.scope;
                Err(Exit::Left(last.jump))
            }
        }
    }

    /// Trip count of a `while`, if it is known, and the constants of variables after it.
    fn count_iterations(&mut self, condition: &Expr, body: &LoopBody<'_>, span: Span) -> Eval<CountedWhile> {
        let test = Block {
            statements: vec![Statement::Expr(condition.clone())],
            value: None,
            exact: false,
        };
        let mutating = &self.library.mutating;
        let (test, effects) = (scan_effects(&test, mutating), scan_effects(body.block, mutating));
        let mut behind = Vec::new();
        for slot in test.mentioned.iter().filter_map(|name| self.scope.find_slot(name)) {
            self.collect_ref_slots(self.scope.name_and_value(slot).1, &mut behind);
        }
        let writes = !test.assigned.is_empty() || (!behind.is_empty() && has_calls(condition));
        if effects.leaves || test.leaves || writes {
            return Ok((None, Vec::new()));
        }
        let (before, initial) = (self.take_checkpoint(), self.scope.clone());
        let unrolls_all = std::mem::replace(&mut self.loops.unrolls_all, true);
        let mut rounds = 0;
        let made = self.builder.graph().nodes.len();
        let most = self.report.limit_nodes(made + MAX_COUNTED);
        let counted = self.unroll_while(condition, body, &mut rounds, span);
        self.loops.unrolls_all = unrolls_all;
        if self.report.restore_limit(most, self.builder.graph().nodes.len()) {
            self.return_to(before);
            return Ok((None, Vec::new()));
        }
        let noted = self.report.error_count() > before.error_count;
        let ended = matches!(counted?, WhileEnd::Ended(_));
        if noted {
            return Err(Exit::Noted);
        }
        let mut after = Vec::new();
        if ended {
            let values = (0..self.scope.len()).map(|slot| (slot, self.scope.name_and_value(slot).1.clone()));
            let changed = values.filter(|(slot, value)| initial.name_and_value(*slot).1 != value);
            after = changed.filter(|(_, value)| self.is_known(value)).collect();
        }
        let (slots, values): (Vec<usize>, Vec<Value>) = after.into_iter().unzip();
        let values = self.return_with(before, values);
        Ok((ended.then_some(rounds), slots.into_iter().zip(values).collect()))
    }

    /// Returns whether all numbers of a value are constants.
    fn is_known(&self, value: &Value) -> bool {
        let mut leaves = Vec::new();
        value.flatten(&mut leaves);
        value.is_plain()
            && leaves
                .iter()
                .all(|id| self.builder.graph().constant_bits(*id).is_some())
    }

    /// Unrolls a `while` as long as its condition is a compile-time constant. Counts the iterations in `rounds`.
    fn unroll_while(&mut self, condition: &Expr, body: &LoopBody<'_>, rounds: &mut u64, span: Span) -> Eval<WhileEnd> {
        let (mark, since) = (self.scope.enter(), self.control.exit_count());
        let noted = self.report.error_count();
        let mut outcome = Ok(Value::unit());
        let limit = self.loops.tracker.iteration_limit(span);
        let mut before: Option<Scope> = None;
        loop {
            self.count_step(span)?;
            let id = self.eval_condition(condition)?;
            match self.known_bool(id) {
                Some(true) => {}
                Some(false) => break,
                None => return Ok(self.open_end(Some(condition.span), &[id])),
            }
            if self.control.exit_count() > since {
                // If no constant changed, the next iteration decides as the last one did, and so do all later ones.
                let repeats = before.as_ref().is_some_and(|before| self.as_known(before, &self.scope));
                if repeats || *rounds >= limit {
                    if !repeats {
                        self.loops.tracker.record_open_end(span);
                    }
                    let conditions = self.control.exits_since(since);
                    let exit = exit_condition(body.block, &self.library.mutating);
                    return Ok(self.open_end(exit.map(|exit| exit.span), &conditions));
                }
                before = Some(self.scope.clone());
            }
            *rounds += 1;
            outcome = self.eval_if_live(since, Tail::Open, span, |e| {
                e.loops.tracker.record_iteration();
                e.eval_body(body, Value::unit(), span).map(|()| Value::unit())
            });
            if outcome.is_err() {
                break;
            }
            if self.report.error_count() > noted {
                return Err(Exit::Noted);
            }
        }
        let arrived = self.merge_exits(since, outcome, mark, &|way| way.breaks_loop(body.label), span);
        match arrived {
            Err(exit) if exit.is_failure() => Err(exit),
            other => Ok(WhileEnd::Ended(other)),
        }
    }

    /// End of a `while` that depends on runtime conditions.
    fn open_end(&self, place: Option<Span>, conditions: &[NodeId]) -> WhileEnd {
        WhileEnd::Open {
            loops: self.loops.structured.loops_feeding(self.builder.graph(), conditions),
            reason: self.runtime_end_reason(place, conditions),
        }
    }
}

/// Maximum number of nodes created to count the iterations of a loop. Beyond it, the end is left to the shader.
const MAX_COUNTED: usize = 50_000;

/// Returns whether an expression may call a function that writes through a reference.
fn has_calls(e: &Expr) -> bool {
    matches!(e.kind, ExprKind::Call(..) | ExprKind::Method(..) | ExprKind::Block(_))
        || child_exprs(e).into_iter().any(has_calls)
}
