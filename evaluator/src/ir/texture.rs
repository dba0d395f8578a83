//! Textures: their kinds, and how each is addressed.

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
    /// The six faces of a cube, addressed by a direction.
    Cube,
    /// A single image with several samples per texel.
    Multisampled,
    /// A single image of depths for comparison.
    Depth,
    /// A stack of images of depths for comparison.
    DepthLayers,
    /// Six faces of depths for comparison.
    DepthCube,
}

impl TextureKind {
    /// Every kind, with its name in the text of a graph.
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

    /// Name in the text of a graph.
    pub fn ir_name(self) -> &'static str {
        let found = TextureKind::ALL.iter().find(|(kind, _)| *kind == self);
        found.expect("every kind is listed").1
    }

    /// Returns whether a layer or sample is part of a texel's address.
    pub fn is_indexed(self) -> bool {
        self.has_layers() || self == TextureKind::Multisampled
    }

    /// Returns whether the texture is a stack of images.
    pub fn has_layers(self) -> bool {
        matches!(self, TextureKind::Layers | TextureKind::DepthLayers)
    }

    /// Returns whether the texels are depths for comparison.
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

    /// Returns whether a sampler can filter the texture.
    pub fn is_filtered(self) -> bool {
        !self.is_depth() && self != TextureKind::Multisampled
    }

    /// Returns whether the rows are those of an image, which some hosts count from below.
    pub fn has_rows(self) -> bool {
        !self.is_cube() && self != TextureKind::Volume
    }

    /// Number of components of a size and of a texel's coordinate, without a layer.
    pub fn dimension_count(self) -> u8 {
        if self == TextureKind::Volume { 3 } else { 2 }
    }

    /// Type of a position for a sampler: two or three floats.
    pub fn position_type(self) -> Type {
        let three = self.is_cube() || self == TextureKind::Volume;
        Type::value(Scalar::F32, if three { 3 } else { 2 })
    }

    /// Type of a texel's coordinate, and of a size, in the graph.
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
    /// Kind of a texel's components: float or integer. Samplers cannot read integers.
    pub scalar: Scalar,
    /// Components of a texel that the kernel uses, 1 to 4.
    pub components: u8,
    /// Components of a texel by its type in the kernel, 1 to 4. With fewer than 3, the texture holds data rather than a
    /// colour.
    pub declared: u8,
    /// `true` if the texture has the output's size, `false` if it has its own.
    pub framed: bool,
}

impl Texture {
    /// Type of a texel in the kernel.
    pub fn texel_type(&self) -> Type {
        Type::value(self.scalar, self.components)
    }

    /// Returns whether the largest index that is read determines the required number of layers, or of samples per texel.
    /// For other textures the number is queried.
    pub fn is_counted(&self) -> bool {
        self.kind == TextureKind::Multisampled || (self.framed && self.kind == TextureKind::Layers)
    }
}
