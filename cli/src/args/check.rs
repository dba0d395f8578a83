//! The arguments of `check`.

use super::{KernelArgs, SettingsArgs, WritingArgs};
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;
use straightline_codegen::ShaderSpec;

/// The form of the errors that `check` prints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MessageFormat {
    /// For people, on standard error
    Human,
    /// cargo's and rustc's JSON, a message a line on standard output, as editors read it
    Json,
}

#[derive(Debug, Args)]
pub struct CheckArgs {
    /// What to check: FILE.rs, FILE.rs::FUNCTION, a built-in kernel, or a folder, which stands for the .rs files in it
    #[arg(required = true, value_name = "KERNEL", value_hint = ValueHint::AnyPath)]
    pub kernels: Vec<String>,
    /// A further file that the kernels call functions of; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    /// The form of the errors
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "human")]
    pub message_format: MessageFormat,
    #[command(flatten)]
    pub options: SettingsArgs,
    #[command(flatten)]
    pub writing: WritingArgs,
    /// A command to run first, whose messages are passed on, such as `cargo check --message-format=json`
    #[arg(last = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}

impl CheckArgs {
    /// The description of the shader that is checked.
    pub fn shader_spec(&self) -> ShaderSpec {
        self.options.shader_spec(&self.writing)
    }

    /// The arguments for one of the kernels.
    pub fn kernel_args(&self, kernel: &str) -> KernelArgs {
        KernelArgs {
            kernel: kernel.to_owned(),
            source: self.source.clone(),
            options: self.options.clone(),
        }
    }
}
