//! Several images in one: multisampled textures and texture arrays.

use super::filter::between_levels;
use super::{Filterable, Sampler, Texel, Texture};
use crate::prelude::quad::PerLane;
use glam::{IVec2, UVec2, Vec2};

/// An image of any size with several samples per texel. Bound as a `texture_multisampled_2d<f32>`.
#[derive(Clone, Debug, PartialEq)]
pub struct Multisampled<T> {
    samples: Vec<Texture<T>>,
}

impl<T: Texel> Multisampled<T> {
    /// Creates an image from one image for each sample. Panics unless there are at least two and all have the same size.
    pub fn new(samples: Vec<Texture<T>>) -> Self {
        assert!(samples.len() > 1, "at least two samples a texel");
        assert!(
            samples.windows(2).all(|pair| pair[0].size() == pair[1].size()),
            "samples of one size"
        );
        Multisampled { samples }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.samples[0].size()
    }

    /// Image of each sample.
    pub fn samples(&self) -> &[Texture<T>] {
        &self.samples
    }

    /// Returns sample `sample` of the texel at `coord`, or of the nearest one on the border if `coord` is outside.
    /// Panics if there is no such sample. A shader's manifest states how many it needs.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P, sample: usize) -> P::Of<T> {
        self.samples[sample].load(coord)
    }
}

/// A stack of images of one size, which may differ from the output's. Bound as a `texture_2d_array` of `f32`, `i32` or `u32`.
///
/// `T` is as for [`Texture`].
#[derive(Clone, Debug, PartialEq)]
pub struct TextureArray<T> {
    layers: Vec<Texture<T>>,
}

impl<T: Texel> TextureArray<T> {
    /// Creates a stack from its layers, with all of their levels. Panics unless there is at least one layer and all have the
    /// same size and number of levels.
    pub fn new(layers: Vec<Texture<T>>) -> Self {
        assert!(!layers.is_empty(), "a stack needs at least one layer");
        assert!(
            layers.windows(2).all(|pair| pair[0].is_like(&pair[1])),
            "layers of one size, with as many levels"
        );
        TextureArray { layers }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.layers[0].size()
    }

    /// Number of layers.
    pub fn layers(&self) -> usize {
        self.layers.len()
    }

    /// Number of levels.
    pub fn levels(&self) -> usize {
        self.layers[0].levels()
    }

    /// Returns a layer, or the last one if `layer` is out of bounds.
    pub fn layer(&self, layer: usize) -> &Texture<T> {
        &self.layers[layer.min(self.layers.len() - 1)]
    }

    /// Returns the texel of `layer` at `coord`, or the nearest one on the border. A layer out of bounds is the last one.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P, layer: usize) -> P::Of<T> {
        self.layer(layer).load(coord)
    }
}

impl<T: Filterable> TextureArray<T> {
    /// Samples `layer` at `uv` like [`Texture::sample`]. A layer out of bounds is the last one.
    pub fn sample<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P, layer: usize) -> P::Of<T> {
        self.layer(layer).sample(sampler, uv)
    }

    /// Samples `layer` at `uv` and `level` like [`Texture::sample_level`]. A layer out of bounds is the last one.
    pub fn sample_level<P: PerLane<Vec2>>(
        &self,
        sampler: &Sampler,
        uv: P,
        layer: usize,
        level: P::Of<f32>,
    ) -> P::Of<T> {
        let layer = self.layer(layer);
        uv.with(level, |uv, level| {
            between_levels(layer.levels(), sampler.mip, level, |k| layer.sampled(k, sampler, uv))
        })
    }
}
