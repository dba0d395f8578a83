//! Comparisons of floats. The generator reads this text too: it is of the kernel language.

use glam::{Vec2, Vec3, Vec4};

/// Greatest distance of two floats that count as equal: each of its parts is enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Distance in units of the last place.
    pub ulps: u32,
    /// Distance.
    pub absolute: f32,
    /// Distance as a part of the greater absolute value.
    pub relative: f32,
}

/// At most `n` units of the last place. A unit is at least the smallest normal number: drivers may take smaller ones for zero.
pub fn ulp(n: u32) -> Tolerance {
    Tolerance {
        ulps: n,
        absolute: n as f32 * f32::MIN_POSITIVE,
        relative: 0.0,
    }
}

/// A distance of at most `e`.
pub fn absolute(e: f32) -> Tolerance {
    Tolerance {
        ulps: 0,
        absolute: e,
        relative: 0.0,
    }
}

/// A distance of at most `e` times the greater absolute value.
pub fn relative(e: f32) -> Tolerance {
    Tolerance {
        ulps: 0,
        absolute: 0.0,
        relative: e,
    }
}

/// Number of floats from one to another; `u32::MAX` if one of them is a NaN.
pub fn ulps_between(a: f32, b: f32) -> u32 {
    if a.is_nan() || b.is_nan() {
        return u32::MAX;
    }
    ordinal_of_float(a).abs_diff(ordinal_of_float(b))
}

/// Position of a float among all floats; 0 for both zeros.
fn ordinal_of_float(x: f32) -> i32 {
    let size = (x.to_bits() & 0x7fff_ffff) as i32;
    if x.to_bits() >> 31 == 1 { -size } else { size }
}

/// Values that have a distance.
pub trait Close {
    /// Returns whether two values, or all of their components, are within a tolerance. A NaN is not close to anything.
    fn close_to(self, other: Self, tolerance: Tolerance) -> bool;
}

impl Close for f32 {
    fn close_to(self, other: f32, tolerance: Tolerance) -> bool {
        let distance = (self - other).abs();
        let greater = self.abs().max(other.abs());
        self == other
            || distance <= tolerance.absolute
            || distance <= tolerance.relative * greater
            || ulps_between(self, other) <= tolerance.ulps
    }
}

impl Close for Vec2 {
    fn close_to(self, other: Vec2, tolerance: Tolerance) -> bool {
        self.x.close_to(other.x, tolerance) && self.y.close_to(other.y, tolerance)
    }
}

impl Close for Vec3 {
    fn close_to(self, other: Vec3, tolerance: Tolerance) -> bool {
        self.x.close_to(other.x, tolerance)
            && self.y.close_to(other.y, tolerance)
            && self.z.close_to(other.z, tolerance)
    }
}

impl Close for Vec4 {
    fn close_to(self, other: Vec4, tolerance: Tolerance) -> bool {
        self.x.close_to(other.x, tolerance)
            && self.y.close_to(other.y, tolerance)
            && self.z.close_to(other.z, tolerance)
            && self.w.close_to(other.w, tolerance)
    }
}
