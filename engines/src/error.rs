//! Errors of engines.

use std::io;
use std::path::PathBuf;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::files::WriteError;

/// Reason why there are no files for an engine.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// Neither a built-in engine nor a folder with one.
    #[error("there is no engine `{name}`: one of {known}, or the path of a folder with an `engine.toml`")]
    Unknown {
        /// The name asked for.
        name: String,
        /// Names of the built-in engines.
        known: String,
    },
    /// A file of a user's engine cannot be read.
    #[error("cannot read `{path}`: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// An `engine.toml` that says something wrong.
    #[error("`engine.toml` of the engine `{engine}` is wrong: {message}")]
    Description {
        /// The engine.
        engine: String,
        /// Description of the error, with its place.
        message: String,
    },
    /// A template that cannot be rendered.
    #[error("the template `{template}` of the engine `{engine}` fails: {message}")]
    Template {
        /// The engine.
        engine: String,
        /// The template.
        template: String,
        /// Description of the error, with its place.
        message: String,
    },
    /// Templates of a user's folder that have not ended in time.
    #[error(
        "the templates of the engine `{engine}` take longer than {seconds} s: is there a loop in a loop in one of them?"
    )]
    Endless {
        /// The engine.
        engine: String,
        /// Seconds that they had.
        seconds: u64,
    },
    /// The kernel, or a setting of it, is wrong, or does not fit the engine: see its code.
    #[error(transparent)]
    Kernel(#[from] Errors),
    /// The files cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
