//! Values that had to be compile-time constants, and the loops left in the shader that they depend on.
//!
//! A loop that is left in the shader makes what it assigns runtime values. Where a constant is needed of one of them, the graph
//! says which loops it depends on, and evaluation goes back to them (`points.rs`).

use super::Evaluator;
use super::value::{Captured, Eval, Exit, Need, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::ir::{Graph, NodeId, Op, RegionId};
use crate::shorten;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Reason why a loop is unrolled although it was asked to be left in the shader.
#[derive(Clone, Debug)]
pub struct Why {
    /// The error of the kernel with the loop in the shader.
    pub error: Diagnostic,
    /// One line for reports.
    pub reason: String,
}

/// A loop that is left in the shader.
struct KeptLoop {
    region: RegionId,
    /// Place of the loop in the source.
    span: Span,
    /// Start and end of its counter, and initial values of what it carries.
    args: Vec<NodeId>,
}

/// Loops that are left in the shader.
#[derive(Default)]
pub struct Kept {
    /// In order of their regions.
    loops: Vec<KeptLoop>,
    /// Loops that could be unrolled, by their places.
    avoidable: HashSet<Span>,
    /// Loops that the trip count of a `while` depends on, by the place of the `while`.
    ends: HashMap<Span, BTreeSet<Span>>,
}

impl Kept {
    /// Notes that a loop has become a region, with its bounds and initial values.
    pub fn enter(&mut self, region: RegionId, span: Span, args: Vec<NodeId>) {
        self.loops.push(KeptLoop { region, span, args });
    }

    /// Number of loops that are left in the shader.
    pub fn len(&self) -> usize {
        self.loops.len()
    }

    /// Forgets loops that came later.
    pub fn truncate(&mut self, len: usize) {
        self.loops.truncate(len);
    }

    /// Notes that a loop is left in the shader only because that is asked for.
    pub fn avoidable(&mut self, span: Span) {
        self.avoidable.insert(span);
    }

    /// Notes the loops because of which the end of a `while` is a runtime value.
    pub fn ends(&mut self, span: Span, loops: BTreeSet<Span>) {
        self.ends.insert(span, loops);
    }

    /// Returns whether a loop that could be unrolled came after the first `len`.
    pub fn avoids_since(&self, len: usize) -> bool {
        let later = self.loops.get(len..).unwrap_or_default();
        later.iter().any(|kept| self.avoidable.contains(&kept.span))
    }

    /// Position of the first loop of a place.
    pub fn first(&self, span: Span) -> Option<usize> {
        self.loops.iter().position(|kept| kept.span == span)
    }

    fn of(&self, region: RegionId) -> Option<&KeptLoop> {
        let found = self.loops.binary_search_by_key(&region.0, |kept| kept.region.0);
        found.ok().map(|k| &self.loops[k])
    }

    /// Loops that could be unrolled, of those that nodes depend on.
    pub fn behind(&self, graph: &Graph, nodes: &[NodeId]) -> BTreeSet<Span> {
        if self.avoidable.is_empty() {
            return BTreeSet::new();
        }
        let walk = Walk {
            graph,
            kept: self,
            seen: HashSet::new(),
            pending: nodes.to_vec(),
            found: BTreeSet::new(),
        };
        walk.run()
    }
}

impl Evaluator<'_> {
    /// Ends evaluation where nodes had to be compile-time constants and are not: with a demand if loops left in the shader are the
    /// cause, else with the error.
    pub fn demand(&self, nodes: &[NodeId], error: impl Into<Box<Diagnostic>>) -> Exit {
        let (loops, error) = (self.kept.behind(self.builder.graph(), nodes), error.into());
        self.demanded(loops, *error)
    }

    /// As [`Evaluator::demand`], of loops that are known to be the cause.
    pub fn demanded(&self, loops: BTreeSet<Span>, error: Diagnostic) -> Exit {
        match loops.is_empty() {
            true => error.into(),
            false => Exit::Demand(vec![Need { loops, error }]),
        }
    }

    /// As [`Evaluator::demand`], of all numbers that values are made of.
    pub fn demand_of(&self, values: &[&Value], error: Diagnostic) -> Exit {
        let mut nodes = Vec::new();
        values.iter().for_each(|value| read(value, &mut nodes));
        self.demand(&nodes, error)
    }

    /// An outcome of which an error is a demand for nodes to be compile-time constants.
    pub fn demanding<T>(&self, nodes: &[NodeId], outcome: Eval<T>) -> Eval<T> {
        outcome.map_err(|exit| match exit {
            Exit::Error(error) => self.demand(nodes, error),
            other => other,
        })
    }

    /// Unrolls loops wherever they are reached from now on.
    pub fn unroll_for(&mut self, loops: BTreeSet<Span>, error: Diagnostic) {
        let why = self.why(error);
        for span in loops {
            self.kept.avoidable.remove(&span);
            self.unrolled.entry(span).or_insert_with(|| why.clone());
        }
    }

    /// An error with the reason that it is for unrolling a loop: the value, its place, and the need.
    pub fn why(&self, error: Diagnostic) -> Why {
        let place = error.span.and_then(|span| {
            let file = self.files.get(span.file as usize)?;
            let text = file.text.get(span.start as usize..span.end as usize)?;
            Some((excerpt(text), format!("{}:{}", file.path, span.line)))
        });
        let reason = match place {
            Some((value, place)) => format!(
                "`{value}` needs a compile-time constant at {place}, and this loop assigns it: {}",
                error.message
            ),
            None => format!(
                "a compile-time constant is needed, and this loop assigns it: {}",
                error.message
            ),
        };
        Why { error, reason }
    }
}

