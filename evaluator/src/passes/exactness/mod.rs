//! Sums whose meaning depends on the order of their operations: compensated sums, the rounding error of a sum or a product,
//! rounding by a large constant.
//!
//! The exact value of such a sum cancels a term: in `(a + b) - a` the term `a`. A compiler that reassociates floats reduces
//! it to `b`, while IEEE 754 yields the part of `b` that `a + b` retains. The operations that the term passes through
//! become [`Op::Exact`], which forbids reassociation. In other operations drivers may change a rounding, with no further
//! consequence.
//!
//! File tests: `evaluator/tests/filetests/passes/exactness`.

mod cone;
mod interned;
mod terms;

use crate::ir::{BinaryOp, Builder, Graph, NodeId, Op, Origin, Rebuild, Replace, UnaryOp, rebuild_replacing};
use crate::passes::Exact;
use interned::Terms;
use rustc_hash::{FxHashMap, FxHashSet};
use terms::Dependence;

/// Marks the operations whose order matters.
pub fn mark_exact_ops(graph: &Graph) -> Graph {
    let marks = find_exact_ops(graph);
    if marks.is_empty() {
        return graph.clone();
    }
    let pass = Rebuild {
        rules: &Exact,
        share_loads: false,
    };
    rebuild_replacing(graph, &pass, &mut Marking { old: graph, marks })
}

/// First origin of the exact operations of each line, by file and line.
pub fn exact_places(graph: &Graph) -> Vec<&Origin> {
    let exact = graph.node_ids().filter(|id| graph.node(*id).op == Op::Exact);
    let origins = exact.filter_map(|id| graph.origin(id).or_else(|| graph.origin(graph.node(id).args[0])));
    let mut places: Vec<&Origin> = origins.filter(|origin| origin.line != Origin::NOWHERE).collect();
    places.sort_by_key(|origin| (origin.file, origin.line));
    places.dedup_by_key(|origin| (origin.file, origin.line));
    places
}

/// Operations whose results must be rounded as written.
fn find_exact_ops(graph: &Graph) -> FxHashSet<NodeId> {
    let dependence = Dependence::from_graph(graph);
    let mut found = cone::ExactSearch::default();
    let mut terms = Terms::new(graph, &dependence);
    for id in graph.node_ids() {
        cone::find_cancelling(&mut terms, id, &mut found);
    }
    let mut ordered = found.marks;
    ordered.extend(made_of(graph, &dependence, found.errors));
    // Operations that are exact already, on request.
    let asked = graph.node_ids().filter(|id| graph.node(*id).op == Op::Exact);
    let asked: FxHashSet<NodeId> = asked.map(|id| graph.node(id).args[0]).collect();
    let mut marks = ordered.clone();
    let mut seen = FxHashMap::default();
    for id in ordered.iter().chain(&asked) {
        // A correctly rounded sum needs correctly rounded operands.
        for arg in &graph.node(*id).args {
            collect_operands(graph, &dependence, *arg, DEPTH, &mut seen, &mut marks);
        }
    }
    marks.retain(|id| !asked.contains(id));
    marks
}

/// Number of operations through which the rounding error of a sum is followed. In another order of these, the error is
/// lost.
const STEPS: usize = 3;

/// Sums and products that use the rounding errors of other sums.
fn made_of(graph: &Graph, dependence: &Dependence, errors: FxHashSet<NodeId>) -> FxHashSet<NodeId> {
    let mut all = FxHashSet::default();
    let mut last = errors;
    for _ in 0..STEPS {
        if last.is_empty() {
            break;
        }
        // Operations that round nothing are transparent. A second sweep covers values that loops carry.
        let (mut seen, mut next) = (last, FxHashSet::default());
        for _ in 0..if dependence.has_loops() { 2 } else { 1 } {
            for id in graph.node_ids().filter(|id| graph.ty(*id).is_float()) {
                let node = graph.node(id);
                let goes_in = match node.op {
                    Op::Param(..) | Op::Result(_) => {
                        dependence.incoming_values(graph, id).iter().any(|of| seen.contains(of))
                    }
                    _ => node.args.iter().any(|arg| seen.contains(arg)),
                };
                if !goes_in {
                    continue;
                }
                match node.op {
                    Op::Binary(BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul) | Op::Dot => _ = next.insert(id),
                    Op::Unary(UnaryOp::Neg)
                    | Op::Splat
                    | Op::Compose
                    | Op::Extract(_)
                    | Op::Select
                    | Op::Param(..)
                    | Op::Result(_)
                    | Op::Exact
                    | Op::Tally(_) => _ = seen.insert(id),
                    _ => {}
                }
            }
        }
        last = next.difference(&all).copied().collect();
        all.extend(next);
    }
    all
}

/// Depth of sums and products below an operand that are also rounded as written: they might be contracted, or their
/// constant factors multiplied.
const DEPTH: u32 = 3;

/// Adds the operations that compute an operand. Operations that round nothing are transparent.
fn collect_operands(
    graph: &Graph,
    dependence: &Dependence,
    id: NodeId,
    depth: u32,
    seen: &mut FxHashMap<NodeId, u32>,
    marks: &mut FxHashSet<NodeId>,
) {
    if !graph.ty(id).is_float() || seen.get(&id).is_some_and(|known| *known >= depth) {
        return;
    }
    seen.insert(id, depth);
    let node = graph.node(id);
    let (further, depth): (Vec<NodeId>, u32) = match &node.op {
        op if op.is_rounding() => {
            marks.insert(id);
            match op {
                Op::Binary(BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul) if depth > 0 => {
                    (node.args.clone(), depth - 1)
                }
                _ => return,
            }
        }
        Op::Unary(_) | Op::Splat | Op::Compose | Op::Extract(_) | Op::Exact | Op::Tally(_) => {
            (node.args.clone(), depth)
        }
        Op::Select => (node.args[1..].to_vec(), depth),
        Op::Param(..) | Op::Result(_) => (dependence.incoming_values(graph, id), depth),
        _ => return,
    };
    for id in further {
        collect_operands(graph, dependence, id, depth, seen, marks);
    }
}

struct Marking<'g> {
    old: &'g Graph,
    marks: FxHashSet<NodeId>,
}

impl Replace for Marking<'_> {
    fn add_prologue(&mut self, _: &mut Builder<'_>) {}

    fn replace_node(&mut self, b: &mut Builder<'_>, id: NodeId, new: &[Option<NodeId>]) -> Option<NodeId> {
        if !self.marks.contains(&id) {
            return None;
        }
        let node = self.old.node(id);
        let args: Option<Vec<NodeId>> = node.args.iter().map(|arg| new[arg.0 as usize]).collect();
        Some(b.add_exact(node.op.clone(), &args?, node.ty))
    }
}
