//! GLSL: what it has no operator for, what it leaves open, and what glslang would make branches of.

use super::{Rule, below_32, by_component, choose, guarded, is_leaf, is_non_finite, to_integer};
use crate::emit::ast::{Expr, Module, Op};
use crate::emit::print::glsl_type;
use crate::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// Rewrites an expression, whose arguments have been rewritten.
pub fn rule(module: &mut Module<'_>, mut expr: Expr) -> Expr {
    let ty = expr.ty;
    match &expr.op {
        _ if is_non_finite(&expr) => by_component(&expr, |bits| {
            let word = Expr::new(Op::Hex(bits), Vec::new(), Type::U32);
            Expr::call("uintBitsToFloat", vec![word], Type::F32)
        }),
        Op::Division(op, known) => {
            let (op, known) = (*op, *known);
            if let Some(function) = guarded(module, op, known, ty, rule as Rule) {
                expr.op = function;
            }
            expr
        }
        Op::Convert { fits: false } if expr.args[0].ty.is_float() && ty.is_integer() => {
            let name = format!("to_{}", glsl_type(ty));
            expr.op = to_integer(module, &name, ty, true, rule as Rule);
            expr
        }
        // GLSL leaves an index outside of an array open.
        Op::Index { inside: false } => {
            let Type::Array { len, .. } = expr.args[0].ty.shape else {
                return expr;
            };
            let index = expr.args.pop().expect("an index").to(Type::U32);
            let last = Expr::splat(Type::U32, len - 1);
            expr.args.push(Expr::call("min", vec![index, last], Type::U32));
            expr
        }
        // A depth texture gives four components here, not one.
        Op::Ir(ir::Op::Load { .. }) if ty.is_scalar() => {
            expr.ty = Type::value(Scalar::F32, 4).into();
            Expr::new(Op::Swizzle(vec![0]), vec![expr], ty)
        }
        Op::Ir(ir::Op::Unary(op)) => unary(*op, expr),
        Op::Ir(ir::Op::Binary(op)) => binary(*op, expr),
        // glslang makes branches of a choice between more than names and literals, and none of `mix`.
        Op::Ir(ir::Op::Select)
            if !(is_leaf(&expr.args[1]) && is_leaf(&expr.args[2])) && ty.kind() != Some(Scalar::Bool) =>
        {
            let [condition, yes, no] = take(expr.args);
            let condition = match ty.lanes() {
                1 => condition,
                _ => Expr::new(Op::Construct, vec![condition], ty.of(Scalar::Bool)),
            };
            choose(condition, yes, no)
        }
        Op::Ir(ir::Op::Bitcast) => {
            let function = match (expr.args[0].ty.kind(), ty.kind()) {
                (Some(Scalar::F32), Some(Scalar::I32)) => "floatBitsToInt",
                (Some(Scalar::F32), _) => "floatBitsToUint",
                (Some(Scalar::I32), Some(Scalar::F32)) => "intBitsToFloat",
                (Some(Scalar::U32), Some(Scalar::F32)) => "uintBitsToFloat",
                _ => {
                    expr.op = Op::Convert { fits: true };
                    return expr;
                }
            };
            expr.op = Op::Call(function);
            expr
        }
        _ => expr,
    }
}

fn take<const N: usize>(args: Vec<Expr>) -> [Expr; N] {
    args.try_into().expect("as many arguments as the operation has")
}

fn unary(op: UnaryOp, mut expr: Expr) -> Expr {
    let ty = expr.ty;
    match op {
        UnaryOp::Not if ty.lanes() > 1 => {
            expr.op = Op::Call("not");
            expr
        }
        UnaryOp::Saturate => {
            let [x] = take(expr.args);
            let [low, high] = [0.0_f32, 1.0].map(|x| Expr::splat(Type::F32, x.to_bits()));
            Expr::call("clamp", vec![x, low, high], ty)
        }
        UnaryOp::CountOneBits => Expr::call("bitCount", expr.args, ty.of(Scalar::I32)).to(ty),
        // Numbered from the lowest bit, and -1 for none.
        UnaryOp::LeadingZeros | UnaryOp::TrailingZeros => {
            let [x] = take(expr.args);
            let bits = match ty.kind() {
                Some(Scalar::I32) => x.to(Type::U32),
                _ => x,
            };
            let number = |n: u32| Expr::splat(Type::I32, n);
            let find = |name| Expr::call(name, vec![bits.clone()], Type::I32);
            let zeros = match op {
                UnaryOp::LeadingZeros => number(31).binary(BinaryOp::Sub, find("findMSB")),
                _ => find("findLSB"),
            };
            let none = bits.clone().binary(BinaryOp::Eq, Expr::splat(Type::U32, 0));
            choose(none, number(32), zeros).to(ty)
        }
        _ => expr,
    }
}

fn binary(op: BinaryOp, mut expr: Expr) -> Expr {
    use BinaryOp::{And, Eq, Ge, Gt, Le, Lt, Ne, Or, Rem, Shl, Shr, Xor};
    let ty = expr.ty;
    let vector = ty.lanes() > 1;
    let bools = ty.kind() == Some(Scalar::Bool);
    if vector {
        let function = match op {
            Eq => Some("equal"),
            Ne => Some("notEqual"),
            Xor if bools => Some("notEqual"),
            Lt => Some("lessThan"),
            Le => Some("lessThanEqual"),
            Gt => Some("greaterThan"),
            Ge => Some("greaterThanEqual"),
            _ => None,
        };
        if let Some(function) = function {
            expr.op = Op::Call(function);
            return expr;
        }
    }
    match op {
        // GLSL's own `%` takes integers only, and its `mod` floors.
        Rem if ty.is_float() => {
            let [x, y] = take(expr.args);
            let quotient = x.clone().binary(BinaryOp::Div, y.clone());
            let whole = Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Trunc)), vec![quotient], ty);
            x.binary(BinaryOp::Sub, y.binary(BinaryOp::Mul, whole))
        }
        // GLSL has no `&` of booleans, and glslang makes branches of `&&` and `||` where the right side is not a name or a
        // comparison of two.
        And | Or if bools && vector => {
            let words = ty.of(Scalar::U32);
            let [x, y] = take(expr.args).map(|side: Expr| side.to(words));
            x.binary(op, y).to(ty)
        }
        And | Or if bools && !is_simple(&expr.args[1]) => {
            let both = Expr::new(Op::Construct, expr.args, Type::value(Scalar::Bool, 2));
            Expr::new(if op == And { Op::All } else { Op::Any }, vec![both], Type::BOOL)
        }
        Shl | Shr => {
            let count = expr.args.pop().expect("two arguments");
            expr.args.push(below_32(count));
            expr
        }
        _ => expr,
    }
}

/// A leaf, or a comparison of two.
fn is_simple(expr: &Expr) -> bool {
    match expr.op {
        Op::Ir(ir::Op::Binary(op)) => op.is_comparison() && expr.args.iter().all(is_leaf),
        _ => is_leaf(expr),
    }
}
