//! What SRAA is compared with and is not ours: filters that look at the picture alone.

mod copy;
mod fxaa;
mod mlaa;
mod smaa;
mod transfer;

pub use fxaa::fxaa;
pub use mlaa::mlaa;
pub use smaa::Smaa;
pub use transfer::Transfer;
