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

use crate::compiled::Compiled;
use crate::emit::{self, EmitOptions, Register, Target};
use crate::files::{self, WriteError};
use crate::pipeline::{Kernel, Settings};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Duration;
use straightline_evaluator::diagnostic::Errors;
use straightline_evaluator::front::raw;
use straightline_evaluator::policy::{Branches, Math, ReadOrder, Share, Transport, Unroll};
use straightline_manifest::{Form, Format, Manifest, Origin, Precision, Stage};

/// Name of the file with the bindings.
const BINDINGS: &str = "straightline.rs";

/// Compiles kernels of one's own: of each file the public function that has the file's name, or else the only public one that
/// takes and gives what a kernel does, with its
/// options at their defaults. For anything else see [`Config`].
///
/// # Errors
///
/// As [`Config::compile`].
pub fn compile<P: AsRef<Path>>(files: impl IntoIterator<Item = P>) -> Result<(), Error> {
    files.into_iter().fold(Config::new(), Config::file).compile()
}

/// Which shaders a crate wants.
#[derive(Clone, Debug, Default)]
pub struct Config {
    kernels: Vec<KernelConfig>,
    out_dir: Option<PathBuf>,
}

/// One shader: a kernel and how it is to be emitted.
#[derive(Clone, Debug)]
pub struct KernelConfig {
    source: Source,
    /// Of a file, the function that is the kernel.
    function: Option<String>,
    name: Option<String>,
    settings: Settings,
    emit: EmitOptions,
    /// Further files that the kernel calls functions of.
    sources: Vec<PathBuf>,
}

#[derive(Clone, Debug)]
enum Source {
    Builtin(String),
    File(PathBuf),
}

/// A shader that is ready to be written.
struct Built {
    name: String,
    compiled: Compiled,
    manifest: Manifest,
    files: BTreeMap<String, Vec<u8>>,
}

impl Built {
    fn module(&self) -> emit::Module<'_> {
        emit::Module {
            name: &self.name,
            compiled: &self.compiled,
            manifest: &self.manifest,
            wgsl: self.wgsl(),
        }
    }

    /// The text of the WGSL, which is always written.
    fn wgsl(&self) -> &str {
        let bytes = self.files.get(&format!("{}.wgsl", self.name));
        bytes
            .and_then(|bytes| std::str::from_utf8(bytes).ok())
            .unwrap_or_default()
    }
}

impl KernelConfig {
    fn new(source: Source) -> Self {
        KernelConfig {
            source,
            function: None,
            name: None,
            settings: Settings::default(),
            emit: EmitOptions::new(),
            sources: Vec::new(),
        }
    }

    /// Sets an option of the kernel; `uniform` makes a number one that is set at run time.
    pub fn set(mut self, option: &str, value: impl fmt::Display) -> Self {
        self.settings.options.push((option.to_owned(), value.to_string()));
        self
    }

    /// What becomes of loops; by default all are unrolled.
    pub fn unroll(mut self, unroll: Unroll) -> Self {
        self.settings.unroll = unroll;
        self
    }

    /// What becomes of one loop, by `function.counter` or by its counter alone, whatever is said of others.
    pub fn unroll_loop(mut self, path: &str, unroll: Unroll) -> Self {
        self.settings.loops.push((path.to_owned(), unroll));
        self
    }

    /// What becomes of an `if` on runtime values; by default both sides are computed.
    pub fn branches(mut self, branches: Branches) -> Self {
        self.settings.branches = branches;
        self
    }

    /// In which order the kernel reads texels, or whether four at once; by default as its source does. The picture is the same, bit
    /// for bit.
    pub fn reads(mut self, reads: ReadOrder) -> Self {
        self.settings.reads = reads;
        self
    }

    /// What pixels share of the texels that they read: with [`Share::WORKGROUP`] a workgroup reads each once, into its memory. By
    /// default nothing. The picture is the same, bit for bit. The size of the workgroup is that of [`KernelConfig::workgroup`]
    /// if that is given.
    pub fn share(mut self, share: Share) -> Self {
        self.settings.share = share;
        self
    }

    /// Which algebra may be done with floats: with [`Math::Fast`] what may change roundings too, with [`Math::Strict`] none, by
    /// drivers either. By default what changes no bit, while drivers may change roundings on which nothing hangs.
    pub fn math(mut self, math: Math) -> Self {
        self.settings.math = math;
        self
    }

    /// Statements that the kernel may have; by default [`Settings::BUDGET`].
    pub fn budget(mut self, statements: u32) -> Self {
        self.settings.budget = statements;
        self
    }

