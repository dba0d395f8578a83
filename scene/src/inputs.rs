//! Inputs of a kernel, by the names of its parameters: plain data, which renderers fill, definitions read and executors bind.

use glam::{UVec2, UVec4, Vec4};
use straightline_kernels::prelude::Frame;

pub use straightline_kernels::prelude::{Address, Comparison};

/// Filter and address modes of a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerState {
    /// True if the four texels around a place are weighed; else the nearest counts alone.
    pub linear: bool,
    /// Address mode beyond the border.
    pub address: Address,
    /// True if the two levels between which one falls are weighed; else the nearest counts alone.
    pub linear_mip: bool,
    /// For a comparison sampler, when a texel passes.
    pub comparison: Comparison,
}

impl SamplerState {
    /// The nearest texel of the nearest level, clamped to the edge.
    pub const NEAREST: SamplerState = SamplerState {
        linear: false,
        address: Address::Clamp,
        linear_mip: false,
        comparison: Comparison::LessEqual,
    };
}

impl Default for SamplerState {
    fn default() -> Self {
        SamplerState {
            linear: true,
            address: Address::default(),
            linear_mip: true,
            comparison: Comparison::default(),
        }
    }
}

/// Inputs of a kernel, by the names that it calls them.
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
    /// Sizes of the pictures of a pass that draws several of unlike sizes.
    pub target_sizes: Vec<(String, UVec2)>,
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
    pub fn with_image(self, name: &str, image: Frame<Vec4>) -> Self {
        self.with_layers(name, vec![image])
    }

    /// With a stack of images.
    pub fn with_layers(mut self, name: &str, layers: Vec<Frame<Vec4>>) -> Self {
        self.images.push((name.to_owned(), layers));
        self
    }

    /// With a texture of several levels, the finest first, each of as many layers, or of the slices of a volume.
    pub fn with_levels(mut self, name: &str, mut levels: Vec<Vec<Frame<Vec4>>>) -> Self {
        let smaller = levels.split_off(levels.len().min(1));
        self.smaller.push((name.to_owned(), smaller));
        self.with_layers(name, levels.pop().unwrap_or_default())
    }

    /// With a stack of images of integers, by their bits.
    pub fn with_integers(mut self, name: &str, layers: Vec<Frame<UVec4>>) -> Self {
        self.integers.push((name.to_owned(), layers));
        self
    }

    /// With a sampler.
    pub fn with_sampler(mut self, name: &str, state: SamplerState) -> Self {
        self.samplers.push((name.to_owned(), state));
        self
    }

    /// With a buffer.
    pub fn with_buffer(mut self, name: &str, elements: Vec<[f64; 4]>) -> Self {
        self.buffers.push((name.to_owned(), elements));
        self
    }

    /// With a uniform.
    pub fn with_uniform(mut self, name: &str, lanes: &[f64]) -> Self {
        self.uniforms.push((name.to_owned(), lanes.to_vec()));
        self
    }
}
