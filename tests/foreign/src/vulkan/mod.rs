//! Compute shaders on a driver of Vulkan, called directly: neither the loader nor wgpu stands between.

mod device;
mod dispatch;
mod driver;
mod memory;

pub use device::Device;
pub use dispatch::{Binding, Dispatch, Resource};
pub use driver::Driver;
pub use memory::{Format, Image};
