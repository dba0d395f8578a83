//! A kernel with the description of its shader, for a `build.rs`.

use super::{Candidates, ShaderSpec, Target, Variants};
use crate::chain::Fuse;
use std::path::{Path, PathBuf};
use straightline_kernels::KernelOptions;
use straightline_manifest::Format;

/// A shader: a kernel and the settings of its computation and text. WGSL is always written, because the bindings include
/// it. Made by [`Config::kernel`](crate::Config::kernel) and [`Config::file_with`](crate::Config::file_with).
#[derive(Clone, Debug)]
pub struct KernelConfig {
    pub(crate) source: Source,
    /// Name of the function that is the kernel of the file.
    pub(crate) function: Option<String>,
    pub(crate) name: Option<String>,
    pub(crate) spec: ShaderSpec,
    /// Pictures of a chain that are computed where they are read.
    pub(crate) fuse: Fuse,
    /// Format of the pictures between the passes of a chain.
    pub(crate) pictures: Option<Format>,
    /// Most pictures that a pass may write; `None` for the default.
    pub(crate) most_outputs: Option<u32>,
    /// Options with several values.
    pub(crate) variants: Variants,
    /// Other settings with which the shader computes the same.
    pub(crate) candidates: Candidates,
    /// Additional files with functions that the kernel calls.
    pub(crate) sources: Vec<PathBuf>,
}

/// Origin of a kernel's text.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// A built-in kernel, by name.
    Builtin(String),
    File(PathBuf),
}

impl KernelConfig {
    pub(crate) fn new(source: Source) -> Self {
        KernelConfig {
            source,
            function: None,
            name: None,
            spec: ShaderSpec::new(),
            fuse: Fuse::None,
            pictures: None,
            most_outputs: None,
            variants: Variants::default(),
            candidates: Candidates::default(),
            sources: Vec::new(),
        }
    }

    /// A kernel of a file, with options at their defaults: for a program that generates it when it runs.
    ///
    /// ```no_run
    /// # use straightline_codegen::KernelConfig;
    /// let emitted = KernelConfig::from_file("src/kernels/glow.rs").set("radius", 4).emit()?;
    /// # Ok::<(), straightline_codegen::config::Error>(())
    /// ```
    pub fn from_file(path: impl AsRef<Path>) -> Self {
        Self::new(Source::File(path.as_ref().to_owned()))
    }

