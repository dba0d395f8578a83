//! Algebraic simplifications that change no bit of the result.
//!
//! Each rule rewrites towards fewer or simpler nodes and states why it is exact if that is not obvious. Rules that may
//! change a rounding, a NaN or the sign of a zero do not belong here.
//!
//! File tests: `evaluator/tests/filetests/passes/fold`.

use super::{edges, ranges};
use crate::ir::{BinaryOp, Builder, Graph, NodeId, Op, Rules, Scalar, Type, UnaryOp, arith, usize_value};

/// The exact rules.
pub struct Exact;

impl Rules for Exact {
    fn simplify(&self, b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
        fold_constant(b, op, args, ty)
            .or_else(|| fold_shape(b, op, args, ty))
            .or_else(|| fold_array(b, op, args, ty))
            .or_else(|| ranges::fold_inner_clamp(b.graph(), op, args, ty))
            .or_else(|| ranges::fold_frame_clamp(b, op, args, ty))
            .or_else(|| ranges::fold_comparison(b, op, args))
            .or_else(|| edges::at_constants(b, op, args, ty))
            .or_else(|| fold_algebra(b, op, args))
            .or_else(|| find_swapped(b, op, args, ty))
    }
}

/// Folds an operation on constants.
fn fold_constant(b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    let (first, last) = (args.first()?, args.last()?);
    // The constant under `Half` stays, since `f64` does not round it.
    if ty.is_array() || *op == Op::Half {
        return None;
    }
    let mut operands = [[0; 4]; arith::MOST_OPERANDS];
    let operands = operands.get_mut(..args.len())?;
    for (operand, arg) in operands.iter_mut().zip(args) {
        *operand = b.graph().constant_bits(*arg)?;
    }
    let operand = b.graph().ty(if matches!(op, Op::Select) { *last } else { *first });
    let bits = arith::fold_op(op, operand, operands, ty)?;
    Some(b.constant(ty, bits))
}

/// Finds a node with exchanged arguments: `b + a` for `a + b`, `b > a` for `a < b`.
fn find_swapped(b: &Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    let Op::Binary(op) = op else { return None };
    let other = match op {
        BinaryOp::Lt => BinaryOp::Gt,
        BinaryOp::Gt => BinaryOp::Lt,
        BinaryOp::Le => BinaryOp::Ge,
        BinaryOp::Ge => BinaryOp::Le,
        op if op.is_commutative() => *op,
        _ => return None,
    };
    b.find_node(&Op::Binary(other), &[args[1], args[0]], ty)
}

/// Folds components of composed vectors, and selections whose condition is known.
fn fold_shape(b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    let node = |id: NodeId| b.graph().node(id);
    match op {
        Op::Extract(lane) => match &node(args[0]).op {
            Op::Compose => Some(node(args[0]).args[*lane as usize]),
            Op::Splat => Some(node(args[0]).args[0]),
            Op::Const(bits) => {
                let bits = [bits[*lane as usize], 0, 0, 0];
                Some(b.constant(ty, bits))
            }
            _ => None,
        },
        Op::Compose => {
            let first = node(args[0]);
            let whole = *first.args.first()?;
            let parts = args
                .iter()
                .enumerate()
                .all(|(k, part)| node(*part).op == Op::Extract(k as u8) && node(*part).args[0] == whole);
            (parts && b.graph().ty(whole) == ty).then_some(whole)
        }
        Op::Select if args[1] == args[2] || node(args[2]).op == Op::Undef => Some(args[1]),
        Op::Select if node(args[1]).op == Op::Undef => Some(args[2]),
        Op::Select => b
            .graph()
            .constant_bits(args[0])
            .map(|c| if c[0] != 0 { args[1] } else { args[2] }),
        Op::Exact | Op::Half if node(args[0]).op == *op => Some(args[0]),
        Op::Convert if b.graph().ty(args[0]) == ty => Some(args[0]),
        // Conversions from a signed integer to an unsigned one and back keep the bits.
        Op::Convert
            if ty.is_integer()
                && ty != Type::USIZE
                && node(args[0]).op == Op::Convert
                && node(args[0]).ty.is_integer()
                && b.graph().ty(node(args[0]).args[0]) == ty =>
        {
            Some(node(args[0]).args[0])
        }
        // A widened number keeps its lower bits.
        Op::Convert
            if matches!(ty, Type::I32 | Type::U32)
                && node(args[0]).op == Op::Convert
                && node(args[0]).ty == Type::USIZE
                && b.graph().ty(node(args[0]).args[0]).is_integer() =>
        {
            let narrow = node(args[0]).args[0];
            Some(b.add(Op::Convert, [narrow], ty))
        }
        // A constant or value of the host is the same in every lane; two equal swaps in a row cancel.
        Op::QuadSwap(_) if matches!(node(args[0]).op, Op::Const(_) | Op::Uniform(_) | Op::Override(_)) => Some(args[0]),
        Op::QuadSwap(_) if node(args[0]).op == *op => Some(node(args[0]).args[0]),
        _ => None,
    }
}

