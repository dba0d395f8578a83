//! Problems of single resources.

use straightline_manifest::{Dimension, SamplerType};
use wgpu::TextureFormat;

/// Reason why a texture view cannot be bound.
///
/// wgpu exposes a view's texture but not the part of it that the view shows. Sizes, layers and formats are therefore those
/// of the texture; everything else is left to wgpu's check, whose error becomes [`ViewProblem::Refused`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewProblem {
    /// A texture or a view of the wrong dimension.
    #[error("needs a view of dimension {}, but was given one of {found}", dimension_name(*.needed))]
    Dimension {
        /// The dimension that is needed.
        needed: Dimension,
        /// The dimension found.
        found: String,
    },
    /// Multisampled, where one sample a texel is needed.
    #[error("needs a single-sampled texture, but this one has {samples} samples a texel: resolve it first")]
    Multisampled {
        /// Samples a texel.
        samples: u32,
    },
    /// Single-sampled, where several samples a texel are needed.
    #[error(
        "needs a multisampled texture with {needed} samples a texel, but this one has a single sample: give it the texture that is drawn to, before it is resolved"
    )]
    SingleSampled {
        /// Samples that the shader can address.
        needed: u32,
    },
    /// Too few samples.
    #[error(
        "needs {needed} samples a texel, but the texture has {found}: raise `TextureDescriptor::sample_count`, or generate the shader for {found}"
    )]
    Samples {
        /// Samples that the shader can address.
        needed: u32,
        /// Samples of the texture.
        found: u32,
    },
    /// Too few layers.
    #[error("needs {needed} layers, but the texture has {found}")]
    Layers {
        /// Layers that the shader can address.
        needed: u32,
        /// Layers of the texture.
        found: u32,
    },
    /// Not of the target's size.
    #[error("is {}x{}, but the target is {}x{}: this input has the size of the target", .input[0], .input[1], .target[0], .target[1])]
    Size {
        /// Width and height of the input.
        input: [u32; 2],
        /// Width and height of the target.
        target: [u32; 2],
    },
    /// An integer, stencil or multi-planar format.
    #[error("is {format:?}, which cannot be read as floats: use a float, normalised or depth format")]
    NotFloat {
        /// The texture's format.
        format: TextureFormat,
    },
    /// A format of other numbers, where integers are read.
    #[error("is {format:?}, but the kernel reads {needed} integers: use a format such as {example:?}")]
    NotInteger {
        /// The texture's format.
        format: TextureFormat,
        /// `signed` or `unsigned`.
        needed: &'static str,
        /// A format that fits.
        example: TextureFormat,
    },
    /// The faces of a cube are not square.
    #[error("is {}x{}, but the faces of a cube are square", .size[0], .size[1])]
    NotSquare {
        /// Width and height.
        size: [u32; 2],
    },
    /// A format without depth, where depths are compared.
    #[error("is {format:?}, but the kernel reads a depth: use a depth format")]
    NotDepth {
        /// The texture's format.
        format: TextureFormat,
    },
    /// A depth format, where a sampler filters.
    #[error(
        "is {format:?}, but the kernel filters it and a depth cannot be filtered: generate the shader with a nearest read or a comparison, or use a float or normalised format"
    )]
    DepthFiltered {
        /// The texture's format.
        format: TextureFormat,
    },
    /// A float format that this device cannot filter, where a sampler filters.
    #[error(
        "is {format:?}, which this device cannot filter: use a 16-bit or normalised format, or ask for the device feature `FLOAT32_FILTERABLE` in `DeviceDescriptor::required_features` where the adapter has it"
    )]
    NotFilterable {
        /// The texture's format.
        format: TextureFormat,
    },
    /// Fewer components than the kernel reads.
    #[error("is {format:?} with {found} component(s), but the kernel reads {needed}")]
    Components {
        /// The texture's format.
        format: TextureFormat,
        /// Components that the kernel reads.
        needed: u8,
        /// Components of the format.
        found: u8,
    },
    /// Not of the format that the shader writes.
    #[error("is {found:?}, but the shader writes {needed:?}: {remedy}")]
    Format {
        /// The format that is needed.
        needed: TextureFormat,
        /// The texture's format.
        found: TextureFormat,
        /// Advice, which differs by stage.
        remedy: &'static str,
    },
    /// The texture was created without a usage.
    #[error("its texture was created without `TextureUsages::{missing}`")]
    Usage {
        /// The constant of [`wgpu::TextureUsages`].
        missing: &'static str,
    },
    /// Size different from the first target's.
    #[error("is {}x{}, but the first target is {}x{}: all targets have one size", .size[0], .size[1], .first[0], .first[1])]
    TargetSize {
        /// Width and height of the target.
        size: [u32; 2],
        /// Width and height of the first one.
        first: [u32; 2],
    },
    /// Image given for two targets.
    #[error("is the target `{other}` too: give each a texture of its own")]
    IsOtherTarget {
        /// The other target.
        other: String,
    },
    /// Image both read and written.
    #[error("is the target itself, which cannot be read while it is written: use two textures")]
    IsTarget,
    /// Larger than one dispatch can cover within the device's limits.
    #[error(
        "is {size} texels along one side, but the device dispatches at most {max}: raise `max_compute_workgroups_per_dimension`"
    )]
    TooLarge {
        /// Texels along the longer side.
        size: u32,
        /// Texels that a dispatch can cover.
        max: u32,
    },
    /// wgpu refuses the view.
    #[error("wgpu refuses the view: {description}")]
    Refused {
        /// wgpu's message.
        description: String,
    },
}

