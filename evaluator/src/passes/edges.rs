//! Float operations on constants where drivers deviate from IEEE 754: division by zero, by an infinity, by subnormal
//! numbers and by a difference that is zero; powers 0 and 1.
//!
//! Drivers fold such a division at compile time, to 0 or to a value that is never written. Each rule computes the same bits
//! by an operation that drivers leave alone; only the bits of a NaN may differ.
//!
//! File tests: `evaluator/tests/filetests/passes/edges`.

use crate::ir::{BinaryOp, Builder, NodeId, Op, Scalar, Type};

/// Replaces a division or a power by other operations with the same value.
pub fn at_constants(b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    let Op::Binary(op @ (BinaryOp::Div | BinaryOp::Pow)) = op else {
        return None;
    };
    if !ty.is_float() || ty.is_array() {
        return None;
    }
    match op {
        BinaryOp::Div => fold_division(b, args[0], args[1], ty),
        _ => fold_power(b, args[0], args[1], ty),
    }
}

/// `x^0` and `1^y` are 1, also for a NaN; `x^1` is `x`.
fn fold_power(b: &mut Builder<'_>, x: NodeId, y: NodeId, ty: Type) -> Option<NodeId> {
    let all = |id: NodeId, value: f32| {
        let lanes = usize::from(ty.component_count());
        let bits = b.graph().constant_bits(id);
        bits.is_some_and(|bits| bits[..lanes].iter().all(|lane| f32::from_bits(*lane) == value))
    };
    match (all(x, 1.0) || all(y, 0.0), all(y, 1.0)) {
        (true, _) => Some(splat_constant(b, 1.0, ty)),
        (_, true) => Some(x),
        _ => None,
    }
}

fn fold_division(b: &mut Builder<'_>, x: NodeId, y: NodeId, ty: Type) -> Option<NodeId> {
    let divisor = b.graph().node(y).clone();
    let lanes = usize::from(ty.component_count());
    match &divisor.op {
        Op::Const(bits) if bits[..lanes].iter().any(|lane| is_edge(*lane)) => {
            if lanes == 1 {
                return Some(by_constant(b, x, f32::from_bits(bits[0])));
            }
            if bits[..lanes].iter().all(|lane| f32::from_bits(*lane) == 0.0) {
                let inverse = bits.map(|lane| (1.0 / f32::from_bits(lane)).to_bits());
                let inverse = b.constant(ty, std::array::from_fn(|k| if k < lanes { inverse[k] } else { 0 }));
                return Some(b.add(Op::Binary(BinaryOp::Mul), [x, inverse], ty));
            }
            Some(by_component(b, x, y, ty))
        }
        Op::Compose => {
            let edge = |id: &NodeId| b.graph().constant_bits(*id).is_some_and(|bits| is_edge(bits[0]));
            divisor.args.iter().any(edge).then(|| by_component(b, x, y, ty))
        }
        Op::Splat => {
            let infinite = of_nothing(b, divisor.args[0])?;
            let infinite = b.add(Op::Splat, [infinite], ty);
            Some(b.add(Op::Binary(BinaryOp::Mul), [x, infinite], ty))
        }
        Op::Binary(BinaryOp::Sub) if divisor.args[0] == divisor.args[1] && lanes > 1 => {
            let parts = split_components(b, divisor.args[0], ty).into_iter().map(|part| {
                let nothing = b.add(Op::Binary(BinaryOp::Sub), [part, part], Type::F32);
                of_nothing(b, nothing)
            });
            let parts: Option<Vec<_>> = parts.collect();
            let infinite = b.add(Op::Compose, parts?, ty);
            Some(b.add(Op::Binary(BinaryOp::Mul), [x, infinite], ty))
        }
        _ => {
            let infinite = of_nothing(b, y)?;
            Some(b.add(Op::Binary(BinaryOp::Mul), [x, infinite], ty))
        }
    }
}

/// Returns whether a divisor is a zero, a subnormal number, an infinity or a NaN.
fn is_edge(bits: u32) -> bool {
    !f32::from_bits(bits).is_normal()
}

/// Divides a scalar by a constant that [`is_edge`].
fn by_constant(b: &mut Builder<'_>, x: NodeId, divisor: f32) -> NodeId {
    let times = |b: &mut Builder<'_>, x: NodeId, factor: f32| {
        let factor = b.f32(factor);
        b.add(Op::Binary(BinaryOp::Mul), [x, factor], Type::F32)
    };
    if divisor.is_nan() {
        b.f32(f32::NAN)
    } else if divisor == 0.0 {
        times(b, x, 1.0 / divisor)
    } else if divisor.is_infinite() {
        let zero = times(b, x, 1.0 / divisor);
        if_finite(b, x, zero)
    } else {
        // If the scaled value overflows, so does the quotient; a power of two never rounds.
        const SCALE: f32 = 16_777_216.0;
        let scaled = times(b, x, SCALE);
        let divisor = b.f32(divisor * SCALE);
        b.add(Op::Binary(BinaryOp::Div), [scaled, divisor], Type::F32)
    }
}

/// The reciprocal of `a - a`, if `y` has that form.
fn of_nothing(b: &mut Builder<'_>, y: NodeId) -> Option<NodeId> {
    let node = b.graph().node(y);
    let same = node.op == Op::Binary(BinaryOp::Sub) && node.args[0] == node.args[1] && node.ty == Type::F32;
    let a = same.then(|| node.args[0])?;
    let infinity = b.f32(f32::INFINITY);
    Some(if_finite(b, a, infinity))
}

/// `value` if `x` is finite, otherwise a NaN.
fn if_finite(b: &mut Builder<'_>, x: NodeId, value: NodeId) -> NodeId {
    let bits = b.add(Op::Bitcast, [x], Type::U32);
    let [mask, infinity] = [0x7fff_ffff, 0x7f80_0000].map(|word| b.constant(Type::U32, [word, 0, 0, 0]));
    let size = b.add(Op::Binary(BinaryOp::And), [bits, mask], Type::U32);
    let finite = b.add(Op::Binary(BinaryOp::Lt), [size, infinity], Type::BOOL);
    let nan = b.f32(f32::NAN);
    b.add(Op::Select, [finite, value, nan], Type::F32)
}

/// Divides vectors component by component.
fn by_component(b: &mut Builder<'_>, x: NodeId, y: NodeId, ty: Type) -> NodeId {
    let pairs = split_components(b, x, ty).into_iter().zip(split_components(b, y, ty));
    let pairs: Vec<_> = pairs.collect();
    let parts: Vec<_> = pairs
        .into_iter()
        .map(|(x, y)| b.add(Op::Binary(BinaryOp::Div), [x, y], Type::F32))
        .collect();
    b.add(Op::Compose, parts, ty)
}

fn split_components(b: &mut Builder<'_>, id: NodeId, ty: Type) -> Vec<NodeId> {
    let part = Type::scalar(Scalar::F32);
    (0..ty.component_count())
        .map(|k| b.add(Op::Extract(k), [id], part))
        .collect()
}

fn splat_constant(b: &mut Builder<'_>, value: f32, ty: Type) -> NodeId {
    let lanes = usize::from(ty.component_count());
    let bits = std::array::from_fn(|k| if k < lanes { value.to_bits() } else { 0 });
    b.constant(ty, bits)
}
