//! Running compiled kernels on images: by the interpreter in any precision, and on a GPU as the shader that is emitted.

mod chain;
mod chain_gpu;
mod convert;
mod cpu;
mod forward;
mod gpu;
mod parameters;
mod shadowed;
mod synthetic;
mod textures;
mod tiles;
mod timing;
mod uploads;
mod work;

use glam::{UVec2, Vec4};
use straightline_kernels::prelude::Frame;

pub use chain::{interpret_chain, picture_size};
pub use cpu::{Interpreted, find_unset_uniform, interpret_kernel, sampler_state};
pub use forward::{Corner, Forward};
pub use gpu::{AllWritten, Bench, Buffers, Uploaded, texture_bytes};
pub use parameters::override_options;
pub use shadowed::Shadowed;
pub use straightline_scene::inputs::{Address, Comparison, Inputs, SamplerState};
pub use synthetic::test_inputs;
pub use tiles::{Tile, crop_inputs, split_tiles};
pub use timing::{Clock, Job, Timed, Times, next_timestamps};
pub use uploads::Uploads;
pub use work::Work;

/// Pixels that a kernel writes to one of its targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// Name of the target: `destination`, or that of a field of the structure that the kernel gives.
    pub name: String,
    /// Width and height.
    pub size: UVec2,
    /// Texels, row by row from the top: floats and integers as they are. Components that the value lacks are 0, and the fourth
    /// is 1.
    pub texels: Vec<[f64; 4]>,
}

impl Written {
    /// The target as a picture of floats; integers beyond 2^24 are rounded.
    pub fn frame(&self) -> Frame<Vec4> {
        let texel = |t: &[f64; 4]| Vec4::from_array(t.map(|v| v as f32));
        Frame::new(self.size, self.texels.iter().map(texel).collect())
    }
}

/// Returns whether `inputs` have an image, a sampler or a buffer of this name.
fn has_input(inputs: &Inputs, name: &str) -> bool {
    find_entry(&inputs.images, name).is_some()
        || find_entry(&inputs.integers, name).is_some()
        || find_entry(&inputs.samplers, name).is_some()
        || find_entry(&inputs.buffers, name).is_some()
}

/// The last entry of this name.
fn find_entry<'a, T>(entries: &'a [(String, T)], name: &str) -> Option<&'a T> {
    entries
        .iter()
        .rev()
        .find(|(known, _)| known == name)
        .map(|(_, value)| value)
}

/// Why a kernel could not be run.
#[derive(Debug, thiserror::Error)]
pub enum ExecuteError {
    /// Something that the kernel reads is missing or does not fit.
    #[error("{0}")]
    Input(String),
    /// The kernel cannot be emitted.
    #[error(transparent)]
    Emit(#[from] straightline_codegen::diagnostic::Errors),
    /// The shader cannot be run on these inputs.
    #[error(transparent)]
    Runtime(#[from] straightline_runtime::Error),
    /// The device failed.
    #[error("{doing}: {message}")]
    Device {
        /// Operation that failed.
        doing: &'static str,
        /// wgpu's message.
        message: String,
    },
}
