//! Scenes and their renderers, captures, pictures, encodings, G-buffers and sequences of frames: what kernels run on.
//!
//! [`inputs`] is the plain data that a kernel reads. Nothing here evaluates, emits or runs a compiled kernel.

pub mod capture;
pub mod encode;
pub mod gbuffer;
pub mod inputs;
pub mod picture;
pub mod render;
pub mod scene;
pub mod sequence;
