//! Definitions of kernels in `f64` with bounds of the error, and error metrics: what judges an emitted shader.
//!
//! Shares no code with what it judges: no evaluator, no generator, no runtime is among its dependencies. Of `straightline-kernels` it
//! uses the prelude's images and vectors and the values of options, and no kernel; of `straightline-scene` the inputs of a kernel and the
//! transfer function of sRGB.

pub mod metrics;
pub mod oracle;
