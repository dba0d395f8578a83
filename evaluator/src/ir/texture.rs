//! Textures: what kinds there are, and how each is addressed.

use super::{Scalar, Type};

/// Kind of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureKind {
    /// A single image.
    Flat,
    /// A stack of images.
    Layers,
    /// A volume.
    Volume,
    /// The six faces of a cube, which a direction finds.
    Cube,
    /// A single image with several samples a texel.
    Multisampled,
    /// A single image of depths to compare.
    Depth,
    /// A stack of images of depths to compare.
    DepthLayers,
    /// Six faces of depths to compare.
    DepthCube,
}

impl TextureKind {
    /// Every kind, with the word for it in the text of a graph.
    pub const ALL: [(TextureKind, &'static str); 8] = [
        (TextureKind::Flat, "flat"),
        (TextureKind::Layers, "layers"),
        (TextureKind::Volume, "volume"),
        (TextureKind::Cube, "cube"),
        (TextureKind::Multisampled, "multisampled"),
        (TextureKind::Depth, "depth"),
        (TextureKind::DepthLayers, "depthlayers"),
        (TextureKind::DepthCube, "depthcube"),
    ];

    /// The word for it in the text of a graph.
    pub fn ir_name(self) -> &'static str {
        let found = TextureKind::ALL.iter().find(|(kind, _)| *kind == self);
        found.expect("every kind is listed").1
    }

    /// Returns whether a layer or sample is part of a texel's address.
    pub fn is_indexed(self) -> bool {
        self.has_layers() || self == TextureKind::Multisampled
    }

    /// Returns whether it is a stack of images.
    pub fn has_layers(self) -> bool {
        matches!(self, TextureKind::Layers | TextureKind::DepthLayers)
    }

    /// Returns whether its texels are depths, to be compared.
    pub fn is_depth(self) -> bool {
        matches!(
            self,
            TextureKind::Depth | TextureKind::DepthLayers | TextureKind::DepthCube
        )
    }

    /// Returns whether texels are addressed by a direction, not by coordinates.
    pub fn is_cube(self) -> bool {
        matches!(self, TextureKind::Cube | TextureKind::DepthCube)
    }

    /// Returns whether a sampler can filter it.
    pub fn is_filtered(self) -> bool {
        !self.is_depth() && self != TextureKind::Multisampled
    }

    /// Returns whether its rows are those of a picture, which some hosts count from below.
    pub fn has_rows(self) -> bool {
        !self.is_cube() && self != TextureKind::Volume
    }

    /// Components of a size and of a texel's coordinate, without a layer.
    pub fn dimension_count(self) -> u8 {
        if self == TextureKind::Volume { 3 } else { 2 }
    }

    /// A place that a sampler reads at: two or three floats.
    pub fn position_type(self) -> Type {
        let three = self.is_cube() || self == TextureKind::Volume;
        Type::value(Scalar::F32, if three { 3 } else { 2 })
    }

    /// A texel's coordinate, and a size, as the graph has them.
    pub fn coordinate_type(self) -> Type {
        Type::value(Scalar::I32, self.dimension_count())
    }
}

/// A texture that the kernel reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Name in the kernel.
    pub name: String,
    /// Kind of the texture.
    pub kind: TextureKind,
    /// Kind of a texel's components: float, or integer, which no sampler reads.
    pub scalar: Scalar,
    /// Components of a texel that the kernel uses, 1 to 4.
    pub components: u8,
    /// Components of a texel by its type in the kernel, 1 to 4: data rather than a colour below 3.
    pub declared: u8,
    /// `true` if it has the output's size, `false` if it has its own.
    pub framed: bool,
}

impl Texture {
    /// A texel as the kernel has it.
    pub fn texel_type(&self) -> Type {
        Type::value(self.scalar, self.components)
    }

    /// Returns whether the largest index that is read determines the required number of layers, or samples of a texel. The number of other
    /// textures is queried.
    pub fn is_counted(&self) -> bool {
        self.kind == TextureKind::Multisampled || (self.framed && self.kind == TextureKind::Layers)
    }
}
