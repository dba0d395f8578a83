//! The command line.

#[cfg(any(test, not(feature = "study")))]
mod absent;
mod at;
mod capture;
mod chain;
mod check;
mod kernel;
mod knobs;
mod run;
#[cfg(feature = "study")]
mod study;
#[cfg(feature = "study")]
mod sweep;
mod test;
#[cfg(feature = "study")]
mod tune;

use clap::{Args, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use glam::UVec2;
use std::path::PathBuf;
use straightline_codegen::emit::DebugInfo;
use straightline_codegen::{Precision, ShaderSpec, shorten};

#[cfg(not(feature = "study"))]
pub use absent::Gpu;
#[cfg(not(feature = "study"))]
use absent::{
    AbsentArgs as BudgetArgs, AbsentArgs as ChooseArgs, AbsentArgs as CompilersArgs, AbsentArgs as FiguresArgs,
    AbsentArgs as QuadsArgs, AbsentArgs as StudyArgs, AbsentArgs as TuneArgs,
};
pub use at::At;
pub use capture::{CaptureArgs, CompareArgs, PlacedByArg, ResolveArgs, ViewArgs};
pub use chain::ChainArgs;
pub use check::{CheckArgs, MessageFormat};
pub use kernel::KernelArgs;
pub use knobs::{SettingsArgs, WritingArgs};
pub use run::{Executor, GivenArgs, RunArgs, WatchArgs};
#[cfg(feature = "study")]
pub use straightline_isa::Gpu;
#[cfg(feature = "study")]
pub use study::{
    AllArgs, ChainsArgs, ChooseArgs, CommonArgs, CompilersArgs, ErrorArgs, FilmArgs, FrameArgs, Gpus, HardArgs,
    IsaArgs, LoopsArgs, MotionArgs, PrecisionArgs, Study, StudyArgs,
};
#[cfg(feature = "study")]
pub use sweep::{CardArgs, MergeArgs, RecordsArgs, SweepArgs};
pub use test::TestArgs;
#[cfg(feature = "study")]
pub use tune::TuneArgs;

/// Image filters written once, as ordinary Rust with ordinary loops, emitted as straight-line shaders.
///
/// Begin with `demo`: it emits shaders, renders a scene, antialiases it, writes pictures and prints what each method
/// costs and how close it comes.
#[derive(Debug, Parser)]
#[command(name = "straightline", version, max_term_width = 110)]
#[cfg_attr(not(feature = "study"), command(after_help = absent::ABOUT))]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Emit shaders, antialias a scene, and print the cost of each method
    Demo(DemoArgs),
    /// List the built-in kernels and engines, or the options of one kernel
    List(ListArgs),
    /// Emit a kernel as WGSL, GLSL, SPIR-V, HLSL or MSL, with a manifest
    Emit(EmitArgs),
    /// Print the errors of kernels, for people or for editors, and write nothing
    Check(CheckArgs),
    /// Count the operations of a kernel per pixel, or explain an error code
    Explain(ExplainArgs),
    /// Run a kernel on pictures
    Run(RunArgs),
    /// Run the tests of a kernel's file as shaders
    Test(TestArgs),
    /// Emit a kernel again whenever its file is saved, and update its picture
    Watch(WatchArgs),
    /// Measure the cost of a frame with and without SRAA: time, memory and reads
    Budget(BudgetArgs),
    /// Compare filters with and without work sharing over pixel quads
    Quads(QuadsArgs),
    /// Reproduce the pictures of the publications
    Figures(FiguresArgs),
    /// Measure unrolling, speed, error and hard cases; write records and a page
    Study(StudyArgs),
    /// Find and emit the cheapest SRAA shader for a scene
    Tune(TuneArgs),
    /// Compare the candidates for a shader by the compilers of GPUs
    Choose(ChooseArgs),
    /// Write the web page that shows and edits kernels
    Page(PageArgs),
    /// Antialias a captured frame
    Resolve(ResolveArgs),
    /// Render a scene or a model to a capture, for `resolve`
    Capture(CaptureArgs),
    /// Compare two pictures: PSNR, SSIM and FLIP
    Compare(CompareArgs),
    /// List the built-in scenes
    Scenes(ScenesArgs),
    /// List the GPUs and drivers that wgpu sees
    Adapters(AdaptersArgs),
    /// List the GPUs that shaders can be compiled for without having them
    Isa(CompilersArgs),
    /// Print the completion script for a shell
    Completions(CompletionsArgs),
    /// Write manual pages
    Man(ManArgs),
    /// Serve compilations for a GPU that is not present, on request of the parent process
    #[cfg(feature = "study")]
    #[command(hide = true)]
    ServeIsa,
}

