//! Depth textures for comparison.

use super::filter::{filtered, gather, sample_cube};
use super::{Address, ComparisonSampler, Sampler, Texture};
use crate::prelude::quad::PerLane;
use glam::{IVec2, UVec2, Vec2, Vec3, Vec4};

/// A depth texture of any size, values 0 to 1, for comparison. Bound as a `texture_depth_2d`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTexture {
    depths: Texture<f32>,
}

impl DepthTexture {
    /// Creates a texture from its depths, like [`Texture::new`].
    pub fn new(size: UVec2, depths: Vec<f32>) -> Self {
        DepthTexture {
            depths: Texture::new(size, depths),
        }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.depths.size()
    }

    /// All depths, row by row from the top.
    pub fn texels(&self) -> &[f32] {
        self.depths.texels()
    }

    fn at(&self, coord: IVec2) -> f32 {
        self.depths.at(coord, Address::Clamp)
    }

    /// Returns the depth at `coord`, or the nearest one on the border if `coord` is outside.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<f32> {
        self.depths.load(coord)
    }

    /// Returns the share of `uv` that passes the comparison with `reference`: 0 to 1. Coordinates are clamped to the border.
    pub fn compare<P: PerLane<Vec2>>(&self, sampler: &ComparisonSampler, uv: P, reference: P::Of<f32>) -> P::Of<f32> {
        uv.with(reference, |uv, reference| {
            filtered(sampler.filter, uv * self.size().as_vec2(), |coord| {
                sampler.comparison.of(reference, self.at(coord))
            })
        })
    }

    /// Returns 1 or 0 for each of the four texels that a linear filter would weight at `uv`: 1 if it passes the comparison.
    /// In the order lower left, lower right, upper right, upper left.
    pub fn gather_compare<P: PerLane<Vec2>>(
        &self,
        sampler: &ComparisonSampler,
        uv: P,
        reference: P::Of<f32>,
    ) -> P::Of<Vec4> {
        uv.with(reference, |uv, reference| {
            let depths = Sampler::default();
            gather(self.size(), &depths, uv, |coord| {
                sampler.comparison.of(reference, self.at(coord))
            })
        })
    }
}

/// A stack of [`DepthTexture`]s of one size, such as the cascades of a shadow map. Bound as a `texture_depth_2d_array`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTextureArray {
    layers: Vec<DepthTexture>,
}

impl DepthTextureArray {
    /// Creates a stack from its layers. Panics unless there is at least one and all have the same size.
    pub fn new(layers: Vec<DepthTexture>) -> Self {
        assert!(!layers.is_empty(), "a stack needs at least one layer");
        assert!(
            layers.windows(2).all(|pair| pair[0].size() == pair[1].size()),
            "layers of one size"
        );
        DepthTextureArray { layers }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.layers[0].size()
    }

    /// Number of layers.
    pub fn layers(&self) -> usize {
        self.layers.len()
    }

    /// Returns a layer, or the last one if `layer` is out of bounds.
    pub fn layer(&self, layer: usize) -> &DepthTexture {
        &self.layers[layer.min(self.layers.len() - 1)]
    }

    /// Returns the depth of `layer` at `coord`, or the nearest one on the border if `coord` is outside. A layer out of bounds is
    /// the last one.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P, layer: usize) -> P::Of<f32> {
        self.layer(layer).load(coord)
    }

    /// Returns the share of `uv` in `layer` that passes the comparison with `reference`: 0 to 1. A layer out of bounds is the
    /// last one. Coordinates are clamped to the border.
    pub fn compare<P: PerLane<Vec2>>(
        &self,
        sampler: &ComparisonSampler,
        uv: P,
        layer: usize,
        reference: P::Of<f32>,
    ) -> P::Of<f32> {
        self.layer(layer).compare(sampler, uv, reference)
    }
}

/// A cube of depths for comparison: the shadow map of a point light. Bound as a `texture_depth_cube`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthCube {
    faces: [DepthTexture; 6],
}

impl DepthCube {
    /// Creates a cube from its faces, +X, -X, +Y, -Y, +Z, -Z, each with the top row first as in Vulkan and WebGPU. Panics
    /// unless they are square and of one size.
    pub fn new(faces: [DepthTexture; 6]) -> Self {
        let size = faces[0].size();
        assert!(
            size.x == size.y && faces.iter().all(|face| face.size() == size),
            "six square faces of one size"
        );
        DepthCube { faces }
    }

    /// Width and height of a face in texels.
    pub fn size(&self) -> UVec2 {
        self.faces[0].size()
    }

    /// Faces in the order +X, -X, +Y, -Y, +Z, -Z.
    pub fn faces(&self) -> &[DepthTexture; 6] {
        &self.faces
    }

    /// Returns the share of `direction`, of any length but 0, that passes the comparison with `reference`: 0 to 1.
    /// Edges are filtered like those of a [`TextureCube`](super::TextureCube).
    pub fn compare<P: PerLane<Vec3>>(
        &self,
        sampler: &ComparisonSampler,
        direction: P,
        reference: P::Of<f32>,
    ) -> P::Of<f32> {
        direction.with(reference, |direction, reference| {
            sample_cube(self.size().x, sampler.filter, direction, |face, coord| {
                sampler.comparison.of(reference, self.faces[face].at(coord))
            })
        })
    }
}
