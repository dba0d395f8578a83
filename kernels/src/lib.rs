//! Image filters as ordinary Rust.
//!
//! Each kernel is a function that rustc compiles and that runs unchanged: the CPU reference. The generator
//! reads the same text, found in [`CATALOGUE`], and resolves its loops and branches at generation time.

// The kernel language has comparisons, but not `contains` of a range.
#![allow(clippy::manual_range_contains)]
// Kernels use counters in loops, as the shaders generated from them do.
#![allow(clippy::needless_range_loop)]

mod catalogue;
#[cfg(feature = "native")]
pub mod edge;
pub mod filters;
mod half;
#[cfg(feature = "native")]
pub mod normals;
mod options;
pub mod pictures;
#[cfg(feature = "native")]
pub mod prelude;
mod presets;
pub mod properties;
#[cfg(feature = "native")]
pub mod quad;
#[cfg(feature = "native")]
pub mod sraa;
#[cfg(feature = "native")]
pub mod testing;
mod values;

pub use catalogue::{CATALOGUE, Entry, PaperCounts, SourceFile, find};
pub use half::HalfPrecision;
pub use options::{KernelOptions, option_name, option_text};
pub use presets::Preset;
pub use values::{OptionText, OptionValue, OptionValues, kebab};
