//! Passes on a device: making, binding, dispatching, drawing, and every error.

mod cache;
mod chains;
mod chains_history;
mod chains_made;
mod choice;
#[path = "../common/mod.rs"]
mod common;
mod dependencies;
mod dispatch;
mod draw;
mod encode_into;
mod errors_binding;
mod errors_chains;
mod errors_making;
mod errors_resources;
mod errors_uniforms;
mod immediates;
mod overrides;
mod pending;
mod quads;
mod reload;
mod resources;
mod source_map;
mod timer;
