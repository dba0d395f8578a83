//! Chains: filters of several passes, from one Rust function.
//!
//! A chain is a function that draws pictures. Each call of `draw` becomes a shader, and the [`ChainPlan`] says in which order they
//! run, what each reads and writes, and which pictures can share a texture.
//!
//! ```
//! use straightline_codegen::ShaderSpec;
//! use straightline_codegen::chain::Chain;
//!
//! let text = "
//!     pub fn glow(color: &Texture<Vec4>, linear: &Sampler) -> Texture<Vec4> {
//!         let small: Texture<Vec4> = draw(color.size() / 2, |pixel| color.load(pixel * 2));
//!         draw(color.size(), |pixel| {
//!             let uv = (pixel.as_vec2() + 0.5) / color.size().as_vec2();
//!             color.load(pixel) + 0.2 * small.sample(linear, uv)
//!         })
//!     }";
//! let chain = Chain::from_text("glow.rs", text, "glow");
//! let emitted = chain.compile(&ShaderSpec::new().into())?.emit()?;
//! assert_eq!(emitted.plan.passes.len(), 2);
//! assert_eq!(emitted.plan.pictures[0].size.to_string(), "color.size() / 2");
//! # Ok::<(), straightline_codegen::diagnostic::Errors>(())
//! ```

mod bindings;
mod cascades;
mod compiled;
mod compiler;
mod emitted;
mod failures;
mod fusion;
mod memory;
mod planned;
mod spec;

use crate::kernel::{Kernel, deep, read_source};
use crate::overridden::{self, Overridable, reads_override};
use crate::spec::ShaderSpec;
use std::path::Path;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Errors, File};
use straightline_evaluator::eval::{OptionInfo, OptionKind};
use straightline_evaluator::front::chain as front;
use straightline_kernels::{OptionText, OptionValues};

pub use compiled::{CompiledChain, CompiledPass, SharedPass};
pub use emitted::{EmittedChain, EmittedPass};
pub use spec::{ChainSpec, Fuse};
pub use straightline_evaluator::front::chain::Source;
pub use straightline_evaluator::passes::{Cascade, CascadeTile};
pub use straightline_manifest::chain::{ChainPlan, PassPlan, PicturePlan, ReadPlan, SizeOp, SizeRule, SizeTerm};

/// A chain's source: its files and which function it is.
#[derive(Clone, Debug)]
pub struct Chain {
    name: String,
    files: Arc<Vec<File>>,
}

impl Chain {
    /// A chain in the caller's text. `path` is only shown.
    pub fn from_text(path: &str, text: &str, function: &str) -> Chain {
        Chain {
            name: function.to_owned(),
            files: Arc::new(vec![File {
                path: path.to_owned(),
                text: text.to_owned(),
            }]),
        }
    }

    /// Finds the chain in a text: the function `function`, or else the public one called `stem`, or the only public one that draws.
    /// `None` if that function is a kernel. `path` is only shown.
    ///
    /// # Errors
    ///
    /// A text with several chains.
    pub fn find(path: &str, text: &str, function: Option<&str>, stem: &str) -> Result<Option<Chain>, Errors> {
        let found = front::chain_of(text, function, stem, path).map_err(|error| {
            let (path, text) = (path.to_owned(), text.to_owned());
            Errors::new(vec![*error], &Arc::new(vec![File { path, text }]))
        })?;
        Ok(found.map(|name| Chain::from_text(path, text, &name)))
    }

    /// Reads the chain of a file, as [`Chain::find`] does for the file's name.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, or that has several chains.
    pub fn from_file(path: &Path, function: Option<&str>) -> Result<Option<Chain>, Errors> {
        let text = read_source(path)?;
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or_default();
        Chain::find(&path.display().to_string(), &text, function, stem)
    }

    /// Finds a chain by its name on a command line: `FILE.rs` or `FILE.rs::FUNCTION`. `None` if that is a kernel.
    ///
    /// # Errors
    ///
    /// As of [`Chain::from_file`].
    pub fn from_argument(text: &str) -> Result<Option<Chain>, Errors> {
        match text.split_once(".rs::") {
            Some((path, function)) => Chain::from_file(Path::new(&format!("{path}.rs")), Some(function)),
            None if text.ends_with(".rs") => Chain::from_file(Path::new(text), None),
            None => Ok(None),
        }
    }

    /// Adds a file that the chain or its passes call functions of.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub fn with_file(mut self, path: &Path) -> Result<Chain, Errors> {
        let text = read_source(path)?;
        let path = path.display().to_string();
        Arc::make_mut(&mut self.files).push(File { path, text });
        Ok(self)
    }

    /// The function's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The chain's files.
    pub fn files(&self) -> &[File] {
        &self.files
    }

    /// The chain's options in order of declaration.
    ///
    /// # Errors
    ///
    /// If the options are declared wrongly.
    pub fn options(&self) -> Result<Vec<OptionInfo>, Errors> {
        Kernel::options_of_chain(&self.files, &self.name).options()
    }

    /// Returns whether an option can be overridden, the other options at their defaults.
    ///
    /// # Errors
    ///
    /// All errors of the chain without settings.
    pub fn overridable(&self, option: &str) -> Result<Overridable, Errors> {
        let compiled = self.compile(&ShaderSpec::new().override_options([option]).into());
        let reads = |compiled: CompiledChain| compiled.kernels.values().any(|kernel| reads_override(&kernel.graph));
        Overridable::from_outcome(compiled.map(reads))
    }

    /// Reads the passes of the chain, and compiles their kernels. Kernels that read pictures at single places can compute them in
    /// place ([`ChainSpec::fuse`]): that of a fused picture is the value before it is stored, so formats of few bits round less.
    ///
    /// # Errors
    ///
    /// Every statement that no chain has; all errors of the passes.
    pub fn compile(&self, spec: &ChainSpec) -> Result<CompiledChain, Errors> {
        let texts = spec.shader.settings.option_texts();
        let options = self.option_values(&texts)?;
        let read = |options: &OptionValues| front::read_chain(&self.files, &self.name, options);
        let mut compiled = deep(|| {
            let chain = read(&options).map_err(|errors| {
                overridden::name_overrides(&texts, &options, errors, &|texts| {
                    read(&self.option_values(&texts)?).map(drop)
                })
            })?;
            compiler::compile_passes(&self.files, chain, spec)
        })?;
        compiled.changed = self.changed_options(&texts)?;
        Ok(compiled)
    }

    /// Options that are not at their defaults, with their values.
    fn changed_options(&self, settings: &[OptionText]) -> Result<Vec<(String, String)>, Errors> {
        let kernel = Kernel::options_of_chain(&self.files, &self.name);
        let [values, defaults] = [kernel.option_values(settings)?, kernel.option_values(&[])?];
        let changed = kernel.options()?.into_iter().filter_map(|info| {
            let value = values.get(&info.name)?;
            (defaults.get(&info.name) != Some(value)).then(|| (info.name, value.to_string()))
        });
        Ok(changed.collect())
    }

    /// Values of the options that decide what passes there are: all but floats, which only passes compute with.
    fn option_values(&self, settings: &[OptionText]) -> Result<OptionValues, Errors> {
        let kernel = Kernel::options_of_chain(&self.files, &self.name);
        let values = kernel.option_values(settings)?;
        let mut known = OptionValues::default();
        for info in kernel.options()? {
            let is_float = matches!(&info.kind, OptionKind::Number(number) if !number.is_integer());
            if let (Some(value), false) = (values.get(&info.name), is_float) {
                known.insert(info.name, value.clone());
            }
        }
        Ok(known)
    }
}
