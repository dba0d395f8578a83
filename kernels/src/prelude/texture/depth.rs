//! Depths, to be compared.

use super::filter::{filtered, gather, sample_cube};
use super::{Address, ComparisonSampler, Sampler, Texture};
use crate::prelude::quad::PerLane;
use glam::{IVec2, UVec2, Vec2, Vec3, Vec4};

/// Depths of any size, 0 to 1, to be compared. Bound as a `texture_depth_2d`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTexture {
    depths: Texture<f32>,
}

impl DepthTexture {
    /// Depths from rows, as [`Texture::new`].
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

    /// The depth at `coord`, or the nearest one on the border if `coord` lies outside.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<f32> {
        self.depths.load(coord)
    }

    /// How much of what lies at `uv` passes the comparison with `reference`: 0 to 1. Beyond the border lie its texels.
    pub fn compare<P: PerLane<Vec2>>(&self, sampler: &ComparisonSampler, uv: P, reference: P::Of<f32>) -> P::Of<f32> {
        uv.with(reference, |uv, reference| {
            filtered(sampler.filter, uv * self.size().as_vec2(), |coord| {
                sampler.comparison.of(reference, self.at(coord))
            })
        })
    }

    /// Which of the four texels that a linear filter would weigh at `uv` pass the comparison, 1 or 0 each: lower left,
    /// lower right, upper right, upper left.
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

/// A stack of [`DepthTexture`]s of one size: the cascades of a shadow map, say. Bound as a `texture_depth_2d_array`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTextureArray {
    layers: Vec<DepthTexture>,
}

impl DepthTextureArray {
    /// A stack from its layers. Panics unless there is at least one and all have the same size.
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

    /// A layer, the last one beyond the end.
    pub fn layer(&self, layer: usize) -> &DepthTexture {
        &self.layers[layer.min(self.layers.len() - 1)]
    }

    /// The depth of `layer` at `coord`, or the nearest one on the border if `coord` lies outside; of the last layer beyond the
    /// end.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P, layer: usize) -> P::Of<f32> {
        self.layer(layer).load(coord)
    }

    /// How much of what lies at `uv` in `layer`, the last one beyond the end, passes the comparison with `reference`: 0 to 1.
    /// Beyond the border lie its texels.
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

/// Depths around a point, to be compared: the shadow map of a point light. Bound as a `texture_depth_cube`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthCube {
    faces: [DepthTexture; 6],
}

impl DepthCube {
    /// A cube from its faces, +X, -X, +Y, -Y, +Z, -Z, each with the upper row first as Vulkan and WebGPU have it. Panics
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

    /// The faces, +X, -X, +Y, -Y, +Z, -Z.
    pub fn faces(&self) -> &[DepthTexture; 6] {
        &self.faces
    }

    /// How much of what lies in `direction`, which may have any length but 0, passes the comparison with `reference`: 0 to 1.
    /// Edges are filtered as those of a [`TextureCube`](super::TextureCube).
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
