//! Everything that can go wrong, as values that name the thing, the place and the way out.

use std::fmt;
use straightline_manifest::Dimension;
use wgpu::TextureFormat;

/// Why a pass could not be made, set or recorded.
///
/// Nothing has been recorded into the caller's encoder when one of these is returned.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The text given as a manifest is not one.
    #[error(transparent)]
    Manifest(#[from] straightline_manifest::Error),

    /// The manifest contradicts itself or asks for something that no shader of this generator needs.
    #[error("manifest of `{kernel}`: {place}: {problem}; generate the shader and its manifest again")]
    BadManifest {
        /// The kernel's name.
        kernel: String,
        /// The part of the manifest, such as ``binding `depth` ``.
        place: String,
        /// What is wrong there.
        problem: String,
    },

    /// The shader is not the one that the manifest describes.
    #[error("shader of `{kernel}` does not fit its manifest: {problem}; use the two files of one generator run")]
    Mismatch {
        /// The kernel's name.
        kernel: String,
        /// Where they differ.
        problem: String,
    },

    /// The WGSL text does not parse, does not validate, or needs something that the device lacks.
    #[error("shader of `{kernel}` was refused: {description}")]
    Shader {
        /// The kernel's name.
        kernel: String,
        /// What naga or wgpu said, with the place in the text where it is known.
        description: String,
    },

    /// Layouts or the pipeline could not be made although shader and manifest agree.
    #[error("pipeline of `{kernel}` could not be made: {description}")]
    Pipeline {
        /// The kernel's name.
        kernel: String,
        /// What wgpu said.
        description: String,
    },

    /// The colour target format asked for cannot be drawn to by this shader on this device.
    #[error("`{kernel}` cannot draw to {format:?}: {reason}")]
    TargetFormat {
        /// The kernel's name.
        kernel: String,
        /// The format asked for.
        format: TextureFormat,
        /// Why not, and what to use.
        reason: String,
    },

    /// The device was created with limits that are too low.
    #[error(
        "`{kernel}` needs {needed} for `{limit}`, but the device was created with {available}: raise it in `DeviceDescriptor::required_limits`"
    )]
    Limit {
        /// The kernel's name.
        kernel: String,
        /// The field of [`wgpu::Limits`].
        limit: &'static str,
        /// What is needed.
        needed: u64,
        /// What the device allows.
        available: u64,
    },

    /// The device was created without a feature.
    #[error(
        "{purpose} needs the device feature `{feature}`: ask for it in `DeviceDescriptor::required_features` where the adapter has it"
    )]
    MissingFeature {
        /// What it is for.
        purpose: &'static str,
        /// The constant of [`wgpu::Features`].
        feature: &'static str,
    },

    /// The device is lost or was destroyed. Nothing that was made from it works any more.
    #[error("the device was lost ({doing}): make a new device, and everything that belongs to it, again")]
    DeviceLost {
        /// What was being done.
        doing: String,
    },

    /// The device has no memory left.
    #[error("out of memory ({doing})")]
    OutOfMemory {
        /// What was being done.
        doing: String,
    },

    /// An input of the kernel was not given.
    #[error("`{kernel}` was not given its input `{name}`; it reads {known}")]
    MissingInput {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
        /// All inputs of the kernel.
        known: Names,
    },

    /// An input was given that the kernel does not have.
    #[error("`{kernel}` has no input `{name}`; it reads {known}")]
    UnknownInput {
        /// The kernel's name.
        kernel: String,
        /// The name that was given.
        name: String,
        /// All inputs of the kernel.
        known: Names,
    },

    /// An input was given twice.
    #[error("`{kernel}` was given its input `{name}` more than once")]
    DuplicateInput {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
    },

    /// The view given for an input cannot be read by the kernel.
    #[error("input `{name}` of `{kernel}`: {problem}")]
    Input {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
        /// What is wrong with the view.
        problem: ViewProblem,
    },

    /// The view given as target cannot be written by the kernel.
    #[error("target of `{kernel}`: {problem}")]
    Target {
        /// The kernel's name.
        kernel: String,
        /// What is wrong with the view.
        problem: ViewProblem,
    },

    /// Each view is fit by itself, but wgpu refuses this combination of them.
    #[error("`{kernel}` cannot run on these views together: {description}")]
    Combination {
        /// The kernel's name.
        kernel: String,
        /// What wgpu said.
        description: String,
    },

    /// A uniform was named that the kernel does not have.
    #[error("`{kernel}` has no uniform `{name}`; it has {known}")]
    UnknownUniform {
        /// The kernel's name.
        kernel: String,
        /// The name that was given.
        name: String,
        /// All uniforms of the kernel.
        known: Names,
    },

    /// A uniform was given a value of another type.
    #[error("uniform `{name}` of `{kernel}` is of type {needed}, but was given a value of type {given}")]
    UniformType {
        /// The kernel's name.
        kernel: String,
        /// The uniform.
        name: String,
        /// Its type, as WGSL spells it.
        needed: String,
        /// The value's type, as WGSL spells it.
        given: String,
    },

    /// A uniform without a default was never set.
    #[error("uniform `{name}` of `{kernel}` has no default: set it with `write_uniform` before encoding")]
    UniformUnset {
        /// The kernel's name.
        kernel: String,
        /// The uniform.
        name: String,
    },

    /// A timer was asked to time more, or less, than it can.
    #[error("a timer can hold 1 to {max} spans, not {asked}")]
    TimerCapacity {
        /// The capacity asked for.
        asked: u32,
        /// The largest there is.
        max: u32,
    },

    /// A timer has no room for another span.
    #[error("the timer's {capacity} spans are used up: call `resolve` once for each encoder, or make a larger timer")]
    TimerFull {
        /// Spans that the timer can hold between two calls of `resolve`.
        capacity: u32,
    },

    /// A timer was read before it was resolved.
    #[error("the timer has nothing to read: call `resolve` after the timed passes, submit, then `read`")]
    TimerNotResolved,

    /// A timer was read before the encoder that resolves it was submitted, or a [`Span`](crate::Span) was not used.
    #[error("the timer's spans have not run: submit the encoder that was given to `resolve`, then `read`")]
    TimerNotSubmitted,

    /// The adapter reports a timestamp period that is no duration.
    #[error("the adapter reports a timestamp period of {period} ns: its timestamps cannot be used")]
    TimerPeriod {
        /// Nanoseconds a tick.
        period: f32,
    },

    /// Reading a timer back failed.
    #[error("reading timestamps back failed: {description}")]
    TimerRead {
        /// What wgpu said.
        description: String,
    },
}

