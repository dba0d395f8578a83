//! GLSL: missing operators, unspecified behaviour, and expressions that glslang would compile to branches.

use super::{
    Rule, below_32, by_component, clamp_index, component_select, componentwise_function, eager_bool_op,
    guarded_division, is_leaf, is_non_finite, is_simple, take_args, to_integer, zero_count,
};
use crate::emit::ast::{Expr, Module, Op, Ty};
use crate::emit::print::glsl_type;
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// Rewrite rule of GLSL for Vulkan.
pub fn vulkan_rule(module: &mut Module<'_>, expr: Expr) -> Expr {
    glsl_rule(module, expr, true)
}

/// Rewrite rule of GLSL for OpenGL, where `mix` only selects between floats.
pub fn opengl_rule(module: &mut Module<'_>, expr: Expr) -> Expr {
    glsl_rule(module, expr, false)
}

fn glsl_rule(module: &mut Module<'_>, mut expr: Expr, mixes: bool) -> Expr {
    let ty = expr.ty;
    match &expr.op {
        _ if is_non_finite(&expr) => by_component(&expr, |bits| {
            let word = Expr::new(Op::Hex(bits), Vec::new(), Type::U32);
            Expr::call("uintBitsToFloat", vec![word], Type::F32)
        }),
        Op::Division(op, known) => {
            let (op, known) = (*op, *known);
            let part = if mixes { ty } else { Ty::from(ty.element_of()) };
            let rule: Rule = if mixes { vulkan_rule } else { opengl_rule };
            if let Some(function) = guarded_division(module, op, known, part, rule) {
                expr.op = componentwise_function(module, function, ty);
            }
            expr
        }
        Op::Convert { fits: false } if expr.args[0].ty.is_float() && ty.is_integer() => {
            let part = if mixes { ty } else { Ty::from(ty.element_of()) };
            let rule: Rule = if mixes { vulkan_rule } else { opengl_rule };
            let name = format!("to_{}", glsl_type(part));
            let function = to_integer(module, &name, part, true, rule);
            expr.op = componentwise_function(module, function, ty);
            expr
        }
        Op::Index { inside: false } => clamp_index(expr),
        // In GLSL, reading a depth texture returns four components, not one.
        Op::Ir(ir::Op::Load { .. }) if ty.is_scalar() => {
            expr.ty = Type::value(Scalar::F32, 4).into();
            Expr::new(Op::Swizzle(vec![0]), vec![expr], ty)
        }
        Op::Ir(ir::Op::Unary(op)) => rewrite_unary(*op, expr),
        Op::Ir(ir::Op::Binary(op)) => rewrite_binary(*op, expr),
        // glslang compiles a `?:` to a branch unless its operands are names or literals, but not `mix`. If `mix` only takes
        // floats, a selection by one boolean stays `?:`, for vectors too.
        Op::Ir(ir::Op::Select)
            if mixes
                && !(is_leaf(&expr.args[1]) && is_leaf(&expr.args[2]))
                && ty.scalar_kind() != Some(Scalar::Bool) =>
        {
            let [condition, yes, no] = take_args(expr.args);
            let condition = match ty.component_count() {
                1 => condition,
                _ => Expr::new(Op::Construct, vec![condition], ty.with_kind(Scalar::Bool)),
            };
            component_select(condition, yes, no)
        }
        Op::Ir(ir::Op::Bitcast) => {
            let function = match (expr.args[0].ty.scalar_kind(), ty.scalar_kind()) {
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

fn rewrite_unary(op: UnaryOp, mut expr: Expr) -> Expr {
    let ty = expr.ty;
    match op {
        UnaryOp::Not if ty.component_count() > 1 => {
            expr.op = Op::Call("not");
            expr
        }
        UnaryOp::Saturate => {
            let [x] = take_args(expr.args);
            let [low, high] = [0.0_f32, 1.0].map(|x| Expr::splat(Type::F32, x.to_bits()));
            Expr::call("clamp", vec![x, low, high], ty)
        }
        UnaryOp::CountOneBits => Expr::call("bitCount", expr.args, ty.with_kind(Scalar::I32)).convert_to(ty),
        UnaryOp::LeadingZeros => zero_count(expr, "findMSB", true),
        UnaryOp::TrailingZeros => zero_count(expr, "findLSB", false),
        _ => expr,
    }
}

fn rewrite_binary(op: BinaryOp, mut expr: Expr) -> Expr {
    use BinaryOp::{And, Eq, Ge, Gt, Le, Lt, Ne, Or, Rem, Shl, Shr, Xor};
    let ty = expr.ty;
    let vector = ty.component_count() > 1;
    let bools = ty.scalar_kind() == Some(Scalar::Bool);
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
        // GLSL's own `%` only takes integers, and its `mod` rounds down.
        Rem if ty.is_float() => {
            let [x, y] = take_args(expr.args);
            let quotient = x.clone().binary(BinaryOp::Div, y.clone());
            let whole = Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Trunc)), vec![quotient], ty);
            x.binary(BinaryOp::Sub, y.binary(BinaryOp::Mul, whole))
        }
        // GLSL has no `&` of booleans. glslang compiles `&&` and `||` to branches unless the right side is a name or a
        // comparison of two.
        And | Or if bools && (vector || !is_simple(&expr.args[1])) => eager_bool_op(op, expr),
        Shl | Shr => {
            let count = expr.args.pop().expect("two arguments");
            expr.args.push(below_32(count));
            expr
        }
        _ => expr,
    }
}
