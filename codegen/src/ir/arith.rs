//! What operations do to bits: the one place, used to fold constants and to interpret.

use super::{BinaryOp, Lanes, Op, Scalar, Type, UnaryOp};

/// The result of a value operation (not a texture read, nor anything of arrays and regions) on arguments of
/// type `operand`; `None` for operations that are not decided by their arguments' bits alone.
pub fn apply(op: &Op, operand: Type, args: &[Lanes], ty: Type) -> Option<Lanes> {
    let lanes = ty.lanes() as usize;
    Some(match op {
        Op::Const(bits) => *bits,
        Op::Unary(op) => each(lanes, |k| unary(*op, operand.kind()?, args[0][k]))?,
        Op::Binary(op) => each(lanes, |k| binary(*op, operand.kind()?, args[0][k], args[1][k]))?,
        Op::Dot => {
            let product = |k: usize| float(args[0][k]) * float(args[1][k]);
            let sum = (1..operand.lanes() as usize).fold(product(0), |sum, k| sum + product(k));
            [sum.to_bits(), 0, 0, 0]
        }
        Op::Cross => {
            let at = |v: usize, k: usize| float(args[v][k % 3]);
            let lane = |k: usize| at(0, k + 1) * at(1, k + 2) - at(1, k + 1) * at(0, k + 2);
            each(3, |k| Some(lane(k).to_bits()))?
        }
        Op::Clamp => each(lanes, |k| {
            let below = binary(BinaryOp::Min, operand.kind()?, args[0][k], args[2][k])?;
            binary(BinaryOp::Max, operand.kind()?, below, args[1][k])
        })?,
        Op::Select => args[if args[0][0] != 0 { 1 } else { 2 }],
        Op::Splat => each(lanes, |_| Some(args[0][0]))?,
        Op::Compose => each(lanes, |k| Some(args[k][0]))?,
        Op::Extract(lane) => [args[0][*lane as usize], 0, 0, 0],
        Op::Convert => each(lanes, |k| convert(args[0][k], operand.kind()?, ty.kind()?))?,
        Op::Tally(_) => args[0],
        _ => return None,
    })
}

fn each(lanes: usize, lane: impl Fn(usize) -> Option<u32>) -> Option<Lanes> {
    let mut out = [0; 4];
    for (k, slot) in out.iter_mut().enumerate().take(lanes) {
        *slot = lane(k)?;
    }
    Some(out)
}

fn float(bits: u32) -> f32 {
    f32::from_bits(bits)
}

fn unary(op: UnaryOp, kind: Scalar, bits: u32) -> Option<u32> {
    use UnaryOp::*;
    Some(match (kind, op) {
        (Scalar::Bool, Not) => 1 - bits,
        (Scalar::I32 | Scalar::U32, BitNot) => !bits,
        (Scalar::I32, Neg) => (bits as i32).wrapping_neg() as u32,
        (Scalar::I32, Abs) => (bits as i32).wrapping_abs() as u32,
        (Scalar::I32, Sign) => (bits as i32).signum() as u32,
        (Scalar::U32, Abs) => bits,
        (Scalar::F32, _) => unary_float(op, float(bits))?.to_bits(),
        _ => return None,
    })
}

fn unary_float(op: UnaryOp, x: f32) -> Option<f32> {
    use UnaryOp::*;
    Some(match op {
        Neg => -x,
        Abs => x.abs(),
        Sign if x > 0.0 => 1.0,
        Sign if x < 0.0 => -1.0,
        Sign => x * 0.0,
        Floor => x.floor(),
        Ceil => x.ceil(),
        Round => x.round_ties_even(),
        Trunc => x.trunc(),
        Fract => x - x.floor(),
        Sqrt => x.sqrt(),
        InverseSqrt => 1.0 / x.sqrt(),
        Exp => x.exp(),
        Exp2 => x.exp2(),
        Log => x.ln(),
        Log2 => x.log2(),
        Sin => x.sin(),
        Cos => x.cos(),
        Tan => x.tan(),
        Asin => x.asin(),
        Acos => x.acos(),
        Atan => x.atan(),
        Not | BitNot => return None,
    })
}

