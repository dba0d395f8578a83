//! Words that a manifest and a plan share: kinds of resources as WebGPU calls them.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A pipeline stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "kebab-case"))]
pub enum Stage {
    /// A compute shader: one invocation a pixel, result through a storage texture.
    Compute,
    /// A fragment shader: one fragment a pixel, result at colour location 0. The host draws a triangle over the target.
    Fragment,
}

impl Stage {
    /// `compute` or `fragment`.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Compute => "compute",
            Stage::Fragment => "fragment",
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Stage {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "compute" => Ok(Stage::Compute),
            "fragment" => Ok(Stage::Fragment),
            _ => Err(format!("unknown stage `{text}`: compute or fragment")),
        }
    }
}

/// Name of the uniform buffer of a shader that filters a rectangle of the image: its fields are `first`, `size` and
/// `place`, each `vec2i`. Where the kernel has a use for the name it is followed by an underscore or a number: `region_`,
/// `region_2`.
pub const REGION: &str = "region";

/// Size in bytes of the uniform buffer [`REGION`].
pub const REGION_SIZE: u32 = 32;

/// Type of a buffer binding, in the words of WebGPU's `GPUBufferBindingType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "kebab-case"))]
pub enum BufferType {
    /// `uniform`.
    Uniform,
    /// `read-only-storage`.
    ReadOnlyStorage,
    /// `storage`: the shader writes to it.
    Storage,
}

/// Access to a storage texture, in the words of WebGPU's `GPUStorageTextureAccess`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "kebab-case"))]
pub enum Access {
    /// `read-only`.
    ReadOnly,
    /// `write-only`.
    WriteOnly,
}

/// Dimension of a texture view, in the words of WebGPU's `GPUTextureViewDimension`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub enum ViewDimension {
    /// `2d`.
    #[cfg_attr(feature = "json", serde(rename = "2d"))]
    D2,
    /// `2d-array`.
    #[cfg_attr(feature = "json", serde(rename = "2d-array"))]
    D2Array,
    /// `3d`.
    #[cfg_attr(feature = "json", serde(rename = "3d"))]
    D3,
    /// `cube`: six layers, +X, -X, +Y, -Y, +Z, -Z.
    #[cfg_attr(feature = "json", serde(rename = "cube"))]
    Cube,
}

/// Shape of a texture. In JSON two fields, as WebGPU has them: `view_dimension` and `multisampled`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "json",
    derive(Serialize, Deserialize),
    serde(into = "Shape", try_from = "Shape")
)]
pub enum Dimension {
    /// A single 2-D image.
    D2,
    /// A stack of 2-D images.
    D2Array,
    /// A volume.
    D3,
    /// Six square 2-D images around a point.
    Cube,
    /// A single 2-D image with several samples a texel.
    D2Multisampled,
}

impl Dimension {
    /// Dimension of the view that is bound.
    pub fn view(self) -> ViewDimension {
        match self {
            Dimension::D2 | Dimension::D2Multisampled => ViewDimension::D2,
            Dimension::D2Array => ViewDimension::D2Array,
            Dimension::D3 => ViewDimension::D3,
            Dimension::Cube => ViewDimension::Cube,
        }
    }

    /// Returns whether a texel has several samples.
    pub fn is_multisampled(self) -> bool {
        self == Dimension::D2Multisampled
    }
}

/// Sample type of a texture, which decides the formats that fit, in the words of WebGPU's `GPUTextureSampleType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize))]
pub enum SampleType {
    /// `unfilterable-float`: one by one; any float, normalised or depth format.
    #[cfg_attr(feature = "json", serde(rename = "unfilterable-float"))]
    Unfilterable,
    /// `float`: by a filtering sampler too; any float or normalised format that the device can filter.
    #[cfg_attr(feature = "json", serde(rename = "float"))]
    Filterable,
    /// `depth`: by a comparison sampler, or one by one from a `texture_depth_2d`; a depth format.
    #[cfg_attr(feature = "json", serde(rename = "depth"))]
    Depth,
    /// `sint`: one by one; a format of signed integers, whose bits arrive as they are.
    #[cfg_attr(feature = "json", serde(rename = "sint"))]
    Sint,
    /// `uint`: one by one; a format of unsigned integers, whose bits arrive as they are.
    #[cfg_attr(feature = "json", serde(rename = "uint"))]
    Uint,
}

/// Use of a sampler, in the words of WebGPU's `GPUSamplerBindingType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "kebab-case"))]
pub enum SamplerType {
    /// To filter.
    Filtering,
    /// To gather texels as they are: give it one that takes the nearest texel and clamps to the edge.
    NonFiltering,
    /// To compare with a reference depth.
    Comparison,
}

/// Size that a texture must have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "kebab-case"))]
pub enum Extent {
    /// That of the output.
    Output,
    /// Any: the shader asks for it.
    Any,
}

#[cfg(feature = "json")]
#[derive(Serialize, Deserialize)]
struct Shape {
    view_dimension: ViewDimension,
    multisampled: bool,
}

#[cfg(feature = "json")]
impl From<Dimension> for Shape {
    fn from(dimension: Dimension) -> Shape {
        Shape {
            view_dimension: dimension.view(),
            multisampled: dimension.is_multisampled(),
        }
    }
}

#[cfg(feature = "json")]
impl TryFrom<Shape> for Dimension {
    type Error = &'static str;

    fn try_from(shape: Shape) -> Result<Dimension, &'static str> {
        match (shape.view_dimension, shape.multisampled) {
            (ViewDimension::D2, false) => Ok(Dimension::D2),
            (ViewDimension::D2Array, false) => Ok(Dimension::D2Array),
            (ViewDimension::D2, true) => Ok(Dimension::D2Multisampled),
            (ViewDimension::D3, false) => Ok(Dimension::D3),
            (ViewDimension::Cube, false) => Ok(Dimension::Cube),
            (_, true) => Err("a texture is multisampled and not 2d, which WebGPU does not have"),
        }
    }
}