/// Folds array elements read at constant indices.
fn fold_array(b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    if *op != Op::ArrayGet {
        return None;
    }
    let Some(index) = b.graph().constant_bits(args[1]).map(|bits| bits[0]) else {
        return read_in_order(b, args[0], args[1], ty);
    };
    let node = b.graph().node(args[0]).clone();
    match node.op {
        Op::MakeArray => Some(*node.args.get(index as usize).or(node.args.last())?),
        Op::ArraySet => {
            let written = b.graph().constant_bits(node.args[1])?[0];
            let Type::Array { len, .. } = node.ty else { return None };
            if written >= len || index >= len {
                None
            } else if written == index {
                Some(node.args[2])
            } else {
                Some(b.add(Op::ArrayGet, [node.args[0], args[1]], ty))
            }
        }
        _ => None,
    }
}

/// Folds an element of an array whose elements are consecutive parts of one buffer element: reads that part directly.
fn read_in_order(b: &mut Builder<'_>, array: NodeId, index: NodeId, ty: Type) -> Option<NodeId> {
    let g = b.graph();
    let parts = g.node(array).args.clone();
    let first = g.node(*parts.first()?).clone();
    let (Op::MakeArray, Op::BufferLoad { .. }, [element, from]) = (&g.node(array).op, &first.op, &first.args[..])
    else {
        return None;
    };
    let (element, from) = (*element, g.constant_bits(*from)?[0]);
    let at = |part: &NodeId| {
        let node = g.node(*part);
        let same = node.op.clone().without_site() == first.op.clone().without_site() && node.args[0] == element;
        if same {
            g.constant_bits(*node.args.get(1)?).map(|bits| bits[0])
        } else {
            None
        }
    };
    let step = at(parts.get(1)?)?.checked_sub(from).filter(|step| *step > 0)?;
    let ordered = (0..).zip(&parts).all(|(k, part)| at(part) == Some(from + k * step));
    if !ordered {
        return None;
    }
    // An index out of range, including a negative one, refers to the last element.
    let last = parts.len() as u32 - 1;
    let inside = ranges::integer_bounds(g, index).is_some_and(|(low, high)| low >= 0 && high <= i64::from(last));
    let index = match inside {
        true => index,
        false => {
            let unsigned = b.add(Op::Bitcast, [index], Type::U32);
            let last = b.constant(Type::U32, [last, 0, 0, 0]);
            let least = b.add(Op::Binary(BinaryOp::Min), [unsigned, last], Type::U32);
            b.add(Op::Bitcast, [least], Type::I32)
        }
    };
    let step = b.i32(step as i32);
    let steps = b.add(Op::Binary(BinaryOp::Mul), [index, step], Type::I32);
    let from = b.i32(from as i32);
    let at = b.add(Op::Binary(BinaryOp::Add), [steps, from], Type::I32);
    Some(b.add(first.op, [element, at], ty))
}

fn fold_algebra(b: &mut Builder<'_>, op: &Op, args: &[NodeId]) -> Option<NodeId> {
    let g = b.graph();
    match op {
        Op::Unary(UnaryOp::Neg) if g.node(args[0]).op == Op::Unary(UnaryOp::Neg) => Some(g.node(args[0]).args[0]),
        Op::Unary(UnaryOp::Not) if g.node(args[0]).op == Op::Unary(UnaryOp::Not) => Some(g.node(args[0]).args[0]),
        Op::Clamp if g.node(args[0]).op == Op::Clamp && g.node(args[0]).args[1..] == args[1..] => Some(args[0]),
        Op::Select if g.ty(args[1]) == Type::BOOL => fold_bool_select(b, args[0], args[1], args[2]),
        Op::Binary(op) => {
            let (x, y) = (args[0], args[1]);
            match g.ty(x).scalar_kind()? {
                Scalar::F32 => fold_float(g, *op, x, y).or_else(|| fold_square(b, *op, x, y)),
                Scalar::I32 | Scalar::U32 | Scalar::Usize => fold_integer(b, *op, x, y),
                Scalar::Bool => fold_boolean(b, *op, x, y),
            }
        }
        _ => None,
    }
}