fn binary(op: BinaryOp, kind: Scalar, a: u32, b: u32) -> Option<u32> {
    match kind {
        Scalar::Bool => binary_bool(op, a != 0, b != 0).map(u32::from),
        Scalar::F32 => binary_float(op, float(a), float(b)),
        Scalar::I32 => binary_i32(op, a as i32, b as i32),
        Scalar::U32 => binary_u32(op, a, b),
    }
}

fn binary_bool(op: BinaryOp, a: bool, b: bool) -> Option<bool> {
    use BinaryOp::*;
    Some(match op {
        And => a & b,
        Or => a | b,
        Xor | Ne => a != b,
        Eq => a == b,
        _ => return None,
    })
}

fn binary_float(op: BinaryOp, a: f32, b: f32) -> Option<u32> {
    use BinaryOp::*;
    Some(match op {
        Add => (a + b).to_bits(),
        Sub => (a - b).to_bits(),
        Mul => (a * b).to_bits(),
        Div => (a / b).to_bits(),
        Rem => (a % b).to_bits(),
        Min => a.min(b).to_bits(),
        Max => a.max(b).to_bits(),
        Pow => a.powf(b).to_bits(),
        Atan2 => a.atan2(b).to_bits(),
        Eq => (a == b).into(),
        Ne => (a != b).into(),
        Lt => (a < b).into(),
        Le => (a <= b).into(),
        Gt => (a > b).into(),
        Ge => (a >= b).into(),
        And | Or | Xor | Shl | Shr => return None,
    })
}

fn binary_i32(op: BinaryOp, a: i32, b: i32) -> Option<u32> {
    use BinaryOp::*;
    Some(match op {
        Add => a.wrapping_add(b) as u32,
        Sub => a.wrapping_sub(b) as u32,
        Mul => a.wrapping_mul(b) as u32,
        Div if b == 0 => a as u32,
        Div => a.wrapping_div(b) as u32,
        Rem if b == 0 => 0,
        Rem => a.wrapping_rem(b) as u32,
        Min => a.min(b) as u32,
        Max => a.max(b) as u32,
        Shr => a.wrapping_shr(b as u32) as u32,
        Lt => (a < b).into(),
        Le => (a <= b).into(),
        Gt => (a > b).into(),
        Ge => (a >= b).into(),
        other => return binary_u32(other, a as u32, b as u32),
    })
}

fn binary_u32(op: BinaryOp, a: u32, b: u32) -> Option<u32> {
    use BinaryOp::*;
    Some(match op {
        Add => a.wrapping_add(b),
        Sub => a.wrapping_sub(b),
        Mul => a.wrapping_mul(b),
        Div => a.checked_div(b).unwrap_or(a),
        Rem => a.checked_rem(b).unwrap_or(0),
        Min => a.min(b),
        Max => a.max(b),
        And => a & b,
        Or => a | b,
        Xor => a ^ b,
        Shl => a.wrapping_shl(b),
        Shr => a.wrapping_shr(b),
        Eq => (a == b).into(),
        Ne => (a != b).into(),
        Lt => (a < b).into(),
        Le => (a <= b).into(),
        Gt => (a > b).into(),
        Ge => (a >= b).into(),
        Pow | Atan2 => return None,
    })
}

fn convert(bits: u32, from: Scalar, to: Scalar) -> Option<u32> {
    use Scalar::*;
    Some(match (from, to) {
        (F32, I32) => float(bits) as i32 as u32,
        (F32, U32) => float(bits) as u32,
        (F32, Bool) => (float(bits) != 0.0).into(),
        (I32, F32) => (bits as i32 as f32).to_bits(),
        (U32, F32) => (bits as f32).to_bits(),
        (Bool, F32) => (bits as f32).to_bits(),
        (I32 | U32, Bool) => (bits != 0).into(),
        (F32, F32) | (I32 | U32 | Bool, I32 | U32) | (Bool, Bool) => bits,
    })
}
