//! Code shared by several tests and programs.
//!
//! [`random`]: differential testing of the generator. A random kernel is compiled natively by rustc, and by the generator in
//! every form: all must compute the same bits.

pub use straightline_oracle::oracle::quads;
pub mod bare;
pub mod compilers;
pub mod edges;
pub mod gl;
pub mod impatient;
pub mod passthrough;
pub mod random;
pub mod readme;
pub mod renamed;
pub mod sraa;
pub mod texts;
