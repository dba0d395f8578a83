//! Loops left in the shader: what they count, and partial unrolling.

use super::Evaluator;
use super::departures::{EarlyExit, Tail};
use super::loops::LoopBody;
use super::ranges::LoopPlan;
use super::scope::Scope;
use super::sequence::Columns;
use super::value::{Eval, Place, Step, Value};
use crate::diagnostic::Span;
use crate::ir::{BinaryOp, Counter, Graph, Mark, NodeId, Type};
use crate::policy::Unroll;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;
use std::sync::Arc;

/// State to restore after an attempt.
#[derive(Clone)]
pub struct Checkpoint {
    scope: Scope,
    counters: Arc<[Counter]>,
    errors: usize,
    loops: super::budget::LoopTracker,
    early_exits: Vec<EarlyExit>,
    loop_depth: u32,
    /// Number of loops left in the shader.
    loop_count: usize,
    /// Site of the last read.
    last_site: u32,
    made: Mark,
}

impl Checkpoint {
    /// Number of loops left in the shader at this point.
    pub fn loop_count(&self) -> usize {
        self.loop_count
    }

    /// Number of errors recorded at this point.
    pub fn error_count(&self) -> usize {
        self.errors
    }
}

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
    /// Captures the current state.
    pub fn take_checkpoint(&self) -> Checkpoint {
        Checkpoint {
            scope: self.scope.clone(),
            counters: Arc::clone(&self.counters),
            errors: self.errors.len(),
            loops: self.loops.clone(),
            early_exits: self.early_exits.clone(),
            loop_depth: self.loop_depth,
            loop_count: self.structured_loops.len(),
            last_site: self.last_site,
            made: self.builder.mark(),
        }
    }

    /// Restores a state and removes all nodes added since. Returns the first error recorded since.
    pub fn return_to(&mut self, before: Checkpoint) -> Option<crate::diagnostic::Diagnostic> {
        self.scope = before.scope;
        self.counters = before.counters;
        self.early_exits = before.early_exits;
        self.loop_depth = before.loop_depth;
        self.structured_loops.truncate(before.loop_count);
        self.builder.return_to(&before.made);
        let is_kept = |id: &NodeId| (id.0 as usize) < before.made.nodes;
        self.consts.retain(|_, (made, _)| *made <= before.made.nodes);
        self.counters_of_usize.retain(|id, _| is_kept(id));
        self.wrapping.retain(is_kept);
        self.places.truncate(before.made.nodes);
        self.loops.return_to(before.loops);
        let noted = self.errors.get(before.errors).cloned();
        self.errors.truncate(before.errors);
        noted
    }

    /// Restores a state completely, including the numbering of reads.
    pub fn rewind_to(&mut self, before: Checkpoint) {
        self.last_site = before.last_site;
        self.return_to(before);
    }

    /// Restores a state, but keeps values built only from constants and earlier nodes.
    pub fn return_with(&mut self, mut before: Checkpoint, values: Vec<Value>) -> Vec<Value> {
        if !values.iter().all(Value::is_plain) {
            // The captures of a closure cannot be rebuilt.
            before.made = self.builder.mark().with_effects_of(&before.made);
            self.return_to(before);
            return values;
        }
        let first = before.made.nodes;
        let mut leaves = Vec::new();
        values.iter().for_each(|value| value.flatten(&mut leaves));
        let mut pending = leaves.clone();
        let mut lost = BTreeMap::new();
        while let Some(id) = pending.pop() {
            let node = self.builder.graph().node(id);
            if id.0 as usize >= first && !lost.contains_key(&id) {
                pending.extend(&node.args);
                lost.insert(id, node.clone());
            }
        }
        self.return_to(before);
        let mut made: HashMap<NodeId, NodeId> = HashMap::new();
        // Arguments precede their users.
        for (id, node) in lost {
            let args: Vec<NodeId> = node.args.iter().map(|arg| *made.get(arg).unwrap_or(arg)).collect();
            made.insert(id, self.builder.add(node.op, args, node.ty));
        }
        let mut leaves = leaves.into_iter().map(|id| *made.get(&id).unwrap_or(&id));
        values.iter().map(|value| value.unflatten(&mut leaves)).collect()
    }

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
        let (mark, since) = (self.scope.enter(), self.early_exits.len());
        let further = LoopBody {
            written: body.written.clone(),
            breaks_here: false,
            ..*body
        };
        let whole = self.build_integer_op(BinaryOp::Div, trips, factor);
        let rounds = |e: &mut Self, own| {
            let from = e.build_integer_op(BinaryOp::Mul, own, factor);
            let since = e.early_exits.len();
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
            let since = e.early_exits.len();
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
