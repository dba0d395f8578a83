//! Generates straight-line shaders from image filters in Rust, by partial evaluation.
//!
//! A kernel is a function in a documented subset of Rust. Its loops and branches over compile-time constants are resolved, and what
//! remains is emitted as WGSL, GLSL, HLSL, MSL or SPIR-V, with a manifest and Rust bindings for the host. The crate needs no GPU, and
//! touches no file outside of [`config`] and [`files`].
//!
//! # In a build script
//!
//! [`Config`] compiles built-in kernels and those of a crate, and writes shaders and bindings to `OUT_DIR`. The crate includes them by
//! `straightline_runtime::include_shaders!()`.
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
//! # In a program
//!
//! A [`Kernel`] is a source, a [`ShaderSpec`] the description of one shader of it: its settings are those of the command line. The result
//! is a [`Compiled`] kernel, with counts and the graph, and [`emit::Emitted`] files.
//!
//! ```
//! use straightline_codegen::spec::Target;
//! use straightline_codegen::{Kernel, ShaderSpec};
//!
//! let text = "pub fn blurred(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
//!     let mut sum = Vec4::ZERO;
//!     for x in -1..=1 {
//!         sum += color.load(pixel + ivec2(x, 0));
//!     }
//!     sum / 3.0
//! }";
//! let kernel = Kernel::from_text("blurred.rs", text, "blurred");
//! let (compiled, emitted) = ShaderSpec::new().emit(&kernel)?;
//! assert_eq!(compiled.counts.basic_blocks, 1);
//! let wgsl = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
//! assert!(wgsl.contains("textureLoad") && !wgsl.contains("for ("));
//! # Ok::<(), straightline_codegen::diagnostic::Errors>(())
//! ```
//!
//! # Errors
//!
//! Every function returns [`diagnostic::Errors`]: messages with a code, a place in the kernel's source and the code to write instead. They
//! print as rustc's do. A kernel cannot take unbounded time or memory: see [`Limits`].

pub mod chain;
mod compiled;
pub mod config;
pub mod default_set;
pub mod drawing;
pub mod emit;
pub mod footprint;
mod kernel;
mod overridden;
mod pipeline;
pub mod spec;
mod stages;
pub mod testing;

pub use compiled::Compiled;
pub use config::{Config, compile};
pub use kernel::Kernel;
pub use overridden::Overridable;
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
