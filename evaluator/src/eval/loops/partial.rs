//! Loops left in the shader: what they count, and partial unrolling.

use super::for_loops::LoopBody;
use crate::diagnostic::Span;
use crate::eval::Evaluator;
use crate::eval::control::Tail;
use crate::eval::ranges::LoopPlan;
use crate::eval::sequence::Columns;
use crate::eval::value::{Eval, Place, Step, Value};
use crate::ir::{BinaryOp, Graph, NodeId, Type};
use crate::policy::Unroll;
use std::rc::Rc;

/// Quantity that a loop left in the shader counts.
pub enum LoopCount {
    /// The values of a range.
    Range(LoopPlan),
    /// Positions in a list of values.
    Elements(Columns),
    /// Elements of an array by mutable reference: the array, and its length.
    Places(Place, u32),
    /// Iterations whose number the body does not use.
    Times(u32),
    /// Nothing: the loop runs until the body exits it.
    Unknown,
}

impl Evaluator<'_> {
    /// Leaves a loop in the shader, its body repeated once or several times. Returns the unroll mode used.
    pub fn keep_loop(&mut self, body: &LoopBody<'_>, count: &LoopCount, unroll: Unroll, span: Span) -> Eval<Unroll> {
        let (own, trips) = match count {
            LoopCount::Range(course) => (course.counter_type, course.trips),
            LoopCount::Elements(columns) => (Type::I32, self.integer_constant(columns.len(), Type::I32)),
            LoopCount::Places(_, len) => (Type::I32, self.integer_constant(*len, Type::I32)),
            LoopCount::Times(times) => (Type::I32, self.integer_constant(*times, Type::I32)),
            LoopCount::Unknown => (Type::I32, self.builder.i32(Graph::ENDLESS)),
        };
        let zero = self.integer_constant(0, own);
        let unroll = match count {
            LoopCount::Unknown => Unroll::None,
            _ => unroll,
        };
        let Unroll::Partial(factor) = unroll else {
            if let LoopCount::Range(course) = count
                && let Some(bounds) = course.plain_bounds
            {
                let index = course.of_indices();
                let iteration = |e: &mut Self, own| {
                    let counter = e.as_counter(own, index);
                    e.eval_body(body, counter, span)
                };
                self.build_loop(body, bounds, iteration, span)?;
            } else {
                self.build_loop(
                    body,
                    (zero, trips),
                    |e, own| e.eval_iteration(body, count, own, span),
                    span,
                )?;
            }
            return Ok(Unroll::None);
        };
        let (mark, since) = (self.scope.enter(), self.control.exit_count());
        let further = LoopBody {
            written: body.written.clone(),
            breaks_here: false,
            ..*body
        };
        let whole = self.build_integer_op(BinaryOp::Div, trips, factor);
        let rounds = |e: &mut Self, own| {
            let from = e.build_integer_op(BinaryOp::Mul, own, factor);
            let since = e.control.exit_count();
            for k in 0..factor {
                let own = e.build_integer_op(BinaryOp::Add, from, k);
                let round = |e: &mut Self| e.eval_iteration(body, count, own, span).map(|()| Value::unit());
                e.eval_if_live(since, Tail::Open, span, round)?;
            }
            Ok(())
        };
        self.build_loop(&further, (zero, whole), rounds, span)?;
        let done = self.build_integer_op(BinaryOp::Mul, whole, factor);
        let rest = |e: &mut Self| {
            let since = e.control.exit_count();
            match e.known_int(&Value::Node(trips)).zip(e.known_int(&Value::Node(done))) {
                Some((trips, done)) => {
                    for k in done..trips {
                        let own = e.integer_constant(k as u32, own);
                        let round = |e: &mut Self| e.eval_iteration(body, count, own, span).map(|()| Value::unit());
                        e.eval_if_live(since, Tail::Open, span, round)?;
                    }
                }
                None => e.build_loop(
                    &further,
                    (done, trips),
                    |e, own| e.eval_iteration(body, count, own, span),
                    span,
                )?,
            }
            Ok(Value::unit())
        };
        let outcome = self.eval_if_live(since, Tail::Open, span, rest);
        self.merge_exits(since, outcome, mark, &|way| way.breaks_loop(body.label), span)?;
        Ok(unroll)
    }

    /// Evaluates iteration `own` of a loop.
    fn eval_iteration(&mut self, body: &LoopBody<'_>, count: &LoopCount, own: NodeId, span: Span) -> Eval<()> {
        let item = match count {
            LoopCount::Range(course) => self.counter_at(course, own),
            LoopCount::Elements(columns) => self.element_at(columns, own),
            LoopCount::Places(array, _) => {
                Value::Ref(Rc::new(array.with_step(Step::Index(self.as_counter(own, true)))))
            }
            LoopCount::Times(_) | LoopCount::Unknown => Value::unit(),
        };
        self.name_position(body, &item, own);
        self.eval_body(body, item, span)
    }
}
