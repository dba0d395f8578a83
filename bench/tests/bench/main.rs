//! The interpreter on kernels, on captures too.

#[path = "../../../scene/tests/common/mod.rs"]
mod common;
mod gbuffer;
mod interpret;
