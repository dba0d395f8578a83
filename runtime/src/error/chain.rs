//! Problems of chains.

use super::Error;

/// Reason why a chain could not be made or bound.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChainProblem {
    /// The chain contradicts itself, or does not fit its shaders.
    #[error("{place}: {problem}; use the files of one generator run")]
    Plan {
        /// The part of the chain, such as ``pass `half` ``.
        place: String,
        /// Description of the contradiction.
        problem: String,
    },
    /// A pass could not be made or bound.
    #[error("pass `{pass}`{role}: {error}")]
    Pass {
        /// The pass.
        pass: String,
        /// Use of the resource at fault, such as ``, which reads picture `half` as `source` ``. May be empty.
        role: String,
        /// Error of the pass, in the names of its shader.
        error: Box<Error>,
    },
    /// A picture is larger than textures of the device may be.
    #[error(
        "picture `{picture}` is {}x{}, by its size `{rule}`, but the device allows {most} along a side: give it smaller inputs, \
         or raise `max_texture_dimension_2d` in `DeviceDescriptor::required_limits`", .size[0], .size[1]
    )]
    PictureSize {
        /// The picture.
        picture: String,
        /// Rule of its size, as in Rust.
        rule: String,
        /// Width and height by the rule.
        size: [u32; 2],
        /// Texels along a side that the device allows.
        most: u32,
    },
    /// A target has another size than the chain writes.
    #[error(
        "target `{target}` is {}x{}, but the chain writes {}x{} there, by the size `{rule}`: `Chain::sizes` returns the size that is \
         needed", .found[0], .found[1], .needed[0], .needed[1]
    )]
    TargetSize {
        /// The target.
        target: String,
        /// Rule of its size, as in Rust.
        rule: String,
        /// Width and height by the rule.
        needed: [u32; 2],
        /// Width and height of the target.
        found: [u32; 2],
    },
    /// An option that only a single pass has.
    #[error("{problem}")]
    Option {
        /// Description of the option, and the remedy.
        problem: &'static str,
    },
}
