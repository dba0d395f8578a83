//! Decimal digits of constants, used by the printers and measured by `tidy`.

use super::ast::Ty;
use straightline_evaluator::ir::Scalar;

/// Returns the shortest decimal that reads back as the same float, both as an `f32` and as an `f64` that is then rounded.
///
/// Tint and glslang read literals as `f64`. Tint rejects a number that exceeds the largest `f32` by less than a rounding.
/// Such numbers, and those that would be rounded twice, get the digits of the equal `f64`.
pub fn decimal_digits(x: f32) -> String {
    // Whole numbers with few digits are printed in full.
    if x.fract() == 0.0 && x.abs() < 1e15 {
        return format!("{:.1}", f64::from(x));
    }
    let short = format!("{x:?}");
    let read = short.parse::<f64>().unwrap_or(f64::NAN);
    if read as f32 == x && read.abs() <= f64::from(f32::MAX) {
        short
    } else {
        format!("{:?}", f64::from(x))
    }
}

/// Returns the approximate width of a scalar constant, in any language.
pub fn number_columns(ty: Ty, bits: u32) -> usize {
    match ty.scalar_kind() {
        Some(Scalar::F32) => float_columns(f32::from_bits(bits)) + usize::from(ty.half),
        Some(Scalar::I32) => (bits as i32).to_string().len(),
        Some(Scalar::U32) => bits.to_string().len() + 1,
        _ => 5,
    }
}

fn float_columns(x: f32) -> usize {
    if x.fract() == 0.0 && x.abs() < 1e6 {
        let digits = (x.abs() as u32).checked_ilog10().unwrap_or(0) as usize + 1;
        return usize::from(x.is_sign_negative()) + digits + ".0".len();
    }
    decimal_digits(x).len()
}
