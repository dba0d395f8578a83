//! Comparison of a driver's results with those of rustc.

use crate::edges_of_functions::functions::{Accuracy, Function};
use straightline_tests::bare::SENTINEL;

/// Kind of a difference from rustc's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The texel holds what it held before.
    Unwritten,
    /// A NaN where there is a number.
    NanForNumber,
    /// A number where there is a NaN.
    NumberForNan,
    /// Infinite, or not, against rustc.
    Infinite,
    /// A zero of the other sign.
    SignOfZero,
    /// Another number than is near enough.
    Off,
    /// Equals the value with subnormal numbers as zero.
    Flushed,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Verdict::Unwritten => "unwritten",
            Verdict::NanForNumber => "NaN for a number",
            Verdict::NumberForNan => "a number for NaN",
            Verdict::Infinite => "finite or infinite",
            Verdict::SignOfZero => "sign of zero",
            Verdict::Off => "off",
            Verdict::Flushed => "flushed",
        })
    }
}

/// A value that is not what rustc computes.
#[derive(Clone, Debug)]
pub struct Mismatch {
    /// The function's text.
    pub text: &'static str,
    /// The function with its constants.
    pub function: String,
    /// The road that it was found on.
    pub road: String,
    /// Kind of the difference.
    pub verdict: Verdict,
    /// Arguments of the function.
    pub arguments: Vec<f32>,
    /// Arguments that are constants.
    pub constants: Vec<f32>,
    /// Value by rustc.
    pub expected: f32,
    /// Value of the driver.
    pub found: f32,
}

impl std::fmt::Display for Mismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{} of {:?}: rustc {:?}, found {:?}",
            self.function, self.arguments, self.expected, self.found
        )
    }
}

/// Compares the interpreter's value; any NaN is any other.
pub fn bit_by_bit(function: &Function, [x, y, z]: [f32; 3], found: f32) -> Option<Verdict> {
    let expected = (function.native)(x, y, z);
    let same = expected.to_bits() == found.to_bits() || (expected.is_nan() && found.is_nan());
    (!same).then(|| verdict(expected, found, Accuracy::Exact).unwrap_or(Verdict::Off))
}

/// Compares a driver's value, within the function's accuracy.
pub fn on_driver(function: &Function, arguments: [f32; 3], found: f32) -> Option<Verdict> {
    if found.to_bits() == SENTINEL {
        return Some(Verdict::Unwritten);
    }
    let [x, y, z] = arguments;
    let why = verdict((function.native)(x, y, z), found, function.accuracy)?;
    match flushed(function, arguments, found) {
        true => Some(Verdict::Flushed),
        false => Some(why),
    }
}

/// Most that a sum of a few numbers may be off where subnormal ones are zero.
const FLUSHED: f32 = 4.0 * f32::MIN_POSITIVE;

/// Returns whether a value is right if some subnormal arguments, intermediate values, or the result are zero.
fn flushed(function: &Function, arguments: [f32; 3], found: f32) -> bool {
    (0..8u32).any(|which| {
        let [x, y, z] = std::array::from_fn(|k| match which >> k & 1 {
            1 => flush(arguments[k]),
            _ => arguments[k],
        });
        let value = (function.native)(x, y, z);
        let near = |value: f32, found: f32| {
            verdict(value, found, function.accuracy).is_none_or(|why| why == Verdict::SignOfZero)
        };
        near(value, found) || near(flush(value), flush(found)) || (value - found).abs() <= FLUSHED
    })
}

fn flush(x: f32) -> f32 {
    match x.is_subnormal() {
        true => 0.0f32.copysign(x),
        false => x,
    }
}

fn verdict(expected: f32, found: f32, accuracy: Accuracy) -> Option<Verdict> {
    if expected.to_bits() == found.to_bits() || (expected.is_nan() && found.is_nan()) {
        return None;
    }
    match (expected.is_nan(), found.is_nan()) {
        (false, true) => return Some(Verdict::NanForNumber),
        (true, false) => return Some(Verdict::NumberForNan),
        _ => {}
    }
    if expected == 0.0 && found == 0.0 {
        return Some(Verdict::SignOfZero);
    }
    let size = f64::from(expected.abs().min(f32::MAX));
    let allowed = match accuracy {
        Accuracy::Exact => 0.0,
        Accuracy::Ulps(n) => f64::from(n) * ulp(expected),
        Accuracy::Near(relative, absolute) => relative * size + absolute,
    };
    if expected.is_infinite() || found.is_infinite() {
        // Beyond the largest number by no more than its accuracy.
        let near = |x: f32| f64::from(x.abs().min(f32::MAX)) + allowed >= f64::from(f32::MAX);
        let same_side = expected.is_sign_negative() == found.is_sign_negative();
        return (!(same_side && near(expected) && near(found))).then_some(Verdict::Infinite);
    }
    let off = (f64::from(found) - f64::from(expected)).abs();
    (off > allowed).then_some(Verdict::Off)
}

/// The distance of a number to the next.
fn ulp(x: f32) -> f64 {
    let x = x.abs().min(f32::MAX);
    f64::from(f32::from_bits(x.to_bits() + 1).min(f32::MAX))
        - f64::from(f32::from_bits(x.to_bits().max(1) - 1)) / 2.0
        - f64::from(x) / 2.0
}
