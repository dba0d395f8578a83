//! Property tests of kernels: plain Rust under `cargo test`, run as shaders by `straightline test`.
//!
//! ```
//! use straightline_kernels::prelude::*;
//! use straightline_kernels::testing::*;
//!
//! fn luma(color: Vec3) -> f32 {
//!     color.dot(vec3(0.2126, 0.7152, 0.0722))
//! }
//!
//! // In a `#[test]`:
//! for_all(|grey: f32| assert_close(luma(Vec3::splat(grey)), grey, ulp(2)));
//! for_all_in((0.0..=1.0, unit()), |from: f32, to: f32| {
//!     assume(from <= to);
//!     assert!(mix(from, to, 0.5) <= to);
//! });
//! ```
//!
//! The cases are the same here and in shaders, and the same each time: edges first, then random values.
//!
//! With the feature `pictures`, `assert_picture` compares what a kernel draws with a golden file, a PNG.

mod close;
mod color;
mod domain;
mod panics;
#[cfg(feature = "pictures")]
mod picture;
mod property;
mod value;

use std::fmt::Debug;

pub use close::{Close, Tolerance, absolute, relative, ulp};
pub use color::Color;
pub use domain::{Domain, Domains, any, every_float, unit};
#[cfg(feature = "pictures")]
pub use picture::{FromTexel, assert_picture, exactly, psnr, read_linear, read_picture};
pub use property::{Property, for_all, for_all_in};
pub use value::{Bits, Value};

/// Asserts that two floats or vectors are within a tolerance.
///
/// # Panics
///
/// If they are not, with both values and their distance.
#[track_caller]
pub fn assert_close<T: Close + Copy + Debug + Components>(a: T, b: T, tolerance: Tolerance) {
    if a.close_to(b, tolerance) {
        return;
    }
    let pairs = a.components().into_iter().zip(b.components());
    let ulps = pairs.map(|(a, b)| close::ulps_between(a, b)).max().unwrap_or(0);
    let apart = match ulps {
        u32::MAX => "not comparable".to_owned(),
        1 => "1 ULP apart".to_owned(),
        n => format!("{n} ULPs apart"),
    };
    panic!("the values are not close: {apart}\n  left: {a:?}\n right: {b:?}");
}

/// Components of a float or vector.
pub trait Components {
    /// The components in order.
    fn components(self) -> Vec<f32>;
}

impl Components for f32 {
    fn components(self) -> Vec<f32> {
        vec![self]
    }
}

macro_rules! vectors {
    ($($vector:ty),*) => {$(
        impl Components for $vector {
            fn components(self) -> Vec<f32> {
                self.to_array().to_vec()
            }
        }
    )*};
}

vectors!(glam::Vec2, glam::Vec3, glam::Vec4);

/// Passes over the case unless `condition` holds.
pub fn assume(condition: bool) {
    if !condition {
        panics::pass_over();
    }
}