/// The first line of an expression's text, without the brace that opens a block.
fn excerpt(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    shorten(line.trim_end().trim_end_matches('{').trim_end())
}

/// All numbers that a value is made of, with those that a closure captures and the ends of ranges.
fn read(value: &Value, out: &mut Vec<NodeId>) {
    match value {
        Value::Closure(closed) => {
            for (_, captured) in &closed.captured {
                if let Captured::Value(value) = captured {
                    read(value, out);
                }
            }
        }
        Value::Range(range) => [&range.start, &range.end].into_iter().for_each(|end| read(end, out)),
        other => other.flatten(out),
    }
}

/// Goes from numbers to what they are computed from.
struct Walk<'w> {
    graph: &'w Graph,
    kept: &'w Kept,
    seen: HashSet<NodeId>,
    pending: Vec<NodeId>,
    found: BTreeSet<Span>,
}

impl Walk<'_> {
    fn run(mut self) -> BTreeSet<Span> {
        let graph = self.graph;
        while let Some(id) = self.pending.pop() {
            if !self.seen.insert(id) {
                continue;
            }
            let node = graph.node(id);
            match (&node.op, node.args.first().map(|owner| graph.node(*owner))) {
                (Op::Result(k), Some(owner)) => match owner.op {
                    Op::Loop(region) => {
                        self.initial(region, Some(*k as usize));
                        self.carried(region, Some(*k as usize));
                    }
                    Op::If(then, otherwise) => {
                        self.pending.extend(&owner.args);
                        for side in [then, otherwise] {
                            self.pending.extend(graph.region(side).results.get(*k as usize));
                        }
                    }
                    _ => self.pending.extend(&node.args),
                },
                // The first is the counter.
                (Op::Param(region, k), _) => {
                    let position = (*k as usize).checked_sub(1);
                    // Unrolled, its first iteration shows whether the initial values matter.
                    if !self.carried(*region, position) {
                        self.initial(*region, position);
                    }
                }
                _ => self.pending.extend(&node.args),
            }
        }
        self.found
    }

    /// The bounds of a loop, and the initial value of what it carries at a position.
    fn initial(&mut self, region: RegionId, position: Option<usize>) {
        let Some(kept) = self.kept.of(region) else { return };
        self.pending.extend(kept.args.iter().take(2));
        self.pending.extend(position.and_then(|k| kept.args.get(k + 2)));
    }

    /// Visits the value that a loop carries at a position, or its counter: both depend on how often it runs. Returns whether the loop can
    /// be unrolled.
    fn carried(&mut self, region: RegionId, position: Option<usize>) -> bool {
        let Some(kept) = self.kept.of(region) else { return false };
        let is_avoidable = self.kept.avoidable.contains(&kept.span);
        if is_avoidable {
            self.found.insert(kept.span);
        }
        let ends = self.kept.ends.get(&kept.span).into_iter().flatten();
        self.found
            .extend(ends.filter(|span| self.kept.avoidable.contains(span)));
        if let Some(k) = position {
            let region = self.graph.region(region);
            let result = region.results.get(k).copied();
            self.pending.extend(result.into_iter().chain(region.stop));
        }
        is_avoidable
    }
}
