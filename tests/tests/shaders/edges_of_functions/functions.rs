//! The functions, each as text and as rustc compiles it.
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a negated comparison is one of the functions"
)]

use straightline_kernels::prelude::*;

/// A function of up to three floats.
pub struct Function {
    /// The text of its body.
    pub text: &'static str,
    /// The number of arguments that it has, of `x`, `y` and `z`.
    pub arity: usize,
    /// The function as rustc compiles it.
    pub native: fn(f32, f32, f32) -> f32,
    /// Largest error of a driver.
    pub accuracy: Accuracy,
    /// `true` if it is also tried with one constant argument.
    pub constants: bool,
}

/// Largest error of a driver for a finite value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Accuracy {
    /// Not at all.
    Exact,
    /// Units in the last place.
    Ulps(u32),
    /// A part of the value's size, and this much besides.
    Near(f64, f64),
}

use Accuracy::{Exact, Near, Ulps};

macro_rules! functions {
    (|$x:ident, $y:ident, $z:ident| $($arity:literal $accuracy:expr, $constants:literal: $body:expr;)*) => {
        &[$(Function {
            text: stringify!($body),
            arity: $arity,
            native: |$x: f32, $y: f32, $z: f32| {
                let _ = ($x, $y, $z);
                $body
            },
            accuracy: $accuracy,
            constants: $constants,
        }),*]
    };
}

/// Accuracy of `sin` and `cos`: 2^-11 between -pi and pi.
const ANGLE: Accuracy = Near(0.0, 4.9e-4);

/// Accuracy of `smoothstep`: 2^-20.
const CUBIC: Accuracy = Near(0.0, 9.6e-7);

