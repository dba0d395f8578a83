//! Captures and pictures in files.

mod capture;
#[path = "../common/mod.rs"]
mod common;
mod picture;
