//! Partially evaluates Rust image filters into straight-line shaders.
//!
//! Path, text and options in; text out. No GPU, no file is touched outside [`config`] and [`files`].
//!
//! ```
//! use straightline_codegen::{Kernel, Settings};
//!
//! let settings = Settings { options: vec![("pattern".into(), "ordered4".into())], ..Settings::default() };
//! let sraa = Kernel::builtin("sraa")?.compile(&settings)?;
//! assert_eq!(sraa.counts.basic_blocks, 1);
//! # Ok::<(), straightline_codegen::diagnostic::Errors>(())
//! ```

mod compiled;
pub mod config;
pub mod default_set;
pub mod diagnostic;
pub mod emit;
mod eval;
pub mod files;
mod front;
mod infer;
pub mod interp;
pub mod ir;
pub mod passes;
mod pipeline;
pub mod policy;
mod shorten;
mod suggest;

pub use compiled::Compiled;
pub use config::{Config, compile};
pub use emit::EmitOptions;
pub use eval::{LoopReport, OptionInfo, OptionKind};
pub use pipeline::{Kernel, Observer, Settings};
pub use policy::{Branches, ReadOrder, Transport, Unroll};
pub use shorten::shorten;
pub use straightline_manifest::{Form, Format, Manifest, Origin, Precision, Stage};