#[derive(Debug, Args)]
pub struct ListArgs {
    /// Kernel to list the options of (a built-in one, FILE.rs or FILE.rs::FUNCTION), or an engine
    #[arg(value_name = "NAME", value_hint = ValueHint::FilePath)]
    pub name: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct EmitArgs {
    #[command(flatten)]
    pub kernel: KernelArgs,
    #[command(flatten)]
    pub writing: WritingArgs,
    #[command(flatten)]
    pub chain: ChainArgs,
    /// Same as `--debug lines`
    #[arg(short = 'g', conflicts_with_all = ["debug", "engine"])]
    pub lines: bool,
    /// Write the files for an engine: NAME (see `list`), or a folder with an `engine.toml`, which sets language, form and
    /// origin
    #[arg(long, value_name = "NAME|FOLDER", conflicts_with_all = straightline_engines::FIXED)]
    pub engine: Option<String>,
    /// Meaning of an input for the engine, where its name does not say it: `color`, `depth`, ... (see `list ENGINE`), or
    /// `own` for an input that you set
    #[arg(long, value_name = "NAME=MEANING", requires = "engine", value_parser = parse_bind)]
    pub bind: Vec<(String, String)>,
    /// Output folder; created if missing
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Name of the files, without extension; by default the kernel's name
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
}

/// Reads an input's name and its meaning.
fn parse_bind(text: &str) -> Result<(String, String), String> {
    pair(text).map_err(|_| "write NAME=MEANING, such as `scene=color`".to_owned())
}

impl EmitArgs {
    /// Returns the description of the shader.
    pub fn shader_spec(&self) -> ShaderSpec {
        let spec = self.kernel.options.shader_spec(&self.writing);
        match self.lines {
            true => spec.debug(DebugInfo::Lines),
            false => spec,
        }
    }
}

#[derive(Debug, Args)]
pub struct ExplainArgs {
    #[command(flatten)]
    pub kernel: KernelArgs,
    #[command(flatten)]
    pub chain: ChainArgs,
    /// Precision of the shader's arithmetic: f32 or f16
    #[arg(long, value_name = "PRECISION", default_value = "f32", value_parser = |s: &str| s.parse::<Precision>())]
    pub precision: Precision,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Also print the graph after each stage of the pipeline, and with --isa the machine code
    #[arg(long)]
    pub dump: bool,
    /// Also print the figures of Mesa's compiler for a GPU, which need not be present, such as amd:navi21, nvidia:ampere or
    /// apple:m1 (see `straightline isa`); or `device`, of this machine's GPU by its own driver
    #[arg(long, value_name = "VENDOR:GPU")]
    pub isa: Option<Gpu>,
    /// Also draw the texels that an invocation reads, with weights and messages, to this SVG file
    #[arg(long, value_name = "FILE.svg", value_hint = ValueHint::FilePath)]
    pub draw: Option<PathBuf>,
    /// Print only where a line of the shader comes from, such as 42 (of the WGSL) or hlsl:42, or which of its lines come
    /// from a line of the source, such as blur.rs:12. The shader is the one that `emit` writes without other settings of
    /// its text; for any other, give the NAME.map.json that `emit --debug map` writes instead of the kernel
    #[arg(long, value_name = "LINE", conflicts_with_all = ["draw", "isa", "dump"])]
    pub at: Option<At>,
}

#[derive(Debug, Args)]
pub struct PageArgs {
    /// Output folder, ready for any static host; created if missing
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// WebAssembly file of the generator, as built by page/build; by default both modules are built from the surrounding
    /// source checkout
    #[arg(long, value_name = "FILE.wasm", requires = "templates")]
    pub module: Option<PathBuf>,
    /// WebAssembly file of the engine templates, built together with the generator
    #[arg(long, value_name = "FILE.wasm", requires = "module")]
    pub templates: Option<PathBuf>,
}

#[cfg(feature = "study")]
#[derive(Debug, Args)]
pub struct BudgetArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: UVec2,
    /// Repetitions of the timing; each runs every pass and filter once, in turn
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u32).range(3..=1000))]
    pub rounds: u32,
    /// Shading evaluations per sample, each at its own position in the pixel; sets how expensive shading is
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub shading_cost: u32,
    /// Also write the measurements and their circumstances to this JSON file
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

