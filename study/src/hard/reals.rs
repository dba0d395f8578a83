//! Precisions beyond the interpreter's own, which model the freedom of devices under the specification.

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};
use straightline_codegen::ir::{BinaryOp, Real, UnaryOp};

/// `R`, with subnormal numbers flushed to zero after every operation.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Flushed<R>(R);

/// `R`, as inexact as WGSL lets a device be (*Floating Point Accuracy*, *Differences from IEEE-754*).
///
/// Every inexact sum, difference and product is rounded up or down, by a hash of its operands: so the same operation on the
/// same numbers gives the same number, and the choice is as good as random (stochastic arithmetic, Vignes 1993, "A stochastic
/// arithmetic for reliable scientific computation"). Reordered sums and fused products move a result no farther than that.
/// Quotients are off by up to 2 ULP, inverse square roots by 2, roots by 4, exponentials by 3 + 2 |x| (in 16 bits 1 + 2 |x|),
/// logarithms by 3. Subnormal numbers are flushed to zero. Of a NaN and a number, `min` and `max` give the NaN: shaders may
/// assume that there is none.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Loose<R>(R);

/// Returns the smallest normal number of a precision.
fn smallest_normal<R: Real>() -> f64 {
    match R::NAME {
        "f16" => 1.0 / 16384.0,
        "f32" => f32::MIN_POSITIVE.into(),
        _ => f64::MIN_POSITIVE,
    }
}

fn flushed<R: Real>(x: R) -> R {
    let value = x.to_f64();
    match value != 0.0 && value.abs() < smallest_normal::<R>() {
        true => R::from_f64(0.0f64.copysign(value)),
        false => x,
    }
}

macro_rules! through {
    ($name:ident) => {
        impl<R: Real> Add for $name<R> {
            type Output = Self;

            fn add(self, other: Self) -> Self {
                self.binary(BinaryOp::Add, other).unwrap_or(self)
            }
        }

        impl<R: Real> Sub for $name<R> {
            type Output = Self;

            fn sub(self, other: Self) -> Self {
                self.binary(BinaryOp::Sub, other).unwrap_or(self)
            }
        }

        impl<R: Real> Mul for $name<R> {
            type Output = Self;

            fn mul(self, other: Self) -> Self {
                self.binary(BinaryOp::Mul, other).unwrap_or(self)
            }
        }

        impl<R: Real> Real for $name<R> {
            const NAME: &'static str = R::NAME;
            type Sampled = R::Sampled;

            fn from_f64(x: f64) -> Self {
                $name(flushed(R::from_f64(x)))
            }

            fn made(x: f64) -> Self {
                $name(flushed(R::made(x)))
            }

            fn to_f64(self) -> f64 {
                self.0.to_f64()
            }

            fn to_bits(self) -> u64 {
                self.0.to_bits()
            }

            fn from_bits(bits: u64) -> Self {
                $name(R::from_bits(bits))
            }

            fn unary(self, op: UnaryOp) -> Option<Self> {
                Some($name(flushed(Self::one(self.0, op)?)))
            }

            fn binary(self, op: BinaryOp, other: Self) -> Option<Self> {
                Some($name(flushed(Self::two(self.0, op, other.0)?)))
            }
        }
    };
}

through!(Flushed);
through!(Loose);

impl<R: Real> Flushed<R> {
    fn one(x: R, op: UnaryOp) -> Option<R> {
        x.unary(op)
    }

    fn two(a: R, op: BinaryOp, b: R) -> Option<R> {
        a.binary(op, b)
    }
}

impl<R: Real> Loose<R> {
    fn one(x: R, op: UnaryOp) -> Option<R> {
        use UnaryOp::*;
        let result = x.unary(op)?;
        let at_zero = if R::NAME == "f16" { 1.0 } else { 3.0 };
        let most = match op {
            InverseSqrt => 2.0,
            Sqrt => 4.0,
            Exp | Exp2 => at_zero + 2.0 * x.to_f64().abs(),
            Log | Log2 => 3.0,
            _ => return Some(result),
        };
        Some(nudge_ulps(result, most, hash(&[x.to_bits(), op as u64])))
    }

    fn two(a: R, op: BinaryOp, b: R) -> Option<R> {
        use BinaryOp::*;
        let (x, y) = (a.to_f64(), b.to_f64());
        let key = hash(&[a.to_bits(), b.to_bits(), op as u64]);
        match op {
            Add => Some(round_loosely(x + y, key)),
            Sub => Some(round_loosely(x - y, key)),
            Mul => Some(round_loosely(x * y, key)),
            Div => Some(nudge_ulps(a.binary(op, b)?, 2.0, key)),
            Min | Max if x.is_nan() || y.is_nan() => Some(R::from_f64(f64::NAN)),
            _ => a.binary(op, b),
        }
    }
}

