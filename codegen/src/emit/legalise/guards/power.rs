//! Powers. Drivers compute `exp2(y * log2(x))`: a NaN or `|x|^y` for negative `x`, and arbitrary results at 0 and at a NaN.

use super::Guard;
use super::body::{Body, and, binary, not, or, unary};
use crate::emit::ast::{Domain, Expr};
use crate::emit::legalise::component_select;
use straightline_evaluator::ir::{BinaryOp, UnaryOp};

/// The largest integer exponent that becomes a product.
pub const MOST: f32 = 64.0;

/// Returns the exponent if it is the same constant in all components.
pub fn constant_exponent(args: &[Expr]) -> Option<f32> {
    let bits = args[1].as_constant()?;
    let lanes = usize::from(args[1].ty.component_count());
    let first = bits[0];
    bits[..lanes]
        .iter()
        .all(|lane| *lane == first)
        .then(|| f32::from_bits(first))
}

/// Returns the exponent as an integer, if the power becomes a product.
pub fn product_of(exponent: f32) -> Option<i32> {
    let integral = exponent.fract() == 0.0 && (1.0..=MOST).contains(&exponent.abs());
    integral.then_some(exponent as i32)
}

/// Returns the guard of a power.
pub fn power_guard(domain: Domain, args: &[Expr]) -> Guard {
    if let Some(n) = constant_exponent(args).and_then(product_of) {
        return product_guard(n);
    }
    match domain.positive {
        true => Guard {
            name: "positive_power".to_owned(),
            comment: "x to the power y, of what is greater than 0: drivers have no infinite power of 1, and none of infinity that is 0.",
            arguments: &["x", "y"],
            scalar: false,
            value: Box::new(|b, args| {
                let x_is_one = binary(&args[0], BinaryOp::Eq, &b.float_constant(1.0));
                let y_is_zero = binary(&args[1], BinaryOp::Eq, &b.float_constant(0.0));
                let power = binary(&args[0], BinaryOp::Pow, &args[1]);
                component_select(or(x_is_one, y_is_zero), b.float_constant(1.0), power)
            }),
        },
        false => Guard {
            name: "power".to_owned(),
            comment: "x to the power y, of 0 and of negative numbers too, which drivers leave open.",
            arguments: &["x", "y"],
            scalar: false,
            value: Box::new(build_power),
        },
    }
}

fn build_power(b: &mut Body<'_, '_>, args: &[Expr]) -> Expr {
    let [x, y] = [&args[0], &args[1]];
    let size = b.emit_let("size", unary(UnaryOp::Abs, x));
    let whole = binary(&unary(UnaryOp::Trunc, y), BinaryOp::Eq, y);
    let whole = b.emit_let("is_whole", whole);
    let half = b.emit_let("half_of_y", binary(y, BinaryOp::Mul, &b.float_constant(0.5)));
    let even = binary(&unary(UnaryOp::Trunc, &half), BinaryOp::Eq, &half);
    let odd = b.emit_let("is_odd", and(whole.clone(), not(even)));
    let below = binary(y, BinaryOp::Lt, &b.float_constant(0.0));
    let of_zero = component_select(below, b.float_constant(f32::INFINITY), b.float_constant(0.0));
    let is_zero = binary(&size, BinaryOp::Eq, &b.float_constant(0.0));
    let raised = component_select(is_zero, of_zero, binary(&size, BinaryOp::Pow, y));
    let raised = b.emit_let("raised", raised);
    let negative = and(odd, b.has_sign(x));
    let signed = b.emit_let(
        "signed",
        component_select(negative, unary(UnaryOp::Neg, &raised), raised),
    );
    let of_one = and(
        binary(&size, BinaryOp::Eq, &b.float_constant(1.0)),
        binary(&b.size_bits(y), BinaryOp::Eq, &b.bits_constant(0x7f80_0000)),
    );
    let x_is_one = binary(x, BinaryOp::Eq, &b.float_constant(1.0));
    let y_is_zero = binary(y, BinaryOp::Eq, &b.float_constant(0.0));
    let is_one = b.emit_let("is_one", or(or(y_is_zero, x_is_one), of_one));
    let root = and(binary(x, BinaryOp::Lt, &b.float_constant(0.0)), not(whole));
    let root = and(
        root,
        binary(&b.size_bits(x), BinaryOp::Lt, &b.bits_constant(0x7f80_0000)),
    );
    let undefined = b.emit_let("is_undefined", or(or(b.is_nan(x), b.is_nan(y)), root));
    let defined = component_select(undefined, b.float_constant(f32::NAN), signed);
    component_select(is_one, b.float_constant(1.0), defined)
}

/// Computes a power by repeated squaring, lowest bit first; for a negative exponent, the reciprocal.
fn product_guard(n: i32) -> Guard {
    let name = match n {
        2 => "square".to_owned(),
        3 => "cube".to_owned(),
        _ if n > 0 => format!("power_{n}"),
        _ => format!("power_minus_{}", n.unsigned_abs()),
    };
    Guard {
        name,
        comment: "A power as a product, of negative numbers too.",
        arguments: &["x"],
        scalar: false,
        value: Box::new(move |b, args| {
            let (mut square, mut squared, mut left) = (args[0].clone(), 1, n.unsigned_abs());
            let mut power: Option<Expr> = None;
            loop {
                if left % 2 == 1 {
                    power = Some(match power {
                        None => square.clone(),
                        Some(power) => power.binary(BinaryOp::Mul, square.clone()),
                    });
                }
                left /= 2;
                if left == 0 {
                    break;
                }
                squared *= 2;
                square = b.emit_let(&format!("x_{squared}"), binary(&square, BinaryOp::Mul, &square));
            }
            let power = power.unwrap_or(square);
            match n < 0 {
                true => b.float_constant(1.0).binary(BinaryOp::Div, power),
                false => power,
            }
        }),
    }
}

/// Returns the guard of the cube root, computed by a power. No shader language has a cube root, or powers of negative
/// numbers.
pub fn cube_root() -> Guard {
    Guard {
        name: "cube_root".to_owned(),
        comment: "The real root, of negative numbers too.",
        arguments: &["x"],
        scalar: false,
        value: Box::new(|b, args| {
            let size = unary(UnaryOp::Abs, &args[0]);
            let third = b.float_constant(1.0 / 3.0);
            let power = b.emit_let("power", binary(&size, BinaryOp::Pow, &third));
            let root = b.with_sign_of(power, &args[0]);
            // Zeros and NaN are their own roots.
            let other = binary(&size, BinaryOp::Gt, &b.float_constant(0.0));
            component_select(other, root, args[0].clone())
        }),
    }
}
