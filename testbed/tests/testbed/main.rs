//! Captures, G-buffers, pictures, oracles and the interpreter.

mod capture;
#[path = "../common/mod.rs"]
mod common;
mod gbuffer;
mod interpret;
mod oracle;
mod picture;
