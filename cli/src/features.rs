//! The features that the command `straightline` is built with.
//!
//! It is a library only so that the crate of the workspace's tests can depend on it and ask for all of them: `cargo test
//! --workspace` then tests the whole command, and `cargo run` builds what the default has.

/// The features, and whether each is there.
pub const FEATURES: [(&str, bool); 3] = [
    ("exr", cfg!(feature = "exr")),
    ("models", cfg!(feature = "models")),
    ("study", cfg!(feature = "study")),
];
