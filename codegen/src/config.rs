//! For `build.rs`: kernels in, shaders and their Rust bindings out.
//!
//! ```no_run
//! // build.rs
//! fn main() -> Result<(), straightline_codegen::config::Error> {
//!     straightline_codegen::Config::new()
//!         .kernel("sraa", |k| k.set("pattern", "latin4").set("metric", "depth"))
//!         .file("src/kernels/glow.rs")
//!         .compile()
//! }
//! ```
//!
//! One's own kernels alone need no more than `straightline_codegen::compile(["src/kernels/glow.rs"])`.
//!
//! The crate then says `straightline_runtime::include_shaders!();` where it wants the modules.

use crate::chain::{Chain, ChainSpec, CompiledChain, EmittedChain};
use crate::compiled::Compiled;
use crate::emit::{self, Emitted};
use crate::files::{self, WriteError};
use crate::kernel::Kernel;
use crate::spec::{Source, Target};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};
use straightline_evaluator::diagnostic::Errors;
use straightline_evaluator::front::raw_name;

pub use crate::spec::KernelConfig;

/// Name of the file with the bindings.
const BINDINGS: &str = "straightline.rs";

/// Compiles kernels of the caller's crate, with options at their defaults. The kernel of a file is the public function with
/// the file's name, or else the only public function with a kernel's parameters and result. For anything else see
/// [`Config`].
///
/// # Errors
///
/// As [`Config::compile`].
pub fn compile<P: AsRef<Path>>(files: impl IntoIterator<Item = P>) -> Result<(), Error> {
    files.into_iter().fold(Config::new(), Config::file).compile()
}

/// The shaders that a crate builds.
#[derive(Clone, Debug, Default)]
pub struct Config {
    kernels: Vec<KernelConfig>,
    out_dir: Option<PathBuf>,
}

/// A shader or a chain ready to be written.
enum Built {
    Shader(Box<BuiltShader>),
    Chain(Box<(CompiledChain, EmittedChain)>),
}

/// A shader ready to be written.
struct BuiltShader {
    name: String,
    compiled: Compiled,
    emitted: Emitted,
}

impl BuiltShader {
    fn bindings_module(&self) -> emit::Module<'_> {
        emit::Module {
            name: &self.name,
            compiled: &self.compiled,
            manifest: &self.emitted.manifest,
            wgsl: self.emitted.wgsl(),
        }
    }
}

impl Built {
    /// Name of the module.
    fn name(&self) -> &str {
        match self {
            Built::Shader(shader) => &shader.name,
            Built::Chain(chain) => &chain.1.plan.chain,
        }
    }

    fn files(&self) -> BTreeMap<String, Vec<u8>> {
        match self {
            Built::Shader(shader) => shader.emitted.named_files(&shader.name),
            Built::Chain(chain) => chain.1.named_files(),
        }
    }
}

/// Builds the shader of a configuration, or its chain.
fn build(config: &KernelConfig) -> Result<Built, Error> {
    let failed = |errors| Error::from_problem(Problem::Kernel(errors));
    if let Source::File(path) = &config.source
        && let Some(chain) = Chain::from_file(path, config.function.as_deref()).map_err(failed)?
    {
        check_name(config.name.as_deref().unwrap_or(chain.name()))?;
        return build_chain(config, chain).map_err(failed);
    }
    build_shader(config).map(|shader| Built::Shader(Box::new(shader)))
}

/// Refuses a name that no module can have.
fn check_name(name: &str) -> Result<(), Error> {
    match syn::parse_str::<syn::Ident>(&raw_name(name)) {
        Ok(_) => Ok(()),
        Err(_) => Err(Error::from_problem(Problem::Name(name.to_owned()))),
    }
}

fn build_chain(config: &KernelConfig, chain: Chain) -> Result<Built, Errors> {
    let chain = config
        .sources
        .iter()
        .try_fold(chain, |chain, path| chain.with_file(path))?;
    let mut spec = ChainSpec::from(config.spec.clone().target(Target::Wgsl)).fuse(config.fuse.clone());
    spec.pictures = config.pictures;
    let compiled = chain.compile(&spec)?;
    let mut emitted = compiled.emit()?;
    if let Some(name) = &config.name {
        emitted = emitted.renamed(name);
    }
    Ok(Built::Chain(Box::new((compiled, emitted))))
}

fn build_shader(config: &KernelConfig) -> Result<BuiltShader, Error> {
    let kernel = match &config.source {
        Source::Builtin(name) if config.function.is_some() => {
            return Err(Error::from_problem(Problem::Function(name.clone())));
        }
        Source::Builtin(name) => Kernel::builtin(name),
        Source::File(path) => Kernel::from_file(path, config.function.as_deref()),
    };
    let kernel = config
        .sources
        .iter()
        .fold(kernel, |kernel, path| kernel?.with_file(path));
    let kernel = kernel.map_err(|e| Error::from_problem(Problem::Kernel(e)))?;
    let name = config.name.clone().unwrap_or_else(|| kernel.name().to_owned());
    check_name(&name)?;
    // The bindings include the WGSL.
    let spec = config.spec.clone().target(Target::Wgsl);
    let (compiled, emitted) = spec
        .emit(&kernel)
        .map_err(|e| Error::from_problem(Problem::Kernel(e)))?;
    Ok(BuiltShader {
        name,
        compiled,
        emitted,
    })
}

