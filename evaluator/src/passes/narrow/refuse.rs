//! Operations on a `usize` that a shader cannot compute, and what to write instead.

use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BinaryOp, Graph, NodeId, Op, Type};
use crate::passes::ranges;
use std::collections::{BTreeSet, HashSet};

/// An operation whose result may differ from the native one.
pub struct Refusal {
    /// The operation.
    pub node: NodeId,
    /// The error.
    pub error: Diagnostic,
}

/// Conversions to `usize` that the operands of rejected operations are computed from.
pub fn source_conversions(graph: &Graph, refused: &[NodeId]) -> BTreeSet<NodeId> {
    let (mut seen, mut found) = (HashSet::new(), BTreeSet::new());
    let mut pending: Vec<NodeId> = refused.iter().flat_map(|id| graph.node(*id).args.clone()).collect();
    while let Some(id) = pending.pop() {
        let node = graph.node(id);
        if node.ty.scalar_kind() != Some(crate::ir::Scalar::Usize) || !seen.insert(id) {
            continue;
        }
        match &node.op {
            Op::Convert => {
                found.insert(id);
            }
            Op::Param(region, k) => {
                let owner = graph.node_ids().find(|id| graph.node(*id).op == Op::Loop(*region));
                let args = owner.map(|owner| graph.node(owner).args.clone()).unwrap_or_default();
                match k {
                    0 => pending.extend(args.iter().take(2)),
                    k => {
                        pending.extend(args.get(*k as usize + 1));
                        pending.extend(graph.region(*region).results.get(*k as usize - 1));
                    }
                }
            }
            Op::Result(k) => {
                let owner = graph.node(node.args[0]);
                for region in graph.regions_of(node.args[0]) {
                    pending.extend(graph.region(region).results.get(*k as usize));
                }
                if let Op::Loop(_) = owner.op {
                    pending.extend(owner.args.get(*k as usize + 2));
                }
            }
            _ => pending.extend(&node.args),
        }
    }
    found
}

/// Errors of rejected operations, one for each location.
pub fn collect_refusals(graph: &Graph, refused: &[NodeId]) -> Vec<Refusal> {
    let mut places = HashSet::new();
    let mut found = Vec::new();
    for id in refused {
        let span = graph.place(*id).map(|place| place.span).unwrap_or_default();
        if places.insert(span) {
            found.push(Refusal {
                node: *id,
                error: refusal_error(graph, *id, span),
            });
        }
    }
    found
}

fn refusal_error(graph: &Graph, id: NodeId, span: Span) -> Diagnostic {
    let what = match &graph.node(id).op {
        Op::Binary(op) => match op {
            BinaryOp::Div => "this quotient of a `usize`",
            BinaryOp::Rem => "this remainder of a `usize`",
            BinaryOp::Shl | BinaryOp::Shr => "this shift of a `usize`",
            BinaryOp::Min => "this minimum of two `usize`",
            BinaryOp::Max => "this maximum of two `usize`",
            _ => "this comparison of two `usize`",
        },
        Op::Unary(_) => "this count of the bits of a `usize`",
        Op::Clamp => "this `clamp` of a `usize`",
        Op::Loop(_) => "this range of `usize`",
        Op::Convert if graph.ty(id) == Type::F32 => "this `usize` as an f32",
        _ => "this `usize`",
    };
    let (label, help) = refusal_cause(graph, id);
    Diagnostic::error_at(
        Code::NarrowUsize,
        span,
        format!("{what} may differ from the native one"),
    )
    .label(label)
    .note("natively a `usize` has 64 bits, and in a shader 32")
    .help(help)
}

/// Reason and help, by the origin of the operands.
fn refusal_cause(graph: &Graph, id: NodeId) -> (&'static str, &'static str) {
    let mut cause = (
        "the value may need more than 32 bits",
        "compute it in u32, with `wrapping_add` and its like where it is to wrap, and convert the result with `as usize`",
    );
    if matches!(graph.node(id).op, Op::Unary(_)) {
        return ("of 64 bits", "count those of a u32: `(x as u32).leading_zeros()`");
    }
    let by_unknown = |args: &[NodeId]| graph.constant_bits(args[1]).is_none();
    match &graph.node(id).op {
        Op::Binary(BinaryOp::Shl) => return ("the count may be 32 or more", "mask the count: `x << (n & 31)`"),
        Op::Binary(BinaryOp::Shr) if by_unknown(&graph.node(id).args) => {
            return ("the count may be 32 or more", "mask the count: `x >> (n & 31)`");
        }
        _ => {}
    }
    for leaf in source_conversions(graph, &[id]) {
        let from = graph.node(leaf).args[0];
        match graph.ty(from) {
            Type::I32 if ranges::integer_bounds(graph, from).is_none_or(|(low, _)| low < 0) => {
                return (
                    "an i32 below 0 `as usize` is a number of 64 bits",
                    "take the remainder or quotient before the conversion, `i.rem_euclid(n) as usize`, or convert with `i as u32 as usize`",
                );
            }
            Type::F32 if ranges::float_bounds(graph, from, 0).is_none_or(|(_, high)| high >= 4_294_967_296.0) => {
                cause = (
                    "a float `as usize` may have 64 bits",
                    "convert with `x as u32 as usize`, which ends at u32::MAX, or bound the float first",
                );
            }
            _ => {}
        }
    }
    cause
}
