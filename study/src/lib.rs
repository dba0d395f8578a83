//! A deferred testbed, captures, references and error metrics for studying antialiasing kernels.
//!
//! Everything here stands apart from the generator: the oracle and the metrics judge what it emits.

pub mod capture;
pub mod metrics;
pub mod oracle;
pub mod picture;
pub mod render;
pub mod scene;
