//! Texel coordinates, component by component.
//!
//! File tests: `evaluator/tests/filetests/passes/coordinates`.

use super::fold::Exact;
use crate::ir::{
    BinaryOp, Builder, Graph, Invocation, NodeId, Op, Origin, Rebuild, Rules, Scalar, Type, rebuild_graph,
};
use std::collections::BTreeSet;

const PAIR: Type = Type::value(Scalar::I32, 2);

/// Steps beyond this might wrap; a pixel's coordinate is less than 2^20.
const MAX_STEP: i32 = 1 << 30;

/// Clamps the coordinates of a pixel's neighbours by column and by row, if that takes fewer operations than by texel. For
/// example, 49 texels around a pixel lie in seven columns and seven rows, one of each without a clamp. Each coordinate
/// remains the same integer.
///
/// Runs after every pass that matches coordinates as vectors.
pub fn by_component(graph: &Graph) -> Graph {
    let found: Vec<Neighbour> = graph
        .node_ids()
        .filter(|id| is_read(&graph.node(*id).op))
        .filter_map(|id| Neighbour::from_node(graph, graph.node(id).args[0]))
        .collect();
    // Count each distinct coordinate and each distinct component once. A vector operation counts as one for each component.
    let whole: BTreeSet<_> = found.iter().collect();
    let parts: BTreeSet<_> = found
        .iter()
        .flat_map(|at| [0, 1].map(|axis| at.axis_part(axis)))
        .collect();
    let together: usize = whole.iter().map(|at| 2 * at.operation_count()).sum();
    let apart: usize = parts.iter().map(Part::operation_count).sum();
    if apart >= together {
        return graph.clone();
    }
    let pass = Rebuild {
        rules: &ByComponent,
        share_loads: false,
    };
    rebuild_graph(graph, &pass)
}

fn is_read(op: &Op) -> bool {
    matches!(op, Op::Load { .. })
}

/// A coordinate at a constant step from the pixel, clamped to the texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Neighbour {
    pixel: NodeId,
    step: [i32; 2],
    /// Largest coordinate, if the coordinate is clamped to that.
    last: Option<NodeId>,
    /// `true` if the coordinate is clamped to at least 0.
    from_zero: bool,
    /// `true` if the pixel itself is known to lie inside, so that a step back never passes the last coordinate.
    inside: bool,
}

/// A component of a neighbour's coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Part {
    pixel: NodeId,
    axis: u8,
    step: i32,
    last: Option<NodeId>,
    from_zero: bool,
}

impl Neighbour {
    fn from_node(g: &Graph, id: NodeId) -> Option<Neighbour> {
        let node = g.node(id);
        if node.ty != PAIR {
            return None;
        }
        let is_zero = |id: NodeId| g.constant_bits(id).is_some_and(|bits| bits[..2] == [0, 0]);
        let (moved, from_zero, last) = match (&node.op, &node.args[..]) {
            (Op::Clamp, [moved, low, last]) if is_zero(*low) => (*moved, true, Some(*last)),
            (Op::Binary(BinaryOp::Max), [moved, low]) if is_zero(*low) => (*moved, true, None),
            (Op::Binary(BinaryOp::Min), [moved, last]) => (*moved, false, Some(*last)),
            _ => return None,
        };
        let size = match last {
            Some(last) => Some(size_op(g, last)?),
            None => None,
        };
        let node = g.node(moved);
        let constant = |id: NodeId| g.constant_bits(id).map(|bits| [bits[0] as i32, bits[1] as i32]);
        let (pixel, step) = match (&node.op, &node.args[..]) {
            (Op::Pixel, _) => (moved, [0, 0]),
            (Op::Binary(BinaryOp::Add), [a, b]) => match (constant(*a), constant(*b)) {
                (None, Some(step)) => (*a, step),
                (Some(step), None) => (*b, step),
                _ => return None,
            },
            _ => return None,
        };
        let reached = step.iter().all(|step| (-MAX_STEP..=MAX_STEP).contains(step));
        (g.node(pixel).op == Op::Pixel && reached).then_some(Neighbour {
            pixel,
            step,
            last,
            from_zero,
            inside: g.invocation == Invocation::Pixel && size == Some(Op::FrameSize),
        })
    }

    /// A component, clamped on the sides where it may lie outside. A pixel never lies before the first coordinate.
    fn axis_part(&self, axis: u8) -> Part {
        let step = self.step[usize::from(axis)];
        Part {
            pixel: self.pixel,
            axis,
            step,
            last: self.last.filter(|_| step > 0 || !self.inside),
            from_zero: self.from_zero && step < 0,
        }
    }

    fn operation_count(&self) -> usize {
        let moves = usize::from(self.step != [0, 0]);
        moves + usize::from(self.last.is_some()) + usize::from(self.from_zero)
    }
}

/// Size operation whose largest coordinate is `last`.
fn size_op(g: &Graph, last: NodeId) -> Option<Op> {
    let node = g.node(last);
    let is_one = |id: NodeId| g.constant_bits(id).is_some_and(|bits| bits[..2] == [1, 1]);
    match (&node.op, &node.args[..]) {
        (Op::Binary(BinaryOp::Sub), [size, one]) if is_one(*one) => match &g.node(*size).op {
            size @ (Op::FrameSize | Op::TextureSize(_)) => Some(size.clone()),
            _ => None,
        },
        _ => None,
    }
}

impl Part {
    fn operation_count(&self) -> usize {
        usize::from(self.step != 0) + usize::from(self.last.is_some()) + usize::from(self.from_zero)
    }

    fn build_part(&self, b: &mut Builder<'_>, like: NodeId) -> NodeId {
        let mut at = b.add(Op::Extract(self.axis), [self.pixel], Type::I32);
        if self.step != 0 {
            let step = b.i32(self.step);
            at = b.add(Op::Binary(BinaryOp::Add), [at, step], Type::I32);
        }
        if self.from_zero {
            let zero = b.i32(0);
            at = b.add(Op::Binary(BinaryOp::Max), [at, zero], Type::I32);
        }
        if let Some(last) = self.last {
            let last = b.add(Op::Extract(self.axis), [last], Type::I32);
            at = b.add(Op::Binary(BinaryOp::Min), [at, last], Type::I32);
        }
        if self.operation_count() > 1
            && let Some(origin) = b.graph().origin(like).cloned()
        {
            let origin = Origin {
                name: self.step_name().into(),
                counters: [].into(),
                ..origin
            };
            b.set_origin(at, &origin);
        }
        at
    }

    /// Name for the column or row, with the distance unless it is 1.
    fn step_name(&self) -> String {
        let side = match (self.axis, self.step) {
            (0, 0) => "column",
            (_, 0) => "row",
            (0, ..0) => "left",
            (0, _) => "right",
            (_, ..0) => "above",
            _ => "below",
        };
        match self.step.unsigned_abs() {
            0 | 1 => side.to_owned(),
            far => format!("{side}{far}"),
        }
    }
}

struct ByComponent;

impl Rules for ByComponent {
    fn simplify(&self, b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
        if !is_read(op) {
            return Exact.simplify(b, op, args, ty);
        }
        let at = Neighbour::from_node(b.graph(), args[0])?;
        let parts = [0, 1].map(|axis| at.axis_part(axis).build_part(b, args[0]));
        let coordinate = b.add(Op::Compose, parts, PAIR);
        if let Some(origin) = b.graph().origin(args[0]).cloned() {
            b.set_origin(coordinate, &origin);
        }
        let args = [&[coordinate], &args[1..]].concat();
        Some(b.intern(op.clone(), args, ty))
    }
}
