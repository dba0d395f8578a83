//! The description of a shader: what it computes and how it is written.
//!
//! [`ShaderSpec`] has two halves, [`Settings`] for [`Kernel::compile`](crate::Kernel::compile) and [`EmitOptions`] for
//! [`Compiled::emit`](crate::Compiled::emit). Each of their fields is a *knob*, declared once in `knobs.rs`: type, default,
//! name as text, builder method and documentation. The command line, the page and `engine.toml` read [`KNOBS`], and so have
//! every knob that `build.rs` has.
//!
//! ```
//! use straightline_codegen::{Kernel, ShaderSpec, Stage};
//!
//! let spec = ShaderSpec::new().set("pattern", "ordered4").stage(Stage::Fragment);
//! let (compiled, emitted) = spec.emit(&Kernel::builtin("sraa")?)?;
//! assert_eq!(compiled.counts.basic_blocks, 1);
//! assert_eq!(emitted.manifest.stage, Stage::Fragment);
//! # Ok::<(), straightline_codegen::diagnostic::Errors>(())
//! ```

mod declare;
mod kernel_config;
mod knobs;
mod overrides;
mod register;
mod target;
mod texels;
mod value;

pub use kernel_config::KernelConfig;
pub(crate) use kernel_config::Source;
pub use knobs::{EmitOptions, KNOBS, Settings};
pub use overrides::Overrides;
pub use register::Register;
pub(crate) use register::{LAST_BINDING, LAST_GROUP};
pub use target::Target;
pub use texels::Texels;
pub use value::Arity;

use straightline_evaluator::is_close;
use straightline_evaluator::limits::Limits;
use straightline_evaluator::policy::Policy;
use straightline_kernels::{KernelOptions, OptionText};
use straightline_manifest::{Form, Origin};

/// The description of a shader: what it computes and how it is written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ShaderSpec {
    /// Settings of its computation.
    pub settings: Settings,
    /// Settings of its text.
    pub emit: EmitOptions,
}

/// The half of a [`ShaderSpec`] that a knob belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Settings of the computation.
    Settings,
    /// Settings of the text.
    EmitOptions,
}

/// A field of a [`ShaderSpec`], as text.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Knob {
    /// Name: `--NAME` of the command line, a key of `engine.toml` and of the page's messages.
    pub name: &'static str,
    /// Placeholder of its value in messages; empty of a flag.
    pub value: &'static str,
    doc: &'static str,
    /// The half that it belongs to.
    pub part: Part,
    /// Number of texts that it takes.
    pub arity: Arity,
    read: fn(&ShaderSpec) -> Vec<String>,
    write: fn(&mut ShaderSpec, &[&str]) -> Result<(), String>,
    example: fn(ShaderSpec) -> ShaderSpec,
    /// Call in a `build.rs` that sets the value of [`Knob::example`].
    pub call: &'static str,
}

impl Knob {
    /// The knob of this name, with `-` or `_` between words.
    ///
    /// # Errors
    ///
    /// There is none; with the name that is meant, if one is close.
    pub fn find(name: &str) -> Result<&'static Knob, String> {
        let spelled = name.replace('_', "-");
        KNOBS.iter().find(|knob| knob.name == spelled).ok_or_else(|| {
            let name = straightline_evaluator::shorten(name);
            match KNOBS.iter().find(|knob| is_close(&spelled, knob.name)) {
                Some(close) => format!("a shader has no setting `{name}`: did you mean `{}`?", close.name),
                None => format!("a shader has no setting `{name}`: docs/settings.md lists them"),
            }
        })
    }

    /// Documentation in one line, without a full stop at its end.
    pub fn help(&self) -> String {
        let words: Vec<&str> = self.doc.split_whitespace().collect();
        words.join(" ").trim_end_matches('.').to_owned()
    }

    /// Texts of its value; none of a value that is not set.
    pub fn value_texts(&self, spec: &ShaderSpec) -> Vec<String> {
        (self.read)(spec)
    }

    /// Sets its value, in place of the one before.
    ///
    /// # Errors
    ///
    /// A text that is no value of the knob, with what would be one.
    pub fn set(&self, spec: &mut ShaderSpec, texts: &[&str]) -> Result<(), String> {
        (self.write)(spec, texts)
    }

    /// The description with this knob at a value that is not its default, as in its documentation: for tests that go over all.
    #[doc(hidden)]
    pub fn example(&self, spec: ShaderSpec) -> ShaderSpec {
        (self.example)(spec)
    }
}

impl ShaderSpec {
    /// A compute shader in WGSL, fully unrolled, with the kernel's options at their defaults.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets options of a built-in kernel by its own structure of them: those that differ from its `Default`.
    pub fn options(mut self, options: &impl KernelOptions) -> Self {
        self.settings = self.settings.options(options);
        self
    }

    /// Also writes the shader in another language.
    pub fn target(mut self, target: Target) -> Self {
        self.emit.targets.insert(target);
        self
    }
}

impl Settings {
    /// Statements that a kernel may have unless more are allowed.
    pub const BUDGET: u32 = 20_000;

    /// Sets options of a kernel by its own structure of them: those that differ from its `Default`.
    pub fn options(mut self, options: &impl KernelOptions) -> Self {
        self.options.extend(options.changed());
        self
    }

    /// Sets several options, as [`Settings::set`] does one.
    pub fn set_all(mut self, options: impl IntoIterator<Item = OptionText>) -> Self {
        self.options.extend(options);
        self
    }

    /// Time and memory that compiling and emitting may take.
    pub fn limits(&self) -> Limits {
        Limits {
            time: self.time_limit,
            memory: self.memory_limit,
        }
    }

    pub(crate) fn policy(&self) -> Policy {
        Policy {
            unroll: self.unroll,
            loops: self.loops.clone(),
            branches: self.branches,
            reads: self.reads,
            share: self.share,
            math: self.math,
        }
    }
}

impl EmitOptions {
    /// A row of pixels, as wide as WebGPU's default limits allow. On lavapipe rows were faster than squares of 8x8 or
    /// 16x16, looped and unrolled; on a GPU this has not been measured yet.
    pub const WORKGROUP: [u32; 2] = [256, 1];

    /// Invocations of a compute workgroup in three dimensions.
    pub(crate) fn workgroup_size(&self) -> [u32; 3] {
        let [x, y] = self.workgroup.unwrap_or(Self::WORKGROUP);
        [x, y, 1]
    }

    pub(crate) fn is_function(&self) -> bool {
        self.form == Form::Function
    }

    /// True of a function whose texels come from functions of the host.
    pub(crate) fn calls_host(&self) -> bool {
        self.is_function() && self.texels == Texels::Functions
    }

    pub(crate) fn counts_from_below(&self) -> bool {
        self.origin == Origin::LowerLeft
    }

    /// True if the entry point has a variable for the place that it writes, which is not the pixel then.
    pub(crate) fn has_place(&self) -> bool {
        self.region || self.counts_from_below()
    }
}
