//! Partially evaluates Rust image filters into straight-line shaders.
//!
//! Path, text and options in; text out. No GPU, no file is touched outside [`config`] and [`files`].
//!
//! ```
//! use straightline_codegen::{Kernel, ShaderSpec};
//!
//! let spec = ShaderSpec::new().set("pattern", "ordered4");
//! let (sraa, _shader) = spec.emit(&Kernel::builtin("sraa")?)?;
//! assert_eq!(sraa.counts.basic_blocks, 1);
//! # Ok::<(), straightline_codegen::diagnostic::Errors>(())
//! ```

mod compiled;
pub mod config;
pub mod default_set;
pub mod emit;
mod kernel;
mod pipeline;
pub mod spec;
mod stages;

pub use compiled::Compiled;
pub use config::{Config, compile};
pub use kernel::Kernel;
pub use pipeline::Observer;
pub use spec::{EmitOptions, KernelConfig, Overrides, Settings, ShaderSpec};
pub use straightline_evaluator::eval::{LoopReport, Numeric, OptionInfo, OptionKind};
pub use straightline_evaluator::limits::Limits;
pub use straightline_evaluator::policy::{Branches, Math, ReadOrder, Share, Transport, Unroll};
pub use straightline_evaluator::{diagnostic, shorten};
pub use straightline_files as files;
// Internals of the evaluator, for this workspace's studies and tests. They may change in any version.
#[doc(hidden)]
pub use straightline_evaluator::{interp, ir, passes, policy};
pub use straightline_kernels as kernels;
pub use straightline_kernels::{OptionText, OptionValue, OptionValues};
pub use straightline_manifest::{Form, Format, Manifest, Origin, Precision, Stage};
