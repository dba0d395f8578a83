//! The arguments that say which kernel, with which options.

use super::{pair, size};
use clap::{Args, ValueHint};
use glam::UVec2;
use std::path::PathBuf;
use std::time::Duration;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::{Branches, Kernel, Limits, Math, ReadOrder, Settings, Share, Transport, Unroll};

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
    pub options: OptionArgs,
}

impl KernelArgs {
    /// The kernel with all its files.
    pub fn locate(&self) -> Result<Kernel, Errors> {
        let kernel = Kernel::locate(&self.kernel);
        self.source.iter().fold(kernel, |kernel, path| kernel?.with_file(path))
    }
}

/// Options of a kernel.
#[derive(Debug, Clone, Args)]
pub struct OptionArgs {
    /// Set an option of the kernel (see `list KERNEL`); may be given several times. A number may be `uniform`: the host gives it
    #[arg(help_heading = "Kernel options", long = "set", value_name = "OPTION=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// How far loops are unrolled: `full`, `none`, or by a factor such as `4`, which leaves loops with four iterations in a row
    #[arg(help_heading = "Kernel options", long, value_name = "POLICY", default_value = "full", value_parser = |s: &str| s.parse::<Unroll>())]
    pub unroll: Unroll,
    /// How far one loop is unrolled: LOOP is `function.counter` (see `explain`) or the counter; may be given several times
    #[arg(help_heading = "Kernel options", long, value_name = "LOOP=POLICY", value_parser = loop_policy)]
    pub unroll_loop: Vec<(String, Unroll)>,
    /// What becomes of an `if` on runtime values: `keep` leaves a branch, `select` computes both sides, `as-loops` keeps it where
    /// loops are left in the shader
    #[arg(help_heading = "Kernel options", long, value_name = "POLICY", default_value = "as-loops", value_parser = |s: &str| s.parse::<Branches>())]
    pub branches: Branches,
    /// How texels are read: `source` as the kernel's text does, `rows` all at first, row by row, `gather` four at once, of one
    /// component, where several of them are wanted. The picture is the same
    #[arg(help_heading = "Kernel options", long, value_name = "ORDER", default_value = "source", value_parser = |s: &str| s.parse::<ReadOrder>())]
    pub reads: ReadOrder,
    /// Most statements that the kernel may have
    #[arg(help_heading = "Kernel options", long, value_name = "STATEMENTS", default_value_t = Settings::BUDGET)]
    pub budget: u32,
    /// Longest time that compiling and emitting the kernel may take, in seconds
    #[arg(help_heading = "Kernel options", long, value_name = "SECONDS", default_value = "60", value_parser = seconds)]
    pub time_limit: Duration,
    /// Most memory that values and operations may take while the kernel is compiled, in millions of bytes
    #[arg(help_heading = "Kernel options", long, value_name = "MEGABYTES", default_value_t = 2000, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub memory_limit: u64,
    /// How the lanes of a pixel quad exchange values: subgroup, derivatives or block; by default subgroup operations in
    /// fragment shaders and blocks in compute
    #[arg(help_heading = "Kernel options", long, value_name = "TRANSPORT", value_parser = |s: &str| s.parse::<Transport>())]
    pub transport: Option<Transport>,
    /// Whether pixels share the texels they read: `invocation` for no; `workgroup` has 16x16 threads read each once into memory of
    /// theirs, `workgroup(WxH)` so many. The picture is the same
    #[arg(help_heading = "Kernel options", long, value_name = "HOW", default_value = "invocation", value_parser = |s: &str| s.parse::<Share>())]
    pub share: Share,
    /// Algebra with floats: `exact` changes no bit of the result, `fast` may change roundings, for fewer and cheaper operations;
    /// `strict` is `exact` and keeps drivers from changing any rounding, at a cost
    #[arg(help_heading = "Kernel options", long, value_name = "HOW", default_value = "exact", value_parser = |s: &str| s.parse::<Math>())]
    pub math: Math,
    /// Pixels that one compute invocation computes, across and down
    #[arg(help_heading = "Kernel options", long, value_name = "WxH", default_value = "1x1", value_parser = size)]
    pub block: UVec2,
}

impl Default for OptionArgs {
    fn default() -> Self {
        OptionArgs {
            set: Vec::new(),
            unroll: Unroll::default(),
            unroll_loop: Vec::new(),
            branches: Branches::default(),
            reads: ReadOrder::default(),
            budget: Settings::BUDGET,
            time_limit: Limits::default().time,
            memory_limit: Limits::default().memory / MEGABYTE,
            transport: None,
            share: Share::default(),
            math: Math::default(),
            block: UVec2::ONE,
        }
    }
}

impl OptionArgs {
    pub fn settings(&self) -> Settings {
        Settings {
            options: self.set.clone(),
            unroll: self.unroll,
            loops: self.unroll_loop.clone(),
            branches: self.branches,
            reads: self.reads,
            budget: self.budget,
            transport: self.transport,
            share: self.share,
            math: self.math,
            block: self.block.to_array(),
            limits: Limits {
                time: self.time_limit,
                memory: self.memory_limit * MEGABYTE,
            },
            ..Settings::default()
        }
    }
}

/// Bytes of a unit of `--memory-limit`.
const MEGABYTE: u64 = 1_000_000;

/// A positive number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().filter(|seconds| *seconds > 0.0);
    let time = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    time.ok_or_else(|| format!("`{text}` is no time: give a positive number of seconds, such as 60 or 0.5"))
}

fn loop_policy(text: &str) -> Result<(String, Unroll), String> {
    let (path, policy) = pair(text)?;
    Ok((path, policy.parse()?))
}
