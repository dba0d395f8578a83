//! Rust that binds a shader's inputs by name, for the caller's crate.
pub fn bindings() {}
