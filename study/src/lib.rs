//! Studies of kernels: unrolled against looped forms, antialiasing methods against references, hard cases with their
//! bounds, statistics of GPU compilers, the search for the cheapest variant, quad filters with every transport, and sweeps
//! over options and forms. Each study returns a [`record`]; [`report`] renders a page of records.
//!
//! `straightline-bench` runs kernels, `straightline-oracle` judges them.

pub mod baselines;
mod builtin;
pub mod chains;
pub mod frame;
pub mod hard;
pub mod isa;
pub mod loops;
pub mod precision;
pub mod progress;
pub mod quads;
pub mod quality;
pub mod record;
pub mod report;
pub mod statistics;
pub mod steps;
pub mod sweep;
pub mod tune;
pub mod turns;