/// Reason why a sampler cannot be bound.
///
/// wgpu does not expose a sampler's kind; the sampler is bound on trial, and the error is read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SamplerProblem {
    /// A comparison sampler where a filtering one is needed, or vice versa.
    #[error("{}", sampler_type_advice(*.needed))]
    Type {
        /// Sampler type that the kernel needs.
        needed: SamplerType,
    },
    /// wgpu refuses the sampler.
    #[error("wgpu refuses the sampler: {description}")]
    Refused {
        /// wgpu's message.
        description: String,
    },
}

/// Reason why a storage buffer cannot be bound. Storage buffers are bound whole.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BufferProblem {
    /// The buffer was created without a usage.
    #[error("the buffer was created without `BufferUsages::{missing}`")]
    Usage {
        /// The constant of [`wgpu::BufferUsages`].
        missing: &'static str,
    },
    /// Too small for a single element.
    #[error("the buffer has {size} bytes, but one element takes {stride}: give it at least one element")]
    TooSmall {
        /// Bytes of the buffer.
        size: u64,
        /// Bytes from one element to the next.
        stride: u32,
    },
    /// Larger than the device can bind.
    #[error(
        "the buffer has {size} bytes, but the device binds at most {max}: raise `max_storage_buffer_binding_size` in `DeviceDescriptor::required_limits`"
    )]
    TooLarge {
        /// Bytes of the buffer.
        size: u64,
        /// Bytes that the device can bind.
        max: u64,
    },
    /// A size that cannot be bound as a whole.
    #[error("the buffer has {size} bytes, not a multiple of 4: round its size up")]
    Unaligned {
        /// Bytes of the buffer.
        size: u64,
    },
    /// The kernel writes it and was given it under another name, too.
    #[error("the kernel writes it, and it is given as `{other}` too: give each a buffer of its own")]
    IsOther {
        /// The other name.
        other: String,
    },
    /// wgpu refuses the buffer.
    #[error("wgpu refuses the buffer: {description}")]
    Refused {
        /// wgpu's message.
        description: String,
    },
}

/// A view dimension as WebGPU spells it.
fn dimension_name(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::D2 => "2d",
        Dimension::D2Array => "2d-array (`TextureViewDescriptor::dimension: Some(TextureViewDimension::D2Array)`)",
        Dimension::D3 => "3d",
        Dimension::Cube => "cube (`TextureViewDescriptor::dimension: Some(TextureViewDimension::Cube)`)",
        Dimension::D2Multisampled => "2d with several samples a texel",
    }
}

fn sampler_type_advice(needed: SamplerType) -> &'static str {
    match needed {
        SamplerType::Filtering => {
            "needs a filtering sampler, but was given a comparison sampler: leave `SamplerDescriptor::compare` at `None`"
        }
        SamplerType::NonFiltering => {
            "needs a sampler that takes the nearest texel: leave `SamplerDescriptor::compare` at `None` and its filters at `FilterMode::Nearest`"
        }
        SamplerType::Comparison => {
            "needs a comparison sampler, but was given a filtering sampler: set `SamplerDescriptor::compare`"
        }
    }
}
