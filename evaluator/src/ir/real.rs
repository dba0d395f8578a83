//! Precisions in which a graph can be interpreted.

use super::{BinaryOp, UnaryOp};
use std::ops::{Add, Mul, Sub};

/// A floating-point number: `f32` as in shaders, `f64` to distinguish rounding from mistakes, [`F16`] to predict the effect
/// of half precision.
pub trait Real:
    Copy + PartialEq + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Send + Sync + 'static
{
    /// `f16`, `f32` or `f64`.
    const NAME: &'static str;
    /// Precision of samplers. They read and return `f32` even where shaders compute in less.
    type Sampled: Real;
    /// The nearest number.
    fn from_f64(x: f64) -> Self;
    /// Converts a number that the kernel creates itself, such as a constant or a converted integer. The result is the
    /// nearest finite number, and not zero unless `x` is zero. A bound such as `x.min(1.0e30)` must stay a bound, and
    /// `sum.max(1.0e-12)` must still prevent 0/0.
    fn made(x: f64) -> Self {
        Self::from_f64(x)
    }
    /// The nearest `f16`; in `f64`, which is the truth that others are compared with, the number itself.
    fn to_half(self) -> Self {
        self
    }
    /// Converts to `f64`, which is lossless.
    fn to_f64(self) -> f64;
    /// Bits of the number, the unused high ones 0.
    fn to_bits(self) -> u64;
    /// The number with these bits.
    fn from_bits(bits: u64) -> Self;
    /// Applies an operation to one number, as WGSL defines it.
    fn unary(self, op: UnaryOp) -> Option<Self>;
    /// Applies an operation on two numbers whose result is a number.
    fn binary(self, op: BinaryOp, other: Self) -> Option<Self>;
}

macro_rules! real {
    ($ty:ty, $bits:ty, |$x:ident| $half:expr) => {
        impl Real for $ty {
            const NAME: &'static str = stringify!($ty);
            type Sampled = $ty;

            fn from_f64(x: f64) -> Self {
                x as $ty
            }

            fn to_half(self) -> Self {
                let $x = self;
                $half
            }

            fn to_f64(self) -> f64 {
                self as f64
            }

            fn to_bits(self) -> u64 {
                <$ty>::to_bits(self) as u64
            }

            fn from_bits(bits: u64) -> Self {
                <$ty>::from_bits(bits as $bits)
            }

            fn unary(self, op: UnaryOp) -> Option<Self> {
                use UnaryOp::*;
                let x = self;
                Some(match op {
                    Neg => -x,
                    Abs => x.abs(),
                    Sign if x > 0.0 => 1.0,
                    Sign if x < 0.0 => -1.0,
                    // A zero keeps its sign; a NaN has none.
                    Sign if x == 0.0 => x,
                    Sign => 0.0,
                    Floor => x.floor(),
                    Ceil => x.ceil(),
                    Round => x.round_ties_even(),
                    Trunc => x.trunc(),
                    Fract => x - x.floor(),
                    // Not `clamp`, which returns a NaN for a NaN; the result is 0 here, as in hardware.
                    Saturate if x > 0.0 => x.min(1.0),
                    Saturate => 0.0,
                    Sqrt => x.sqrt(),
                    InverseSqrt => 1.0 / x.sqrt(),
                    Cbrt => x.cbrt(),
                    Exp => x.exp(),
                    Exp2 => x.exp2(),
                    Log => x.ln(),
                    Log2 => x.log2(),
                    Sin => x.sin(),
                    Cos => x.cos(),
                    Tan => x.tan(),
                    Asin => x.asin(),
                    Acos => x.acos(),
                    Atan => x.atan(),
                    Sinh => x.sinh(),
                    Cosh => x.cosh(),
                    Tanh => x.tanh(),
                    Not | BitNot | CountOneBits | ReverseBits | LeadingZeros | TrailingZeros => return None,
                })
            }

            fn binary(self, op: BinaryOp, b: Self) -> Option<Self> {
                use BinaryOp::*;
                let a = self;
                Some(match op {
                    Add => a + b,
                    Sub => a - b,
                    Mul => a * b,
                    Div => a / b,
                    Rem => a % b,
                    Min => a.min(b),
                    Max => a.max(b),
                    Pow => a.powf(b),
                    Atan2 => a.atan2(b),
                    _ => return None,
                })
            }
        }
    };
}

real!(f32, u32, |x| half::f16::from_f32(x).to_f32());
real!(f64, u64, |x| x);

/// IEEE 754 binary16. Every operation is computed in `f32` and rounded, which is the correctly rounded result for + - * /
/// and the square root.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct F16(half::f16);

impl F16 {
    fn from_f32_rounded(x: f32) -> F16 {
        F16(half::f16::from_f32(x))
    }

    /// Nearest number that is finite if `x` is finite, and nonzero if `x` is nonzero.
    pub fn nearest_finite(x: f64) -> half::f16 {
        use half::f16;
        let near = f16::from_f64(x);
        let instead = if near.is_infinite() && x.is_finite() {
            f16::MAX
        } else if near.to_f32() == 0.0 && x != 0.0 {
            f16::MIN_POSITIVE_SUBNORMAL
        } else {
            near
        };
        f16::from_f64(instead.to_f64().copysign(x))
    }
}

impl Add for F16 {
    type Output = F16;

    fn add(self, other: F16) -> F16 {
        F16::from_f32_rounded(self.0.to_f32() + other.0.to_f32())
    }
}

impl Sub for F16 {
    type Output = F16;

    fn sub(self, other: F16) -> F16 {
        F16::from_f32_rounded(self.0.to_f32() - other.0.to_f32())
    }
}

impl Mul for F16 {
    type Output = F16;

    fn mul(self, other: F16) -> F16 {
        F16::from_f32_rounded(self.0.to_f32() * other.0.to_f32())
    }
}

impl Real for F16 {
    const NAME: &'static str = "f16";
    type Sampled = f32;

    fn from_f64(x: f64) -> Self {
        F16(half::f16::from_f64(x))
    }

    fn made(x: f64) -> Self {
        F16(F16::nearest_finite(x))
    }

    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }

    fn to_bits(self) -> u64 {
        self.0.to_bits().into()
    }

    fn from_bits(bits: u64) -> Self {
        F16(half::f16::from_bits(bits as u16))
    }

    fn unary(self, op: UnaryOp) -> Option<Self> {
        self.0.to_f32().unary(op).map(F16::from_f32_rounded)
    }

    fn binary(self, op: BinaryOp, other: Self) -> Option<Self> {
        self.0.to_f32().binary(op, other.0.to_f32()).map(F16::from_f32_rounded)
    }
}
