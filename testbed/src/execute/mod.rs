//! Running compiled kernels on images: by the interpreter in any precision, and on a GPU as the shader that is emitted.

mod convert;
mod cpu;
mod forward;
mod gpu;
mod shadowed;
mod synthetic;
mod textures;
mod tiles;
mod timing;
mod uploads;
mod work;

use glam::{UVec2, UVec4, Vec4};
use straightline_kernels::prelude::Frame;

pub use cpu::{Interpreted, interpret, unset};
pub use forward::{Corner, Forward};
pub use gpu::{AllWritten, Bench, Buffers, Uploaded, texture_bytes};
pub use shadowed::Shadowed;
pub use straightline_codegen::interp::{Address, Comparison, SamplerState};
pub use synthetic::test_inputs;
pub use tiles::{Tile, cropped, tiles};
pub use timing::{Clock, Job, Quartiles, Ratio, Timed, Times};
pub use uploads::Uploads;
pub use work::Work;

/// What a kernel gives for each pixel in one of its targets.
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

/// What a kernel is run on, by the names that it calls them.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// Width and height of the output.
    pub size: UVec2,
    /// Images: one for a plain texture, several for layers, for the samples of a texel, for the slices of a volume, or for the
    /// faces of a cube +X, -X, +Y, -Y, +Z, -Z.
    pub images: Vec<(String, Vec<Frame<Vec4>>)>,
    /// Further levels of those images, each half as large as the one before, rounded down.
    pub smaller: Vec<(String, Vec<Vec<Frame<Vec4>>>)>,
    /// Images of integers by their bits, otherwise as `images`.
    pub integers: Vec<(String, Vec<Frame<UVec4>>)>,
    /// Samplers; one that is not named filters linearly, clamps, and compares by `<=`.
    pub samplers: Vec<(String, SamplerState)>,
    /// Elements of buffers, each in as many lanes as it has; of structures all their numbers and vectors, one after the other.
    pub buffers: Vec<(String, Vec<[f64; 4]>)>,
    /// Lanes of uniforms; one that is not named keeps its default.
    pub uniforms: Vec<(String, Vec<f64>)>,
}

impl Inputs {
    /// Nothing to read yet.
    pub fn new(size: UVec2) -> Self {
        Inputs {
            size,
            ..Inputs::default()
        }
    }

    /// With an image.
    pub fn image(self, name: &str, image: Frame<Vec4>) -> Self {
        self.layers(name, vec![image])
    }

    /// With a stack of images.
    pub fn layers(mut self, name: &str, layers: Vec<Frame<Vec4>>) -> Self {
        self.images.push((name.to_owned(), layers));
        self
    }

    /// With a texture of several levels, the finest first, each of as many layers, or of the slices of a volume.
    pub fn levels(mut self, name: &str, mut levels: Vec<Vec<Frame<Vec4>>>) -> Self {
        let smaller = levels.split_off(levels.len().min(1));
        self.smaller.push((name.to_owned(), smaller));
        self.layers(name, levels.pop().unwrap_or_default())
    }

    /// With a stack of images of integers, by their bits.
    pub fn integers(mut self, name: &str, layers: Vec<Frame<UVec4>>) -> Self {
        self.integers.push((name.to_owned(), layers));
        self
    }

    /// With a sampler.
    pub fn sampler(mut self, name: &str, state: SamplerState) -> Self {
        self.samplers.push((name.to_owned(), state));
        self
    }

    /// With a buffer.
    pub fn buffer(mut self, name: &str, elements: Vec<[f64; 4]>) -> Self {
        self.buffers.push((name.to_owned(), elements));
        self
    }

    /// With a uniform.
    pub fn uniform(mut self, name: &str, lanes: &[f64]) -> Self {
        self.uniforms.push((name.to_owned(), lanes.to_vec()));
        self
    }

    /// Whether there is anything but a uniform of this name.
    fn has(&self, name: &str) -> bool {
        Inputs::find(&self.images, name).is_some()
            || Inputs::find(&self.integers, name).is_some()
            || Inputs::find(&self.samplers, name).is_some()
            || Inputs::find(&self.buffers, name).is_some()
    }

    fn find<'a, T>(entries: &'a [(String, T)], name: &str) -> Option<&'a T> {
        entries
            .iter()
            .rev()
            .find(|(known, _)| known == name)
            .map(|(_, value)| value)
    }
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
        /// What was being done.
        doing: &'static str,
        /// What wgpu said.
        message: String,
    },
}
