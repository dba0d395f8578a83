//! Half precision for chosen values: each operation that computes one of them rounds its operands and its result to `f16`.
//!
//! File tests: `evaluator/tests/filetests/passes/half`.

use super::fold::Exact;
use crate::ir::{BinaryOp, Builder, F16, Graph, NodeId, Op, Rebuild, Replace, Scalar, UnaryOp, rebuild_replacing};
use std::collections::BTreeSet;

/// Rebuilds the kernel with the values of these names in half precision.
///
/// A name is that of a variable, a parameter or a function in the kernel's source ([`half_names`]). It covers all
/// operations up to the values of other names: `let step = (a - b) * k` has two. Texels, integers that become floats and
/// uniforms are rounded where such an operation uses them. Exact operations ([`Op::Exact`]) stay as they are.
pub fn lower_to_half(graph: &Graph, names: &BTreeSet<String>) -> Graph {
    let mut lowering = Lowering {
        old: graph,
        lowered: lowered_nodes(graph, &|name| names.contains(name)),
    };
    let pass = Rebuild {
        rules: &Exact,
        share_loads: false,
    };
    rebuild_replacing(graph, &pass, &mut lowering)
}

/// Names of the kernel's values that [`lower_to_half`] can lower.
pub fn half_names(graph: &Graph) -> BTreeSet<String> {
    let named = |id: NodeId| {
        let name = name_of(graph, id)?;
        let is_lowered = can_be_half(&graph.node(id).op) || chosen_value(graph, id).is_some();
        (is_float(graph, id) && is_lowered).then(|| name.to_owned())
    };
    graph.node_ids().filter_map(named).collect()
}

fn name_of(graph: &Graph, id: NodeId) -> Option<&str> {
    let origin = graph.origin(id)?;
    (!origin.name.is_empty()).then_some(&*origin.name)
}

fn is_float(graph: &Graph, id: NodeId) -> bool {
    let ty = graph.ty(id);
    ty.is_float() && !ty.is_array()
}

/// The values that a branch chooses between for one of its results.
fn chosen_value(graph: &Graph, id: NodeId) -> Option<[NodeId; 2]> {
    let node = graph.node(id);
    let (Op::Result(k), [owner]) = (&node.op, &node.args[..]) else {
        return None;
    };
    match graph.node(*owner).op {
        Op::If(then, otherwise) => Some([then, otherwise].map(|region| graph.region(region).results[*k as usize])),
        _ => None,
    }
}

/// Returns whether an operation may have a result in half precision.
fn can_be_half(op: &Op) -> bool {
    is_move(op) || matches!(op, Op::Unary(_) | Op::Binary(_) | Op::Dot | Op::Cross | Op::Convert)
}

/// Returns whether every component of an operation's result is one of its arguments, but for the sign.
pub fn is_move(op: &Op) -> bool {
    matches!(
        op,
        Op::Select
            | Op::Splat
            | Op::Compose
            | Op::Extract(_)
            | Op::Unary(UnaryOp::Neg | UnaryOp::Abs)
            | Op::Binary(BinaryOp::Min | BinaryOp::Max)
            | Op::Clamp
    )
}

/// Returns whether an operation's operands keep full precision whatever its result is: they are places, bits, counters or
/// what memory holds.
pub fn keeps_operands(op: &Op) -> bool {
    op.is_read()
        || op.is_effect()
        || matches!(
            op,
            Op::Convert
                | Op::Bitcast
                | Op::Exact
                | Op::Tally(_)
                | Op::QuadSwap(_)
                | Op::Derivative(_)
                | Op::MakeArray
                | Op::ArrayGet
                | Op::ArraySet
                | Op::Loop(_)
                | Op::If(..)
                | Op::Result(_)
        )
}

