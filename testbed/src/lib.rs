//! A deferred testbed: scenes and their renderers, captures, the references that judge filters, error metrics, pictures, and the
//! execution of compiled kernels on them.
//!
//! Only [`execute`] knows the generator. All else stands apart from it: the oracle and the metrics judge what it emits.

pub mod capture;
pub mod encode;
pub mod execute;
pub mod gbuffer;
pub mod metrics;
pub mod oracle;
pub mod picture;
pub mod render;
pub mod scene;
pub mod sequence;
