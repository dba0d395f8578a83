//! Values that had to be compile-time constants, and the loops left in the shader that they depend on.
//!
//! A loop left in the shader turns the variables that it assigns into runtime values. If a constant is needed that depends
//! on such a value, the graph shows the loops that feed it, and evaluation goes back to them (`points.rs`).

use crate::diagnostic::{Diagnostic, Span};
use crate::eval::Evaluator;
use crate::eval::value::{Captured, ConstantDemand, Eval, Exit, Value};
use crate::ir::{Graph, NodeId, Op, RegionId};
use crate::shorten;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Reason why a loop is unrolled although it was requested to stay in the shader.
#[derive(Clone, Debug)]
pub struct UnrollReason {
    /// The error that occurs with the loop in the shader.
    pub error: Diagnostic,
    /// Reason in one line, for reports.
    pub reason: String,
}

/// A loop that is left in the shader.
struct StructuredLoop {
    region: RegionId,
    /// Location of the loop in the source.
    span: Span,
    /// Start and end of the counter, and initial carried values.
    args: Vec<NodeId>,
}

/// All loops that are left in the shader.
#[derive(Default)]
pub struct StructuredLoops {
    /// In order of their regions.
    loops: Vec<StructuredLoop>,
    /// Loops that could be unrolled, by location.
    unrollable: HashSet<Span>,
    /// Loops that the trip count of a `while` depends on, by the location of the `while`.
    end_causes: HashMap<Span, BTreeSet<Span>>,
}

impl StructuredLoops {
    /// Records that a loop has become a region, with its bounds and initial values.
    pub fn push_loop(&mut self, region: RegionId, span: Span, args: Vec<NodeId>) {
        self.loops.push(StructuredLoop { region, span, args });
    }

    /// Number of loops that are left in the shader.
    pub fn len(&self) -> usize {
        self.loops.len()
    }

    /// Removes all loops after the first `len`.
    pub fn truncate(&mut self, len: usize) {
        self.loops.truncate(len);
    }

    /// Records that a loop is left in the shader only because it was requested.
    pub fn mark_unrollable(&mut self, span: Span) {
        self.unrollable.insert(span);
    }

    /// Records the loops that make the end of a `while` a runtime value.
    pub fn record_end_causes(&mut self, span: Span, loops: BTreeSet<Span>) {
        self.end_causes.insert(span, loops);
    }

    /// Returns whether a loop that could be unrolled was added after the first `len`.
    pub fn has_unrollable_since(&self, len: usize) -> bool {
        let later = self.loops.get(len..).unwrap_or_default();
        later.iter().any(|kept| self.unrollable.contains(&kept.span))
    }

    /// Position of the first loop at a location.
    pub fn first_position(&self, span: Span) -> Option<usize> {
        self.loops.iter().position(|kept| kept.span == span)
    }

    fn find_loop(&self, region: RegionId) -> Option<&StructuredLoop> {
        let found = self.loops.binary_search_by_key(&region.0, |kept| kept.region.0);
        found.ok().map(|k| &self.loops[k])
    }

    /// Loops that could be unrolled and that `nodes` depend on.
    pub fn loops_feeding(&self, graph: &Graph, nodes: &[NodeId]) -> BTreeSet<Span> {
        if self.unrollable.is_empty() {
            return BTreeSet::new();
        }
        let walk = LoopSearch {
            graph,
            kept: self,
            seen: HashSet::new(),
            pending: nodes.to_vec(),
            found: BTreeSet::new(),
        };
        walk.find_loops()
    }
}