/// Folds a selection between booleans, one of them constant, to a conjunction or disjunction.
fn fold_bool_select(b: &mut Builder<'_>, condition: NodeId, yes: NodeId, no: NodeId) -> Option<NodeId> {
    let known = |b: &Builder<'_>, id| b.graph().constant_bits(id).map(|bits| bits[0] != 0);
    let (op, negated, other) = match (known(b, yes), known(b, no)) {
        (Some(true), Some(false)) => return Some(condition),
        (Some(false), Some(true)) => return Some(b.add(Op::Unary(UnaryOp::Not), [condition], Type::BOOL)),
        (Some(true), None) => (BinaryOp::Or, false, no),
        (Some(false), None) => (BinaryOp::And, true, no),
        (None, Some(true)) => (BinaryOp::Or, true, yes),
        (None, Some(false)) => (BinaryOp::And, false, yes),
        _ => return None,
    };
    let condition = match negated {
        true => b.add(Op::Unary(UnaryOp::Not), [condition], Type::BOOL),
        false => condition,
    };
    Some(b.add(Op::Binary(op), [condition, other], Type::BOOL))
}

fn fold_float(g: &Graph, op: BinaryOp, x: NodeId, y: NodeId) -> Option<NodeId> {
    let is = |id: NodeId, value: f32| all_lanes(g, id, value.to_bits());
    match op {
        // -0 + 0 is 0, so a zero can be dropped only if the other side is never -0; x + -0 is x for every x.
        BinaryOp::Add if is(y, -0.0) || (is(y, 0.0) && ranges::is_nonnegative(g, x)) => Some(x),
        BinaryOp::Add if is(x, -0.0) || (is(x, 0.0) && ranges::is_nonnegative(g, y)) => Some(y),
        BinaryOp::Sub if is(y, 0.0) => Some(x),
        BinaryOp::Mul | BinaryOp::Div if is(y, 1.0) => Some(x),
        BinaryOp::Mul if is(x, 1.0) => Some(y),
        // The minimum of 0 and a nonnegative value is 0. For a NaN it is 0 too, but for vectors only if the 0 comes last.
        BinaryOp::Min if is(x, 0.0) && ranges::is_nonnegative(g, y) && g.ty(x).is_scalar() => Some(x),
        BinaryOp::Min if is(y, 0.0) && ranges::is_nonnegative(g, x) => Some(y),
        // The value is bounded already. The result of `min` is no NaN.
        BinaryOp::Min if bounded_by(g, y, x) => Some(y),
        BinaryOp::Min if bounded_by(g, x, y) => Some(x),
        BinaryOp::Min | BinaryOp::Max if x == y => Some(x),
        _ => None,
    }
}

/// Replaces a square by that of the negated value, if that exists: rounding is symmetric around zero.
fn fold_square(b: &mut Builder<'_>, op: BinaryOp, x: NodeId, y: NodeId) -> Option<NodeId> {
    if op != BinaryOp::Mul || x != y {
        return None;
    }
    let opposite = find_negation(b, x).filter(|opposite| *opposite < x)?;
    let ty = b.graph().ty(x);
    Some(b.add(Op::Binary(op), [opposite, opposite], ty))
}

/// Existing node that computes `-id`: `b - a` for `a - b`, and quotients of such differences.
fn find_negation(b: &Builder<'_>, id: NodeId) -> Option<NodeId> {
    let node = b.graph().node(id);
    let args = match node.op {
        Op::Binary(BinaryOp::Sub) => vec![node.args[1], node.args[0]],
        Op::Binary(BinaryOp::Div) => vec![find_negation(b, node.args[0])?, node.args[1]],
        _ => return None,
    };
    b.find_node(&node.op, &args, node.ty)
}

/// Returns whether `id` is at most the non-zero constant `bound`, and never a NaN.
fn bounded_by(g: &Graph, id: NodeId, bound: NodeId) -> bool {
    let is_bound = g.constant_bits(bound).is_some() && !all_lanes(g, bound, 0) && !all_lanes(g, bound, 1 << 31);
    is_bound && at_most(g, id, bound)
}

