//! A deferred testbed, captures, references and error metrics for studying antialiasing kernels.
//!
//! Only [`execute`] and [`tune`] know the generator. All else stands apart from it: the oracle and the metrics judge what it
//! emits.

pub mod capture;
pub mod encode;
pub mod execute;
pub mod gbuffer;
pub mod metrics;
pub mod oracle;
pub mod picture;
pub mod record;
pub mod render;
pub mod scene;
pub mod tune;
