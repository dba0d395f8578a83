//! The Cargo features of the command `straightline`.
//!
//! This is a library only so that the crate of the workspace's tests can depend on it with all features: `cargo test
//! --workspace` then tests the whole command, and `cargo run` builds the default.

/// Names of the features; `true` if built in.
pub const FEATURES: [(&str, bool); 3] = [
    ("exr", cfg!(feature = "exr")),
    ("models", cfg!(feature = "models")),
    ("study", cfg!(feature = "study")),
];
