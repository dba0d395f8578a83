//! GLSL: what it has no operator for, what it leaves open, and what glslang would make branches of.

use super::{
    Rule, below_32, both, by_component, choose, componentwise, guarded, inside, is_leaf, is_non_finite, is_simple,
    take, to_integer, zeros,
};
use crate::emit::ast::{Expr, Module, Op, Ty};
use crate::emit::print::glsl_type;
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// The rule of GLSL for Vulkan.
pub fn vulkan(module: &mut Module<'_>, expr: Expr) -> Expr {
    rule(module, expr, true)
}

/// The rule of GLSL for OpenGL, where `mix` chooses between floats alone.
pub fn opengl(module: &mut Module<'_>, expr: Expr) -> Expr {
    rule(module, expr, false)
}

fn rule(module: &mut Module<'_>, mut expr: Expr, mixes: bool) -> Expr {
    let ty = expr.ty;
    match &expr.op {
        _ if is_non_finite(&expr) => by_component(&expr, |bits| {
            let word = Expr::new(Op::Hex(bits), Vec::new(), Type::U32);
            Expr::call("uintBitsToFloat", vec![word], Type::F32)
        }),
        Op::Division(op, known) => {
            let (op, known) = (*op, *known);
            let part = if mixes { ty } else { Ty::from(ty.element_of()) };
            let rule: Rule = if mixes { vulkan } else { opengl };
            if let Some(function) = guarded(module, op, known, part, rule) {
                expr.op = componentwise(module, function, ty);
            }
            expr
        }
        Op::Convert { fits: false } if expr.args[0].ty.is_float() && ty.is_integer() => {
            let part = if mixes { ty } else { Ty::from(ty.element_of()) };
            let rule: Rule = if mixes { vulkan } else { opengl };
            let name = format!("to_{}", glsl_type(part));
            let function = to_integer(module, &name, part, true, rule);
            expr.op = componentwise(module, function, ty);
            expr
        }
        Op::Index { inside: false } => inside(expr),
        // A depth texture gives four components here, not one.
        Op::Ir(ir::Op::Load { .. }) if ty.is_scalar() => {
            expr.ty = Type::value(Scalar::F32, 4).into();
            Expr::new(Op::Swizzle(vec![0]), vec![expr], ty)
        }
        Op::Ir(ir::Op::Unary(op)) => unary(*op, expr),
        Op::Ir(ir::Op::Binary(op)) => binary(*op, expr),
        // glslang makes branches of a choice between more than names and literals, and none of `mix`. Where `mix` is of floats
        // alone, a choice by one boolean stays one, of vectors too.
        Op::Ir(ir::Op::Select)
            if mixes && !(is_leaf(&expr.args[1]) && is_leaf(&expr.args[2])) && ty.kind() != Some(Scalar::Bool) =>
        {
            let [condition, yes, no] = take(expr.args);
            let condition = match ty.components() {
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

fn unary(op: UnaryOp, mut expr: Expr) -> Expr {
    let ty = expr.ty;
    match op {
        UnaryOp::Not if ty.components() > 1 => {
            expr.op = Op::Call("not");
            expr
        }
        UnaryOp::Saturate => {
            let [x] = take(expr.args);
            let [low, high] = [0.0_f32, 1.0].map(|x| Expr::splat(Type::F32, x.to_bits()));
            Expr::call("clamp", vec![x, low, high], ty)
        }
        UnaryOp::CountOneBits => Expr::call("bitCount", expr.args, ty.of(Scalar::I32)).to(ty),
        UnaryOp::LeadingZeros => zeros(expr, "findMSB", true),
        UnaryOp::TrailingZeros => zeros(expr, "findLSB", false),
        _ => expr,
    }
}

fn binary(op: BinaryOp, mut expr: Expr) -> Expr {
    use BinaryOp::{And, Eq, Ge, Gt, Le, Lt, Ne, Or, Rem, Shl, Shr, Xor};
    let ty = expr.ty;
    let vector = ty.components() > 1;
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
        And | Or if bools && (vector || !is_simple(&expr.args[1])) => both(op, expr),
        Shl | Shr => {
            let count = expr.args.pop().expect("two arguments");
            expr.args.push(below_32(count));
            expr
        }
        _ => expr,
    }
}
