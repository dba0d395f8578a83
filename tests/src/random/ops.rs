//! What operators and methods do to values.

use super::ast::{Binary, Method, Ty, Unary};
use super::real::Real;
use super::value::Value;

/// `-x`, `!x`.
pub fn unary<R: Real>(op: Unary, x: &Value<R>) -> Option<Value<R>> {
    Some(match (op, x) {
        (Unary::Neg, Value::F32(x)) => Value::F32(x.negated()),
        (Unary::Neg, Value::I32(n)) => Value::I32(n.wrapping_neg()),
        (Unary::Neg, Value::Vec(lanes, n)) => Value::Vec(lanes.map(R::negated), *n),
        (Unary::Neg, Value::IVec(lanes, n)) => Value::IVec(lanes.map(i32::wrapping_neg), *n),
        (Unary::Not, Value::Bool(b)) => Value::Bool(!b),
        (Unary::Not, Value::I32(n)) => Value::I32(!n),
        (Unary::Not, Value::U32(n)) => Value::U32(!n),
        _ => return None,
    })
}

/// An operator between two values, one of which may be a scalar where the other is a vector.
pub fn binary<R: Real>(op: Binary, a: &Value<R>, b: &Value<R>) -> Option<Value<R>> {
    use Binary::*;
    let lanes = a.lanes().max(b.lanes());
    if lanes > 1 {
        let side = |v: &Value<R>, k| if v.lanes() == 1 { Some(v.clone()) } else { v.lane(k) };
        let each: Option<Vec<_>> = (0..lanes as usize)
            .map(|k| binary(op, &side(a, k)?, &side(b, k)?))
            .collect();
        let each = each?;
        let truth = |v: &Value<R>| matches!(v, Value::Bool(true));
        return match op {
            Eq => Some(Value::Bool(each.iter().all(truth))),
            Ne => Some(Value::Bool(each.iter().any(truth))),
            _ => Value::gather(&each),
        };
    }
    Some(match (a, b) {
        (Value::Bool(a), Value::Bool(b)) => Value::Bool(match op {
            And | LazyAnd => a & b,
            Or | LazyOr => a | b,
            Xor | Ne => a ^ b,
            Eq => a == b,
            _ => return None,
        }),
        (Value::F32(a), Value::F32(b)) => match op {
            Add | Sub | Mul | Div | Rem => Value::F32(R::binary(op, *a, *b)),
            Eq | Ne | Lt | Le | Gt | Ge => Value::Bool(R::compares(op, *a, *b)),
            _ => return None,
        },
        (Value::I32(a), Value::I32(b)) => signed(op, *a, *b)?,
        (Value::U32(a), Value::U32(b)) => unsigned(op, *a, *b)?,
        (Value::I32(a), Value::U32(b)) if matches!(op, Shl | Shr) => signed(op, *a, *b as i32)?,
        (Value::U32(a), Value::I32(b)) if matches!(op, Shl | Shr) => unsigned(op, *a, *b as u32)?,
        _ => return None,
    })
}

fn signed<R>(op: Binary, a: i32, b: i32) -> Option<Value<R>> {
    use Binary::*;
    Some(match op {
        Add => Value::I32(a.wrapping_add(b)),
        Sub => Value::I32(a.wrapping_sub(b)),
        Mul => Value::I32(a.wrapping_mul(b)),
        Div if b == 0 => Value::I32(a),
        Rem if b == 0 => Value::I32(0),
        Div => Value::I32(a.wrapping_div(b)),
        Rem => Value::I32(a.wrapping_rem(b)),
        And => Value::I32(a & b),
        Or => Value::I32(a | b),
        Xor => Value::I32(a ^ b),
        Shl => Value::I32(a.wrapping_shl(b as u32)),
        Shr => Value::I32(a.wrapping_shr(b as u32)),
        _ => Value::Bool(compares(op, &a, &b)?),
    })
}

