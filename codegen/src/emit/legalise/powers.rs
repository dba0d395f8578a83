//! Divisions of non-negative numbers by powers of two, as shifts and masks. naga guards every integer division, and a
//! compiler that does not know the dividend's sign adds a correction.

use super::take_args;
use crate::emit::ast::{Expr, Op};
use straightline_evaluator::ir::BinaryOp;

/// Returns a quotient or remainder without a division, if no component can be negative and the divisor's components are
/// constant powers of two.
pub fn divide_by_shift(expr: Expr) -> Expr {
    let Op::Division(op, known) = expr.op else { return expr };
    let ty = expr.ty;
    let divisor = expr.args.get(1).and_then(Expr::as_constant).copied();
    let lanes = ty.component_count() as usize;
    let Some(divisor) = divisor.filter(|bits| known.positive && bits[..lanes].iter().all(|n| n.is_power_of_two()))
    else {
        return expr;
    };
    let [x, _] = take_args(expr.args);
    let (op, bits): (_, fn(u32) -> u32) = match op {
        BinaryOp::Div => (BinaryOp::Shr, u32::trailing_zeros),
        _ => (BinaryOp::And, |n| n - 1),
    };
    // Components beyond the type's are 0, and stay 0.
    let by = divisor.map(|n| if n == 0 { 0 } else { bits(n) });
    x.binary(op, Expr::constant(ty, by))
}
