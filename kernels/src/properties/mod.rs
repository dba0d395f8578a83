//! Cases of property tests: their arguments, their generation, their minimisation and their text.
//!
//! The functions of [`testing`](crate::testing) and the command `straightline test` run the same cases.

mod argument;
mod cases;
mod minimise;
mod text;

pub use argument::{Argument, Component, Range};
pub use cases::{CASES, Case, SEED, generate_cases};
pub use minimise::minimise_case;
pub use text::{case_text, float_text};

/// The source of `testing/close.rs`: tolerances and comparisons in the kernel language.
pub const CLOSE: &str = include_str!("../testing/close.rs");

/// The source of `testing/color.rs`: results of kernels as colours, in the kernel language.
pub const COLOR: &str = include_str!("../testing/color.rs");
