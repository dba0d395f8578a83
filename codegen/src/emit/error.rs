//! Why a kernel cannot be emitted.

use crate::compiled::Compiled;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Diagnostic, Errors};
use straightline_evaluator::limits::Excess;

/// Why a kernel cannot be emitted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EmitError {
    /// A limit of time or memory.
    #[error("emitting `{kernel}` takes {excess}, with {statements} statements{largest}: {}", excess.help())]
    Limit {
        /// The kernel.
        kernel: String,
        /// The limit.
        excess: Excess,
        /// Statements that it has.
        statements: u32,
        /// The loop that made the most of them, if there is one.
        largest: String,
    },
    /// A built-in kernel in half precision, whose loss hard cases show.
    #[error(
        "`{kernel}` in f16 does not keep what can be seen: {reason}. Emit it in f32, or with options that keep it (`study hard --precision f16` tells which \
         do); where your scenes do not show the loss, which `tune` measures, accept it: `--accept-loss`, or `.accept_loss(true)` in build.rs"
    )]
    VisibleLoss {
        /// The kernel.
        kernel: String,
        /// What 11 bits cannot hold.
        reason: &'static str,
    },
    /// The size of the frame is needed and nothing tells it.
    #[error(
        "`{kernel}` needs the frame's size but reads no texture of that size, so only a compute shader with an output can know it: emit a whole shader for compute, or take a `Frame`"
    )]
    NoFrame {
        /// The kernel.
        kernel: String,
    },
    /// A fragment shader without a colour.
    #[error("`{kernel}` gives nothing for a pixel, and a fragment shader gives a colour: emit it for compute")]
    NoColour {
        /// The kernel.
        kernel: String,
    },
    /// Pictures that are written at any place, where a shader gives only its own pixel or knows only a part of the frame.
    #[error(
        "`{kernel}` writes to `{image}` at any place, which {what} cannot: emit it as a compute shader of the whole frame"
    )]
    Image {
        /// The kernel.
        kernel: String,
        /// The picture.
        image: String,
        /// What cannot.
        what: &'static str,
    },
    /// Lanes in a stage that has none.
    #[error(
        "`{kernel}` sends messages by {transport}, and compute shaders have no pixel quads: emit it for fragment, or use the transport `block`"
    )]
    NoQuads {
        /// The kernel.
        kernel: String,
        /// How lanes were to communicate.
        transport: String,
    },
    /// Quads over a rectangle that may begin anywhere.
    #[error("`{kernel}` computes quads, which begin at even pixels, and a region may begin at any: leave `region` out")]
    QuadsOfRegion {
        /// The kernel.
        kernel: String,
    },
    /// A block of pixels in a stage that writes one.
    #[error("`{kernel}` computes a block of pixels, and a fragment writes one: emit it for compute")]
    OnePixel {
        /// The kernel.
        kernel: String,
    },
    /// Fine derivatives in a language without them.
    #[error(
        "`{kernel}` sends messages by fine derivatives, which {target} does not have: use the transport `subgroup` or `block`"
    )]
    Derivatives {
        /// The kernel.
        kernel: String,
        /// The language.
        target: &'static str,
    },
    /// Something that a language does not have.
    #[error("`{kernel}` cannot be written in {target}: it {what}, which {target} does not have; use {instead}")]
    Missing {
        /// The kernel.
        kernel: String,
        /// The language.
        target: &'static str,
        /// What the kernel does.
        what: &'static str,
        /// Languages that have it.
        instead: &'static str,
    },
    /// Half precision in a language that naga can neither write nor check with it.
    #[error(
        "`{kernel}` in half precision cannot be written in {target}, where naga knows no f16: use wgsl, spirv, hlsl or msl, or leave the precision at f32"
    )]
    HalfGlsl {
        /// The kernel.
        kernel: String,
        /// The language.
        target: &'static str,
    },
    /// A layer or sample whose index nothing bounds.
    #[error(
        "`{kernel}` reads a layer or sample of `{texture}` whose index is a runtime value, so nothing tells how many it needs: bound it with `.min(...)`"
    )]
    Layers {
        /// The kernel.
        kernel: String,
        /// The texture.
        texture: String,
    },
    /// A workgroup of another size than the kernel's.
    #[error(
        "`{kernel}` is a kernel of workgroups of {}x{}, and {}x{} are asked for: leave `workgroup` out, or change the kernel",
        own[0], own[1], asked[0], asked[1]
    )]
    Group {
        /// The kernel.
        kernel: String,
        /// The kernel's.
        own: [u32; 2],
        /// What is asked for.
        asked: [u32; 2],
    },
    /// A kernel of workgroups in a stage that has none.
    #[error("`{kernel}` is a kernel of workgroups, which fragments and functions are not in: emit it for compute")]
    GroupStage {
        /// The kernel.
        kernel: String,
    },
    /// A workgroup of another size than the one that shares texels.
    #[error(
        "the pixels of `{kernel}` share texels by workgroups of {}x{}, and {}x{} are asked for: say `workgroup({}x{})` where sharing is asked for, or leave \
         `workgroup` out",
        own[0], own[1], asked[0], asked[1], asked[0], asked[1]
    )]
    Sharing {
        /// The kernel.
        kernel: String,
        /// The workgroup that shares.
        own: [u32; 2],
        /// What is asked for.
        asked: [u32; 2],
    },
    /// Texels shared by workgroups in a stage that has none.
    #[error(
        "the pixels of `{kernel}` share texels by workgroup, and fragments and functions are in none: emit it for compute, or leave `share` out"
    )]
    SharingStage {
        /// The kernel.
        kernel: String,
    },
    /// Texels gathered at places that half precision cannot tell apart.
    #[error(
        "`{kernel}` gathers texels, and half precision does not hold where they lie: leave `reads` or the precision out"
    )]
    HalfGathers {
        /// The kernel.
        kernel: String,
    },
    /// A workgroup that no device runs.
    #[error(
        "a workgroup of {0}x{1} is not possible: each side is at least 1, and both together at most 1024 invocations"
    )]
    Workgroup(u32, u32),
    /// More names of one kind than a text can have.
    #[error("`{kernel}` has a million names like `{name}`: give them other names")]
    Names {
        /// The kernel.
        kernel: String,
        /// What they begin with, cut if it is long.
        name: String,
    },
    /// Binding numbers, registers or a group that the shader cannot have.
    #[error("`{kernel}` cannot be bound so: {what}; {help}")]
    Place {
        /// The kernel.
        kernel: String,
        /// What is wrong.
        what: String,
        /// What to do.
        help: String,
    },
    /// A name that an entry point or function cannot have.
    #[error("the entry point of `{kernel}` cannot be called `{name}`, which {why}: give it another name")]
    Entry {
        /// The kernel.
        kernel: String,
        /// The name, cut if it is long.
        name: String,
        /// What is wrong with it.
        why: String,
    },
    /// Something that a function cannot be.
    #[error("`{kernel}` cannot be a function: {why}")]
    Function {
        /// The kernel.
        kernel: String,
        /// Why not, and what to do.
        why: String,
    },
    /// A shader that cannot count its rows from below.
    #[error("`{kernel}` cannot have its origin at the lower left: {why}")]
    FromBelow {
        /// The kernel.
        kernel: String,
        /// Why not, and what to do.
        why: &'static str,
    },
    /// A validator refused the text: a mistake of the emitter's.
    #[error(
        "the {target} text of `{kernel}` is not valid; this is a mistake in Straightline, please report it:\n{message}"
    )]
    Invalid {
        /// The kernel.
        kernel: String,
        /// The language.
        target: &'static str,
        /// What the validator says.
        message: String,
    },
    /// naga cannot say it in this language.
    #[error("`{kernel}` cannot be written in {target}: {message}")]
    Translate {
        /// The kernel.
        kernel: String,
        /// The language.
        target: &'static str,
        /// What naga says.
        message: String,
    },
}

impl EmitError {
    /// The input that the error is about, if it is about one.
    pub fn input(&self) -> Option<&str> {
        match self {
            EmitError::Image { image, .. } => Some(image),
            EmitError::Layers { texture, .. } => Some(texture),
            _ => None,
        }
    }
}

impl Compiled {
    /// An error of emission at the place that it concerns: the input that it names, or else the kernel.
    pub fn locate(&self, error: &EmitError) -> Errors {
        let named = error.input().and_then(|input| {
            // Parts of structures and arrays are called by both names.
            let is_part = |name: &str| {
                input
                    .strip_prefix(name)
                    .is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
            };
            let inputs = self.places.inputs.iter().filter(|(name, _)| is_part(name));
            inputs.max_by_key(|(name, _)| name.len()).map(|(_, span)| *span)
        });
        let (what, label) = (
            error.to_string(),
            if named.is_some() { "this input" } else { "this kernel" },
        );
        let error = match named.or(self.places.kernel) {
            Some(span) => Diagnostic::at(span, what).label(label),
            None => Diagnostic::new(what),
        };
        Errors {
            diagnostics: vec![error],
            files: Arc::clone(&self.places.files),
        }
    }
}
