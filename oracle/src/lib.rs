//! The judges of emitted shaders: definitions of kernels in `f64` with bounds of the error, and error metrics.
//!
//! This crate shares no code with the code it judges: none of its dependencies evaluates, emits or runs kernels. From
//! `straightline-kernels` it uses the prelude's images and vectors and the values of options, but no kernel. From
//! `straightline-scene` it uses the inputs of a kernel and the transfer function of sRGB.

pub mod metrics;
pub mod oracle;