impl Evaluator<'_> {
    /// Returns the exit for nodes that must be compile-time constants and are not: a demand to unroll the loops left in the
    /// shader that feed them, or the error if there are none.
    pub fn demand_constants(&self, nodes: &[NodeId], error: impl Into<Box<Diagnostic>>) -> Exit {
        let (loops, error) = (
            self.loops.structured.loops_feeding(self.builder.graph(), nodes),
            error.into(),
        );
        self.demand_unrolling(loops, *error)
    }

    /// Like [`Evaluator::demand_constants`], for loops that are known to be the cause.
    pub fn demand_unrolling(&self, loops: BTreeSet<Span>, error: Diagnostic) -> Exit {
        match loops.is_empty() {
            true => error.into(),
            false => Exit::Demand(vec![ConstantDemand { loops, error }]),
        }
    }

    /// Like [`Evaluator::demand_constants`], for all nodes of several values.
    pub fn demand_of(&self, values: &[&Value], error: Diagnostic) -> Exit {
        let mut nodes = Vec::new();
        values.iter().for_each(|value| collect_nodes(value, &mut nodes));
        self.demand_constants(&nodes, error)
    }

    /// Turns an error in `outcome` into a demand for `nodes` to be compile-time constants.
    pub fn demand_on_error<T>(&self, nodes: &[NodeId], outcome: Eval<T>) -> Eval<T> {
        outcome.map_err(|exit| match exit {
            Exit::Error(error) => self.demand_constants(nodes, error),
            other => other,
        })
    }

    /// Unrolls the given loops wherever they are reached from now on.
    pub fn unroll_for(&mut self, loops: BTreeSet<Span>, error: Diagnostic) {
        let why = self.unroll_reason(error);
        for span in loops {
            self.loops.structured.unrollable.remove(&span);
            self.loops.forced.entry(span).or_insert_with(|| why.clone());
        }
    }

    /// Reason for unrolling a loop, built from an error: the value, its location, and why a constant is needed.
    pub fn unroll_reason(&self, error: Diagnostic) -> UnrollReason {
        let reason = match error.span.and_then(|span| self.report.excerpt(span)) {
            Some((text, place)) => format!(
                "`{}` needs a compile-time constant at {place}, and this loop assigns it: {}",
                source_excerpt(text),
                error.message
            ),
            None => format!(
                "a compile-time constant is needed, and this loop assigns it: {}",
                error.message
            ),
        };
        UnrollReason { error, reason }
    }
}

/// The first line of an expression's text, without the brace that opens a block.
pub fn source_excerpt(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    shorten(line.trim_end().trim_end_matches('{').trim_end())
}

/// Collects all nodes of a value, including those that a closure captures and the ends of ranges.
fn collect_nodes(value: &Value, out: &mut Vec<NodeId>) {
    match value {
        Value::Closure(closed) => {
            for (_, captured) in &closed.captured {
                if let Captured::Value(value) = captured {
                    collect_nodes(value, out);
                }
            }
        }
        Value::Range(range) => [&range.start, &range.end]
            .into_iter()
            .for_each(|end| collect_nodes(end, out)),
        other => other.flatten(out),
    }
}

/// Search from nodes to the loops that they are computed from.
struct LoopSearch<'w> {
    graph: &'w Graph,
    kept: &'w StructuredLoops,
    seen: HashSet<NodeId>,
    pending: Vec<NodeId>,
    found: BTreeSet<Span>,
}

impl LoopSearch<'_> {
    fn find_loops(mut self) -> BTreeSet<Span> {
        let graph = self.graph;
        while let Some(id) = self.pending.pop() {
            if !self.seen.insert(id) {
                continue;
            }
            let node = graph.node(id);
            match (&node.op, node.args.first().map(|owner| graph.node(*owner))) {
                (Op::Result(k), Some(owner)) => match owner.op {
                    Op::Loop(region) => {
                        self.visit_initial(region, Some(*k as usize));
                        self.visit_carried(region, Some(*k as usize));
                    }
                    Op::If(then, otherwise) => {
                        self.pending.extend(&owner.args);
                        for side in [then, otherwise] {
                            self.pending.extend(graph.region(side).results.get(*k as usize));
                        }
                    }
                    _ => self.pending.extend(&node.args),
                },
                // Parameter 0 is the counter.
                (Op::Param(region, k), _) => {
                    let position = (*k as usize).checked_sub(1);
                    // If the loop is unrolled, its first iteration shows whether the initial values matter.
                    if !self.visit_carried(*region, position) {
                        self.visit_initial(*region, position);
                    }
                }
                _ => self.pending.extend(&node.args),
            }
        }
        self.found
    }

    /// Visits the bounds of a loop, and the initial value of the carried variable at a position.
    fn visit_initial(&mut self, region: RegionId, position: Option<usize>) {
        let Some(kept) = self.kept.find_loop(region) else {
            return;
        };
        self.pending.extend(kept.args.iter().take(2));
        self.pending.extend(position.and_then(|k| kept.args.get(k + 2)));
    }

    /// Visits the carried value at a position, or the counter. Both depend on the trip count. Returns whether the loop can
    /// be unrolled.
    fn visit_carried(&mut self, region: RegionId, position: Option<usize>) -> bool {
        let Some(kept) = self.kept.find_loop(region) else {
            return false;
        };
        let is_avoidable = self.kept.unrollable.contains(&kept.span);
        if is_avoidable {
            self.found.insert(kept.span);
        }
        let ends = self.kept.end_causes.get(&kept.span).into_iter().flatten();
        self.found
            .extend(ends.filter(|span| self.kept.unrollable.contains(span)));
        if let Some(k) = position {
            let region = self.graph.region(region);
            let result = region.results.get(k).copied();
            self.pending.extend(result.into_iter().chain(region.stop));
        }
        is_avoidable
    }
}