    /// Longest time that compiling and emitting the kernel may take; by default 60 s. What takes longer is an error that names the
    /// loops with the most work.
    pub fn time_limit(mut self, time: Duration) -> Self {
        self.settings.limits.time = time;
        self
    }

    /// Most bytes that values and operations may hold while the kernel is compiled; by default 2 000 000 000.
    pub fn memory_limit(mut self, bytes: u64) -> Self {
        self.settings.limits.memory = bytes;
        self
    }

    /// How the lanes of a kernel of pixel quads send each other messages; by default by subgroup operations in fragment shaders,
    /// and in compute one invocation has all four. A kernel of single pixels is refused with any.
    pub fn transport(mut self, transport: Transport) -> Self {
        self.settings.transport = Some(transport);
        self
    }

    /// Pixels that one compute invocation has, across and down, 1 to 64 together; by default one. Neighbours share reads.
    pub fn block(mut self, width: u32, height: u32) -> Self {
        self.settings.block = [width, height];
        self
    }

    /// A further file that the kernel calls functions of.
    pub fn source(mut self, path: impl AsRef<Path>) -> Self {
        self.sources.push(path.as_ref().to_owned());
        self
    }

    /// The pipeline stage; by default compute.
    pub fn stage(mut self, stage: Stage) -> Self {
        self.emit.stage = stage;
        self
    }

    /// Filters a rectangle that the host states, not all of the image: see [`EmitOptions::region`].
    pub fn region(mut self) -> Self {
        self.emit.region = true;
        self
    }

    /// Invocations of a compute workgroup, across and down; by default [`EmitOptions::WORKGROUP`], and where they share texels
    /// 16 by 16.
    pub fn workgroup(mut self, x: u32, y: u32) -> Self {
        self.emit.workgroup = Some([x, y]);
        self
    }

    /// Format of the output; by default `rgba16float`.
    pub fn format(mut self, format: Format) -> Self {
        self.emit.format = format;
        self
    }

    /// What the shader computes in; by default full precision. For half precision the device needs the feature
    /// `SHADER_F16`: see [`EmitOptions::precision`].
    pub fn precision(mut self, precision: Precision) -> Self {
        self.emit.precision = precision;
        self
    }

    /// Whether a built-in kernel is written in half precision although hard cases show the loss: see [`EmitOptions::accept_loss`].
    pub fn accept_loss(mut self, accept: bool) -> Self {
        self.emit.accept_loss = accept;
        self
    }

    /// Bind group of everything, 0 to 31; by default 0. Devices promise four groups.
    pub fn group(mut self, group: u32) -> Self {
        self.emit.group = group;
        self
    }

    /// Binding number, 0 to 999, of what is called `name`: a texture, sampler or buffer, `parameters` (the uniform buffer) or
    /// `destination` (the output): see [`EmitOptions::bindings`]. All else takes the lowest numbers that are free.
    pub fn binding(mut self, name: &str, number: u32) -> Self {
        self.emit = self.emit.binding(name, number);
        self
    }

    /// Register of what is called `name` in HLSL; by default that of its binding number, in the space of its group.
    pub fn register(mut self, name: &str, register: Register) -> Self {
        self.emit = self.emit.register(name, register);
        self
    }

    /// Name of the entry point, or of the function; by default the kernel's.
    pub fn entry(mut self, name: &str) -> Self {
        self.emit.entry = Some(name.to_owned());
        self
    }

    /// A whole shader, or a function to be put into a fragment shader of one's own, whose module has its text and manifest and
    /// no `Pass`; by default a whole shader.
    pub fn form(mut self, form: Form) -> Self {
        self.emit.form = form;
        self
    }

    /// Where row 0 of textures, target and positions is; by default the upper left: see [`EmitOptions::origin`].
    pub fn origin(mut self, origin: Origin) -> Self {
        self.emit.origin = origin;
        self
    }

    /// Name of the module and of the files; by default the kernel's. Variants of one kernel need names.
    pub fn name(mut self, name: &str) -> Self {
        self.name = Some(name.to_owned());
        self
    }

    /// Of a file, the function that is the kernel; by default the public one with the file's name, or else the only public one that takes
    /// and gives what a kernel does.
    pub fn function(mut self, function: &str) -> Self {
        self.function = Some(function.to_owned());
        self
    }

    /// Also writes the shader in another language.
    pub fn target(mut self, target: Target) -> Self {
        self.emit.targets.insert(target);
        self
    }

