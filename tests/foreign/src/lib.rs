//! Foreign libraries that tests call: Microsoft's compiler of HLSL, and drivers of Vulkan without loader and without wgpu.
//!
//! Beside `isa` the one crate with `unsafe`. It knows nothing of kernels: texts, words and bytes go in and come out.

pub mod dxc;
mod open;
pub mod vulkan;
