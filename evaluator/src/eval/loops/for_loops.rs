//! `for`, and the rules common to all loops: a loop is left in the shader if that is requested and possible.

use super::causes::range_ends;
use super::demand::UnrollReason;
use super::partial::LoopCount;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::eval::Evaluator;
use crate::eval::control::Tail;
use crate::eval::stages::{Stage, split_stages};
use crate::eval::value::{Eval, Exit, Place, Range, Step, Value};
use crate::front::tree::{Block, ForLoop, Pattern};
use crate::ir::Counter;
use crate::policy::{Asked, Unroll};
use std::sync::Arc;

/// Body of a loop.
pub struct LoopBody<'a> {
    /// Statements of the body.
    pub block: &'a Block,
    /// Pattern bound to each value; `None` for a `while`.
    pub pattern: Option<&'a Pattern>,
    /// Name of the counter in the shader, if the source has one.
    pub counter: Option<(&'a str, Span)>,
    /// Label of the loop.
    pub label: Option<&'a str>,
    /// Adaptors between the values and the pattern.
    pub stages: &'a [Stage],
    /// Positions of variables that may be written through the iterated value.
    pub written: Vec<usize>,
    /// `true` if `break` leads to the end of the loop in the graph, and no further.
    pub breaks_here: bool,
}

/// A loop with a known number of iterations, and the policy requested for it.
pub struct LoopRequest {
    /// Unroll policy requested for this loop.
    pub asked: Asked,
    /// Number of evaluations of its body.
    pub iterations: u64,
    /// Span of the whole loop, which identifies it.
    pub span: Span,
    /// Span that an error labels.
    pub head: Span,
}

/// Outcome of a [`LoopRequest`].
pub enum LoopOutcome {
    /// The loop is left in the shader.
    Kept(Unroll),
    /// The loop is to be unrolled. Holds the error if the loop was named in the request.
    Unrolled(Option<Diagnostic>),
}