/// Rounds a number that has two neighbours to one of them.
fn round_loosely<R: Real>(exact: f64, key: u64) -> R {
    let nearest = R::from_f64(exact);
    let found = nearest.to_f64();
    if found == exact || !found.is_finite() || key & 1 == 0 {
        return nearest;
    }
    let other = step_ulps(nearest, if found.abs() < exact.abs() { 1 } else { -1 });
    if other.to_f64().is_finite() { other } else { nearest }
}

/// Moves a number by at most `most` units in the last place; zeros, infinities and NaNs are unchanged.
fn nudge_ulps<R: Real>(x: R, most: f64, key: u64) -> R {
    let value = x.to_f64();
    if value == 0.0 || !value.is_finite() {
        return x;
    }
    let most = most.min(1.0e6) as i64;
    let by = (key % (2 * most as u64 + 1)) as i64 - most;
    let moved = step_ulps(x, by);
    let kept = moved.to_f64().is_finite() && moved.to_f64().signum() == value.signum();
    if kept { moved } else { x }
}

/// Returns the number `by` representable steps farther from zero.
fn step_ulps<R: Real>(x: R, by: i64) -> R {
    let sign = match R::NAME {
        "f16" => 1 << 15,
        "f32" => 1 << 31,
        _ => 1 << 63,
    };
    let bits = x.to_bits();
    let magnitude = (bits & !sign) as i64 + by;
    match magnitude < 0 {
        true => x,
        false => R::from_bits(bits & sign | magnitude as u64),
    }
}

/// Returns a pseudo-random number (SplitMix64), a function of the words.
fn hash(words: &[u64]) -> u64 {
    words.iter().fold(0x9e37_79b9_7f4a_7c15, |state, word| {
        let mut z = (state ^ word).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_codegen::ir::F16;

    #[test]
    fn subnormal_results_are_zero() {
        let x = Flushed::<f32>::from_f64(1.0e-30);
        assert_eq!((x * x).to_f64(), 0.0);
        assert_eq!(
            Flushed::<f32>::from_f64(-1.0e-40).to_f64().to_bits(),
            (-0.0f64).to_bits()
        );
        let half = Flushed::<F16>::from_f64(0.01);
        assert_eq!(
            (half * half).to_f64(),
            F16::from_f64(0.01)
                .binary(BinaryOp::Mul, F16::from_f64(0.01))
                .map(Real::to_f64)
                .unwrap_or(0.0)
        );
        let tiny = Flushed::<F16>::from_f64(0.001);
        assert_eq!((tiny * tiny).to_f64(), 0.0);
    }

    #[test]
    fn loose_results_are_neighbours_and_exact_ones_exact() {
        let (mut up, mut down) = (0, 0);
        for k in 1..2000 {
            let (a, b) = (1.0 + f64::from(k) / 3.0, 0.1 * f64::from(k));
            let (x, y) = (Loose::<f32>::from_f64(a), Loose::<f32>::from_f64(b));
            let exact = x.to_f64() * y.to_f64();
            let found = (x * y).to_f64();
            let place = f64::from(exact as f32).abs() * f64::from(f32::EPSILON);
            assert!((found - exact).abs() <= place, "{found} {exact}");
            up += i32::from(found > exact);
            down += i32::from(found < exact);
            assert_eq!((x - x).to_f64(), 0.0);
        }
        assert!(up > 500 && down > 500, "{up} {down}");
    }

    #[test]
    fn loose_functions_stay_within_their_ulps() {
        for k in 0..2000 {
            let x = Loose::<f32>::from_f64(-0.01 * f64::from(k));
            let exact = x.to_f64().exp2();
            let found = x.unary(UnaryOp::Exp2).map_or(f64::NAN, Real::to_f64);
            let ulps = (found - exact).abs() / (exact * f64::from(f32::EPSILON));
            assert!(ulps <= 2.0 * (4.0 + 2.0 * x.to_f64().abs()), "{ulps}");
        }
        let bad = Loose::<f32>::from_f64(f64::NAN);
        let one = Loose::<f32>::from_f64(1.0);
        for (a, b) in [(bad, one), (one, bad)] {
            assert!(a.binary(BinaryOp::Min, b).is_some_and(|x| x.to_f64().is_nan()));
        }
    }
}
