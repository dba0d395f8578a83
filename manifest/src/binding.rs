//! What a shader binds: in WebGPU's words, and language by language.

use crate::{Element, Scalar, ValueType};
use serde::{Deserialize, Serialize};

/// One input resource. Of a function ([`Form::Function`](crate::Form::Function)) nothing is bound: group and number are those
/// that the entry point would have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Binding {
    /// Bind group.
    pub group: u32,
    /// Binding number in the group.
    pub binding: u32,
    /// The name in the kernel's source, and in the text unless [`LanguageBinding`] says another; of a uniform buffer, which no
    /// kernel names, the generator's.
    pub name: String,
    /// What must be bound.
    #[serde(flatten)]
    pub kind: BindingKind,
}

impl Binding {
    /// Whether it is the rectangle of a shader that filters one: a uniform buffer called [`REGION`], `region_`, `region_2`, ...
    pub fn is_region(&self) -> bool {
        let is_mark = |rest: &str| {
            rest.is_empty()
                || rest
                    .strip_prefix('_')
                    .is_some_and(|number| number.bytes().all(|b| b.is_ascii_digit()))
        };
        // No kernel names a uniform buffer.
        matches!(self.kind, BindingKind::Uniform { .. }) && self.name.strip_prefix(REGION).is_some_and(is_mark)
    }
}

/// What must be bound at a [`Binding`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum BindingKind {
    /// A texture.
    Texture {
        /// `view_dimension`, `2d`, `2d-array`, `3d` or `cube`, and `multisampled`.
        #[serde(flatten)]
        dimension: Dimension,
        /// How texels are read.
        sample_type: SampleType,
        /// Components that the kernel uses, 1 to 4. Any format of the sample type with at least as many will do.
        components: u8,
        /// Layers that the shader can address; 1 unless it is an array of the output's size: of other arrays the shader asks how
        /// many there are.
        layers: u32,
        /// Samples of a texel that the shader can address; 1 unless it is multisampled.
        samples: u32,
        /// Which size it must have.
        extent: Extent,
    },
    /// A sampler.
    Sampler {
        /// What it is used for.
        #[serde(rename = "sampler_type")]
        sampler: SamplerType,
    },
    /// A storage buffer: elements one after the other, at least one, so that `stride` is its least size.
    Buffer {
        /// `read-only-storage`, or `storage` of one that the shader writes to.
        buffer_type: BufferType,
        /// What an element is: in JSON its type, or of a structure its name.
        element: Element,
        /// Bytes from one element to the next.
        stride: u32,
        /// Fields of a structure in order of offset; none of other elements.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        fields: Vec<UniformField>,
    },
    /// A uniform buffer.
    Uniform {
        /// Always `uniform`.
        buffer_type: BufferType,
        /// Size of the buffer in bytes, a multiple of 16.
        size: u32,
        /// The struct's fields in order of offset.
        fields: Vec<UniformField>,
    },
}

/// Name of the uniform buffer of a shader that filters a rectangle of the image: see [`region_fields`]. Where the kernel has a
/// use for the name it is followed by an underscore or a number: see [`Binding::is_region`].
pub const REGION: &str = "region";

/// Fields of the uniform buffer [`REGION`]: the rectangle's upper left pixel in the inputs, its size, and its upper left
/// pixel in the target.
pub fn region_fields() -> Vec<UniformField> {
    let field = |(k, name): (u32, &str)| UniformField {
        name: name.to_owned(),
        ty: ValueType::of(Scalar::I32, 2),
        offset: 8 * k,
        size: 8,
        default: None,
        part: None,
    };
    (0..).zip(["first", "size", "place"]).map(field).collect()
}

/// Size in bytes of the uniform buffer [`REGION`].
pub const REGION_SIZE: u32 = 32;

/// How a buffer is bound, in the words of WebGPU's `GPUBufferBindingType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BufferType {
    /// `uniform`.
    Uniform,
    /// `read-only-storage`.
    ReadOnlyStorage,
    /// `storage`: the shader writes to it.
    Storage,
}

/// How a storage texture is accessed, in the words of WebGPU's `GPUStorageTextureAccess`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Access {
    /// `read-only`.
    ReadOnly,
    /// `write-only`.
    WriteOnly,
}

/// Dimension of a texture view, in the words of WebGPU's `GPUTextureViewDimension`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ViewDimension {
    /// `2d`.
    #[serde(rename = "2d")]
    D2,
    /// `2d-array`.
    #[serde(rename = "2d-array")]
    D2Array,
    /// `3d`.
    #[serde(rename = "3d")]
    D3,
    /// `cube`: six layers, +X, -X, +Y, -Y, +Z, -Z.
    #[serde(rename = "cube")]
    Cube,
}

/// Shape of a texture. In JSON two fields, as WebGPU has them: `view_dimension` and `multisampled`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "Shape", try_from = "Shape")]
pub enum Dimension {
    /// One 2-D image.
    D2,
    /// A stack of 2-D images.
    D2Array,
    /// A volume.
    D3,
    /// Six square 2-D images around a point.
    Cube,
    /// One 2-D image with several samples a texel.
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

