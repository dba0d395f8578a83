//! A deferred testbed, captures, references and error metrics for studying antialiasing kernels.
//!
//! Only [`execute`], and the studies that run kernels, know the generator. All else stands apart from it: the oracle and the
//! metrics judge what it emits.

pub mod capture;
pub mod encode;
pub mod execute;
pub mod gbuffer;
pub mod hard;
pub mod isa;
pub mod loops;
pub mod metrics;
pub mod oracle;
pub mod peers;
pub mod picture;
pub mod quality;
pub mod record;
pub mod render;
pub mod report;
pub mod scene;
pub mod tune;
pub mod watch;
