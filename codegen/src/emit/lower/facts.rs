//! Facts about operands, by which the text can omit guards against values that cannot occur.

use crate::emit::ast::{Division, Domain};
use straightline_evaluator::ir::{BinaryOp, Graph, NodeId, Op, Scalar, Type, UnaryOp};
use straightline_evaluator::passes::{component_bounds, float_bounds, integer_bounds};
use straightline_evaluator::policy::Math;

/// Returns the facts known about the operands of an integer division.
pub fn division_facts(graph: &Graph, x: NodeId, y: NodeId) -> Division {
    let ty = graph.ty(x);
    let signed = ty.scalar_kind() == Some(Scalar::I32);
    let bounds = |id: NodeId| (0..ty.component_count()).map(move |k| component_bounds(graph, id, k));
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

/// Returns the facts known about the arguments of a function of floats, if they may lie where drivers deviate from it. Fast
/// mathematics assumes that they never do. A power that is a product always needs the facts.
pub fn float_domain(graph: &Graph, id: NodeId, math: Math) -> Option<Domain> {
    let node = graph.node(id);
    if !node.ty.is_float() || node.ty.is_array() {
        return None;
    }
    let all = |id: NodeId, holds: &dyn Fn(f32, f32) -> bool| {
        let mut lanes = 0..graph.ty(id).component_count();
        lanes.all(|k| float_bounds(graph, id, k).is_some_and(|(low, high)| holds(low, high)))
    };
    let within = |id: NodeId, size: f32| all(id, &|low, high| low >= -size && high <= size);
    let known = |id: NodeId| within(id, f32::INFINITY);
    let positive = |id: NodeId| all(id, &|low, _| low >= f32::MIN_POSITIVE);
    let not_negative = |id: NodeId| all(id, &|low, _| low >= 0.0);
    let first = *node.args.first()?;
    let domain = Domain {
        positive: positive(first),
        not_negative: not_negative(first),
        bounded: false,
    };
    let guarded = match node.op {
        Op::Binary(BinaryOp::Pow) => return power_domain(graph, node.args[0], node.args[1], domain, math),
        Op::Unary(UnaryOp::Cbrt) => return Some(domain),
        _ if math == Math::Fast => false,
        Op::Binary(BinaryOp::Rem) => return remainder_domain(graph, node.args[0], node.args[1]),
        Op::Binary(BinaryOp::Atan2) => !(domain.positive && known(node.args[1])),
        Op::Unary(UnaryOp::Log | UnaryOp::Log2) => !domain.positive,
        Op::Unary(UnaryOp::Sinh | UnaryOp::Cosh | UnaryOp::Tanh) => !within(first, 40.0),
        Op::Unary(UnaryOp::Fract) => !within(first, f32::MAX),
        Op::Unary(UnaryOp::Atan) => !known(first),
        _ => false,
    };
    guarded.then_some(domain)
}

/// As [`float_domain`], for a power.
fn power_domain(graph: &Graph, x: NodeId, y: NodeId, domain: Domain, math: Math) -> Option<Domain> {
    let lanes = usize::from(graph.ty(y).component_count());
    let constant = |id: NodeId| {
        let bits = graph.constant_bits(id)?;
        let same = bits[..lanes].iter().all(|lane| *lane == bits[0]);
        same.then(|| f32::from_bits(bits[0]))
    };
    let finite = |id: NodeId| {
        let within = |k| float_bounds(graph, id, k).is_some_and(|(low, high)| low >= f32::MIN && high <= f32::MAX);
        (0..lanes as u8).all(within)
    };
    let simple = match constant(y) {
        // A product, or a root.
        Some(n) if n.fract() == 0.0 && (1.0..=64.0).contains(&n.abs()) => return Some(domain),
        Some(y) if y.abs() == 0.5 && domain.not_negative => return Some(domain),
        // At 0 a driver returns 2^-127y, which is as small as a rounding of 1.
        Some(y) if y.is_finite() => domain.positive || (domain.not_negative && y >= 0.2),
        _ => domain.positive && finite(x) && (finite(y) || constant(x).is_some_and(|x| x != 1.0)),
    };
    (math == Math::Exact && !simple).then_some(domain)
}

/// As [`float_domain`], for a remainder. With a power of two of at least 1 no operation rounds.
fn remainder_domain(graph: &Graph, x: NodeId, y: NodeId) -> Option<Domain> {
    let lanes = graph.ty(y).component_count();
    let is_power = |bits: u32| f32::from_bits(bits).abs() >= 1.0 && bits & 0x007f_ffff == 0 && bits << 1 < 0xff00_0000;
    if graph
        .constant_bits(y)
        .is_some_and(|bits| bits[..usize::from(lanes)].iter().all(|bits| is_power(*bits)))
    {
        return None;
    }
    let quotient = |k: u8| {
        let (low, high) = float_bounds(graph, x, k)?;
        let (least, most) = float_bounds(graph, y, k)?;
        let smallest = if least > 0.0 { least } else { -most };
        let largest = low.abs().max(high.abs());
        (smallest >= f32::MIN_POSITIVE).then_some(largest / smallest)
    };
    let bounded = (0..lanes).all(|k| quotient(k).is_some_and(|q| q < 2000.0));
    Some(Domain {
        bounded,
        ..Domain::default()
    })
}

/// Returns whether every value of a node is representable in the type `to`: for a float the truncated integer, for an
/// integer a finite number of every precision, or the same integer.
pub fn is_convertible(graph: &Graph, id: NodeId, to: Type, half: bool) -> bool {
    match (graph.ty(id).is_float(), to.is_integer()) {
        (true, true) => has_integer(graph, id, to, half),
        (false, true) => has_no_sign(graph, id),
        (_, false) => fits_half(graph, id),
    }
}

/// Returns whether every component of an integer is known to lie between 0 and the largest signed integer.
fn has_no_sign(graph: &Graph, id: NodeId) -> bool {
    let fits = |k| component_bounds(graph, id, k).is_some_and(|(low, high)| low >= 0 && high <= i64::from(i32::MAX));
    (0..graph.ty(id).component_count()).all(fits)
}

/// Returns whether every possible value of a float truncates to an integer of the type `to`. In half precision the largest
/// numbers may have become infinities.
fn has_integer(graph: &Graph, id: NodeId, to: Type, half: bool) -> bool {
    // A driver may round slightly differently, so values near the limits are excluded.
    let (smallest, largest) = match (half, to.scalar_kind()) {
        (true, Some(Scalar::I32)) => (-60_000.0, 60_000.0),
        (true, _) => (-0.5, 60_000.0),
        (false, Some(Scalar::I32)) => (-2.1e9, 2.1e9),
        (false, _) => (-0.5, 4.2e9),
    };
    let fits = |(low, high): (f32, f32)| low >= smallest && high <= largest;
    (0..to.component_count()).all(|k| float_bounds(graph, id, k).is_some_and(fits))
}

/// Returns whether an integer is known to lie within the finite numbers of half precision. Texture sizes always do.
fn fits_half(graph: &Graph, id: NodeId) -> bool {
    let node = graph.node(id);
    match node.op {
        Op::Pixel | Op::FrameSize | Op::TextureSize(_) | Op::TextureLevels(_) | Op::TextureLayers(_) | Op::Lane => true,
        Op::Extract(_) | Op::Splat | Op::Compose | Op::Tally(_) => node.args.iter().all(|arg| fits_half(graph, *arg)),
        _ if node.ty.is_scalar() => integer_bounds(graph, id).is_some_and(|(low, high)| low >= -65504 && high <= 65504),
        _ => false,
    }
}

/// Returns whether an index is known to lie inside an array of `len` elements.
pub fn is_inside(graph: &Graph, index: NodeId, len: u32) -> bool {
    component_bounds(graph, index, 0).is_some_and(|(low, high)| low >= 0 && high < i64::from(len))
}

/// Returns whether all elements of an array are finite constants, which a literal can spell.
pub fn is_table(graph: &Graph, elements: &[NodeId]) -> bool {
    elements.iter().all(|id| {
        let ty = graph.ty(*id);
        let finite = |bits: &u32| !ty.is_float() || f32::from_bits(*bits).is_finite();
        graph
            .constant_bits(*id)
            .is_some_and(|bits| bits[..ty.component_count() as usize].iter().all(finite))
    })
}