fn unsigned<R>(op: Binary, a: u32, b: u32) -> Option<Value<R>> {
    use Binary::*;
    Some(match op {
        Add => Value::U32(a.wrapping_add(b)),
        Sub => Value::U32(a.wrapping_sub(b)),
        Mul => Value::U32(a.wrapping_mul(b)),
        Div if b == 0 => Value::U32(a),
        Rem if b == 0 => Value::U32(0),
        Div => Value::U32(a / b),
        Rem => Value::U32(a % b),
        And => Value::U32(a & b),
        Or => Value::U32(a | b),
        Xor => Value::U32(a ^ b),
        Shl => Value::U32(a.wrapping_shl(b)),
        Shr => Value::U32(a.wrapping_shr(b)),
        _ => Value::Bool(compares(op, &a, &b)?),
    })
}

fn compares<T: Ord>(op: Binary, a: &T, b: &T) -> Option<bool> {
    Some(match op {
        Binary::Eq => a == b,
        Binary::Ne => a != b,
        Binary::Lt => a < b,
        Binary::Le => a <= b,
        Binary::Gt => a > b,
        Binary::Ge => a >= b,
        _ => return None,
    })
}

/// `x as type`.
pub fn cast<R: Real>(x: &Value<R>, to: &Ty) -> Option<Value<R>> {
    Some(match (x, to) {
        (Value::F32(x), Ty::I32) => Value::I32(x.to_i32()),
        (Value::F32(x), Ty::U32) => Value::U32(x.to_u32()),
        (Value::F32(x), Ty::F32) => Value::F32(*x),
        (Value::I32(n), Ty::I32) => Value::I32(*n),
        (Value::I32(n), Ty::U32) => Value::U32(*n as u32),
        (Value::I32(n), Ty::F32) => Value::F32(R::of_int(i64::from(*n))),
        (Value::U32(n), Ty::I32) => Value::I32(*n as i32),
        (Value::U32(n), Ty::U32) => Value::U32(*n),
        (Value::U32(n), Ty::F32) => Value::F32(R::of_int(i64::from(*n))),
        (Value::Bool(b), Ty::I32) => Value::I32(i32::from(*b)),
        (Value::Bool(b), Ty::U32) => Value::U32(u32::from(*b)),
        _ => return None,
    })
}