impl Evaluator<'_> {
    pub fn eval_for(&mut self, f: &ForLoop, span: Span) -> Eval {
        let items = self.eval_expr(&f.over)?;
        let function = self.report.function();
        let counter = counter_of(f);
        let asked = self.policy.requested_unroll(&function, &counter, f.unroll);
        let made = self.builder.graph().nodes.len();
        self.loops.tracker.enter_loop(&function, &counter, span, made);
        let outcome = self.run_for(f, items, asked, span);
        let made = self.builder.graph().nodes.len();
        let became = *outcome.as_ref().unwrap_or(&Unroll::Full);
        self.loops.tracker.leave_loop(became, made);
        outcome.map(|_| Value::unit())
    }

    /// Runs a loop as requested, or as possible; returns the applied policy.
    fn run_for(&mut self, f: &ForLoop, items: Value, asked: Asked, span: Span) -> Eval<Unroll> {
        let counter = match (&f.pattern, &items) {
            (Pattern::Name(name, _, at), Value::Range(_)) => Some((name.as_str(), *at)),
            _ => None,
        };
        let (items, stages) = split_stages(items);
        let mut body = LoopBody {
            block: &f.body,
            pattern: Some(&f.pattern),
            counter,
            label: f.label.as_deref(),
            stages: &stages,
            written: Vec::new(),
            breaks_here: true,
        };
        for stage in &stages {
            for closure in stage.closures() {
                self.collect_ref_slots(&closure, &mut body.written);
            }
        }
        let mut range = None;
        let values = match items {
            Value::Range(items) => match self.range_values(&items, f.over.span)? {
                Some(values) => {
                    range = Some(items);
                    values
                }
                None if asked.by_name && asked.unroll == Unroll::Full => {
                    let error = Diagnostic::error_at(
                        Code::CannotUnroll,
                        f.over.span,
                        "a loop whose bounds are runtime values cannot be unrolled",
                    )
                    .label("a runtime value")
                    .help("give the loop fixed bounds, or leave out that it is to be unrolled");
                    return Err(self.demand_of(&[&Value::Range(items)], error));
                }
                None => {
                    let course = self.plan_loop(&items, f.over.span)?;
                    let bounds = course.bounds();
                    let outcome = self.keep_loop(&body, &LoopCount::Range(course), asked.unroll, span);
                    if asked.unroll == Unroll::Full {
                        self.record_runtime_end(f, &items, span);
                    }
                    return self.demand_on_error(&bounds, outcome);
                }
            },
            Value::Array(elements) => elements.to_vec(),
            Value::Ref(_) => match self.elements_mut(&items, f.over.span)? {
                Value::Array(elements) => elements.to_vec(),
                _ => return Err(Exit::Noted),
            },
            Value::Table(_) => self.rows(&items, f.over.span)?,
            Value::Endless(_) => self.collect_endless(&items, f.over.span)?,
            Value::Node(id) if self.ty(id).is_array() => self.rows(&items, f.over.span)?,
            Value::Poison => return Err(Exit::Noted),
            other => {
                return Err(Diagnostic::error_at(
                    Code::MismatchedTypes,
                    f.over.span,
                    format!("`for` cannot run over {}", other.describe()),
                )
                .label("not a range")
                .help("run over a range such as `0..n`, or over an array")
                .into());
            }
        };
        values
            .iter()
            .for_each(|value| self.collect_ref_slots(value, &mut body.written));
        let wish = LoopRequest {
            asked,
            iterations: values.len() as u64,
            span,
            head: f.over.span,
        };
        let count = |e: &mut Self| match &range {
            Some(range) => e.plan_loop(range, f.over.span).map(LoopCount::Range),
            None => match array_behind(&values) {
                Some(array) => Ok(LoopCount::Places(array, values.len() as u32)),
                None => e.by_columns(&values, f.over.span).map(LoopCount::Elements),
            },
        };
        let refused = match self.try_keep_loop(&body, &wish, count)? {
            LoopOutcome::Kept(unroll) => return Ok(unroll),
            LoopOutcome::Unrolled(refused) => refused,
        };
        self.unroll_loop(&body, values, span)?;
        refused.map_or(Ok(Unroll::Full), |error| Err(error.into()))
    }

    /// Records the end of a range that leaves its loop in the shader.
    fn record_runtime_end(&mut self, f: &ForLoop, range: &Range, span: Span) {
        let is_end = self.known_int(&range.end).is_none();
        let value = if is_end { &range.end } else { &range.start };
        let place = range_ends(&f.over).map(|(start, end)| if is_end { end.span } else { start.span });
        let mut nodes = Vec::new();
        value.flatten(&mut nodes);
        let reason = self.runtime_end_reason(Some(place.unwrap_or(f.over.span)), &nodes);
        self.loops.tracker.record_reason(span, reason);
    }

    /// Leaves a loop in the shader if that is requested and possible.
    pub fn try_keep_loop(
        &mut self,
        body: &LoopBody<'_>,
        wish: &LoopRequest,
        count: impl FnOnce(&mut Self) -> Eval<LoopCount>,
    ) -> Eval<LoopOutcome> {
        let LoopRequest { asked, span, .. } = *wish;
        let least = match asked.unroll {
            Unroll::Full => return Ok(LoopOutcome::Unrolled(None)),
            _ if self.loops.unrolls_all => return Ok(LoopOutcome::Unrolled(None)),
            Unroll::None => 1,
            Unroll::Partial(factor) => 2 * u64::from(factor),
        };
        if wish.iterations < least {
            let reason = match wish.iterations {
                0 => "it has no iterations".to_owned(),
                1 => "it has 1 iteration".to_owned(),
                n => format!("it has {n} iterations, fewer than {least}"),
            };
            self.loops.tracker.record_reason(span, reason);
            return Ok(LoopOutcome::Unrolled(None));
        }
        if let Some(needed) = self.loops.forced.get(&span) {
            let why = needed.clone();
            self.loops.tracker.record_reason(span, why.reason);
            if asked.by_name {
                let error =
                    refusal_error(wish, &why.error).note("what the loop assigns would be a runtime value after it");
                self.loops.tracker.defer_error(error);
            }
            return Ok(LoopOutcome::Unrolled(None));
        }
        let why = if let Some(why) = self.loops.tracker.previous_failure(span) {
            why
        } else {
            let before = self.take_checkpoint();
            self.loops.structured.mark_unrollable(span);
            match count(self).and_then(|count| self.keep_loop(body, &count, asked.unroll, span)) {
                Err(exit) if self.report.is_exhausted() => return Err(exit),
                // All invocations have exited, or a loop around or before this one has to be unrolled.
                Err(exit @ Exit::Left(_)) => return Err(exit),
                Err(Exit::Demand(needs)) if needs.iter().all(|need| !need.loops.contains(&span)) => {
                    return Err(Exit::Demand(needs));
                }
                // A loop that cannot stay in the shader is unrolled. If that fails too, its error is reported.
                Err(exit) => {
                    let noted = self.return_to(before);
                    let why = match exit {
                        Exit::Demand(needs) => {
                            let own = needs.into_iter().find(|need| need.loops.contains(&span));
                            own.map(|need| self.unroll_reason(need.error))
                        }
                        Exit::Error(error) => Some(one_line_reason(*error)),
                        _ => noted.map(one_line_reason),
                    };
                    let body = || {
                        one_line_reason(Diagnostic::error_at(
                            Code::CannotStay,
                            wish.head,
                            "its body has an error",
                        ))
                    };
                    let why = why.unwrap_or_else(body);
                    self.loops.tracker.record_failure(span, &why);
                    why
                }
                Ok(unroll) => return Ok(LoopOutcome::Kept(unroll)),
            }
        };
        self.loops.tracker.record_reason(span, why.reason);
        Ok(LoopOutcome::Unrolled(
            asked.by_name.then(|| refusal_error(wish, &why.error)),
        ))
    }

    fn unroll_loop(&mut self, body: &LoopBody<'_>, items: Vec<Value>, span: Span) -> Eval<()> {
        let (mark, since) = (self.scope.enter(), self.control.exit_count());
        let noted = self.report.error_count();
        let mut outcome = Ok(Value::unit());
        for item in items {
            outcome = self.eval_if_live(since, Tail::Open, span, |e| {
                e.loops.tracker.record_iteration();
                e.eval_body(body, item, span).map(|()| Value::unit())
            });
            if outcome.is_err() {
                break;
            }
            // The next iteration would only report the same errors again.
            if self.report.error_count() > noted {
                return Err(Exit::Noted);
            }
        }
        self.merge_exits(since, outcome, mark, &|way| way.breaks_loop(body.label), span)?;
        Ok(())
    }

    /// Evaluates the body for one value of the iterated sequence.
    pub fn eval_body(&mut self, body: &LoopBody<'_>, item: Value, span: Span) -> Eval<()> {
        self.count_step(span)?;
        let (mark, since) = (self.scope.enter(), self.control.exit_count());
        let outcome = match body.pattern {
            Some(_) => self.eval_staged_body(body.stages, [item.clone(), item], body, span),
            None => self.block_in(body.block, Tail::Iteration(body.label)),
        };
        self.merge_exits(
            since,
            outcome.map(|_| Value::unit()),
            mark,
            &|way| way.continues_loop(body.label),
            span,
        )?;
        Ok(())
    }

    /// Evaluates the body with the counter bound to a value.
    pub fn eval_bound_body(&mut self, pattern: &Pattern, item: Value, body: &LoopBody<'_>, span: Span) -> Eval {
        let mark = self.scope.enter();
        let counter = match (pattern, self.known_int(&item)) {
            (Pattern::Name(name, ..), Some(value)) => Some(Counter {
                name: name.as_str().into(),
                value,
            }),
            _ => None,
        };
        let around = Arc::clone(&self.loops.counters);
        if counter.is_some() {
            self.loops.counters = around.iter().cloned().chain(counter).collect();
        }
        let outcome = self
            .bind_pattern(pattern, item, span)
            .and_then(|()| self.block_in(body.block, Tail::Iteration(body.label)));
        self.loops.counters = around;
        self.scope.leave(mark);
        outcome
    }
}

