//! The language: results of kernels, compared with rustc and at the edges of its values.

mod arrays;
mod cascades;
mod chains;
#[path = "../common/mod.rs"]
mod common;
mod departures;
mod every_option;
mod exactness;
mod kept;
mod language;
mod loops;
mod names;
mod operations;
mod overrides;
mod random;
mod ranges;
mod uniforms;
mod values;
