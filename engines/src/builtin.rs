//! The engines that are built in: the folders of `templates/`, as text.

/// A file of an engine's folder: name and text.
pub type Source = (&'static str, &'static str);

/// Name and files of each engine, in order.
pub static ENGINES: &[(&str, &[Source])] = include!(concat!(env!("OUT_DIR"), "/builtin.rs"));
