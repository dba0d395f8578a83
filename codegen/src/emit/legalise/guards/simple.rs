//! Short guards, and expressions that need no guard.

use super::body::{binary, not, unary};
use super::{Guard, is_leaf, power};
use crate::emit::ast::{Domain, Expr, Op, Ty};
use crate::emit::legalise::component_select;
use straightline_evaluator::ir::{self, BinaryOp, UnaryOp};

/// Returns a shorter expression with the same edge cases, if there is one.
pub fn inline_guard(op: &ir::Op, domain: Domain, args: &[Expr], ty: Ty) -> Option<Expr> {
    let x = &args[0];
    if *op == ir::Op::Unary(UnaryOp::Fract) && is_short(x) {
        return Some(binary(x, BinaryOp::Sub, &unary(UnaryOp::Floor, x)));
    }
    if *op != ir::Op::Binary(BinaryOp::Pow) {
        return None;
    }
    let exponent = power::constant_exponent(args)?;
    if exponent == -1.0 {
        return Some(Expr::splat(ty, 1.0_f32.to_bits()).binary(BinaryOp::Div, x.clone()));
    }
    if exponent == 2.0 && is_name(x) {
        return Some(binary(x, BinaryOp::Mul, x));
    }
    match exponent {
        0.5 if domain.not_negative => Some(unary(UnaryOp::Sqrt, x)),
        -0.5 if domain.positive => Some(unary(UnaryOp::InverseSqrt, x)),
        // For -0 the result must be infinite as well.
        -0.5 if domain.not_negative => Some(unary(UnaryOp::InverseSqrt, &unary(UnaryOp::Abs, x))),
        _ => None,
    }
}

/// Returns whether an expression is a name, a number, or components of one.
fn is_name(expr: &Expr) -> bool {
    match expr.op {
        Op::Swizzle(_) => is_name(&expr.args[0]),
        _ => is_leaf(expr),
    }
}

/// Returns whether an expression is as short as its own name would be: at most two operators on names, which compilers
/// merge as a common subexpression.
fn is_short(expr: &Expr) -> bool {
    let mut operators = 0;
    expr.visit(&mut |expr| {
        operators += match expr.op {
            _ if is_name(expr) => 0,
            Op::Ir(ir::Op::Binary(BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div)) => 1,
            _ => 3,
        };
    });
    operators <= 2
}

/// Returns the guard of a logarithm. Some drivers return finite values at 0, for negative numbers or for a NaN.
pub fn logarithm_guard(op: UnaryOp) -> Guard {
    let name = match op {
        UnaryOp::Log2 => "binary_logarithm",
        _ => "natural_logarithm",
    };
    Guard {
        name: name.to_owned(),
        comment: "The logarithm, which of 0 is -infinity, and a NaN of negative numbers.",
        arguments: &["x"],
        scalar: false,
        value: Box::new(move |b, args| {
            let x = &args[0];
            let zero = binary(x, BinaryOp::Eq, &b.float_constant(0.0));
            let none = component_select(zero, b.float_constant(f32::NEG_INFINITY), b.float_constant(f32::NAN));
            let positive = binary(x, BinaryOp::Gt, &b.float_constant(0.0));
            component_select(positive, unary(op, x), none)
        }),
    }
}

/// Returns the guard of `x - floor(x)`, which is a NaN for an infinity.
pub fn fraction_guard() -> Guard {
    Guard {
        name: "fraction".to_owned(),
        comment: "What lies above the integer below x: a NaN of what is not finite.",
        arguments: &["x"],
        scalar: false,
        value: Box::new(|_, args| binary(&args[0], BinaryOp::Sub, &unary(UnaryOp::Floor, &args[0]))),
    }
}

/// Returns the guard of the arc tangent. One driver returns 0 for a NaN.
pub fn arc_tangent() -> Guard {
    Guard {
        name: "arc_tangent".to_owned(),
        comment: "atan(x), of a NaN too.",
        arguments: &["x"],
        scalar: false,
        value: Box::new(|b, args| {
            let x = &args[0];
            component_select(not(b.is_nan(x)), unary(UnaryOp::Atan, x), x.clone())
        }),
    }
}

/// Returns the guard of a point's angle, computed by an arc tangent between 0 and 1. Drivers leave `atan2` undefined at the
/// origin, for zeros on the negative side and for infinities.
pub fn angle_guard() -> Guard {
    Guard {
        name: "angle".to_owned(),
        comment: "atan2(y, x), at the origin, of -0 and of infinities too.",
        arguments: &["y", "x"],
        scalar: false,
        value: Box::new(|b, args| {
            let [y, x] = [&args[0], &args[1]];
            let height = b.emit_let("height", unary(UnaryOp::Abs, y));
            let width = b.emit_let("width", unary(UnaryOp::Abs, x));
            let steep = b.emit_let("is_steep", binary(&height, BinaryOp::Gt, &width));
            let shorter = b.emit_let(
                "shorter",
                component_select(steep.clone(), width.clone(), height.clone()),
            );
            let longer = b.emit_let("longer", component_select(steep.clone(), height, width));
            // Equal sides give 1, and the origin gives 0.
            let equal = binary(&shorter, BinaryOp::Eq, &longer);
            let slope = component_select(
                equal,
                unary(UnaryOp::Sign, &longer),
                binary(&shorter, BinaryOp::Div, &longer),
            );
            let slope = b.emit_let("slope", slope);
            let within = b.emit_let("within", unary(UnaryOp::Atan, &slope));
            let right = b
                .float_constant(std::f32::consts::FRAC_PI_2)
                .binary(BinaryOp::Sub, within.clone());
            let above = b.emit_let("above", component_select(steep, right, within));
            let behind = binary(&b.float_constant(std::f32::consts::PI), BinaryOp::Sub, &above);
            let above = b.emit_let("above", component_select(b.has_sign(x), behind, above));
            let signed = b.with_sign_of(above, y);
            component_select(b.is_nan(&slope), slope, signed)
        }),
    }
}

/// Compares floats by `!(a == b)`: a NaN is unequal to everything, but some drivers evaluate `!=` to false for it, and none
/// evaluates `==` to true.
pub fn rewrite_unequal(mut expr: Expr) -> Expr {
    let is_ne = expr.op == Op::Ir(ir::Op::Binary(BinaryOp::Ne));
    if !is_ne || !expr.args[0].ty.is_float() {
        return expr;
    }
    expr.op = Op::Ir(ir::Op::Binary(BinaryOp::Eq));
    not(expr)
}
