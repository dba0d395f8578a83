//! Passes of a chain on their way to kernels.

use super::compiled::SharedPass;
use super::fusion::Kept;
use crate::pipeline::Start;
use straightline_evaluator::front::chain::Source;
use straightline_manifest::Format;

/// A pass that draws a picture, before its kernel is compiled.
#[derive(Clone)]
pub struct Planned {
    /// Index of its picture in the chain.
    pub picture: usize,
    /// Name of its kernel.
    pub kernel: String,
    /// Name of the kernel as the front end made it.
    pub entry: String,
    /// Kernel with the pictures in it that are computed in place; `None` if there are none.
    pub fused: Option<Start>,
    pub reads: Vec<(String, Source)>,
}

/// A pass before its kernel is compiled.
pub struct Pass {
    /// Indices of the pictures that it stores, in the order of its kernel's targets.
    pub pictures: Vec<usize>,
    pub kernel: String,
    pub entry: String,
    /// Kernel in place of the one that the front end made.
    pub changed: Option<Start>,
    pub format: Format,
    pub reads: Vec<(String, Source)>,
}

/// Passes of which some compute several pictures.
pub struct Shared {
    pub passes: Vec<Pass>,
    pub shared: Vec<SharedPass>,
    /// Pictures that could not be shared.
    pub kept: Vec<Kept>,
}