/// What is wrong with a texture view.
///
/// wgpu tells a view's texture but not which part of it the view shows. Sizes, layers and formats are therefore
/// those of the texture; what only the view knows is asked of wgpu, and its answer is [`ViewProblem::Refused`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewProblem {
    /// Not a 2-D texture, or a view of the wrong dimension.
    #[error("needs a view of dimension {}, but was given one of {found}", dimension_name(*.needed))]
    Dimension {
        /// The dimension that is needed.
        needed: Dimension,
        /// What was found.
        found: String,
    },
    /// Multisampled, where one sample a texel is needed.
    #[error("needs a single-sampled texture, but this one has {samples} samples a texel: resolve it first")]
    Multisampled {
        /// Samples a texel.
        samples: u32,
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
    #[error("is {}x{}, but the target is {}x{}: every input has the size of the target", .input[0], .input[1], .target[0], .target[1])]
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
        /// The way out, which differs by stage.
        remedy: &'static str,
    },
    /// The texture was created without a usage.
    #[error("its texture was created without `TextureUsages::{missing}`")]
    Usage {
        /// The constant of [`wgpu::TextureUsages`].
        missing: &'static str,
    },
    /// The same image is read and written.
    #[error("is the target itself, which cannot be read while it is written: use two textures")]
    IsTarget,
    /// Larger than one dispatch can cover with the device's limits.
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
        /// What wgpu said.
        description: String,
    },
}

/// A list of names for a message: `` `a`, `b` and `c` ``, or `none`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names(pub Vec<String>);

impl<'a> FromIterator<&'a str> for Names {
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Self {
        Names(names.into_iter().map(str::to_owned).collect())
    }
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some((last, rest)) = self.0.split_last() else {
            return f.write_str("none");
        };
        for (i, name) in rest.iter().enumerate() {
            write!(f, "{}`{name}`", if i == 0 { "" } else { ", " })?;
        }
        write!(f, "{}`{last}`", if rest.is_empty() { "" } else { " and " })
    }
}

/// A view dimension as WebGPU spells it.
pub(crate) fn dimension_name(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::D2 => "2d",
        Dimension::D2Array => "2d-array (`TextureViewDescriptor::dimension: Some(TextureViewDimension::D2Array)`)",
    }
}