#[cfg(feature = "study")]
#[derive(Debug, Args)]
pub struct QuadsArgs {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: UVec2,
    /// Model to render instead of the built-in scene: .gltf, .glb or .obj
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Repetitions of the timing; each runs every shader once, in turn
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Also write the table and its circumstances to this JSON file
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Width and height of the shadow map, in texels
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub texels: u32,
    /// Also write pictures of shadows and occlusion to this folder
    #[arg(long, value_name = "DIR")]
    pub pictures: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

#[cfg(feature = "study")]
#[derive(Debug, Args)]
pub struct FiguresArgs {
    /// Figure to write, by its file name without extension; may be given several times; by default all of them
    #[arg(long = "figure", value_name = "NAME")]
    pub figures: Vec<String>,
    /// Width and height of the rendered picture, in pixels; the figure shows a detail of it
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size)]
    pub size: UVec2,
    /// Output folder; created if missing
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

#[derive(Debug, Clone, Default, Args)]
pub struct AdapterArgs {
    /// Adapter to use: the first whose name or driver contains this text (see `adapters`)
    #[arg(long, value_name = "TEXT", global = true)]
    pub adapter: Option<String>,
}

#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell to complete for
    pub shell: Shell,
}

#[derive(Debug, Args)]
pub struct ManArgs {
    /// Output folder, with one page for each command; created if missing
    #[arg(value_name = "DIR")]
    pub out: PathBuf,
}

#[derive(Debug, Args)]
pub struct ScenesArgs {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct AdaptersArgs {
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct DemoArgs {
    /// Folder for shaders and pictures
    #[arg(long, value_name = "DIR", default_value = "demo")]
    pub out: PathBuf,
    /// Built-in scene to render (see `scenes`)
    #[arg(long, value_name = "NAME", default_value = "roof")]
    pub scene: String,
    /// Width and height in pixels; by default 1280x720, or 320x180 without a GPU
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Model to render instead of a built-in scene: .gltf, .glb or .obj
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    pub mesh: Option<PathBuf>,
    /// Repetitions of the timing, each of which runs every pass once, in turn; fewer if they take longer than 10 seconds
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Print only the table, adapter and driver, as JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

impl Default for DemoArgs {
    fn default() -> Self {
        DemoArgs {
            out: PathBuf::from("demo"),
            scene: "roof".to_owned(),
            size: None,
            mesh: None,
            rounds: 15,
            json: false,
            adapter: AdapterArgs::default(),
        }
    }
}

fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() && !value.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err(format!(
            "`{}` is not of the form OPTION=VALUE, such as pattern=ordered16",
            shorten(text)
        )),
    }
}

fn size(text: &str) -> Result<UVec2, String> {
    let parse = |(w, h): (&str, &str)| Some(UVec2::new(w.parse().ok()?, h.parse().ok()?));
    match text.split_once('x').and_then(parse) {
        Some(size) if (1..=8192).contains(&size.x) && (1..=8192).contains(&size.y) => Ok(size),
        _ => Err(format!(
            "`{}` is not a size such as 1280x720, from 1x1 to 8192x8192",
            shorten(text)
        )),
    }
}
