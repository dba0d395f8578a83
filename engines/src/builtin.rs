//! The engines that are built in: the folders of `templates/`.

/// A template of an engine's folder: name and text.
pub type Source = (&'static str, &'static str);

/// Name of each engine, in order, and its `engine.toml` as JSON.
pub static DESCRIPTIONS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/descriptions.rs"));

/// Name and templates of each.
pub static TEMPLATES: &[(&str, &[Source])] = include!(concat!(env!("OUT_DIR"), "/templates.rs"));
