//! Deviations to which drivers have a right, with the reason. Each is a row of *On a GPU* in docs/semantics.md.

use crate::edges_of_functions::compare::{Mismatch, Verdict};
use crate::edges_of_functions::roads::INTERPRETER;

/// Values that a driver has a right to.
struct Right {
    reason: &'static str,
    /// Returns whether a value is one of them.
    covers: fn(&Mismatch) -> bool,
}

const RIGHTS: &[Right] = &[
    Right {
        reason: "subnormal numbers are zero, or lose digits in logarithms and powers",
        covers: |m| {
            let logarithm = has(m, &["ln()", "log2()", "powf(", "cbrt()"]);
            m.verdict == Verdict::Flushed || (logarithm && m.arguments.iter().any(|x| x.is_subnormal()))
        },
    },
    Right {
        reason: "`min`, `max` and `clamp` of a NaN give either operand",
        covers: |m| has(m, &[".min(", ".max(", ".clamp(", "_element()"]) && of_nan(m),
    },
    Right {
        reason: "an exponential of a NaN is infinite",
        covers: |m| m.verdict == Verdict::NumberForNan && has(m, &["exp()", "exp2()", "cosh()", "powf("]) && of_nan(m),
    },
    Right {
        reason: "a constant 0 times or divided by any number is 0, also where that is infinite, NaN or 0",
        covers: |m| {
            let by_zero = m.constants.contains(&0.0) && has(m, &["x * y", "x / y", "div_euclid(y)", "atan2(y)"]);
            let along_axis =
                has(m, &["reflect(Vec3::Y)", "refract(Vec2::Y"]) && m.arguments.iter().any(|x| overflows(*x));
            (by_zero && m.verdict == Verdict::NumberForNan) || along_axis
        },
    },
    Right {
        reason: "a zero that is added or subtracted leaves -0 as it is",
        covers: |m| {
            m.constants.contains(&0.0) && m.arguments.iter().all(|x| *x == 0.0) && has(m, &["smoothstep(x, y, 0.5)"])
        },
    },
    Right {
        reason: "a power is 2^(y log2 x), whose logarithm is off by 2^-21 near 1, which y multiplies",
        covers: |m| {
            let [x, y] = [0, 1].map(|k| m.arguments.get(k).copied().unwrap_or(0.0));
            m.verdict == Verdict::Off && has(m, &["powf(y)"]) && (x.abs() - 1.0).abs() < 0.5 && y.abs() > 1.0e4
        },
    },
    Right {
        reason: "sums are reassociated",
        covers: |m| has(m, &["dot(vec2(y, x))", "element_sum()"]),
    },
    Right {
        reason: "angles are exact to 2^-11 between -pi and pi, and mean nothing beyond 2^20",
        covers: |m| has(m, &["x.sin()", "x.cos()", "x.tan()"]) && m.arguments[0].abs() > 1_048_576.0,
    },
    Right {
        reason: "a tangent is a quotient of sine and cosine, and means nothing where the cosine is less than 2^-11",
        covers: |m| has(m, &["x.tan()"]) && m.arguments[0].cos().abs() < 4.9e-4,
    },
    Right {
        reason: "the interpreter's `min_element` and `max_element` leave a NaN out, and give either of two zeros",
        covers: |m| {
            let zeros = m.arguments.iter().all(|x| *x == 0.0);
            m.road == INTERPRETER && has(m, &["_element()"]) && (of_nan(m) || zeros)
        },
    },
];

/// Returns whether the function's text has one of these.
fn has(mismatch: &Mismatch, parts: &[&str]) -> bool {
    parts.iter().any(|part| mismatch.text.contains(part))
}

fn of_nan(mismatch: &Mismatch) -> bool {
    mismatch.arguments.iter().any(|x| x.is_nan())
}

/// Returns whether a number's square is not finite.
fn overflows(x: f32) -> bool {
    !(x * x).is_finite()
}

/// The reason why a value may differ, if there is one.
pub fn of(mismatch: &Mismatch) -> Option<&'static str> {
    let right = RIGHTS.iter().find(|right| (right.covers)(mismatch));
    right.map(|right| right.reason)
}

/// All reasons.
pub fn reasons() -> impl Iterator<Item = &'static str> {
    RIGHTS.iter().map(|right| right.reason)
}
