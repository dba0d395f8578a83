//! Shaders, sets of them and chains, between their configuration and the files.

use super::candidates::{BuiltCandidates, build_candidates};
use super::error::{Error, Problem};
use super::shader::{BuiltShader, build_shader};
use super::variants::{BuiltVariants, build_variants};
use crate::chain::{Chain, ChainSpec, CompiledChain, EmittedChain};
use crate::emit::{self, Emitted, Modules};
use crate::kernel::Kernel;
use crate::spec::{KernelConfig, Source, Target};
use std::collections::BTreeMap;
use straightline_evaluator::diagnostic::Errors;
use straightline_evaluator::front::raw_name;

/// A shader, a set of them or a chain, ready to be written.
pub(super) enum Built {
    Shader(Box<BuiltShader>),
    Candidates(BuiltCandidates),
    Variants(BuiltVariants),
    Chain(Box<(CompiledChain, EmittedChain)>),
}

impl Built {
    /// Builds the shader of a configuration, its set of shaders, or its chain.
    pub fn new(config: &KernelConfig) -> Result<Built, Error> {
        if let Source::File(path) = &config.source
            && let Some(chain) = Chain::from_file(path, config.function.as_deref()).map_err(Error::from_errors)?
        {
            check_name(config.name.as_deref().unwrap_or(chain.name()))?;
            if !config.variants.axes().is_empty() || !config.candidates.is_empty() {
                return Err(Error::from_problem(Problem::Variants(
                    chain.name().to_owned(),
                    "a chain has neither variants nor candidates: add it once for each".to_owned(),
                )));
            }
            return build_chain(config, chain).map_err(Error::from_errors);
        }
        let kernel = load_kernel(config)?;
        let name = config.name.clone().unwrap_or_else(|| kernel.name().to_owned());
        check_name(&name)?;
        if !config.candidates.is_empty() {
            return build_candidates(config, &kernel, name).map(Built::Candidates);
        }
        if !config.variants.axes().is_empty() {
            return build_variants(config, &kernel, name).map(Built::Variants);
        }
        let shader = build_shader(&config.spec, &kernel, name).map_err(Error::from_errors)?;
        Ok(Built::Shader(Box::new(shader)))
    }

    /// Name of the module.
    pub fn name(&self) -> &str {
        match self {
            Built::Shader(shader) => &shader.name,
            Built::Candidates(set) => set.name(),
            Built::Variants(set) => &set.name,
            Built::Chain(chain) => &chain.1.plan.chain,
        }
    }

    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        match self {
            Built::Shader(shader) => shader.emitted.named_files(&shader.name),
            Built::Candidates(set) => set.files(),
            Built::Variants(set) => set.files(),
            Built::Chain(chain) => chain.1.named_files(),
        }
    }

    /// Adds the module to those of the bindings.
    pub fn push_module<'a>(&'a self, modules: &mut Modules<'a>) {
        match self {
            Built::Shader(shader) => modules.shaders.push(shader.bindings_module()),
            Built::Candidates(set) => modules.candidates.push(set.bindings_module()),
            Built::Variants(set) => modules.variants.push(set.bindings_module()),
            Built::Chain(chain) => modules.chains.push(emit::ChainModule {
                compiled: &chain.0,
                emitted: &chain.1,
            }),
        }
    }
}

impl KernelConfig {
    /// Generates the shader, and writes no files.
    ///
    /// # Errors
    ///
    /// Every error of the kernel. A chain and a set of variants or candidates are refused: they are not one shader.
    pub fn emit(&self) -> Result<Emitted, Error> {
        match Built::new(self)? {
            Built::Shader(shader) => Ok(shader.emitted),
            other => Err(Error::from_problem(Problem::Several(other.name().to_owned()))),
        }
    }
}

/// Refuses a name that no module can have.
fn check_name(name: &str) -> Result<(), Error> {
    match syn::parse_str::<syn::Ident>(&raw_name(name)) {
        Ok(_) => Ok(()),
        Err(_) => Err(Error::from_problem(Problem::Name(name.to_owned()))),
    }
}

fn load_kernel(config: &KernelConfig) -> Result<Kernel, Error> {
    let kernel = match &config.source {
        Source::Builtin(name) if config.function.is_some() => {
            return Err(Error::from_problem(Problem::Function(name.clone())));
        }
        Source::Builtin(name) => Kernel::builtin(name),
        Source::File(path) => Kernel::from_file(path, config.function.as_deref()),
    };
    config
        .sources
        .iter()
        .fold(kernel, |kernel, path| kernel?.with_file(path))
        .map_err(Error::from_errors)
}

fn build_chain(config: &KernelConfig, chain: Chain) -> Result<Built, Errors> {
    let chain = config
        .sources
        .iter()
        .try_fold(chain, |chain, path| chain.with_file(path))?;
    let mut spec = ChainSpec::from(config.spec.clone().target(Target::Wgsl)).fuse(config.fuse.clone());
    spec.pictures = config.pictures;
    spec.most_outputs = config.most_outputs.unwrap_or(spec.most_outputs);
    let compiled = chain.compile(&spec)?;
    let mut emitted = compiled.emit()?;
    if let Some(name) = &config.name {
        emitted = emitted.renamed(name);
    }
    Ok(Built::Chain(Box::new((compiled, emitted))))
}
