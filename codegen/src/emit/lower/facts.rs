//! What is known of operands, so that the text need not guard what cannot happen.

use crate::emit::ast::Division;
use straightline_evaluator::ir::{Graph, NodeId, Op, Scalar, Type};
use straightline_evaluator::passes::{bounds, component_bounds, float_bounds};

/// What is known of the operands of an integer division.
pub fn division(graph: &Graph, x: NodeId, y: NodeId) -> Division {
    let ty = graph.ty(x);
    let signed = ty.kind() == Some(Scalar::I32);
    let bounds = |id: NodeId| (0..ty.components()).map(move |k| component_bounds(graph, id, k));
    let defined = bounds(x).zip(bounds(y)).all(|(x, y)| {
        let Some((low, high)) = y else { return false };
        let zero = low <= 0 && high >= 0;
        let overflow = signed && low <= -1 && high >= -1 && x.is_none_or(|(low, _)| low == i64::from(i32::MIN));
        !zero && !overflow
    });
    let positive = |id: NodeId| bounds(id).all(|b| b.is_some_and(|(low, _)| low >= 0));
    Division {
        defined,
        positive: positive(x) && positive(y),
    }
}

/// Whether every value of a node has its like in the type `to`: for a float an integer where it is cut off, for an integer a
/// finite number of every precision, or the same integer.
pub fn converts(graph: &Graph, id: NodeId, to: Type, half: bool) -> bool {
    match (graph.ty(id).is_float(), to.is_integer()) {
        (true, true) => has_integer(graph, id, to, half),
        (false, true) => has_no_sign(graph, id),
        (_, false) => fits_half(graph, id),
    }
}

/// Whether no component of an integer is negative, or over the largest signed one.
fn has_no_sign(graph: &Graph, id: NodeId) -> bool {
    let fits = |k| component_bounds(graph, id, k).is_some_and(|(low, high)| low >= 0 && high <= i64::from(i32::MAX));
    (0..graph.ty(id).components()).all(fits)
}

/// Whether every float that a value can be has an integer of the type `to` where it is cut off. In half precision the largest
/// numbers may have become infinities.
fn has_integer(graph: &Graph, id: NodeId, to: Type, half: bool) -> bool {
    // A driver may round a little differently: stay clear of the edges.
    let (smallest, largest) = match (half, to.kind()) {
        (true, Some(Scalar::I32)) => (-60_000.0, 60_000.0),
        (true, _) => (-0.5, 60_000.0),
        (false, Some(Scalar::I32)) => (-2.1e9, 2.1e9),
        (false, _) => (-0.5, 4.2e9),
    };
    let fits = |(low, high): (f32, f32)| low >= smallest && high <= largest;
    (0..to.components()).all(|k| float_bounds(graph, id, k).is_some_and(fits))
}

/// Whether an integer is known to lie within the finite numbers of half precision. Textures are never as wide as that.
fn fits_half(graph: &Graph, id: NodeId) -> bool {
    let node = graph.node(id);
    match node.op {
        Op::Pixel | Op::FrameSize | Op::TextureSize(_) | Op::TextureLevels(_) | Op::TextureLayers(_) | Op::Lane => true,
        Op::Extract(_) | Op::Splat | Op::Compose | Op::Tally(_) => node.args.iter().all(|arg| fits_half(graph, *arg)),
        _ if node.ty.is_scalar() => bounds(graph, id).is_some_and(|(low, high)| low >= -65504 && high <= 65504),
        _ => false,
    }
}

/// Whether an index is known to lie inside an array of so many elements.
pub fn is_inside(graph: &Graph, index: NodeId, len: u32) -> bool {
    component_bounds(graph, index, 0).is_some_and(|(low, high)| low >= 0 && high < i64::from(len))
}

/// Whether all elements of an array literal are constants that a literal can say.
pub fn is_table(graph: &Graph, elements: &[NodeId]) -> bool {
    elements.iter().all(|id| {
        let ty = graph.ty(*id);
        let finite = |bits: &u32| !ty.is_float() || f32::from_bits(*bits).is_finite();
        graph
            .constant(*id)
            .is_some_and(|bits| bits[..ty.components() as usize].iter().all(finite))
    })
}
