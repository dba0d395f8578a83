//! The arguments that say which kernel, with which options.

use super::SettingsArgs;
use clap::{Args, ValueHint};
use std::path::PathBuf;
use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::Errors;

/// Which kernel, with which options.
#[derive(Debug, Clone, Args)]
pub struct KernelArgs {
    /// A built-in kernel (see `list`), FILE.rs, or FILE.rs::FUNCTION
    #[arg(value_hint = ValueHint::FilePath)]
    pub kernel: String,
    /// A further file that the kernel calls functions of; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    #[command(flatten)]
    pub options: SettingsArgs,
}

impl KernelArgs {
    /// The kernel with all its files.
    pub fn locate_kernel(&self) -> Result<Kernel, Errors> {
        let kernel = Kernel::from_argument(&self.kernel);
        self.source.iter().fold(kernel, |kernel, path| kernel?.with_file(path))
    }
}
