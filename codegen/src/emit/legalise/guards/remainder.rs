//! The remainder of floats, which is exact in Rust. Drivers compute `x - y * trunc(x / y)`, with the roundings of three
//! operations; the quotient's rounding may change the result by as much as `y`.

use super::Guard;
use super::body::{Body, binary, or, unary};
use crate::emit::ast::{Division, Domain, Expr, Op};
use crate::emit::legalise::component_select;
use straightline_evaluator::ir::{BinaryOp, Scalar, UnaryOp};

/// Bits of a quotient that one step removes. Times the upper half of the divisor's bits, the product is exact.
const STEP: u32 = 10;

/// Returns the guard of a remainder, without a loop if the quotient is known to be small.
pub fn remainder_guard(domain: Domain) -> Guard {
    let (name, comment): (_, &'static str) = match domain.bounded {
        true => (
            "short_remainder",
            "x % y without a rounding, where x / y is less than 2048.",
        ),
        false => ("remainder", "x % y without a rounding: most quotients take one step."),
    };
    Guard {
        name: name.to_owned(),
        comment,
        arguments: &["x", "y"],
        scalar: !domain.bounded,
        value: Box::new(move |b, args| build_remainder(b, &args[0], &args[1], domain.bounded)),
    }
}

fn build_remainder(b: &mut Body<'_, '_>, x: &Expr, y: &Expr, bounded: bool) -> Expr {
    let size = b.emit_let("size", unary(UnaryOp::Abs, y));
    let rest = match bounded {
        true => short_remainder(b, unary(UnaryOp::Abs, x), size.clone()),
        false => by_steps(b, x, &size),
    };
    let signed = b.emit_let("signed", b.with_sign_of(rest, x));
    let smaller = binary(&unary(UnaryOp::Abs, x), BinaryOp::Lt, &size);
    let infinity = 0x7f80_0000;
    let nothing = binary(
        &b.size_bits(y),
        BinaryOp::Lt,
        &b.bits_constant(f32::MIN_POSITIVE.to_bits()),
    );
    let infinite = binary(&b.size_bits(x), BinaryOp::Ge, &b.bits_constant(infinity));
    let undefined = or(or(infinite, b.is_nan(y)), nothing);
    let undefined = b.emit_let("is_undefined", undefined);
    let defined = component_select(smaller, x.clone(), signed);
    component_select(undefined, b.float_constant(f32::NAN), defined)
}

/// Computes the remainder of a number less than 2048 times as large as the divisor, without rounding.
fn short_remainder(b: &mut Body<'_, '_>, rest: Expr, divisor: Expr) -> Expr {
    let rest = b.emit_let("rest", rest);
    let quotient = b.emit_let(
        "quotient",
        unary(UnaryOp::Trunc, &binary(&rest, BinaryOp::Div, &divisor)),
    );
    let upper = b
        .to_bits(&divisor)
        .binary(BinaryOp::And, b.bits_constant(0xffff_f000))
        .bits_as(b.ty);
    let upper = b.emit_let("upper_bits", upper);
    let lower = binary(&divisor, BinaryOp::Sub, &upper);
    let left = rest
        .binary(BinaryOp::Sub, binary(&quotient, BinaryOp::Mul, &upper))
        .binary(BinaryOp::Sub, quotient.binary(BinaryOp::Mul, lower));
    let left = b.emit_let("left", left);
    // The quotient may have been rounded to the next integer, up or down.
    let below = binary(&left, BinaryOp::Lt, &b.float_constant(0.0));
    let left = component_select(below, binary(&left, BinaryOp::Add, &divisor), left);
    let left = b.emit_let("left", left);
    let above = binary(&left, BinaryOp::Ge, &divisor);
    component_select(above, binary(&left, BinaryOp::Sub, &divisor), left)
}

/// Computes the remainder of a scalar, first by the divisor times 2^n, so that each quotient is small. The number of steps
/// is a runtime value, because drivers unroll loops with a constant trip count.
fn by_steps(b: &mut Body<'_, '_>, x: &Expr, size: &Expr) -> Expr {
    let (whole, words) = (b.ty.with_kind(Scalar::I32), b.ty.with_kind(Scalar::U32));
    let integer = |n: u32| Expr::splat(whole, n);
    let mantissa = || Expr::splat(words, 23);
    let rest = b.emit_var("rest", unary(UnaryOp::Abs, x));
    let own = b.to_bits(size);
    let own = b.emit_let("size_bits", own);
    // Number of doublings that makes the divisor as large as possible, but less than 2^STEP times smaller than the rest.
    let doublings = |b: &Body<'_, '_>| {
        let exponent = |bits: Expr| bits.binary(BinaryOp::Shr, mantissa()).convert_to(whole);
        let apart = exponent(b.to_bits(&b.read_variable(rest))).binary(BinaryOp::Sub, exponent(own.clone()));
        apart
            .binary(BinaryOp::Sub, integer(STEP))
            .binary(BinaryOp::Max, integer(0))
    };
    let first = doublings(b);
    let steps = first.binary(BinaryOp::Add, integer(2 * STEP - 1));
    let sure = Division {
        defined: true,
        positive: true,
    };
    let steps = Expr::new(Op::Division(BinaryOp::Div, sure), vec![steps, integer(STEP)], whole);
    let steps = b.emit_let("steps", steps);
    b.emit_loop(steps, |b| {
        let doubled = doublings(b).convert_to(words);
        let divisor = binary(&own, BinaryOp::Add, &doubled.binary(BinaryOp::Shl, mantissa()));
        let divisor = b.emit_let("divisor", divisor.bits_as(b.ty));
        let left = short_remainder(b, b.read_variable(rest), divisor);
        b.emit_assign(rest, left);
    });
    b.read_variable(rest)
}
