//! The arguments of `check`.

use super::{KernelArgs, SettingsArgs, WritingArgs};
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;
use straightline_codegen::ShaderSpec;

/// Format of the errors that `check` prints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// Readable text on standard error
    Human,
    /// The JSON of cargo and rustc, one message a line on standard output, as editors read it
    Json,
}

#[derive(Debug, Args)]
pub struct CheckArgs {
    /// Kernels to check: FILE.rs, FILE.rs::FUNCTION, a built-in kernel, or a folder for all of its .rs files
    #[arg(required = true, value_name = "KERNEL", value_hint = ValueHint::AnyPath)]
    pub kernels: Vec<String>,
    /// Additional file with functions that the kernels call; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    /// Format of the errors
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "human")]
    pub message_format: MessageFormat,
    #[command(flatten)]
    pub options: SettingsArgs,
    #[command(flatten)]
    pub writing: WritingArgs,
    /// Command to run first, such as `cargo check --message-format=json`; its messages are passed on
    #[arg(last = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}

impl CheckArgs {
    /// Returns the description of the shader to check.
    pub fn shader_spec(&self) -> ShaderSpec {
        self.options.shader_spec(&self.writing)
    }

    /// Returns the arguments for one of the kernels.
    pub fn kernel_args(&self, kernel: &str) -> KernelArgs {
        KernelArgs {
            kernel: kernel.to_owned(),
            source: self.source.clone(),
            options: self.options.clone(),
        }
    }
}
