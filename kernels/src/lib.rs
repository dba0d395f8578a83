//! Image filters as ordinary Rust.
//!
//! Each kernel is a function that rustc compiles and that runs as it stands: the CPU reference. The generator
//! reads the same text, found in [`CATALOGUE`], and evaluates its loops and branches away.

// Comparisons are part of the kernel language; `contains` of a range is none of it.
#![allow(clippy::manual_range_contains)]
// Kernels are written with counters, as the shaders are that are made of them.
#![allow(clippy::needless_range_loop)]

mod catalogue;
#[cfg(feature = "native")]
pub mod edge;
pub mod filters;
mod half;
#[cfg(feature = "native")]
pub mod normals;
mod options;
#[cfg(feature = "native")]
pub mod prelude;
mod presets;
#[cfg(feature = "native")]
pub mod quad;
#[cfg(feature = "native")]
pub mod sraa;
mod values;

pub use catalogue::{CATALOGUE, Entry, PaperCounts, SourceFile, find};
pub use half::HalfPrecision;
pub use options::{KernelOptions, option_name, option_text};
pub use presets::Preset;
pub use values::{OptionText, OptionValue, OptionValues, kebab};
