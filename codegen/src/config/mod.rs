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

mod built;
mod candidates;
mod error;
mod parallel;
mod shader;
mod variants;

use crate::emit::{self, Modules};
use crate::files;
use crate::spec::Source;
use built::Built;
use error::Problem;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

pub use crate::spec::{KernelConfig, Variants};
pub use error::Error;

/// Name of the file with the bindings.
const BINDINGS: &str = "straightline.rs";

/// Name of the file with the bindings that use wgpu alone.
const PLAIN_BINDINGS: &str = "straightline_wgpu.rs";

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
    plain: bool,
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
        self.kernels.push(options(KernelConfig::from_file(path)));
        self
    }

    /// Also writes bindings that need no runtime, to `straightline_wgpu.rs`, for a crate with its own version of wgpu. They
    /// have the texts, layouts, structures and constants, and the caller makes pipelines and bind groups:
    /// `include!(concat!(env!("OUT_DIR"), "/straightline_wgpu.rs"));`
    pub fn plain_bindings(mut self) -> Self {
        self.plain = true;
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
            for path in kernel.files() {
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
            match Built::new(kernel) {
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
        let mut modules = Modules::default();
        for each in &built {
            each.push_module(&mut modules);
        }
        let bindings = emit::render_bindings(&modules).map_err(Error::from_errors)?;
        all.insert(BINDINGS.to_owned(), bindings.into_bytes());
        if self.plain {
            let bindings = emit::render_plain_bindings(&modules);
            all.insert(PLAIN_BINDINGS.to_owned(), bindings.into_bytes());
        }
        files::write_all(&folder, &all)
            .map(|_| ())
            .map_err(|e| Error::from_problem(Problem::Write(e)))
    }
}
