//! The data that kernels run on: scenes and their renderers, captures, pictures, encodings, G-buffers and sequences of frames.
//!
//! [`inputs`] is the plain data that a kernel reads. No module evaluates, emits or runs a compiled kernel.

pub mod capture;
pub mod encode;
pub mod gbuffer;
pub mod inputs;
pub mod picture;
pub mod render;
pub mod scene;
pub mod sequence;
