//! Filters: built-in kernels, examples and the gallery, against their definitions.

#[path = "../common/mod.rs"]
mod common;
mod demodulated;
mod edge;
mod extra;
mod gallery;
mod guide;
mod hard;
mod history;
mod kernels;
mod placed;
mod presets;
mod quad;
mod renderers;
mod resolves;
mod scene;
mod tiles;
