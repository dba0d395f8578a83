//! The language: what the generator makes of kernels, against rustc, against texts that are kept, and at the edges of its values.

mod arrays;
#[path = "../common/mod.rs"]
mod common;
mod departures;
mod errors;
mod every_option;
mod exactness;
mod kept;
mod language;
mod limits;
mod loops;
mod names;
mod operations;
mod random;
mod ranges;
mod values;
