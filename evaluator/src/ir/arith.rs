//! Arithmetic of the operations: the single definition, used by constant folding and by the interpreter, in any precision.

use super::{AtomicOp, BinaryOp, Bits, Op, Real, Scalar, Type, UnaryOp, usize_bits, usize_value};

/// A scalar or up to four components of a vector, each the bits of an integer or of an `R`; unused components are 0.
pub type Cells = [u64; 4];

/// Converts host data to cells of an `R`.
pub fn host_cells<R: Real>(ty: Type, bits: &Bits) -> Cells {
    bits.map(|bits| match ty.scalar_kind() {
        Some(Scalar::F32) => R::from_f64(f64::from(f32::from_bits(bits))).to_bits(),
        _ => u64::from(bits),
    })
}

/// Converts the bits of a constant to cells of an `R`.
pub fn constant_cells<R: Real>(ty: Type, bits: &Bits) -> Cells {
    if ty == Type::USIZE {
        return [usize_value(bits), 0, 0, 0];
    }
    bits.map(|bits| match ty.scalar_kind() {
        Some(Scalar::F32) => R::made(f32::from_bits(bits).into()).to_bits(),
        _ => u64::from(bits),
    })
}

/// Maximum number of operands of a value operation: the components of a vector.
pub const MOST_OPERANDS: usize = 4;

/// Evaluates a value operation on constants in `f32`, in the graph's representation.
pub fn fold_op(op: &Op, operand: Type, args: &[Bits], ty: Type) -> Option<Bits> {
    let mut cells = [[0; 4]; MOST_OPERANDS];
    let cells = cells.get_mut(..args.len())?;
    for (cells, lanes) in cells.iter_mut().zip(args) {
        *cells = match operand {
            Type::USIZE => [usize_value(lanes), 0, 0, 0],
            _ => lanes.map(u64::from),
        };
    }
    let found = apply_op::<f32>(op, operand, cells, ty)?;
    Some(match ty {
        Type::USIZE => usize_bits(found[0]),
        _ => found.map(|cell| cell as u32),
    })
}

/// Evaluates a value operation on arguments of type `operand`. Returns `None` for operations that their arguments alone do
/// not determine: reads, and operations on arrays and regions.
pub fn apply_op<R: Real>(op: &Op, operand: Type, args: &[Cells], ty: Type) -> Option<Cells> {
    let lanes = ty.component_count() as usize;
    let real = |cell: u64| R::from_bits(cell);
    Some(match op {
        Op::Const(bits) => constant_cells::<R>(ty, bits),
        Op::Unary(op) => map_components(lanes, |k| apply_unary::<R>(*op, operand.scalar_kind()?, args[0][k]))?,
        Op::Binary(op) => map_components(lanes, |k| apply_component::<R>(*op, operand, args[0][k], args[1][k]))?,
        Op::Dot => {
            let product = |k: usize| real(args[0][k]) * real(args[1][k]);
            let sum = (1..operand.component_count() as usize).fold(product(0), |sum, k| sum + product(k));
            [sum.to_bits(), 0, 0, 0]
        }
        Op::Cross => {
            let at = |v: usize, k: usize| real(args[v][k % 3]);
            let lane = |k: usize| at(0, k + 1) * at(1, k + 2) - at(1, k + 1) * at(0, k + 2);
            map_components(3, |k| Some(lane(k).to_bits()))?
        }
        Op::Clamp if operand == Type::F32 => {
            let [x, low, high] = [0, 1, 2].map(|k| real(args[k][0]));
            let clamped = if x < low {
                low
            } else if x > high {
                high
            } else {
                x
            };
            [clamped.to_bits(), 0, 0, 0]
        }
        Op::Clamp => map_components(lanes, |k| {
            let above = apply_component::<R>(BinaryOp::Max, operand, args[0][k], args[1][k])?;
            apply_component::<R>(BinaryOp::Min, operand, above, args[2][k])
        })?,
        Op::Select => args[if args[0][0] != 0 { 1 } else { 2 }],
        Op::Splat => map_components(lanes, |_| Some(args[0][0]))?,
        Op::Compose => map_components(lanes, |k| Some(args[k][0]))?,
        Op::Extract(lane) => [args[0][*lane as usize], 0, 0, 0],
        Op::Convert => map_components(lanes, |k| {
            convert_cell::<R>(args[0][k], operand.scalar_kind()?, ty.scalar_kind()?)
        })?,
        Op::Bitcast => map_components(lanes, |k| {
            bitcast_cell::<R>(args[0][k], operand.scalar_kind()?, ty.scalar_kind()?)
        })?,
        Op::Half => map_components(lanes, |k| Some(real(args[0][k]).to_half().to_bits()))?,
        Op::Exact | Op::Tally(_) => args[0],
        _ => return None,
    })
}

fn map_components(lanes: usize, lane: impl Fn(usize) -> Option<u64>) -> Option<Cells> {
    let mut out = [0; 4];
    for (k, slot) in out.iter_mut().enumerate().take(lanes) {
        *slot = lane(k)?;
    }
    Some(out)
}

