//! Files for users of an engine to drop in: the shader in the engine's dialect, the lines of host code or resource that bind
//! it, and a README.
//!
//! An engine is a folder: `engine.toml` says which shaders it wants of the generator and what it can bind
//! ([`description`]), and templates of tera write the files around them ([`context`] is what templates are given). The built-in
//! ones lie in `templates/`; a user's own is given by its path. No template computes anything: all that differs in a shader
//! comes from the generator.
//!
//! [`Engine::render_files`] is two steps: [`Engine::context`] has the generator emit what templates are given, and [`Engine::render`] renders them. A
//! program that takes one of the two holds nothing of the other.
//!
//! In a `build.rs`:
//!
//! ```no_run
//! use straightline_codegen::{Kernel, Settings};
//! use straightline_engines::write;
//!
//! let kernel = Kernel::from_file("src/kernels/glow.rs".as_ref(), None)?;
//! println!("cargo:rerun-if-changed=src/kernels/glow.rs");
//! write(&kernel, &Settings::default(), "godot", "assets/shaders".as_ref())?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod builtin;
pub mod chain;
pub mod context;
pub mod description;
mod engine;
mod error;
mod filters;
mod fits;
mod folder;
mod inputs;
pub mod meaning;
mod render;
mod shader_context;
mod spelling;
mod words;

pub use chain::ChainRequest;
pub use description::FIXED;
pub use engine::{Engine, Request};
pub use error::EngineError;
pub use meaning::{MEANINGS, Meaning, OWN};

use std::path::{Path, PathBuf};
use straightline_codegen::chain::{Chain, ChainSpec};
use straightline_codegen::{Kernel, Settings, files};

/// Names of the built-in engines, in order.
pub fn engine_names() -> impl Iterator<Item = &'static str> {
    builtin::DESCRIPTIONS.iter().map(|(name, _)| *name)
}

/// Writes a kernel for an engine, built in or a folder, into `out`, which is made if it is not there; all files or none. Returns
/// their paths. For a `build.rs`, which says itself what it is to be run again for.
///
/// # Errors
///
/// The kernel is wrong, it does not fit the engine, or the files cannot be written.
pub fn write(kernel: &Kernel, settings: &Settings, engine: &str, out: &Path) -> Result<Vec<PathBuf>, EngineError> {
    write_bound(kernel, settings, engine, &[], out)
}

/// Writes a chain for an engine, as [`write()`] does a kernel. `binds` has a [`Meaning`] or [`OWN`] for inputs whose names in the
/// chain do not say theirs.
///
/// # Errors
///
/// As [`write()`].
pub fn write_chain(
    chain: &Chain,
    spec: &ChainSpec,
    engine: &str,
    binds: &[(&str, &str)],
    out: &Path,
) -> Result<Vec<PathBuf>, EngineError> {
    let engine = Engine::find(engine)?;
    let compiled = chain.compile(spec)?;
    let options = chain.options()?;
    let request = ChainRequest::new(&compiled, &options);
    let request = binds
        .iter()
        .fold(request, |request, (input, word)| request.bind(input, word));
    Ok(files::write_all(out, &engine.render_chain_files(&request)?)?)
}

/// As [`write()`], with a [`Meaning`] or [`OWN`] for inputs whose names do not say theirs: `[("before", "color")]`.
///
/// # Errors
///
/// As [`write()`]; and if there is no such input or meaning.
pub fn write_bound(
    kernel: &Kernel,
    settings: &Settings,
    engine: &str,
    binds: &[(&str, &str)],
    out: &Path,
) -> Result<Vec<PathBuf>, EngineError> {
    let engine = Engine::find(engine)?;
    let compiled = kernel.compile(settings)?;
    let options = kernel.options()?;
    let request = Request::new(&compiled, &options);
    let request = binds
        .iter()
        .fold(request, |request, (input, word)| request.bind(input, word));
    Ok(files::write_all(out, &engine.render_files(&request)?)?)
}
