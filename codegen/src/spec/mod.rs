//! Description of a shader: its computation and its text.
//!
//! [`ShaderSpec`] has two halves, [`Settings`] for [`Kernel::compile`](crate::Kernel::compile) and [`EmitOptions`] for
//! [`Compiled::emit`](crate::Compiled::emit). Each of their fields is a *knob*, declared once in `knobs.rs`: type, default,
//! name as text, builder method and documentation. The command line, the page and `engine.toml` read [`KNOBS`], so they
//! have every knob that `build.rs` has.
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

mod candidates;
mod debug_info;
mod declare;
mod kernel_config;
mod knobs;
mod overrides;
mod parameters;
mod register;
mod target;
mod texels;
mod value;
mod variants;

pub(crate) use candidates::Candidates;
pub use debug_info::DebugInfo;
pub use kernel_config::KernelConfig;
pub(crate) use kernel_config::Source;
pub use knobs::{EmitOptions, KNOBS, Settings};
pub use overrides::Overrides;
pub use parameters::Parameters;
pub use register::Register;
pub(crate) use register::{LAST_BINDING, LAST_GROUP};
pub use target::Target;
pub use texels::Texels;
pub use value::Arity;
pub use variants::Variants;

use straightline_evaluator::eval::override_text;
use straightline_evaluator::is_close;
use straightline_evaluator::limits::Limits;
use straightline_evaluator::policy::Policy;
use straightline_kernels::{KernelOptions, OptionText};
use straightline_manifest::{Form, Origin};

/// Description of a shader: its computation and its text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ShaderSpec {
    /// Settings of the computation.
    pub settings: Settings,
    /// Settings of the text.
    pub emit: EmitOptions,
}

/// The half of a [`ShaderSpec`] that contains a knob.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Settings of the computation.
    Settings,
    /// Settings of the text.
    EmitOptions,
}

/// A field of a [`ShaderSpec`], with a textual interface.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Knob {
    /// Name: `--NAME` of the command line, a key of `engine.toml` and of the page's messages.
    pub name: &'static str,
    /// Placeholder of the value in messages; empty for a flag.
    pub value: &'static str,
    doc: &'static str,
    /// The half that contains the knob.
    pub part: Part,
    /// Number of texts that the value consists of.
    pub arity: Arity,
    read: fn(&ShaderSpec) -> Vec<String>,
    write: fn(&mut ShaderSpec, &[&str]) -> Result<(), String>,
    example: fn(ShaderSpec) -> ShaderSpec,
    /// Call in a `build.rs` that sets the value of [`Knob::example`].
    pub call: &'static str,
}

impl Knob {
    /// Returns the knob of this name, with `-` or `_` between words.
    ///
    /// # Errors
    ///
    /// If there is none; with the name that was meant, if one is close.
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

    /// Returns the documentation in one line, without the final full stop.
    pub fn help(&self) -> String {
        let words: Vec<&str> = self.doc.split_whitespace().collect();
        words.join(" ").trim_end_matches('.').to_owned()
    }

    /// Returns the texts of the value; empty if it is not set.
    pub fn value_texts(&self, spec: &ShaderSpec) -> Vec<String> {
        (self.read)(spec)
    }

    /// Sets the value, replacing the previous one.
    ///
    /// # Errors
    ///
    /// If a text is not a valid value, with an example of one.
    pub fn set(&self, spec: &mut ShaderSpec, texts: &[&str]) -> Result<(), String> {
        (self.write)(spec, texts)
    }

    /// Sets this knob to the non-default value of its documentation, for tests that cover all knobs.
    #[doc(hidden)]
    pub fn example(&self, spec: ShaderSpec) -> ShaderSpec {
        (self.example)(spec)
    }
}

impl ShaderSpec {
    /// Describes a compute shader in WGSL, fully unrolled, with the kernel's options at their defaults.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets options of a kernel from its typed structure: those that differ from its `Default`.
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
    /// Default maximum number of statements.
    pub const BUDGET: u32 = 20_000;

    /// Sets options of a kernel from its typed structure: those that differ from its `Default`.
    pub fn options(mut self, options: &impl KernelOptions) -> Self {
        self.options.extend(options.changed());
        self
    }

    /// Sets several options, as [`Settings::set`] does for one.
    pub fn set_all(mut self, options: impl IntoIterator<Item = OptionText>) -> Self {
        self.options.extend(options);
        self
    }

    /// Returns the options, with those to be overridden spelled as such.
    pub fn option_texts(&self) -> Vec<OptionText> {
        self.with_overrides(self.options.clone())
    }

    /// Returns options with those to be overridden spelled as such.
    pub(crate) fn with_overrides(&self, mut options: Vec<OptionText>) -> Vec<OptionText> {
        for name in &self.overrides {
            match options.iter_mut().find(|(known, _)| known == name) {
                Some((_, value)) => *value = override_text(Some(value)),
                None => options.push((name.clone(), override_text(None))),
            }
        }
        options
    }

    /// Returns the limits on time and memory for compiling and emitting.
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
    /// A square of as many pixels as WebGPU's default limits allow: neighbours read the same texels, which then lie in
    /// the cache. On an H100, SRAA takes 1.3 to 1.4 times as long in rows of 256x1, and no form that was measured both
    /// ways gains more than 3 % by them (docs/study-gpu.md).
    pub const WORKGROUP: [u32; 2] = [16, 16];

    /// Invocations of a compute workgroup in three dimensions.
    pub(crate) fn workgroup_size(&self) -> [u32; 3] {
        let [x, y] = self.workgroup.unwrap_or(Self::WORKGROUP);
        [x, y, 1]
    }

    pub(crate) fn is_function(&self) -> bool {
        self.form == Form::Function
    }

    /// Returns whether this is a function whose texels come from host functions.
    pub(crate) fn calls_host(&self) -> bool {
        self.is_function() && self.texels == Texels::Functions
    }

    pub(crate) fn counts_from_below(&self) -> bool {
        self.origin == Origin::LowerLeft
    }

    /// Returns whether the entry point has a separate variable for the written place, because it differs from the pixel.
    pub(crate) fn has_place(&self) -> bool {
        self.region || self.counts_from_below()
    }
}
