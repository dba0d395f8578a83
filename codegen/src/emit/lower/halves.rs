//! Values that the text holds in half precision, and conversions where they meet others.

use crate::compiled::Compiled;
use straightline_evaluator::ir::{Graph, NodeId, Op, Real};
use straightline_evaluator::passes;

/// Returns for each node whether its value is an `f16` in the text.
///
/// An operation is one of half precision if all its operands are, and nothing but [`Op::Half`] uses its result: rounding
/// the `f32` result is then the same.
pub fn half_values(compiled: &Compiled) -> Vec<bool> {
    let graph = &compiled.graph;
    let rounded = rounded_alone(graph);
    let mut halves = vec![false; graph.nodes.len()];
    for id in graph.node_ids() {
        let node = graph.node(id);
        let is_float = node.ty.is_float() && !node.ty.is_array();
        halves[id.0 as usize] = match &node.op {
            Op::Half => true,
            op if !is_float || passes::keeps_operands(op) => false,
            op => operands_are_half(graph, id, &halves) && (passes::is_move(op) || rounded[id.0 as usize]),
        };
    }
    widen_vectors(graph, &mut halves);
    halves
}

/// Vectors of halves that no operation of half precision uses: their components are converted, not they.
fn widen_vectors(graph: &Graph, halves: &mut [bool]) {
    let mut is_used = vec![false; graph.nodes.len()];
    for id in graph.node_ids().rev() {
        let node = graph.node(id);
        if matches!(node.op, Op::Splat | Op::Compose) && !is_used[id.0 as usize] {
            halves[id.0 as usize] = false;
        }
        let in_half = is_operation_on_halves(graph, id, halves);
        for arg in node.args.iter().filter(|_| in_half) {
            is_used[arg.0 as usize] = true;
        }
    }
}

/// Returns whether a node computes with operands in half precision: for a value that is an `f16`, or a comparison.
pub fn is_operation_on_halves(graph: &Graph, id: NodeId, halves: &[bool]) -> bool {
    let node = graph.node(id);
    match node.ty.is_float() || passes::keeps_operands(&node.op) {
        true => halves[id.0 as usize],
        false => operands_are_half(graph, id, halves),
    }
}

/// Returns whether every float among a node's operands is an `f16` or a constant that one holds, and not all are constants.
fn operands_are_half(graph: &Graph, id: NodeId, halves: &[bool]) -> bool {
    let floats = graph.node(id).args.iter().filter(|arg| graph.ty(**arg).is_float());
    let (mut any, mut all) = (false, true);
    for arg in floats {
        let is_half = halves[arg.0 as usize];
        any |= is_half;
        all &= is_half || is_held(graph, *arg);
    }
    any && all
}

/// Returns whether a node is a constant that half precision holds exactly.
fn is_held(graph: &Graph, id: NodeId) -> bool {
    let lanes = usize::from(graph.ty(id).component_count());
    let held = |bits: &u32| f32::from_bits(*bits).to_half().to_bits() == *bits;
    graph
        .constant_bits(id)
        .is_some_and(|bits| bits[..lanes].iter().all(held))
}

/// Returns for each node whether all its uses round it to half precision.
fn rounded_alone(graph: &Graph) -> Vec<bool> {
    let mut rounded = vec![true; graph.nodes.len()];
    for id in graph.node_ids().filter(|id| graph.node(*id).op != Op::Half) {
        for arg in &graph.node(id).args {
            rounded[arg.0 as usize] = false;
        }
    }
    for region in &graph.regions {
        region.yielded_values().for_each(|id| rounded[id.0 as usize] = false);
    }
    rounded
}