    /// Whether a texel has several samples.
    pub fn is_multisampled(self) -> bool {
        self == Dimension::D2Multisampled
    }
}

#[derive(Serialize, Deserialize)]
struct Shape {
    view_dimension: ViewDimension,
    multisampled: bool,
}

impl From<Dimension> for Shape {
    fn from(dimension: Dimension) -> Shape {
        Shape {
            view_dimension: dimension.view(),
            multisampled: dimension.is_multisampled(),
        }
    }
}

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

/// How the texels of a texture are read, which decides the formats that fit, in the words of WebGPU's `GPUTextureSampleType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SampleType {
    /// `unfilterable-float`: one by one; any float, normalised or depth format.
    #[serde(rename = "unfilterable-float")]
    Unfilterable,
    /// `float`: by a filtering sampler too; any float or normalised format that the device can filter.
    #[serde(rename = "float")]
    Filterable,
    /// `depth`: by a comparison sampler, or one by one from a `texture_depth_2d`; a depth format.
    #[serde(rename = "depth")]
    Depth,
    /// `sint`: one by one; a format of signed integers, whose bits arrive as they are.
    #[serde(rename = "sint")]
    Sint,
    /// `uint`: one by one; a format of unsigned integers, whose bits arrive as they are.
    #[serde(rename = "uint")]
    Uint,
}

/// What a sampler is used for, in the words of WebGPU's `GPUSamplerBindingType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SamplerType {
    /// To filter.
    Filtering,
    /// To gather texels as they are: give it one that takes the nearest texel and clamps to the edge.
    NonFiltering,
    /// To compare with a reference depth.
    Comparison,
}

/// Which size a texture must have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Extent {
    /// That of the output.
    Output,
    /// Any: the shader asks for it.
    Any,
}

/// A field of a uniform struct, or of the elements of a buffer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UniformField {
    /// Name in the kernel's source.
    pub name: String,
    /// A number or a vector; in elements of buffers an array of these too.
    #[serde(rename = "type")]
    pub ty: ValueType,
    /// Byte offset from the start of the buffer, or of the element.
    pub offset: u32,
    /// Size in bytes.
    pub size: u32,
    /// Value to use unless the caller sets one, where the kernel states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub default: Option<f64>,
    /// Of a matrix or an array that the kernel takes: which part of it this field is. Parts that are not read have no field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Part>,
}

/// A part of a value that has no field of its own: a column of a matrix, or an element of an array.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Name of the whole in the kernel's source.
    pub of: String,
    /// Type of the whole.
    #[serde(rename = "type")]
    pub ty: ValueType,
    /// Which part, from 0.
    pub index: u32,
}

/// What a shader binds, or takes as a parameter, in one language.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LanguageBinding {
    /// Target name, as in [`Manifest::files`](crate::Manifest::files).
    pub language: String,
    /// Name in the text.
    pub name: String,
    /// What it is there.
    pub kind: LanguageKind,
    /// Descriptor set: `glsl450` only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub group: Option<u32>,
    /// Binding number in the set; in the languages of OpenGL the unit of a sampler or image, or the binding point of a buffer;
    /// of `msl` the index among textures, samplers or buffers. Without one, it is bound by name, or a parameter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub binding: Option<u32>,
    /// Register of `hlsl`: `t0`, `s1`, `b2`, `u3`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub register: Option<String>,
    /// Register space of `hlsl`, where it is not 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<u32>,
    /// Location of a value that is interpolated, where the language numbers it; of `hlsl` the index of `TEXCOORD`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub location: Option<u32>,
    /// Name of what it stands for: of a [`Binding`], of [`Output`](crate::Output), of a [`Varying`](crate::Varying), or of a
    /// field of a uniform struct. Not of what this language alone needs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// Of a combined sampler, the texture; of a function, the name that the texture can have beside it in the text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
    /// Of a combined sampler, the sampler; without one it is read texel by texel: give it a sampler for the nearest texel, and
    /// no smaller levels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampler: Option<String>,
    /// What is to be given, in words, where `of` does not tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub what: Option<String>,
}

/// What a [`LanguageBinding`] is in its language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LanguageKind {
    /// A texture without a sampler.
    Texture,
    /// A sampler without a texture.
    Sampler,
    /// A texture together with a sampler.
    CombinedSampler,
    /// A storage buffer.
    StorageBuffer,
    /// A uniform buffer.
    UniformBuffer,
    /// A uniform that lies in no buffer, or a number that is a parameter.
    Uniform,
    /// A member of the uniform buffer, listed where it has another name in the text.
    Member,
    /// The image that is written.
    StorageTexture,
    /// A function of the host's that reads a texture: it stands before the shader's.
    Function,
    /// A value that is interpolated.
    Varying,
    /// The position of the fragment, in pixels from the origin: of a function, a parameter.
    Position,
}