/// A method of a number, vector or array.
pub fn method<R: Real>(method: Method, args: &[Value<R>], ty: &Ty) -> Option<Value<R>> {
    use Method::*;
    let x = &args[0];
    match method {
        Len => match x {
            Value::Many(parts) => Some(Value::I32(parts.len() as i32)),
            _ => None,
        },
        Dot => sum_of_products(x, &args[1]),
        LengthSquared => sum_of_products(x, x),
        Length => self::method(Sqrt, &[sum_of_products(x, x)?], ty),
        DistanceSquared => {
            let between = binary(Binary::Sub, x, &args[1])?;
            sum_of_products(&between, &between)
        }
        Lerp => {
            let rest = binary(Binary::Sub, &Value::F32(R::of(1.0)), &args[2])?;
            let from = binary(Binary::Mul, x, &rest)?;
            let to = binary(Binary::Mul, &args[1], &args[2])?;
            binary(Binary::Add, &from, &to)
        }
        Cross => {
            let lane = |v: usize, k: usize| args[v].lane(k % 3);
            let product = |a: usize, b: usize| binary(Binary::Mul, &lane(0, a)?, &lane(1, b)?);
            let each: Option<Vec<_>> = (0..3)
                .map(|k| binary(Binary::Sub, &product(k + 1, k + 2)?, &product(k + 2, k + 1)?))
                .collect();
            Value::gather(&each?)
        }
        Extend => {
            let mut lanes = all_lanes(x)?;
            lanes.push(args[1].clone());
            Value::gather(&lanes)
        }
        Truncate => {
            let lanes = all_lanes(x)?;
            Value::gather(&lanes[..lanes.len() - 1])
        }
        MinElement | MaxElement | ElementSum => {
            let lanes = all_lanes(x)?;
            let mut result = lanes[0].clone();
            for lane in &lanes[1..] {
                result = match method {
                    MinElement => self::method(Min, &[result, lane.clone()], ty)?,
                    MaxElement => self::method(Max, &[result, lane.clone()], ty)?,
                    _ => binary(Binary::Add, &result, lane)?,
                };
            }
            Some(result)
        }
        As => {
            let part = if matches!(ty, Ty::Vec(_)) { Ty::F32 } else { Ty::I32 };
            let lanes: Option<Vec<_>> = all_lanes(x)?.iter().map(|lane| cast(lane, &part)).collect();
            Value::gather(&lanes?)
        }
        Powi => {
            let Value::I32(power) = args[1] else { return None };
            (1..power).try_fold(x.clone(), |product, _| binary(Binary::Mul, &product, x))
        }
        _ if x.lanes() > 1 => {
            let lanes: Option<Vec<_>> = (0..x.lanes() as usize)
                .map(|k| {
                    let each: Option<Vec<_>> = args.iter().map(|arg| arg.lane(k)).collect();
                    match method {
                        Min | Max => component(method, &each?),
                        Clamp => {
                            let each = each?;
                            let above = component(Max, &each[..2])?;
                            component(Min, &[above, each[2].clone()])
                        }
                        _ => self::method(method, &each?, ty),
                    }
                })
                .collect();
            Value::gather(&lanes?)
        }
        // Rust's own keeps a NaN; glam's, of vectors, does not.
        _ if method == Method::Clamp && matches!(&args[0], Value::F32(x) if x.value().is_nan()) => {
            Some(args[0].clone())
        }
        _ => scalar(method, args),
    }
}

/// The smaller or larger of two components, as glam chooses: the second where neither is.
fn component<R: Real>(method: Method, args: &[Value<R>]) -> Option<Value<R>> {
    match args {
        [Value::F32(a), Value::F32(b)] => {
            let op = if method == Method::Max { Binary::Gt } else { Binary::Lt };
            Some(Value::F32(if R::compares(op, *a, *b) { *a } else { *b }))
        }
        _ => scalar(method, args),
    }
}

fn scalar<R: Real>(method: Method, args: &[Value<R>]) -> Option<Value<R>> {
    use Method::*;
    Some(match (method, args) {
        (Min | Max, [Value::F32(a), Value::F32(b)]) => Value::F32(R::extreme(method == Max, *a, *b)),
        (Min, [Value::I32(a), Value::I32(b)]) => Value::I32(*a.min(b)),
        (Max, [Value::I32(a), Value::I32(b)]) => Value::I32(*a.max(b)),
        (Min, [Value::U32(a), Value::U32(b)]) => Value::U32(*a.min(b)),
        (Max, [Value::U32(a), Value::U32(b)]) => Value::U32(*a.max(b)),
        (Clamp, [x, low, high]) => {
            let above = scalar(Max, &[x.clone(), low.clone()])?;
            scalar(Min, &[above, high.clone()])?
        }
        (Abs, [Value::I32(n)]) => Value::I32(n.wrapping_abs()),
        (Abs | Floor | Ceil | Trunc | RoundTiesEven | Sqrt | Exp2 | Recip, [Value::F32(x)]) => {
            Value::F32(R::unary(method, *x))
        }
        _ => return None,
    })
}

fn all_lanes<R: Real>(x: &Value<R>) -> Option<Vec<Value<R>>> {
    (0..x.lanes() as usize).map(|k| x.lane(k)).collect()
}

fn sum_of_products<R: Real>(x: &Value<R>, y: &Value<R>) -> Option<Value<R>> {
    let products = all_lanes(&binary(Binary::Mul, x, y)?)?;
    let first = products[0].clone();
    products[1..]
        .iter()
        .try_fold(first, |sum, product| binary(Binary::Add, &sum, product))
}