/// Returns for each node whether it belongs to a chosen name: its own, or else those of all values that are computed of it.
fn lowered_nodes(graph: &Graph, chosen: &dyn Fn(&str) -> bool) -> Vec<bool> {
    let mut lowered = vec![false; graph.nodes.len()];
    // Users so far: none, or whether all of them are lowered.
    let mut users: Vec<Option<bool>> = vec![None; graph.nodes.len()];
    let mut exact = vec![false; graph.nodes.len()];
    graph.outputs().iter().for_each(|id| users[id.0 as usize] = Some(false));
    for id in graph.node_ids() {
        if let Op::Loop(region) = graph.node(id).op {
            let yielded = graph.region(region).yielded_values();
            yielded.for_each(|id| users[id.0 as usize] = Some(false));
        }
    }
    for id in graph.node_ids().rev() {
        let (k, node) = (id.0 as usize, graph.node(id));
        let belongs = match name_of(graph, id) {
            Some(name) => chosen(name),
            None => users[k] == Some(true),
        };
        lowered[k] = belongs && can_be_half(&node.op) && !exact[k];
        for value in chosen_value(graph, id).into_iter().flatten() {
            let all = users[value.0 as usize].unwrap_or(true);
            users[value.0 as usize] = Some(all && belongs);
        }
        let whole = !lowered[k] || keeps_operands(&node.op);
        for arg in &node.args {
            let all = users[arg.0 as usize].unwrap_or(true);
            users[arg.0 as usize] = Some(all && !whole);
            exact[arg.0 as usize] |= node.op == Op::Exact;
        }
    }
    lowered
}

struct Lowering<'g> {
    old: &'g Graph,
    /// By node, whether it is computed in half precision.
    lowered: Vec<bool>,
}

impl Lowering<'_> {
    /// Returns an operand, rounded.
    fn rounded(&self, b: &mut Builder<'_>, old: NodeId, new: NodeId) -> NodeId {
        if !is_float(self.old, old) {
            return new;
        }
        let ty = b.graph().ty(new);
        let id = match b.graph().constant_bits(new) {
            Some(bits) => {
                let held = bits.map(|bits| held_in_half(f32::from_bits(bits)).to_bits());
                b.constant(ty, held)
            }
            None => new,
        };
        b.add(Op::Half, [id], ty)
    }
}

/// Returns a constant that half precision can hold: the number itself, unless it would become infinite or 0.
fn held_in_half(x: f32) -> f32 {
    let near = half::f16::from_f32(x).to_f32();
    let lost = x.is_finite() && (near.is_infinite() || (near == 0.0 && x != 0.0));
    if lost {
        F16::nearest_finite(x.into()).to_f32()
    } else {
        x
    }
}

impl Replace for Lowering<'_> {
    fn add_prologue(&mut self, _: &mut Builder<'_>) {}

    fn replace_node(&mut self, b: &mut Builder<'_>, id: NodeId, new: &[Option<NodeId>]) -> Option<NodeId> {
        let node = self.old.node(id);
        if !self.lowered[id.0 as usize] {
            return None;
        }
        let args: Vec<NodeId> = node.args.iter().map(|arg| new[arg.0 as usize]).collect::<Option<_>>()?;
        let of_texel = matches!(node.op, Op::Extract(_)) && self.old.node(node.args[0]).op.is_read();
        let args = match of_texel || keeps_operands(&node.op) {
            true => args,
            false => {
                let pairs = node.args.iter().zip(args);
                pairs.map(|(old, new)| self.rounded(b, *old, new)).collect()
            }
        };
        let computed = b.add(node.op.clone(), &args, node.ty);
        // Of a texel, only the components in use are rounded.
        let rounds = node.ty.scalar_kind() == Some(Scalar::F32) && (of_texel || !is_move(&node.op));
        if !rounds {
            return Some(computed);
        }
        if let Some(origin) = self.old.origin(id) {
            b.set_origin(computed, origin);
        }
        Some(b.add(Op::Half, [computed], node.ty))
    }
}