fn at_most(g: &Graph, id: NodeId, bound: NodeId) -> bool {
    let node = g.node(id);
    match node.op {
        _ if id == bound => !g
            .constant_bits(bound)
            .is_some_and(|lanes| lanes.iter().any(|x| f32::from_bits(*x).is_nan())),
        Op::Exact | Op::Tally(_) => at_most(g, node.args[0], bound),
        // For vectors, the last argument replaces a NaN in the first.
        Op::Binary(BinaryOp::Min) if node.ty.is_scalar() => node.args.contains(&bound),
        Op::Binary(BinaryOp::Min) => node.args[1] == bound,
        Op::Binary(BinaryOp::Max) => node.args.iter().all(|arg| at_most(g, *arg, bound)),
        // A selection that compares its value with the bound.
        Op::Select if node.ty.is_scalar() => {
            let (condition, [yes, no]) = (g.node(node.args[0]), [node.args[1], node.args[2]]);
            let compared = condition.op == Op::Binary(BinaryOp::Lt) && condition.args == [yes, bound];
            (compared || at_most(g, yes, bound)) && at_most(g, no, bound)
        }
        _ => false,
    }
}

fn fold_integer(b: &mut Builder<'_>, op: BinaryOp, x: NodeId, y: NodeId) -> Option<NodeId> {
    if matches!(op, BinaryOp::Div | BinaryOp::Rem)
        && let Some(divisor) = without_zeros(b, y)
    {
        let ty = b.graph().ty(y);
        return Some(b.add(Op::Binary(op), [x, divisor], ty));
    }
    if op == BinaryOp::Add
        && let Some(sum) = merge_steps(b, x, y)
    {
        return Some(sum);
    }
    if op == BinaryOp::Sub
        && let (Some(step), Op::Pixel) = (b.graph().constant_bits(y), &b.graph().node(x).op)
    {
        // Canonical form of a neighbour's coordinate.
        let ty = b.graph().ty(y);
        let back = b.constant(ty, step.map(u32::wrapping_neg));
        return Some(b.add(Op::Binary(BinaryOp::Add), [x, back], ty));
    }
    let g = b.graph();
    let is = |id: NodeId, value: u32| all_lanes(g, id, value);
    match op {
        BinaryOp::Add | BinaryOp::Or | BinaryOp::Xor if is(x, 0) => Some(y),
        BinaryOp::Add | BinaryOp::Sub | BinaryOp::Or | BinaryOp::Xor | BinaryOp::Shl | BinaryOp::Shr if is(y, 0) => {
            Some(x)
        }
        BinaryOp::Mul | BinaryOp::Div if is(y, 1) => Some(x),
        BinaryOp::Mul if is(x, 1) => Some(y),
        BinaryOp::Rem if is(y, 1) => {
            let ty = g.ty(x);
            Some(b.constant(ty, [0; 4]))
        }
        BinaryOp::Mul | BinaryOp::And if is(x, 0) => Some(x),
        BinaryOp::Mul | BinaryOp::And if is(y, 0) => Some(y),
        BinaryOp::Min | BinaryOp::Max | BinaryOp::And | BinaryOp::Or if x == y => Some(x),
        BinaryOp::Sub | BinaryOp::Xor if x == y => {
            let ty = g.ty(x);
            Some(b.constant(ty, [0; 4]))
        }
        BinaryOp::Eq | BinaryOp::Le | BinaryOp::Ge if x == y && g.ty(x).is_scalar() => Some(b.bool(true)),
        BinaryOp::Ne | BinaryOp::Lt | BinaryOp::Gt if x == y && g.ty(x).is_scalar() => Some(b.bool(false)),
        _ => None,
    }
}

