//! Arguments that select a kernel and its options.

use super::SettingsArgs;
use clap::{Args, ValueHint};
use std::path::PathBuf;
use straightline_codegen::Kernel;
use straightline_codegen::chain::Chain;
use straightline_codegen::diagnostic::Errors;

/// Selection of a kernel and its options.
#[derive(Debug, Clone, Args)]
pub struct KernelArgs {
    /// Kernel: a built-in one (see `list`), FILE.rs, or FILE.rs::FUNCTION
    #[arg(value_hint = ValueHint::FilePath)]
    pub kernel: String,
    /// Additional file with functions that the kernel calls; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    #[command(flatten)]
    pub options: SettingsArgs,
}

impl KernelArgs {
    /// Returns the chain with all its files; `None` if the name is that of a kernel.
    pub fn locate_chain(&self) -> Result<Option<Chain>, Errors> {
        let Some(chain) = Chain::from_argument(&self.kernel)? else {
            return Ok(None);
        };
        let chain = self.source.iter().try_fold(chain, |chain, path| chain.with_file(path));
        chain.map(Some)
    }

    /// Returns the kernel with all its files.
    pub fn locate_kernel(&self) -> Result<Kernel, Errors> {
        let kernel = Kernel::from_argument(&self.kernel);
        self.source.iter().fold(kernel, |kernel, path| kernel?.with_file(path))
    }
}
