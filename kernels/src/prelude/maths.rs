//! Functions whose name has a different meaning in Rust and in shaders. Here they have the shader's meaning.

use glam::{Vec2, Vec3, Vec4};
use std::ops::{Add, Mul, Sub};

/// A float or a vector of floats.
pub trait Floats:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Mul<f32, Output = Self>
{
    /// Applies `f` to each component.
    fn map(self, f: impl Fn(f32) -> f32) -> Self;
}

impl Floats for f32 {
    fn map(self, f: impl Fn(f32) -> f32) -> f32 {
        f(self)
    }
}

impl Floats for Vec2 {
    fn map(self, f: impl Fn(f32) -> f32) -> Vec2 {
        Vec2::new(f(self.x), f(self.y))
    }
}

impl Floats for Vec3 {
    fn map(self, f: impl Fn(f32) -> f32) -> Vec3 {
        Vec3::new(f(self.x), f(self.y), f(self.z))
    }
}

impl Floats for Vec4 {
    fn map(self, f: impl Fn(f32) -> f32) -> Vec4 {
        Vec4::new(f(self.x), f(self.y), f(self.z), f(self.w))
    }
}

/// `x - floor(x)`: in 0..1 for negative numbers as well, whereas `f32::fract` truncates.
pub fn fract<T: Floats>(x: T) -> T {
    x.map(|x| x - x.floor())
}

/// Rounds to the nearest integer, ties to even, whereas `f32::round` rounds ties away from zero.
pub fn round<T: Floats>(x: T) -> T {
    x.map(f32::round_ties_even)
}

/// Returns 1, -1, or `x` itself if it is a zero, whereas `f32::signum` never returns 0. Returns 0 for a NaN.
pub fn sign<T: Floats>(x: T) -> T {
    x.map(|x| {
        if x > 0.0 {
            1.0
        } else if x < 0.0 {
            -1.0
        } else if x.is_nan() {
            0.0
        } else {
            x
        }
    })
}

/// Clamps `x` to 0..1. Returns 0 for a NaN, as GPUs do.
pub fn saturate<T: Floats>(x: T) -> T {
    x.map(|x| if x > 0.0 { x.min(1.0) } else { 0.0 })
}

/// `1 / sqrt(x)`.
pub fn inverse_sqrt<T: Floats>(x: T) -> T {
    x.map(|x| 1.0 / x.sqrt())
}

/// Interpolates linearly from `a` at 0 to `b` at 1: `a * (1 - t) + b * t`.
pub fn mix<T, S>(a: T, b: T, t: S) -> T
where
    T: Floats + Mul<S, Output = T>,
    S: Copy,
    f32: Sub<S, Output = S>,
{
    a * (1.0 - t) + b * t
}

/// Returns 0 if `x` is less than `edge`, else 1.
pub fn step(edge: f32, x: f32) -> f32 {
    if x < edge { 0.0 } else { 1.0 }
}

/// 0 up to `low`, 1 from `high`, and a cubic between: `t * t * (3 - 2 * t)`. If `low` equals `high`: 0 up to it and 1 above.
pub fn smoothstep<T: Floats>(low: f32, high: f32, x: T) -> T {
    x.map(|x| {
        let t = saturate((x - low) / (high - low));
        t * t * (3.0 - 2.0 * t)
    })
}
