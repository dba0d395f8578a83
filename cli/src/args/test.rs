//! The arguments of `test`.

use super::{AdapterArgs, SettingsArgs};
use clap::{Args, ValueHint};
use std::path::PathBuf;
use straightline_codegen::testing::{CASES, SEED};

#[derive(Debug, Args)]
pub struct TestArgs {
    /// File with a kernel and its tests, functions with `#[test]`
    #[arg(value_name = "FILE.rs", value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Tests to run: those whose path contains one of these texts; by default all of them
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// Additional file with functions that the kernel calls; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    /// Cases of each property
    #[arg(long, value_name = "N", default_value_t = CASES as u32, value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub cases: u32,
    /// Seed of the random cases
    #[arg(long, value_name = "N", default_value_t = SEED)]
    pub seed: u64,
    /// Run by the interpreter alone
    #[arg(long, conflicts_with = "adapter")]
    pub without_gpu: bool,
    /// Write the golden files of pictures from what the interpreter draws
    #[arg(long)]
    pub bless: bool,
    /// Also count what the tests execute, and write it to this file, as LCOV
    #[arg(long, value_name = "FILE.info", value_hint = ValueHint::FilePath)]
    pub coverage: Option<PathBuf>,
    /// Print JSON, one object a line, as the test programs of Rust do
    #[arg(long)]
    pub json: bool,
    /// Also write the results to this file, in the XML of JUnit
    #[arg(long, value_name = "FILE.xml", value_hint = ValueHint::FilePath)]
    pub junit: Option<PathBuf>,
    #[command(flatten)]
    pub options: SettingsArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}
