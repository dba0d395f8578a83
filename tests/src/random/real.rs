//! The number types that a tree is evaluated in.

use super::ast::{Binary, Method};
use std::cell::Cell;
use std::fmt::Debug;

/// What stands for `f32`.
pub trait Real: Copy + Debug {
    /// From a literal or texel.
    fn of(x: f32) -> Self;
    /// From an integer.
    fn of_int(n: i64) -> Self;
    /// A binary operator that gives a number.
    fn binary(op: Binary, a: Self, b: Self) -> Self;
    /// `min` (false) or `max` (true).
    fn extreme(max: bool, a: Self, b: Self) -> Self;
    /// A method without arguments.
    fn unary(method: Method, x: Self) -> Self;
    /// `-x`.
    fn negated(self) -> Self;
    /// A comparison.
    fn compares(op: Binary, a: Self, b: Self) -> bool;
    /// `as i32`.
    fn to_i32(self) -> i32;
    /// `as u32`.
    fn to_u32(self) -> u32;
    /// As `f32`.
    fn value(self) -> f32;
}

impl Real for f32 {
    fn of(x: f32) -> f32 {
        x
    }

    fn of_int(n: i64) -> f32 {
        n as f32
    }

    fn binary(op: Binary, a: f32, b: f32) -> f32 {
        match op {
            Binary::Add => a + b,
            Binary::Sub => a - b,
            Binary::Mul => a * b,
            Binary::Div => a / b,
            _ => a % b,
        }
    }

    fn extreme(max: bool, a: f32, b: f32) -> f32 {
        if max { a.max(b) } else { a.min(b) }
    }

    fn unary(method: Method, x: f32) -> f32 {
        match method {
            Method::Abs => x.abs(),
            Method::Floor => x.floor(),
            Method::Ceil => x.ceil(),
            Method::Trunc => x.trunc(),
            Method::RoundTiesEven => x.round_ties_even(),
            Method::Sqrt => x.sqrt(),
            Method::Exp2 => x.exp2(),
            _ => 1.0 / x,
        }
    }

    fn negated(self) -> f32 {
        -self
    }

    fn compares(op: Binary, a: f32, b: f32) -> bool {
        match op {
            Binary::Eq => a == b,
            Binary::Ne => a != b,
            Binary::Lt => a < b,
            Binary::Le => a <= b,
            Binary::Gt => a > b,
            _ => a >= b,
        }
    }

    fn to_i32(self) -> i32 {
        self as i32
    }

    fn to_u32(self) -> u32 {
        self as u32
    }

    fn value(self) -> f32 {
        self
    }
}

/// A double whose every rounded result is a little off, as that of a GPU may be, and which notes decisions that such
/// an error could turn. Where two runs of it agree with `f32`, a GPU must agree as well.
#[derive(Clone, Copy, Debug)]
pub struct Noisy {
    value: f64,
    /// Whether nothing was rounded on the way, so that a GPU has the same number.
    exact: bool,
}

/// Relative size of the error: that of two roundings of `f32`.
const NOISE: f64 = 1.0 / (1 << 22) as f64;

/// Relative distance to a threshold below which a decision is not sure.
const MARGIN: f64 = 1.0e-4;

/// Beyond this a number may overflow where others do not.
const HUGE: f64 = 1.0e15;

thread_local! {
    static SEED: Cell<u64> = const { Cell::new(0) };
    static UNSURE: Cell<bool> = const { Cell::new(false) };
}

impl Noisy {
    /// Starts a run with errors of its own.
    pub fn begin(seed: u64) {
        SEED.set(seed);
        UNSURE.set(false);
    }

    /// Whether a decision of the run was not sure.
    pub fn unsure() -> bool {
        UNSURE.get()
    }

    /// A result, of exact operands or not.
    fn off(value: f64, exact: bool) -> Noisy {
        if !value.is_finite() || value.abs() > HUGE {
            UNSURE.set(true);
        }
        if exact && f64::from(value as f32) == value {
            return Noisy { value, exact: true };
        }
        let mut random = super::Random(SEED.get());
        let noise = (random.bits() >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        SEED.set(random.0);
        Noisy {
            value: value * (1.0 + noise * NOISE),
            exact: false,
        }
    }

    /// Notes a comparison of two numbers that may come out otherwise.
    fn close(a: f64, b: f64) {
        if (a - b).abs() <= MARGIN * a.abs().max(b.abs()).max(1.0) {
            UNSURE.set(true);
        }
    }

    /// Notes a step function that steps near this: at the integers, or `at` between them.
    fn step(self, at: f64) {
        if !self.exact {
            Noisy::close(self.value, (self.value - at).round_ties_even() + at);
        }
    }
}

impl Real for Noisy {
    fn of(x: f32) -> Noisy {
        Noisy {
            value: f64::from(x),
            exact: true,
        }
    }

    fn of_int(n: i64) -> Noisy {
        Noisy::off(n as f64, true)
    }

    fn binary(op: Binary, a: Noisy, b: Noisy) -> Noisy {
        let exact = a.exact && b.exact;
        let (a, b) = (a.value, b.value);
        let value = match op {
            Binary::Add => a + b,
            Binary::Sub => a - b,
            Binary::Mul => a * b,
            Binary::Div => a / b,
            _ => {
                Noisy::off(a / b, false).step(0.0);
                a % b
            }
        };
        Noisy::off(value, exact)
    }

    fn extreme(max: bool, a: Noisy, b: Noisy) -> Noisy {
        let first = if max { a.value >= b.value } else { a.value <= b.value };
        if first { a } else { b }
    }

    fn unary(method: Method, x: Noisy) -> Noisy {
        match method {
            Method::Floor | Method::Ceil | Method::Trunc => x.step(0.0),
            Method::RoundTiesEven => x.step(0.5),
            _ => {}
        }
        let (x, exact) = (x.value, x.exact);
        match method {
            Method::Abs => Noisy { value: x.abs(), exact },
            Method::Floor => Noisy::off(x.floor(), true),
            Method::Ceil => Noisy::off(x.ceil(), true),
            Method::Trunc => Noisy::off(x.trunc(), true),
            Method::RoundTiesEven => Noisy::off(x.round_ties_even(), true),
            Method::Sqrt => Noisy::off(x.sqrt(), exact),
            Method::Exp2 => Noisy::off(x.exp2(), false),
            _ => Noisy::off(1.0 / x, exact),
        }
    }

    fn negated(self) -> Noisy {
        Noisy {
            value: -self.value,
            exact: self.exact,
        }
    }

    fn compares(op: Binary, a: Noisy, b: Noisy) -> bool {
        if !(a.exact && b.exact) {
            Noisy::close(a.value, b.value);
        }
        let (a, b) = (a.value, b.value);
        match op {
            Binary::Eq => a == b,
            Binary::Ne => a != b,
            Binary::Lt => a < b,
            Binary::Le => a <= b,
            Binary::Gt => a > b,
            _ => a >= b,
        }
    }

    fn to_i32(self) -> i32 {
        self.step(0.0);
        self.value as i32
    }

    fn to_u32(self) -> u32 {
        self.step(0.0);
        self.value as u32
    }

    fn value(self) -> f32 {
        self.value as f32
    }
}