fn apply_unary<R: Real>(op: UnaryOp, kind: Scalar, cell: u64) -> Option<u64> {
    use UnaryOp::*;
    let bits = cell as u32;
    let word = match (kind, op) {
        (Scalar::F32, _) => return Some(R::from_bits(cell).unary(op)?.to_bits()),
        (Scalar::Usize, BitNot) => return Some(!cell),
        (Scalar::Usize, CountOneBits) => return Some(cell.count_ones().into()),
        (Scalar::Usize, LeadingZeros) => return Some(cell.leading_zeros().into()),
        (Scalar::Usize, TrailingZeros) => return Some(cell.trailing_zeros().into()),
        (Scalar::Bool, Not) => 1 - bits,
        (Scalar::I32 | Scalar::U32, BitNot) => !bits,
        (Scalar::I32 | Scalar::U32, CountOneBits) => bits.count_ones(),
        (Scalar::I32 | Scalar::U32, ReverseBits) => bits.reverse_bits(),
        (Scalar::I32 | Scalar::U32, LeadingZeros) => bits.leading_zeros(),
        (Scalar::I32 | Scalar::U32, TrailingZeros) => bits.trailing_zeros(),
        (Scalar::I32, Neg) => (bits as i32).wrapping_neg() as u32,
        (Scalar::I32, Abs) => (bits as i32).wrapping_abs() as u32,
        (Scalar::I32, Sign) => (bits as i32).signum() as u32,
        (Scalar::U32, Abs) => bits,
        _ => return None,
    };
    Some(word.into())
}

fn apply_binary<R: Real>(op: BinaryOp, kind: Scalar, a: u64, b: u64) -> Option<u64> {
    match kind {
        Scalar::Bool => binary_bool(op, a != 0, b != 0).map(u64::from),
        Scalar::F32 => binary_real(op, R::from_bits(a), R::from_bits(b)),
        Scalar::I32 => binary_i32(op, a as i32, b as i32).map(u64::from),
        Scalar::U32 => binary_u32(op, a as u32, b as u32).map(u64::from),
        Scalar::Usize => binary_usize(op, a, b),
    }
}

/// Evaluates one component of an operation on two operands of a type.
fn apply_component<R: Real>(op: BinaryOp, operand: Type, a: u64, b: u64) -> Option<u64> {
    let first = |holds: bool| Some(if holds { a } else { b });
    match op {
        BinaryOp::Min if operand.is_float() && !operand.is_scalar() => first(R::from_bits(a) < R::from_bits(b)),
        BinaryOp::Max if operand.is_float() && !operand.is_scalar() => first(R::from_bits(a) > R::from_bits(b)),
        _ => apply_binary::<R>(op, operand.scalar_kind()?, a, b),
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

fn binary_real<R: Real>(op: BinaryOp, a: R, b: R) -> Option<u64> {
    use BinaryOp::*;
    Some(match op {
        Eq => (a == b).into(),
        Ne => (a != b).into(),
        Lt => (a < b).into(),
        Le => (a <= b).into(),
        Gt => (a > b).into(),
        Ge => (a >= b).into(),
        _ => a.binary(op, b)?.to_bits(),
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

fn binary_usize(op: BinaryOp, a: u64, b: u64) -> Option<u64> {
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
        Shl => a.wrapping_shl(b as u32),
        Shr => a.wrapping_shr(b as u32),
        Eq => (a == b).into(),
        Ne => (a != b).into(),
        Lt => (a < b).into(),
        Le => (a <= b).into(),
        Gt => (a > b).into(),
        Ge => (a >= b).into(),
        Pow | Atan2 => return None,
    })
}

fn convert_cell<R: Real>(cell: u64, from: Scalar, to: Scalar) -> Option<u64> {
    use Scalar::*;
    let bits = cell as u32;
    let number = |x: f64| R::made(x).to_bits();
    Some(match (from, to) {
        (F32, I32) => u64::from(R::from_bits(cell).to_f64() as i32 as u32),
        (F32, U32) => u64::from(R::from_bits(cell).to_f64() as u32),
        (F32, Usize) => R::from_bits(cell).to_f64() as u64,
        (Usize, F32) => R::from_f64(cell as f32 as f64).to_bits(),
        (Usize, Bool) => (cell != 0).into(),
        (Usize, I32 | U32) => u64::from(bits),
        (I32, Usize) => i64::from(bits as i32) as u64,
        (U32 | Bool | Usize, Usize) => cell,
        (F32, Bool) => (R::from_bits(cell).to_f64() != 0.0).into(),
        (I32, F32) => number(f64::from(bits as i32)),
        (U32 | Bool, F32) => number(f64::from(bits)),
        (I32 | U32, Bool) => (bits != 0).into(),
        (F32, F32) | (I32 | U32 | Bool, I32 | U32) | (Bool, Bool) => cell,
    })
}

fn bitcast_cell<R: Real>(cell: u64, from: Scalar, to: Scalar) -> Option<u64> {
    use Scalar::*;
    // In other precisions too, the bits are those of the nearest `f32`.
    Some(match (from, to) {
        (F32, I32 | U32) => u64::from((R::from_bits(cell).to_f64() as f32).to_bits()),
        (I32 | U32, F32) => R::from_f64(f64::from(f32::from_bits(cell as u32))).to_bits(),
        (Usize, I32 | U32) => u64::from(cell as u32),
        (F32, F32) | (I32 | U32, I32 | U32) => cell,
        _ => return None,
    })
}
/// Returns the value that an atomic operation stores, from the old value and its operand.
pub fn apply_atomic(op: AtomicOp, ty: Type, before: u64, value: u64) -> u64 {
    let (a, b) = (before as u32, value as u32);
    let signed = ty.scalar_kind() == Some(Scalar::I32);
    let after = match op {
        AtomicOp::Add => a.wrapping_add(b),
        AtomicOp::Max if signed => (a as i32).max(b as i32) as u32,
        AtomicOp::Min if signed => (a as i32).min(b as i32) as u32,
        AtomicOp::Max => a.max(b),
        AtomicOp::Min => a.min(b),
        AtomicOp::And => a & b,
        AtomicOp::Or => a | b,
        AtomicOp::Xor => a ^ b,
        AtomicOp::Exchange => b,
        AtomicOp::Load => a,
    };
    u64::from(after)
}