impl Config {
    /// Creates a configuration without shaders.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a built-in kernel.
    pub fn kernel(mut self, name: &str, options: impl FnOnce(KernelConfig) -> KernelConfig) -> Self {
        self.kernels
            .push(options(KernelConfig::new(Source::Builtin(name.to_owned()))));
        self
    }

    /// Adds a kernel of the caller's crate, with options at their defaults. The kernel is the public function with the
    /// file's name, or else the only public function with a kernel's parameters and result.
    pub fn file(self, path: impl AsRef<Path>) -> Self {
        self.file_with(path, |k| k)
    }

    /// Adds a kernel of the caller's crate with options.
    pub fn file_with(mut self, path: impl AsRef<Path>, options: impl FnOnce(KernelConfig) -> KernelConfig) -> Self {
        let source = Source::File(path.as_ref().to_owned());
        self.kernels.push(options(KernelConfig::new(source)));
        self
    }

    /// Output folder; cargo's `OUT_DIR` by default.
    pub fn out_dir(mut self, folder: impl AsRef<Path>) -> Self {
        self.out_dir = Some(folder.as_ref().to_owned());
        self
    }

    /// Prints the files that the shaders depend on, for cargo.
    fn print_dependencies(&self) {
        for kernel in &self.kernels {
            let own = match &kernel.source {
                Source::File(path) => Some(path),
                Source::Builtin(_) => None,
            };
            for path in own.into_iter().chain(&kernel.sources) {
                println!("cargo::rerun-if-changed={}", path.display());
            }
        }
        // Without any such line, cargo reruns the script on every change in the package.
        println!("cargo::rerun-if-changed=build.rs");
    }

    /// Emits and writes everything, or nothing. In a build script, cargo reruns it only when a kernel's file changes.
    ///
    /// # Errors
    ///
    /// Every error of every kernel at once; two shaders of one name; a folder that cannot be written.
    pub fn compile(&self) -> Result<(), Error> {
        // Cargo sets `OUT_DIR` for build scripts, and reads their output.
        if std::env::var_os("OUT_DIR").is_some() {
            self.print_dependencies();
        }
        let folder = match &self.out_dir {
            Some(folder) if folder.as_os_str().is_empty() => return Err(Error::from_problem(Problem::EmptyFolder)),
            Some(folder) => folder.clone(),
            None => std::env::var_os("OUT_DIR")
                .map(PathBuf::from)
                .ok_or_else(|| Error::from_problem(Problem::NoFolder))?,
        };
        let mut problems = Vec::new();
        let mut built = Vec::new();
        for kernel in &self.kernels {
            match build(kernel) {
                Ok(shader) => built.push(shader),
                Err(error) => problems.extend(error.problems),
            }
        }
        let mut all = BTreeMap::new();
        let mut names = BTreeSet::new();
        for each in &built {
            let files = each.files();
            // Passes of a chain have files too.
            if !names.insert(each.name()) || files.keys().any(|file| all.contains_key(file)) {
                problems.push(Problem::Twice(each.name().to_owned()));
            }
            all.extend(files);
        }
        if !problems.is_empty() {
            return Err(Error { problems });
        }
        let (mut modules, mut chains) = (Vec::new(), Vec::new());
        for each in &built {
            match each {
                Built::Shader(shader) => modules.push(shader.bindings_module()),
                Built::Chain(chain) => chains.push(emit::ChainModule {
                    compiled: &chain.0,
                    emitted: &chain.1,
                }),
            }
        }
        let bindings = emit::render_bindings(&modules, &chains).map_err(|e| Error::from_problem(Problem::Kernel(e)))?;
        all.insert(BINDINGS.to_owned(), bindings.into_bytes());
        files::write_all(&folder, &all)
            .map(|_| ())
            .map_err(|e| Error::from_problem(Problem::Write(e)))
    }
}

/// All errors of a build.
pub struct Error {
    problems: Vec<Problem>,
}

/// A problem with one shader or with the output.
#[derive(Debug, thiserror::Error)]
enum Problem {
    #[error(transparent)]
    Kernel(Errors),
    #[error(transparent)]
    Write(WriteError),
    #[error("`{0}` is built in and has one function: leave `.function(...)` out")]
    Function(String),
    #[error("`{0}` cannot name a module: give the shader another name with `.name(\"...\")`")]
    Name(String),
    #[error("two shaders are called `{0}`: give one of them another name with `.name(\"...\")`")]
    Twice(String),
    #[error(
        "the folder to write to is empty: say `.out_dir(\".\")` for the folder that the build runs in, or leave it out"
    )]
    EmptyFolder,
    #[error("OUT_DIR is not set: call this from build.rs, or say where to write with `.out_dir(...)`")]
    NoFolder,
}

impl Error {
    fn from_problem(problem: Problem) -> Self {
        Error {
            problems: vec![problem],
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, problem) in self.problems.iter().enumerate() {
            let gap = if k > 0 { "\n" } else { "" };
            write!(f, "{gap}{problem}")?;
        }
        Ok(())
    }
}

/// As `Display`, because `fn main() -> Result<...>` in a `build.rs` prints errors with `Debug`.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Error {
    /// Returns the system's error for the first file that could not be read or written, if there is one.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.problems.iter().find_map(std::error::Error::source)
    }
}