/// Returns the name by which policies refer to a loop: its counter, or the first name that it binds.
fn counter_of(f: &ForLoop) -> String {
    match &f.pattern {
        _ if f.bounded => "while".to_owned(),
        Pattern::Name(name, ..) => name.to_string(),
        _ => "_".to_owned(),
    }
}

/// Returns an error as the reason why a loop cannot be left in the shader.
fn one_line_reason(error: Diagnostic) -> UnrollReason {
    let reason = match error.span {
        Some(span) => format!("{} (line {})", error.message, span.line),
        None => error.message.clone(),
    };
    UnrollReason { error, reason }
}

/// Returns the error for a loop that was named in a request but cannot be left in the shader.
fn refusal_error(wish: &LoopRequest, why: &Diagnostic) -> Diagnostic {
    let asked = match wish.asked.unroll {
        Unroll::Partial(factor) => format!("unroll({factor})"),
        other => format!("unroll({other})"),
    };
    let mut error = Diagnostic::error_at(
        Code::CannotStay,
        wish.head,
        format!("this loop cannot be left in the shader: {}", why.message),
    )
    .label(format!("`{asked}` asks for it"))
    .help("leave it out, so that the loop is unrolled where it has to be");
    if let Some(at) = why.span.filter(|at| *at != wish.head) {
        let label = if why.label.is_empty() {
            "here"
        } else {
            why.label.as_str()
        };
        error = error.label_at(at, label);
    }
    error
}

/// Returns the array to whose elements, first to last, the values are mutable references.
fn array_behind(values: &[Value]) -> Option<Place> {
    let mut array: Option<Place> = None;
    for (k, value) in values.iter().enumerate() {
        let Value::Ref(place) = value else { return None };
        let (last, path) = place.path.split_last()?;
        if *last != Step::Index(Value::Int(k as i64)) {
            return None;
        }
        let of = Place {
            path: path.to_vec(),
            ..(**place).clone()
        };
        if array.as_ref().is_some_and(|array| *array != of) {
            return None;
        }
        array = Some(of);
    }
    array
}
