//! What several tests and programs share.
//!
//! [`random`]: differential testing of the generator. A random kernel is a tree of this crate's own, printed as text for the generator and evaluated directly by a tree
//! walker that shares no code with it. The two must agree bit for bit, whatever becomes of loops.

pub use straightline_study::oracle::quads;
pub mod compilers;
pub mod gl;
pub mod impatient;
pub mod passthrough;
pub mod random;
pub mod readme;
pub mod sraa;
