//! All errors, as values that name the item, the place and the remedy.

mod chain;
mod names;
mod problem;

use crate::plan::OverrideType;
use crate::{OverrideValue, Region, ResourceKind};
use wgpu::TextureFormat;

pub use chain::ChainProblem;
pub use names::Names;
pub use problem::{BufferProblem, SamplerProblem, ViewProblem};

/// Reason why a pass could not be created, set or recorded.
///
/// Nothing has been recorded into the caller's encoder when one of these is returned.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The text given as a manifest is not one.
    #[cfg(feature = "manifest")]
    #[error(transparent)]
    Manifest(#[from] straightline_manifest::Error),

    /// The kernel was refused by the generator.
    #[cfg(feature = "reload")]
    #[error("{message}")]
    Generate {
        /// The generator's message, in rustc's form, with its place in the file.
        message: String,
    },

    /// A kernel that was changed binds other resources than before.
    #[cfg(feature = "reload")]
    #[error("`{kernel}` was changed and binds other resources: {change}; restart the program for this change")]
    Changed {
        /// The kernel's name.
        kernel: String,
        /// The first difference, such as ``input `mask` is new``.
        change: String,
    },

    /// A binding was to be renewed that belongs to another pass.
    #[cfg(feature = "reload")]
    #[error("a binding of `{bound}` was given to renew, and it was not made by the `Reloading` of `{kernel}`")]
    NotOurs {
        /// The kernel that is reloaded.
        kernel: String,
        /// The kernel of the binding.
        bound: String,
    },

    /// The manifest contradicts itself or describes something that no shader of this generator needs.
    #[error("manifest of `{kernel}`: {place}: {problem}; generate the shader and its manifest again")]
    BadManifest {
        /// The kernel's name.
        kernel: String,
        /// The part of the manifest, such as ``binding `depth` ``.
        place: String,
        /// Description of the error.
        problem: String,
    },

    /// The shader is not the one that the manifest describes.
    #[error("shader of `{kernel}` does not fit its manifest: {problem}; use the two files of one generator run")]
    Mismatch {
        /// The kernel's name.
        kernel: String,
        /// Description of the difference.
        problem: String,
    },

    /// The WGSL text differs from the one that the manifest was written for: edited, or from another run of the generator.
    #[error(
        "shader of `{kernel}` is not the text that its manifest was written with: hash {found}, where the manifest has {wanted}; use the \
         two files of one generator run, or take `hashes` out of the manifest of a text that you changed"
    )]
    Hash {
        /// The kernel's name.
        kernel: String,
        /// The manifest's hash of the text.
        wanted: String,
        /// Hash of the given text.
        found: String,
    },

    /// The WGSL text does not parse, does not validate, or needs something that the device lacks.
    #[error("shader of `{kernel}` was refused: {description}")]
    Shader {
        /// The kernel's name.
        kernel: String,
        /// Message of naga or wgpu, with the place in the text where it is known.
        description: String,
    },

    /// Loops were to go without wgpu's bound, and the text does not show that all of them end.
    #[error("loops of `{kernel}` cannot go without a bound: {problem}; leave `unbounded_loops` out")]
    UnboundedLoop {
        /// The kernel's name.
        kernel: String,
        /// Description of the first loop that is not shown to end.
        problem: String,
    },

    /// Layouts or the pipeline could not be made although shader and manifest agree.
    #[error("pipeline of `{kernel}` could not be made: {description}")]
    Pipeline {
        /// The kernel's name.
        kernel: String,
        /// wgpu's message.
        description: String,
    },

    /// The caller's vertex shader does not compile or has no such entry point.
    #[error("the vertex shader that `{kernel}` is to be drawn behind was refused: {description}")]
    VertexShader {
        /// The kernel's name.
        kernel: String,
        /// Message of naga or wgpu, with the place in the text where it is known.
        description: String,
    },

    /// The caller's vertex shader does not output the kernel's interpolated values.
    #[error("`{kernel}` takes `{name}`, {ty} at location {location}, {problem}")]
    Varying {
        /// The kernel's name.
        kernel: String,
        /// The varying.
        name: String,
        /// Location of the varying.
        location: u32,
        /// Type of the varying, as WGSL spells it.
        ty: String,
        /// Description of the vertex shader's output there, and of the one needed.
        problem: String,
    },

    /// The colour target format asked for cannot be drawn to by this shader on this device.
    #[error("`{kernel}` cannot draw to {format:?}: {reason}")]
    TargetFormat {
        /// The kernel's name.
        kernel: String,
        /// The format asked for.
        format: TextureFormat,
        /// Reason, and the remedy.
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
        /// Value that the shader needs.
        needed: u64,
        /// Value that the device allows.
        available: u64,
    },

    /// The device was created without a feature.
    #[error(
        "{purpose} needs the device feature `{feature}`: ask for it in `DeviceDescriptor::required_features` where the adapter has it"
    )]
    MissingFeature {
        /// Purpose of the feature.
        purpose: &'static str,
        /// The constant of [`wgpu::Features`].
        feature: &'static str,
    },

    /// The device is lost or was destroyed. Nothing that was made from it works any more.
    #[error("the device was lost ({doing}): make a new device, and everything that belongs to it, again")]
    DeviceLost {
        /// Operation during which the loss was found.
        doing: String,
    },

    /// The device has no memory left.
    #[error("out of memory ({doing})")]
    OutOfMemory {
        /// Operation that ran out of memory.
        doing: String,
    },

    /// The system starts no thread for a [`Pending`](crate::Pending).
    #[error("cannot start a thread: {0}")]
    Thread(#[source] std::io::Error),

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

    /// An input was given a resource of another kind.
    #[error("`{kernel}` reads its input `{name}` as {needed}, but was given {given}: give it a `&wgpu::{}`", .needed.type_name())]
    InputKind {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
        /// The kind that is needed.
        needed: ResourceKind,
        /// The kind that was given.
        given: ResourceKind,
    },

    /// The view given for an input cannot be read by the kernel.
    #[error("input `{name}` of `{kernel}`: {problem}")]
    Input {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
        /// Problem of the view.
        problem: ViewProblem,
    },

    /// The sampler given for an input cannot be used by the kernel.
    #[error("input `{name}` of `{kernel}`: {problem}")]
    InputSampler {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
        /// Problem of the sampler.
        problem: SamplerProblem,
    },

    /// The buffer given for an input cannot be read by the kernel.
    #[error("input `{name}` of `{kernel}`: {problem}")]
    InputBuffer {
        /// The kernel's name.
        kernel: String,
        /// The input.
        name: String,
        /// Problem of the buffer.
        problem: BufferProblem,
    },

    /// A kernel with several outputs was given one target.
    #[error("`{kernel}` writes {known}: give each its target by name, as in `&[(\"{}\", &view), ...]`", .known.0.first().map_or("", String::as_str))]
    TargetNames {
        /// The kernel's name.
        kernel: String,
        /// All outputs of the kernel.
        known: Names,
    },

    /// A target of the kernel was not given.
    #[error("`{kernel}` was not given the target `{name}`; it writes {known}")]
    MissingTarget {
        /// The kernel's name.
        kernel: String,
        /// The target.
        name: String,
        /// All outputs of the kernel.
        known: Names,
    },

    /// A target was given that the kernel does not have.
    #[error("`{kernel}` has no target `{name}`; it writes {known}")]
    UnknownTarget {
        /// The kernel's name.
        kernel: String,
        /// The name that was given.
        name: String,
        /// All outputs of the kernel.
        known: Names,
    },

    /// A target was given twice.
    #[error("`{kernel}` was given its target `{name}` more than once")]
    DuplicateTarget {
        /// The kernel's name.
        kernel: String,
        /// The target.
        name: String,
    },

    /// The view given as target cannot be written by the kernel.
    #[error("target{} of `{kernel}`: {problem}", .name.as_ref().map_or_else(String::new, |name| format!(" `{name}`")))]
    Target {
        /// The kernel's name.
        kernel: String,
        /// The target, if the kernel has several and the wrong one is known.
        name: Option<String>,
        /// Problem of the view.
        problem: ViewProblem,
    },

    /// Each resource is valid on its own, but wgpu rejects this combination.
    #[error("`{kernel}` cannot run on these resources together: {description}")]
    Combination {
        /// The kernel's name.
        kernel: String,
        /// wgpu's message.
        description: String,
    },

    /// A chain could not be made, or not be bound as asked.
    #[error("chain `{chain}`: {problem}")]
    Chain {
        /// The chain's name.
        chain: String,
        /// Description of the problem.
        problem: ChainProblem,
    },

    /// The shader cannot filter this rectangle.
    #[error("`{kernel}` cannot filter the region {region}: {problem}")]
    Region {
        /// The kernel's name.
        kernel: String,
        /// The rectangle.
        region: Region,
        /// Reason, and the remedy.
        problem: String,
    },

    /// A compute shader was to be recorded into a render pass, or a fragment shader into a compute pass.
    #[error("{}", pass_kind_advice(.kernel, *.is_compute))]
    PassKind {
        /// The kernel's name.
        kernel: String,
        /// `true` if the shader is a compute shader.
        is_compute: bool,
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
        /// Type of the uniform, as WGSL spells it.
        needed: String,
        /// The value's type, as WGSL spells it.
        given: String,
    },

    /// An override was named that the kernel does not have.
    #[error("`{kernel}` has no override `{name}`; it has {known}: emit it with `override`, or leave the value out")]
    UnknownOverride {
        /// The kernel's or chain's name.
        kernel: String,
        /// The name that was given.
        name: String,
        /// All overrides of the kernel or chain.
        known: Names,
    },

    /// An override was given a value of another type.
    #[error("override `{name}` of `{kernel}` is of type {needed}, but was given a value of type {given}")]
    OverrideType {
        /// The kernel's name.
        kernel: String,
        /// The override.
        name: String,
        /// Type of the override.
        needed: OverrideType,
        /// Type of the value.
        given: OverrideType,
    },

    /// An override was given a value that it cannot have.
    #[error("override `{name}` of `{kernel}` cannot be {value}: it takes {allowed}")]
    OverrideValue {
        /// The kernel's name.
        kernel: String,
        /// The override.
        name: String,
        /// The value.
        value: OverrideValue,
        /// Values that the override takes.
        allowed: String,
    },

    /// Uniforms were to be written all at once, but the kernel has none.
    #[error(
        "`{kernel}` has no uniforms to write: leave the call out, or generate the shader with an option as a uniform"
    )]
    NoUniforms {
        /// The kernel's name.
        kernel: String,
    },

    /// The bytes for all uniforms are of another size than their buffer.
    #[error(
        "the uniforms of `{kernel}` take {needed} bytes, but were given {given}: give the whole struct as it lies in the buffer, padding included"
    )]
    UniformSize {
        /// The kernel's name.
        kernel: String,
        /// Bytes that the uniforms take.
        needed: u64,
        /// Bytes that were given.
        given: u64,
    },

    /// A uniform without a default was never set.
    #[error(
        "uniform `{name}` of `{kernel}` has no default: give it a value when the pass is bound, with `BindOptions::uniform` or `BindOptions::uniforms`"
    )]
    UniformUnset {
        /// The kernel's name.
        kernel: String,
        /// The uniform.
        name: String,
    },

    /// A file of a pipeline cache or of choices cannot be written.
    #[error(transparent)]
    Write(#[from] straightline_files::WriteError),

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

    /// There is no candidate to choose.
    #[error("there are no candidates to choose from")]
    NoCandidates,

    /// A line of a text is no choice between candidates.
    #[error("line {line} of the choices cannot be read: {problem}")]
    Choices {
        /// Number of the line, from 1.
        line: usize,
        /// Description of the problem.
        problem: String,
    },

    /// A file cannot be read.
    #[error("cannot read `{}`: {source}", path.display())]
    Read {
        /// The file.
        path: std::path::PathBuf,
        /// The system's error.
        source: std::io::Error,
    },

    /// Reading a timer back failed.
    #[error("reading timestamps back failed: {description}")]
    TimerRead {
        /// wgpu's message.
        description: String,
    },
}

fn pass_kind_advice(kernel: &str, is_compute: bool) -> String {
    let (own, other, method, into) = match is_compute {
        true => ("compute", "fragment", "encode_into", "a render pass"),
        false => ("fragment", "compute", "draw_into", "a compute pass"),
    };
    format!(
        "`{kernel}` is a {own} shader and cannot be recorded into {into}: call `{method}`, or generate it for the stage `{other}`"
    )
}
