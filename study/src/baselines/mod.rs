//! Baselines from outside for SRAA: filters of the picture alone, or of its samples.

mod copy;
mod directional;
mod fxaa;
mod mlaa;
mod smaa;
mod transfer;

pub use directional::resolve_directional;
pub use fxaa::fxaa_kernel;
pub use mlaa::apply_mlaa;
pub use smaa::Smaa;
pub use transfer::Transfer;
