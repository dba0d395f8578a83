//! Hyperbolic functions of large arguments. Drivers compute them with an `exp` that overflows before the result does.

use super::Guard;
use super::body::{binary, unary};
use crate::emit::legalise::component_select;
use straightline_evaluator::ir::{BinaryOp, UnaryOp};

/// Size from which one of the two exponentials is less than half a rounding of the other.
const LARGE: f32 = 10.0;

/// Returns the guard of a hyperbolic function.
pub fn hyperbolic_guard(op: UnaryOp) -> Guard {
    let (name, comment) = match op {
        UnaryOp::Sinh => (
            "hyperbolic_sine",
            "sinh(x), which is finite a little longer than exp(x).",
        ),
        UnaryOp::Cosh => (
            "hyperbolic_cosine",
            "cosh(x), which is finite a little longer than exp(x).",
        ),
        _ => ("hyperbolic_tangent", "tanh(x), where exp(x) is infinite too."),
    };
    Guard {
        name: name.to_owned(),
        comment,
        arguments: &["x"],
        scalar: false,
        value: Box::new(move |b, args| {
            let x = &args[0];
            let size = b.emit_let("size", unary(UnaryOp::Abs, x));
            let sign = unary(UnaryOp::Sign, x);
            // exp(size) / 2 is exp(size - ln 2).
            let half = unary(
                UnaryOp::Exp,
                &binary(&size, BinaryOp::Sub, &b.float_constant(std::f32::consts::LN_2)),
            );
            let far = match op {
                UnaryOp::Sinh => sign.binary(BinaryOp::Mul, half),
                UnaryOp::Cosh => half,
                _ => sign,
            };
            let large = binary(&size, BinaryOp::Gt, &b.float_constant(LARGE));
            component_select(large, far, unary(op, x))
        }),
    }
}
