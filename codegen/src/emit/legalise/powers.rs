//! Divisions by powers of two of what is not negative: shifts and masks. naga guards every division of integers, and a compiler that does
//! not know the sign of what is divided corrects for it.

use super::take_args;
use crate::emit::ast::{Expr, Op};
use straightline_evaluator::ir::BinaryOp;

/// A quotient or remainder of numbers that are not negative by a constant whose components are powers of two, without a division.
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
    // Components beyond the type's are 0, and stay so.
    let by = divisor.map(|n| if n == 0 { 0 } else { bits(n) });
    x.binary(op, Expr::constant(ty, by))
}
