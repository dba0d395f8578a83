//! Resources that a shader binds: in WebGPU's words, and language by language.

use crate::{BufferType, Dimension, Element, Extent, REGION, SampleType, SamplerType, Scalar, ValueType};
use serde::{Deserialize, Serialize};

/// An input resource. A function ([`Form::Function`](crate::Form::Function)) binds nothing: group and number are those that
/// an entry point would have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Binding {
    /// Bind group.
    pub group: u32,
    /// Binding number in the group.
    pub binding: u32,
    /// The name in the kernel's source, and in the text unless [`LanguageBinding`] says another; of a uniform buffer, which no
    /// kernel names, the generator's.
    pub name: String,
    /// Kind of resource to bind.
    #[serde(flatten)]
    pub kind: BindingKind,
}

impl Binding {
    /// Returns whether this is the rectangle of a shader that filters one: a uniform buffer called [`REGION`], `region_`,
    /// `region_2`, ...
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

/// Kind of resource that a [`Binding`] needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum BindingKind {
    /// A texture.
    Texture {
        /// `view_dimension`, `2d`, `2d-array`, `3d` or `cube`, and `multisampled`.
        #[serde(flatten)]
        dimension: Dimension,
        /// Sample type, in which texels are read.
        sample_type: SampleType,
        /// Components that the kernel uses, 1 to 4. Any format of the sample type with at least as many is accepted.
        components: u8,
        /// Layers that the shader can address; 1 unless it is an array of the output's size. The shader queries the size of
        /// other arrays.
        layers: u32,
        /// Samples of a texel that the shader can address; 1 unless it is multisampled.
        samples: u32,
        /// Size that the texture must have.
        extent: Extent,
    },
    /// A sampler.
    Sampler {
        /// Use of the sampler.
        #[serde(rename = "sampler_type")]
        sampler: SamplerType,
    },
    /// A storage buffer: elements one after the other, at least one, so that `stride` is its least size.
    Buffer {
        /// `read-only-storage`, or `storage` of one that the shader writes to.
        buffer_type: BufferType,
        /// Type of an element: in JSON its type, or of a structure its name.
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

/// Uniforms that the host records into its commands: `var<immediate>` in WGSL, push constants in SPIR-V, GLSL 4.50 and HLSL
/// for Vulkan, root constants in HLSL for Direct3D 12, `setBytes` in Metal. A shader with immediates has the feature
/// `immediates`, and no uniform buffer but that of a region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Immediates {
    /// Name of the variable, as that of a uniform buffer.
    pub name: String,
    /// Size in bytes, a multiple of 16, from offset 0.
    pub size: u32,
    /// The struct's fields in order of offset.
    pub fields: Vec<UniformField>,
}

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
        frame_size: false,
    };
    (0..).zip(["first", "size", "place"]).map(field).collect()
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
    /// For a matrix or an array of the kernel: the part of it that this field holds. Unread parts have no field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Part>,
    /// `true` if the field holds the width and height of the frame: the host sets it to the target's size. A shader has such a
    /// field if it needs that size, and neither a texture nor an output of its own has it.
    #[serde(default, skip_serializing_if = "is_false")]
    pub frame_size: bool,
}

fn is_false(value: &bool) -> bool {
    !value
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
    /// Index of the part, from 0.
    pub index: u32,
}

/// A resource that a shader binds, or a parameter that it takes, in one language.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LanguageBinding {
    /// Target name, as in [`Manifest::files`](crate::Manifest::files).
    pub language: String,
    /// Name in the text.
    pub name: String,
    /// Kind of the resource or parameter in this language.
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
    /// Name of the corresponding [`Binding`], [`Output`](crate::Output), [`Varying`](crate::Varying), or field of a uniform
    /// struct; `None` for items that only this language needs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<String>,
    /// For a combined sampler, the texture; for a function, the name that the texture can have beside it in the text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
    /// For a combined sampler, the sampler. Without one, texels are loaded directly: bind a nearest-texel sampler, and no
    /// smaller levels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampler: Option<String>,
    /// Description of the value to bind, if `of` does not name it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub what: Option<String>,
}

/// Kind of a [`LanguageBinding`] in its language.
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
    /// Uniforms in no buffer, as [`Immediates`]: in `hlsl` at a register, in `msl` at the index of a buffer.
    Immediates,
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
