//! Chains whose passes are compiled.

use super::spec::ChainSpec;
use crate::compiled::Compiled;
use std::collections::BTreeMap;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Diagnostic, Errors, File, Span};
use straightline_evaluator::front::chain::{Picture, Source};
use straightline_evaluator::ir::Graph;
use straightline_evaluator::passes::Cascade;
use straightline_manifest::Format;

/// A chain whose passes are compiled, ready to be emitted or interpreted.
#[derive(Clone, Debug)]
pub struct CompiledChain {
    /// Name of the function.
    pub name: String,
    /// First sentence of its documentation.
    pub summary: String,
    /// Options that are not at their defaults, with their values.
    pub changed: Vec<(String, String)>,
    /// Textures, samplers and buffers that it takes.
    pub inputs: Vec<String>,
    /// Pictures that are stored, in the order in which they are drawn.
    pub pictures: Vec<Picture>,
    /// Passes in order.
    pub passes: Vec<CompiledPass>,
    /// Indices of the pictures that the chain returns.
    pub results: Vec<usize>,
    /// Kernels of the passes, by name.
    pub kernels: BTreeMap<String, Compiled>,
    /// Pictures that are computed where they are read.
    pub fused: Vec<String>,
    /// Pictures that workgroups compute one after another, by pass: the last one from the others, which are stored only if
    /// something else reads them.
    pub shared: Vec<SharedPass>,
    /// Pictures that could not be fused or would cost more so, each with the reason.
    pub kept: Vec<(String, String)>,
    pub(super) spec: ChainSpec,
    pub(super) files: Arc<Vec<File>>,
    /// Place of the function's name.
    pub(super) span: Span,
}

/// A pass whose workgroups compute several pictures.
#[derive(Clone, Debug)]
pub struct SharedPass {
    /// Name of its kernel.
    pub kernel: String,
    /// The texels that a workgroup computes of each picture.
    pub cascade: Cascade,
}

/// A pass of a compiled chain.
#[derive(Clone, Debug)]
pub struct CompiledPass {
    /// Name of its kernel in [`CompiledChain::kernels`].
    pub kernel: String,
    /// Name of its shader: that of its kernel, with the format of what it draws where passes of one kernel differ in it.
    pub shader: String,
    /// Indices of the pictures that it draws, in the order of the kernel's targets.
    pub draws: Vec<usize>,
    /// Format of what it draws, if its texels are floats of three or four components.
    pub format: Format,
    /// Inputs of the kernel with what each reads.
    pub reads: Vec<(String, Source)>,
}

impl CompiledPass {
    /// Name of the chain's input that a resource of the kernel is; `None` of a picture.
    pub fn input_named(&self, resource: &str) -> Option<&str> {
        let (_, source) = self.reads.iter().find(|(name, _)| name == resource)?;
        match source {
            Source::Input(name) => Some(name),
            Source::Picture(_) => None,
        }
    }
}

impl CompiledChain {
    /// Returns an error about the chain, located at its name.
    pub fn locate_error(&self, mut error: Diagnostic) -> Errors {
        error.span = Some(self.span);
        error.label = "this chain".to_owned();
        Errors::new(vec![error], &self.files)
    }

    /// The kernel of a pass.
    pub fn kernel_of(&self, pass: &CompiledPass) -> &Compiled {
        &self.kernels[&pass.kernel]
    }

    /// Everything that the passes take from the caller, as the tables of a graph without operations.
    pub fn inputs_graph(&self) -> Graph {
        let mut all = Graph::default();
        for pass in &self.passes {
            let graph = &self.kernel_of(pass).graph;
            for texture in &graph.textures {
                let Some(name) = pass.input_named(&texture.name) else {
                    continue;
                };
                match all.textures.iter_mut().find(|known| known.name == name) {
                    Some(known) => {
                        known.components = known.components.max(texture.components);
                        known.framed |= texture.framed;
                    }
                    None => {
                        let mut texture = texture.clone();
                        name.clone_into(&mut texture.name);
                        all.textures.push(texture);
                    }
                }
            }
            for buffer in &graph.buffers {
                let named = pass.input_named(&buffer.name);
                if let Some(name) = named.filter(|name| all.buffers.iter().all(|known| known.name != *name)) {
                    let mut buffer = buffer.clone();
                    name.clone_into(&mut buffer.name);
                    all.buffers.push(buffer);
                }
            }
            for of in &graph.overrides {
                if all.overrides.iter().all(|known| known.name != of.name) {
                    all.overrides.push(of.clone());
                }
            }
            for uniform in &graph.uniforms {
                if all.uniforms.iter().all(|known| known.name != uniform.name) {
                    all.uniforms.push(uniform.clone());
                }
            }
        }
        all
    }

    /// The pass that draws a picture, and which of its outputs that is.
    pub fn drawn_by(&self, picture: usize) -> (usize, usize) {
        let mut passes = self.passes.iter().enumerate();
        let found = passes.find_map(|(k, pass)| Some((k, pass.draws.iter().position(|index| *index == picture)?)));
        found.expect("a pass draws each picture")
    }

    /// Name of the input or picture that a pass reads.
    pub fn source_name<'c>(&'c self, source: &'c Source) -> &'c str {
        match source {
            Source::Input(name) => name,
            Source::Picture(index) => &self.pictures[*index].name,
        }
    }
}