    /// The files that the shader is generated of; none of a built-in kernel.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let own = match &self.source {
            Source::File(path) => Some(path),
            Source::Builtin(_) => None,
        };
        own.into_iter().chain(&self.sources).map(PathBuf::as_path)
    }

    /// Describes the shader by `spec`, in place of what was said before: for one description of several shaders.
    ///
    /// ```
    /// use straightline_codegen::{Config, ShaderSpec, Stage};
    ///
    /// let fragment = ShaderSpec::new().stage(Stage::Fragment);
    /// let shaders = Config::new().kernel("sraa", |k| k.spec(fragment.clone())).kernel("tabula_rasa", |k| k.spec(fragment));
    /// ```
    pub fn spec(mut self, spec: ShaderSpec) -> Self {
        self.spec = spec;
        self
    }

    /// Sets options of the kernel by its own structure of them, those that differ from its `Default`: checked by the editor. The
    /// feature `typed-options` gives the structures of the built-in kernels.
    ///
    /// ```
    /// # #[cfg(feature = "typed-options")] {
    /// use straightline_codegen::kernels::sraa::{Pattern, Sraa};
    ///
    /// let shaders = straightline_codegen::Config::new()
    ///     .kernel("sraa", |k| k.options(&Sraa { pattern: Pattern::Latin16, ..Default::default() }));
    /// # }
    /// ```
    pub fn options(mut self, options: &impl KernelOptions) -> Self {
        self.spec = self.spec.options(options);
        self
    }

    /// Also writes the shader in another language.
    ///
    /// ```
    /// # use straightline_codegen::{emit::Target, Config};
    /// let shaders = Config::new().kernel("sraa", |k| k.target(Target::Hlsl));
    /// ```
    pub fn target(mut self, target: Target) -> Self {
        self.spec = self.spec.target(target);
        self
    }

    /// Computes pictures of a chain where they are read, in place of storing them.
    ///
    /// ```
    /// # use straightline_codegen::{chain::Fuse, Config};
    /// let shaders = Config::new().file_with("src/bloom.rs", |k| k.fuse(Fuse::Auto));
    /// ```
    pub fn fuse(mut self, fuse: Fuse) -> Self {
        self.fuse = fuse;
        self
    }

    /// Sets how many pictures a pass of a chain may write, where workgroups compute several ([`Fuse::Share`]): 4 unless stated,
    /// which every device of WebGPU has.
    ///
    /// ```
    /// # use straightline_codegen::{chain::Fuse, Config};
    /// let shaders = Config::new().file_with("src/mips.rs", |k| k.fuse(Fuse::Share).most_outputs(8));
    /// ```
    pub fn most_outputs(mut self, most: u32) -> Self {
        self.most_outputs = Some(most);
        self
    }

    /// Format of the pictures between the passes of a chain, but of those with an attribute.
    ///
    /// ```
    /// # use straightline_codegen::{Config, Format};
    /// let shaders = Config::new().file_with("src/bloom.rs", |k| k.pictures(Format::Rgba8Unorm));
    /// ```
    pub fn pictures(mut self, format: Format) -> Self {
        self.pictures = Some(format);
        self
    }

    /// Adds a further file that the kernel calls functions of.
    ///
    /// ```
    /// # use straightline_codegen::Config;
    /// let shaders = Config::new().file_with("src/glow.rs", |k| k.source("src/colour.rs"));
    /// ```
    pub fn source(mut self, path: impl AsRef<Path>) -> Self {
        self.sources.push(path.as_ref().to_owned());
        self
    }

    /// Generates a shader for each combination of some options' values. Shaders with the same text are written once.
    ///
    /// The module then has an enum for each of these options, a structure `Variant` of their values with its shader, and
    /// `Passes`, which makes the pass of a variant when it is first asked for. The table of sizes is `NAME.variants.txt`.
    ///
    /// ```
    /// # use straightline_codegen::Config;
    /// let shaders = Config::new().kernel("sraa", |k| {
    ///     k.variants(|v| v.set("pattern", ["latin4", "latin16"]).set("mask", ["none", "branch"]))
    /// });
    /// ```
    pub fn variants(mut self, variants: impl FnOnce(Variants) -> Variants) -> Self {
        self.variants = variants(self.variants);
        self
    }

    /// Generates another shader that computes the same by other settings. The shader's own settings are the candidate
    /// `default`.
    ///
    /// The module then has the constant `CANDIDATES`, and `Pass::choose`, which times them on the user's device.
    /// A candidate has the same options, inputs, uniforms and targets.
    ///
    /// ```
    /// # use straightline_codegen::{Config, Share, Unroll};
    /// let shaders = Config::new().file_with("src/blur.rs", |k| {
    ///     k.candidate("looped", |s| s.unroll(Unroll::None)).candidate("shared", |s| s.share(Share::WORKGROUP))
    /// });
    /// ```
    pub fn candidate(mut self, name: &str, change: impl Fn(ShaderSpec) -> ShaderSpec + Send + Sync + 'static) -> Self {
        self.candidates.push(name, change);
        self
    }

    /// Name of the module and of the files; by default the kernel's. Variants of one kernel need names.
    ///
    /// ```
    /// # use straightline_codegen::Config;
    /// let shaders = Config::new().kernel("sraa", |k| k.set("pattern", "latin16").name("sraa_16"));
    /// ```
    pub fn name(mut self, name: &str) -> Self {
        self.name = Some(name.to_owned());
        self
    }

    /// Function that is the kernel of a file; by default the public one with the file's name, or else the only public one
    /// that takes and gives what a kernel does.
    ///
    /// ```
    /// # use straightline_codegen::Config;
    /// let shaders = Config::new().file_with("src/filters.rs", |k| k.function("glow"));
    /// ```
    pub fn function(mut self, function: &str) -> Self {
        self.function = Some(function.to_owned());
        self
    }
}
