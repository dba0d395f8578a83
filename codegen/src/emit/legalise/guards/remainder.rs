//! The remainder of floats, which is exact in Rust: drivers compute `x - y * trunc(x / y)`, with the roundings of three
//! operations, of which the quotient's may be as large as `y`.

use super::Guard;
use super::body::{Body, binary, or, unary};
use crate::emit::ast::{Division, Domain, Expr, Op};
use crate::emit::legalise::choose;
use straightline_evaluator::ir::{BinaryOp, Scalar, UnaryOp};

/// Bits of a quotient that one step takes off. With the upper half of the divisor's bits it makes a product without rounding.
const STEP: u32 = 10;

/// The function for a remainder: without a loop where the quotient is known to be small.
pub fn guard(domain: Domain) -> Guard {
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
        value: Box::new(move |b, args| remainder(b, &args[0], &args[1], domain.bounded)),
    }
}

fn remainder(b: &mut Body<'_, '_>, x: &Expr, y: &Expr, bounded: bool) -> Expr {
    let size = b.declare("size", unary(UnaryOp::Abs, y));
    let rest = match bounded {
        true => less(b, unary(UnaryOp::Abs, x), size.clone()),
        false => by_steps(b, x, &size),
    };
    let signed = b.declare("signed", b.with_sign_of(rest, x));
    let smaller = binary(&unary(UnaryOp::Abs, x), BinaryOp::Lt, &size);
    let infinity = 0x7f80_0000;
    let nothing = binary(&b.size_bits(y), BinaryOp::Lt, &b.word(f32::MIN_POSITIVE.to_bits()));
    let infinite = binary(&b.size_bits(x), BinaryOp::Ge, &b.word(infinity));
    let undefined = or(or(infinite, b.is_nan(y)), nothing);
    let undefined = b.declare("is_undefined", undefined);
    let defined = choose(smaller, x.clone(), signed);
    choose(undefined, b.number(f32::NAN), defined)
}

/// Remainder of a number less than 2048 times as large as the divisor, computed without rounding.
fn less(b: &mut Body<'_, '_>, rest: Expr, divisor: Expr) -> Expr {
    let rest = b.declare("rest", rest);
    let quotient = b.declare(
        "quotient",
        unary(UnaryOp::Trunc, &binary(&rest, BinaryOp::Div, &divisor)),
    );
    let upper = b
        .bits(&divisor)
        .binary(BinaryOp::And, b.word(0xffff_f000))
        .bits_as(b.ty);
    let upper = b.declare("upper_bits", upper);
    let lower = binary(&divisor, BinaryOp::Sub, &upper);
    let left = rest
        .binary(BinaryOp::Sub, binary(&quotient, BinaryOp::Mul, &upper))
        .binary(BinaryOp::Sub, quotient.binary(BinaryOp::Mul, lower));
    let left = b.declare("left", left);
    // The quotient may have been rounded to the next integer, either way.
    let below = binary(&left, BinaryOp::Lt, &b.number(0.0));
    let left = choose(below, binary(&left, BinaryOp::Add, &divisor), left);
    let left = b.declare("left", left);
    let above = binary(&left, BinaryOp::Ge, &divisor);
    choose(above, binary(&left, BinaryOp::Sub, &divisor), left)
}

/// Remainder of a scalar: first by the divisor times 2^n, so that each quotient is small. The number of steps is a runtime value: drivers
/// unroll loops with a constant trip count.
fn by_steps(b: &mut Body<'_, '_>, x: &Expr, size: &Expr) -> Expr {
    let (whole, words) = (b.ty.of(Scalar::I32), b.ty.of(Scalar::U32));
    let integer = |n: u32| Expr::splat(whole, n);
    let mantissa = || Expr::splat(words, 23);
    let rest = b.variable("rest", unary(UnaryOp::Abs, x));
    let own = b.bits(size);
    let own = b.declare("size_bits", own);
    // Doublings after which the divisor is the largest one less than 2^STEP times as small as the rest.
    let doublings = |b: &Body<'_, '_>| {
        let exponent = |bits: Expr| bits.binary(BinaryOp::Shr, mantissa()).to(whole);
        let apart = exponent(b.bits(&b.read(rest))).binary(BinaryOp::Sub, exponent(own.clone()));
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
    let steps = b.declare("steps", steps);
    b.repeat(steps, |b| {
        let doubled = doublings(b).to(words);
        let divisor = binary(&own, BinaryOp::Add, &doubled.binary(BinaryOp::Shl, mantissa()));
        let divisor = b.declare("divisor", divisor.bits_as(b.ty));
        let left = less(b, b.read(rest), divisor);
        b.assign(rest, left);
    });
    b.read(rest)
}