/// Rewrites `(pixel + a) + b` as `pixel + (a + b)`, which is exact because integers wrap. Neighbours of neighbours then
/// have the same form, and their reads are shared.
fn merge_steps(b: &mut Builder<'_>, x: NodeId, y: NodeId) -> Option<NodeId> {
    let ty = b.graph().ty(x);
    let (inner, second) = match (b.graph().constant_bits(x), b.graph().constant_bits(y)) {
        (None, Some(step)) => (b.graph().node(x), step),
        (Some(step), None) => (b.graph().node(y), step),
        _ => return None,
    };
    if inner.op != Op::Binary(BinaryOp::Add) {
        return None;
    }
    let (p, q) = (inner.args[0], inner.args[1]);
    let (pixel, first) = match (&b.graph().node(p).op, &b.graph().node(q).op) {
        (Op::Pixel, Op::Const(step)) => (p, *step),
        (Op::Const(step), Op::Pixel) => (q, *step),
        _ => return None,
    };
    let mut sum = [0; 4];
    for (k, slot) in sum.iter_mut().enumerate().take(ty.component_count() as usize) {
        *slot = first[k].wrapping_add(second[k]);
    }
    let sum = b.constant(ty, sum);
    Some(b.add(Op::Binary(BinaryOp::Add), [pixel, sum], ty))
}

/// Replaces each component of a divisor that is known to be 0 by 1. Both divisors return the dividend and remainder 0, but
/// shading languages reject a constant divisor 0.
fn without_zeros(b: &mut Builder<'_>, y: NodeId) -> Option<NodeId> {
    let ty = b.graph().ty(y);
    let node = b.graph().node(y).clone();
    match node.op {
        Op::Const(bits) if ty == Type::USIZE && bits[1] != 0 => None,
        Op::Const(mut bits) => {
            let lanes = &mut bits[..ty.component_count() as usize];
            if !lanes.contains(&0) {
                return None;
            }
            lanes.iter_mut().filter(|lane| **lane == 0).for_each(|lane| *lane = 1);
            Some(b.constant(ty, bits))
        }
        Op::Compose => {
            let zero = |b: &Builder<'_>, id: NodeId| all_lanes(b.graph(), id, 0);
            if !node.args.iter().any(|lane| zero(b, *lane)) {
                return None;
            }
            let one = b.constant(Type::scalar(ty.scalar_kind()?), [1, 0, 0, 0]);
            let lanes = node.args.iter().map(|lane| if zero(b, *lane) { one } else { *lane });
            let lanes: Vec<_> = lanes.collect();
            Some(b.add(Op::Compose, lanes, ty))
        }
        _ => None,
    }
}

fn fold_boolean(b: &mut Builder<'_>, op: BinaryOp, x: NodeId, y: NodeId) -> Option<NodeId> {
    let g = b.graph();
    let is = |id: NodeId, value: u32| all_lanes(g, id, value);
    match op {
        BinaryOp::Eq | BinaryOp::Ne | BinaryOp::Xor if x == y => {
            let ty = g.ty(x);
            let same = u32::from(op == BinaryOp::Eq);
            let lane = |k| if k < ty.component_count() as usize { same } else { 0 };
            Some(b.constant(ty, std::array::from_fn(lane)))
        }
        BinaryOp::Eq | BinaryOp::Ne => {
            let known = |id| [0, 1].into_iter().find(|value| is(id, *value));
            let (value, other) = match (known(x), known(y)) {
                (Some(value), _) => (value, y),
                (_, Some(value)) => (value, x),
                _ => return None,
            };
            let same = (value == 1) == (op == BinaryOp::Eq);
            Some(if same { other } else { not(b, other) })
        }
        BinaryOp::And if is(x, 1) => Some(y),
        BinaryOp::And if is(y, 1) => Some(x),
        BinaryOp::And if is(x, 0) => Some(x),
        BinaryOp::And if is(y, 0) => Some(y),
        BinaryOp::Or if is(x, 0) => Some(y),
        BinaryOp::Or if is(y, 0) => Some(x),
        BinaryOp::Or if is(x, 1) => Some(x),
        BinaryOp::Or if is(y, 1) => Some(y),
        BinaryOp::And | BinaryOp::Or if x == y => Some(x),
        _ => None,
    }
}

fn not(b: &mut Builder<'_>, x: NodeId) -> NodeId {
    let ty = b.graph().ty(x);
    b.add(Op::Unary(UnaryOp::Not), [x], ty)
}

/// Returns whether `id` is a constant with `bits` in every component.
fn all_lanes(g: &Graph, id: NodeId, bits: u32) -> bool {
    let lanes = match g.ty(id) {
        Type::USIZE => return g.constant_bits(id).is_some_and(|c| usize_value(&c) == u64::from(bits)),
        ty => ty.component_count() as usize,
    };
    g.constant_bits(id)
        .is_some_and(|c| c[..lanes].iter().all(|lane| *lane == bits))
}
