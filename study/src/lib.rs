//! Studies of kernels: unroll against loop, methods of antialiasing against references, hard cases with their bounds, what GPU
//! compilers say, the search for the cheapest variant, filters of pixel quads by every transport, and any kernel in every combination
//! of options and forms. Each gives a [`record`]; [`report`] makes a page of records.
//!
//! `straightline-bench` runs kernels, `straightline-oracle` judges them.

pub mod baselines;
mod builtin;
pub mod frame;
pub mod hard;
pub mod isa;
pub mod loops;
pub mod progress;
pub mod quads;
pub mod quality;
pub mod record;
pub mod report;
pub mod sweep;
pub mod tune;