/// All of them, with the accuracies that docs/semantics.md states.
#[allow(clippy::nonminimal_bool, clippy::eq_op, clippy::redundant_closure)]
pub const FUNCTIONS: &[Function] = functions! { |x, y, z|
    1 Exact, true: x;
    1 Exact, false: -x;
    1 Exact, false: x.abs();
    1 Exact, false: sign(x);
    1 Exact, false: x.floor();
    1 Exact, false: x.ceil();
    1 Exact, false: round(x);
    1 Exact, false: x.trunc();
    1 Exact, false: fract(x);
    1 Exact, false: vec2(x, 1.0).fract_gl().x;
    1 Exact, false: saturate(x);
    1 Exact, false: x.clamp(-2.5, 3.0);
    1 Ulps(3), false: x.sqrt();
    1 Ulps(2), false: inverse_sqrt(x);
    1 Ulps(3), false: x.recip();
    1 Ulps(16), false: x.cbrt();
    1 Near(3.0e-5, 0.0), false: x.exp();
    1 Near(3.0e-5, 0.0), false: x.exp2();
    1 Near(4.0e-7, 5.0e-7), false: x.ln();
    1 Near(4.0e-7, 5.0e-7), false: x.log2();
    1 ANGLE, false: x.sin();
    1 ANGLE, false: x.cos();
    1 Near(2.0e-3, 1.0e-3), false: x.tan();
    1 ANGLE, false: x.asin();
    1 ANGLE, false: x.acos();
    1 Near(5.0e-4, 0.0), false: x.atan();
    1 Near(3.0e-5, 5.0e-7), false: x.sinh();
    1 Near(3.0e-5, 0.0), false: x.cosh();
    1 Near(3.0e-5, 5.0e-7), false: x.tanh();
    1 Ulps(2), false: x.to_degrees();
    1 Ulps(2), false: x.to_radians();
    1 Exact, false: x.powi(0);
    1 Exact, false: x.powi(1);
    1 Exact, false: x.powi(2);
    1 Ulps(2), false: x.powi(3);
    1 Ulps(4), false: x.powi(7);
    1 Ulps(4), false: x.powi(-1);
    1 Ulps(8), false: x.powi(-2);
    1 Ulps(8), false: x.powi(-3);
    1 Exact, false: x.is_nan() as u32 as f32;
    1 Exact, false: x.is_finite() as u32 as f32;
    1 Exact, false: x.is_infinite() as u32 as f32;
    1 Exact, false: x.is_sign_negative() as u32 as f32;
    1 Exact, false: x as i32 as f32;
    1 Exact, false: x as u32 as f32;
    1 Exact, false: (x as i32 >> 16) as f32;
    1 Exact, false: f32::from_bits(x.to_bits() ^ 0x0040_0000);
    1 CUBIC, false: smoothstep(0.0, 1.0, x);
    1 Near(3.0e-7, 0.0), false: x.powf(3.0);
    1 Near(3.0e-7, 0.0), false: x.powf(-2.0);
    1 Near(1.0e-4, 0.0), false: x.powf(2.2);
    1 Ulps(8), false: x.powf(0.5);
    1 Ulps(3), false: 1.0 / x;
    // A known range makes guards unnecessary.
    1 Exact, false: saturate(x.clamp(-2.0, 2.0));
    1 Near(5.0e-4, 1.0e-5), false: x.clamp(-9.0, 9.0).tanh();
    1 Near(5.0e-4, 1.0e-6), false: x.clamp(-88.0, 50.0).sinh();
    1 Near(4.0e-7, 5.0e-7), false: (x.abs() + 1.0e-3).ln();
    1 Near(4.0e-7, 5.0e-7), false: x.max(0.0).log2();
    1 Ulps(8), false: saturate(x).powf(0.5);
    1 Near(1.0e-4, 0.0), false: saturate(x).powf(2.2);
    1 Near(1.0e-4, 0.0), false: x.abs().powf(0.125);
    2 Exact, true: x + y;
    2 Exact, true: x - y;
    2 Exact, true: x * y;
    2 Ulps(3), true: x / y;
    2 Exact, true: x % y;
    2 Near(1.0e-5, 0.0), true: x.rem_euclid(y);
    2 Ulps(8), true: x.div_euclid(y);
    2 Exact, true: x.min(y);
    2 Exact, true: x.max(y);
    2 Near(1.0e-4, 0.0), true: x.powf(y);
    2 Near(5.0e-4, 0.0), true: x.atan2(y);
    2 Near(5.0e-4, 0.0), false: (x.abs() + 0.5).atan2(y);
    2 Near(5.0e-4, 0.0), false: saturate(x).atan2(y.clamp(-1.0, 1.0));
    2 Near(1.0e-4, 0.0), false: saturate(x).powf(y);
    2 Near(1.0e-4, 0.0), false: (x.abs() + 1.0e-3).powf(y.clamp(-4.0, 4.0));
    2 Near(1.0e-5, 0.0), false: x.clamp(-100.0, 100.0) % (saturate(y) + 1.0);
    2 Exact, true: x.copysign(y);
    2 Exact, true: (x < y) as u32 as f32;
    2 Exact, true: (x <= y) as u32 as f32;
    2 Exact, true: (x > y) as u32 as f32;
    2 Exact, true: (x >= y) as u32 as f32;
    2 Exact, true: (x == y) as u32 as f32;
    2 Exact, true: (x != y) as u32 as f32;
    2 Exact, false: !(x < y) as u32 as f32;
    2 Exact, false: if x < y { x } else { y };
    2 Exact, true: step(x, y);
    2 Ulps(4), true: vec2(x, 1.0).midpoint(vec2(y, 2.0)).x;
    2 Ulps(8), true: mix(x, y, 0.25);
    2 CUBIC, true: smoothstep(x, x, y);
    2 CUBIC, true: smoothstep(x, y, 0.5);
    2 Ulps(8), false: vec2(x, y).length();
    2 Ulps(8), false: vec2(x, y).length_squared();
    2 Ulps(8), false: vec3(x, y, 1.0).length();
    2 Ulps(8), false: vec2(x, y).normalize().x;
    2 Ulps(8), false: vec2(x, y).normalize_or_zero().y;
    2 Ulps(8), false: vec3(x, y, 0.0).normalize_or(Vec3::Z).z;
    2 Ulps(8), false: vec2(x, y).dot(vec2(y, x));
    2 Ulps(8), false: vec2(x, 1.0).distance(vec2(0.0, y));
    2 Exact, false: vec2(x, y).min_element();
    2 Exact, false: vec2(x, y).max_element();
    2 Ulps(8), false: vec2(x, y).clamp_length_max(2.0).x;
    2 Near(5.0e-4, 1.0e-6), false: vec2(x, y).to_angle();
    3 Ulps(8), false: mix(x, y, z);
    3 Ulps(8), false: x * y + z;
    3 CUBIC, false: smoothstep(x, y, z);
    3 Exact, false: if x < y { z } else { x };
    3 Exact, false: if x == y { z } else { x };
    3 Ulps(8), false: vec3(x, y, z).dot(vec3(y, z, x));
    3 Ulps(8), false: vec3(x, y, z).length();
    3 Ulps(8), false: vec3(x, y, z).normalize().z;
    3 Ulps(8), false: vec3(x, y, z).normalize_or_zero().y;
    3 Ulps(8), false: vec3(x, y, 1.0).cross(vec3(y, z, x)).z;
    3 Near(1.0e-5, 1.0e-5), false: vec3(x, y, z).reflect(Vec3::Y).x;
    3 Near(1.0e-4, 1.0e-5), false: vec2(x, y).refract(Vec2::Y, z).x;
    3 Exact, false: vec3(x, y, z).min(vec3(y, z, x)).x;
    3 Exact, false: vec4(x, y, z, 1.0).element_sum();
    3 Ulps(8), false: vec3(x, y, z).element_product();
};
