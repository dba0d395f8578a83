//! SRAA on random surfaces, in every way that its options allow: inputs for shaders, for the native kernel and for the
//! oracle.

pub mod native;
pub mod options;
pub mod scenes;
pub mod surfaces;

use straightline_codegen::diagnostic::Errors;
use straightline_codegen::{Compiled, Kernel, Settings, Unroll};
use straightline_kernels::prelude::{Frame, Vec4};
use straightline_oracle::oracle::Resolved;

pub use options::Options;

/// A small deterministic generator (SplitMix64).
pub struct Random(pub u64);

impl Random {
    /// Any number.
    pub fn number(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..1.
    pub fn unit(&mut self) -> f32 {
        (self.number() >> 40) as f32 / (1 << 24) as f32
    }

    /// Chooses one of `all`, which is not empty.
    pub fn choose<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.number() % all.len() as u64) as usize]
    }
}

/// The filter with some options set.
///
/// # Errors
///
/// What the kernel refuses, and why.
pub fn compiled(options: &Options, unroll: Unroll) -> Result<Compiled, Errors> {
    kernel("sraa", options, unroll)
}

/// Compiles one of the kernels of SRAA with some options set.
///
/// # Errors
///
/// What the kernel refuses, and why.
pub fn kernel(name: &str, options: &Options, unroll: Unroll) -> Result<Compiled, Errors> {
    let settings = Settings::new().set_all(options.clone()).unroll(unroll);
    Kernel::builtin(name)?.compile(&settings)
}

/// Distance of a result from the expected one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Difference {
    /// The largest, over all components of all pixels that 32 bits decide as 64 do.
    pub largest: f64,
    /// Pixels that were compared.
    pub compared: usize,
    /// Pixels of these that are not finite and should be.
    pub non_finite: usize,
}

/// Compares a result with the oracle's.
pub fn difference(result: &Frame<Vec4>, expected: &[Resolved]) -> Difference {
    let mut difference = Difference::default();
    for (found, expected) in result.texels().iter().zip(expected) {
        if !expected.sure || expected.color.iter().any(|axis| !axis.is_finite()) {
            continue;
        }
        difference.compared += 1;
        if !found.is_finite() {
            difference.non_finite += 1;
            continue;
        }
        for (a, b) in found.to_array().into_iter().zip(expected.color) {
            difference.largest = difference.largest.max((f64::from(a) - b).abs());
        }
    }
    difference
}
