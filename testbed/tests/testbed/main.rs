//! Captures, G-buffers, pictures and oracles.

mod capture;
#[path = "../common/mod.rs"]
mod common;
mod gbuffer;
mod oracle;
mod picture;
