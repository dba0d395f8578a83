//! Loops that are kept: their own counter, and bodies written several times in a row.

use super::Evaluator;
use super::scope::Scope;
use super::value::{Eval, Exit, Range, Value};
use crate::diagnostic::Span;
use crate::front::tree::ForLoop;
use crate::ir::{BinaryOp, NodeId, Op, Type};
use crate::policy::Unroll;

/// What an attempt may change, to go back to.
pub struct Checkpoint {
    scope: Scope,
    counters: usize,
    errors: usize,
    loops: super::budget::Loops,
}

impl Evaluator<'_> {
    /// A state to return to. Nodes made meanwhile stay, unused.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            scope: self.scope.clone(),
            counters: self.counters.len(),
            errors: self.errors.len(),
            loops: self.loops.clone(),
        }
    }

    /// Goes back.
    pub fn return_to(&mut self, before: Checkpoint) {
        self.scope = before.scope;
        self.counters.truncate(before.counters);
        self.errors.truncate(before.errors);
        self.loops = before.loops;
    }

    /// Keeps a loop over a range, its body written once or several times in a row.
    pub fn keep(&mut self, f: &ForLoop, range: &Range, unroll: Unroll, span: Span) -> Eval<Unroll> {
        let (first, end) = (self.index_node(&range.start, span)?, self.index_node(&range.end, span)?);
        let Unroll::Partial(factor) = unroll else {
            let plain = !range.reversed && range.step == 1;
            let trips = self.trips(first, end, range);
            let zero = self.builder.i32(0);
            let bounds = if plain { (first, end) } else { (zero, trips) };
            self.kept(
                f,
                bounds,
                |e, own| {
                    let counter = if plain {
                        own
                    } else {
                        e.value_of(own, first, range, trips)
                    };
                    e.body(f, counter, span)
                },
                span,
            )?;
            return Ok(Unroll::None);
        };
        let trips = self.trips(first, end, range);
        let zero = self.builder.i32(0);
        let whole = self.integer(BinaryOp::Div, trips, factor as i32);
        self.kept(
            f,
            (zero, whole),
            |e, own| {
                let from = e.integer(BinaryOp::Mul, own, factor as i32);
                for k in 0..factor {
                    let own = e.integer(BinaryOp::Add, from, k as i32);
                    let counter = e.value_of(own, first, range, trips);
                    e.body(f, counter, span)?;
                }
                Ok(())
            },
            span,
        )?;
        let done = self.integer(BinaryOp::Mul, whole, factor as i32);
        match self
            .known_int(&Value::Node(trips))
            .zip(self.known_int(&Value::Node(done)))
        {
            Some((trips_known, done)) => {
                for own in done..trips_known {
                    let own = self.builder.i32(own as i32);
                    let counter = self.value_of(own, first, range, trips);
                    self.body(f, counter, span)?;
                }
            }
            None => self.kept(
                f,
                (done, trips),
                |e, own| {
                    let counter = e.value_of(own, first, range, trips);
                    e.body(f, counter, span)
                },
                span,
            )?,
        }
        Ok(unroll)
    }

    fn body(&mut self, f: &ForLoop, counter: NodeId, span: Span) -> Eval<()> {
        self.step(span)?;
        match self.round(&f.pattern, Value::Node(counter), &f.body, span) {
            Ok(_) => Ok(()),
            Err(exit @ (Exit::Error(_) | Exit::Noted)) => Err(exit),
            Err(_) => Err(Exit::Noted),
        }
    }

    /// Number of rounds. A range that runs backwards has none: the loop's own test sees to that, or a bound of 0.
    fn trips(&mut self, first: NodeId, end: NodeId, range: &Range) -> NodeId {
        let mut length = self.builder.add(Op::Binary(BinaryOp::Sub), vec![end, first], Type::I32);
        if range.step != 1 {
            length = self.integer(BinaryOp::Add, length, range.step as i32 - 1);
            length = self.integer(BinaryOp::Div, length, range.step as i32);
        }
        let zero = self.builder.i32(0);
        self.builder
            .add(Op::Binary(BinaryOp::Max), vec![length, zero], Type::I32)
    }

    /// The source's counter in round `own`.
    fn value_of(&mut self, own: NodeId, first: NodeId, range: &Range, trips: NodeId) -> NodeId {
        let mut at = own;
        if range.reversed {
            // Of a, a+s, ..., the last comes first.
            let last = self.integer(BinaryOp::Sub, trips, 1);
            at = self.builder.add(Op::Binary(BinaryOp::Sub), vec![last, own], Type::I32);
        }
        let far = self.integer(BinaryOp::Mul, at, range.step as i32);
        self.builder.add(Op::Binary(BinaryOp::Add), vec![first, far], Type::I32)
    }

    fn integer(&mut self, op: BinaryOp, x: NodeId, n: i32) -> NodeId {
        let n = self.builder.i32(n);
        self.builder.add(Op::Binary(op), vec![x, n], Type::I32)
    }
}
