//! Foreign libraries that tests call: Microsoft's compiler of HLSL, and Vulkan drivers without loader and without wgpu.
//!
//! The only crate with `unsafe` besides `isa`. Independent of kernels: texts, words and bytes go in and out.

pub mod dxc;
mod open;
pub mod vulkan;