    fn build(&self) -> Result<Built, Error> {
        let kernel = match &self.source {
            Source::Builtin(name) if self.function.is_some() => return Err(Error::of(Problem::Function(name.clone()))),
            Source::Builtin(name) => Kernel::builtin(name),
            Source::File(path) => Kernel::from_file(path, self.function.as_deref()),
        };
        let kernel = self.sources.iter().fold(kernel, |kernel, path| kernel?.with_file(path));
        let kernel = kernel.map_err(|e| Error::of(Problem::Kernel(e)))?;
        let name = self.name.clone().unwrap_or_else(|| kernel.name().to_owned());
        if syn::parse_str::<syn::Ident>(&raw(&name)).is_err() {
            return Err(Error::of(Problem::Name(name)));
        }
        let mut settings = self.settings.clone();
        if let Some(size) = self.emit.workgroup {
            settings.share = settings.share.of_size(size);
        }
        let compiled = kernel.compile(&settings).map_err(|e| Error::of(Problem::Kernel(e)))?;
        let emitted = compiled
            .emit(&self.emit)
            .map_err(|errors| Error::of(Problem::Kernel(errors)))?;
        let files = emitted.named(&name);
        Ok(Built {
            name,
            compiled,
            manifest: emitted.manifest,
            files,
        })
    }
}

impl Config {
    /// No shader yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// A built-in kernel.
    pub fn kernel(mut self, name: &str, options: impl FnOnce(KernelConfig) -> KernelConfig) -> Self {
        self.kernels
            .push(options(KernelConfig::new(Source::Builtin(name.to_owned()))));
        self
    }

    /// A kernel of one's own: the public function that has the file's name, or else the only public one that takes and gives
    /// what a kernel does, with its options at their
    /// defaults.
    pub fn file(self, path: impl AsRef<Path>) -> Self {
        self.file_with(path, |k| k)
    }

    /// A kernel of one's own with options.
    pub fn file_with(mut self, path: impl AsRef<Path>, options: impl FnOnce(KernelConfig) -> KernelConfig) -> Self {
        let source = Source::File(path.as_ref().to_owned());
        self.kernels.push(options(KernelConfig::new(source)));
        self
    }

    /// Where to write; by default cargo's `OUT_DIR`.
    pub fn out_dir(mut self, folder: impl AsRef<Path>) -> Self {
        self.out_dir = Some(folder.as_ref().to_owned());
        self
    }

    /// Tells cargo which files the shaders are made of.
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
        // Without a line of its own cargo would come back for every change in the package.
        println!("cargo::rerun-if-changed=build.rs");
    }

    /// Emits and writes everything, or nothing; in a build script tells cargo to come back when a
    /// kernel's file changes, and only then.
    ///
    /// # Errors
    ///
    /// Every error of every kernel at once; two shaders of one name; a folder that cannot be written.
    pub fn compile(&self) -> Result<(), Error> {
        // Cargo sets it for build scripts, and reads what they print.
        if std::env::var_os("OUT_DIR").is_some() {
            self.print_dependencies();
        }
        let folder = match &self.out_dir {
            Some(folder) if folder.as_os_str().is_empty() => return Err(Error::of(Problem::EmptyFolder)),
            Some(folder) => folder.clone(),
            None => std::env::var_os("OUT_DIR")
                .map(PathBuf::from)
                .ok_or_else(|| Error::of(Problem::NoFolder))?,
        };
        let mut problems = Vec::new();
        let mut built = Vec::new();
        for kernel in &self.kernels {
            match kernel.build() {
                Ok(shader) => built.push(shader),
                Err(error) => problems.extend(error.problems),
            }
        }
        let mut all = BTreeMap::new();
        for Built { name, files, .. } in &built {
            if all.contains_key(&format!("{name}.json")) {
                problems.push(Problem::Twice(name.clone()));
            }
            all.extend(files.clone());
        }
        if !problems.is_empty() {
            return Err(Error { problems });
        }
        let modules: Vec<emit::Module<'_>> = built.iter().map(Built::module).collect();
        let bindings = emit::bindings(&modules).map_err(|e| Error::of(Problem::Kernel(e)))?;
        all.insert(BINDINGS.to_owned(), bindings.into_bytes());
        files::write_all(&folder, &all)
            .map(|_| ())
            .map_err(|e| Error::of(Problem::Write(e)))
    }
}

/// Everything that kept a build from its shaders.
pub struct Error {
    problems: Vec<Problem>,
}

/// One thing that is wrong.
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
    fn of(problem: Problem) -> Self {
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

/// As `Display`: what `fn main() -> Result<...>` in a `build.rs` prints.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Error {
    /// What the system says about the first file that could not be read or written, if one is the problem.
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.problems.iter().find_map(std::error::Error::source)
    }
}
