//! Compute shaders on a Vulkan driver, called directly without the loader and wgpu.

mod device;
mod dispatch;
mod driver;
mod memory;

pub use device::Device;
pub use dispatch::{Binding, Dispatch, Resource};
pub use driver::Driver;
pub use memory::{Format, Image};
