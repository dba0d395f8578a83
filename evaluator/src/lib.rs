//! The partial evaluator: from a kernel's text to the graph of what is left to compute, and an interpreter of that graph.
//!
//! `straightline-codegen` calls these modules in order ([`Kernel::compile`]), emits what they make, and is the interface for
//! users; it gives [`ir`], [`passes`], [`interp`], [`policy`] and [`diagnostic`] out as its own.
//!
//! [`Kernel::compile`]: https://docs.rs/straightline-codegen/latest/straightline_codegen/struct.Kernel.html#method.compile

pub mod diagnostic;
pub mod eval;
pub mod front;
pub mod infer;
pub mod interp;
pub mod ir;
pub mod limits;
pub mod passes;
pub mod policy;
mod suggest;

pub use straightline_files::shorten;
pub use suggest::{is_close, suggest_name};
