//! Arguments of `study` and `tune`.

use super::{AdapterArgs, CardArgs, KernelArgs, MergeArgs, RecordsArgs, SweepArgs, size};
use clap::{Args, Subcommand, ValueHint};
use glam::{UVec2, Vec2};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::str::FromStr;
use straightline_codegen::Precision;
use straightline_isa::Gpu;

#[derive(Debug, Args)]
pub struct StudyArgs {
    /// Study to run; by default all of them
    #[command(subcommand)]
    pub study: Option<Study>,
    #[command(flatten)]
    pub common: CommonArgs,
}

/// Arguments shared by all studies.
#[derive(Clone, Debug, Args)]
pub struct CommonArgs {
    /// Folder for records (JSON, CSV), pictures and report.html; the report shows every record in the folder
    #[arg(long, value_name = "DIR", default_value = "study-report", global = true)]
    pub out: PathBuf,
    /// Small pictures and few repetitions: minutes instead of hours, with less precise measurements
    #[arg(long, global = true)]
    pub quick: bool,
    /// Width and height in pixels; by default 1280x720, with --quick 480x270
    #[arg(long, value_name = "WxH", value_parser = size, global = true)]
    pub size: Option<UVec2>,
    /// Repetitions of the timing; each runs every shader once, in turn; by default 31, with --quick 11
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000), global = true)]
    pub rounds: Option<u32>,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

impl CommonArgs {
    /// Returns the width and height of pictures.
    pub fn picture_size(&self) -> UVec2 {
        self.size.unwrap_or(match self.quick {
            true => UVec2::new(480, 270),
            false => UVec2::new(1280, 720),
        })
    }

    /// Returns the number of timing rounds.
    pub fn timing_rounds(&self) -> u32 {
        self.rounds.unwrap_or(if self.quick { 11 } else { 31 })
    }
}

#[derive(Clone, Debug, Subcommand)]
pub enum Study {
    /// Compare the unrolled and looped forms of each kernel: time, counts, error
    Loops(LoopsArgs),
    /// Compare antialiasing methods on all scenes: time, and error against 256 samples a pixel
    Error(ErrorArgs),
    /// Plot the time of a whole frame against its error, from records of `budget` and `study error`
    Frame(FrameArgs),
    /// Film a slow pan by several methods side by side, and measure the error of the change between frames
    Film(FilmArgs),
    /// Compare SRAA with and without earlier frames, and supersampling, in a still, a pan, a turn and with moving objects
    Motion(MotionArgs),
    /// Run numerically hard cases in every precision, in shader and interpreter
    Hard(HardArgs),
    /// Compile each kernel with GPU compilers, without a GPU, and report their figures
    Isa(IsaArgs),
    /// Measure chains of passes with pictures stored and computed where they are read: time, memory, error
    Chains(ChainsArgs),
    /// Find values of a kernel that may be computed in half precision: the cheapest choice within a bound of the error
    Precision(Box<PrecisionArgs>),
    /// Measure one kernel in every combination of options, unroll factors, stages, workgroups and blocks
    Sweep(Box<SweepArgs>),
    /// Join the records of all shards of a sweep
    Merge(MergeArgs),
    /// Compare two records of a sweep; exit status 1 if they differ
    Compare(RecordsArgs),
    /// Take every record of the documents again, with --quick or --full; kept where it is complete in --out
    All(AllArgs),
    /// Write the report page again from the records in the folder
    Report,
}

#[derive(Clone, Debug, Default, Args)]
pub struct LoopsArgs {
    /// Kernel to study instead of the built-in selection: FILE.rs, FILE.rs::FUNCTION, or a built-in name; may be given
    /// several times; each runs on a test card
    #[arg(long, value_name = "KERNEL")]
    pub from: Vec<String>,
    /// Hand-written version with loops of each --from kernel, in order, with the same inputs under the same names
    #[arg(long, value_name = "KERNEL", requires = "from")]
    pub by_hand: Vec<String>,
    /// Value of a uniform of the --from kernels: NAME=NUMBER, or NAME=X,Y,Z for a vector; by default 1 if the kernel states
    /// none; may be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = super::pair, requires = "from")]
    pub uniform: Vec<(String, String)>,
    /// Also write the picture of each kernel to this folder, and all of them in one picture, `all.png`
    #[arg(long, value_name = "DIR")]
    pub pictures: Option<PathBuf>,
}

#[derive(Clone, Debug, Args)]
pub struct ChainsArgs {
    /// Chain to measure: FILE.rs or FILE.rs::FUNCTION; several are measured one after the other
    #[arg(required = true, value_name = "CHAIN")]
    pub chains: Vec<String>,
    /// Additional file with functions that the chains call; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    /// Picture for a texture of each chain, NAME=FILE, in place of the test card; may be given several times
    #[arg(long, value_name = "NAME=FILE", value_parser = super::pair)]
    pub input: Vec<(String, String)>,
    /// Value of a uniform of the chains: NAME=NUMBER, or NAME=X,Y,Z for a vector; by default 1 if the chain states none; may
    /// be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = super::pair)]
    pub uniform: Vec<(String, String)>,
    /// Most pictures that a pass may write, where workgroups compute several
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub most_outputs: u32,
}

#[derive(Clone, Debug, Default, Args)]
pub struct IsaArgs {
    /// Kernel to study instead of the built-in selection: FILE.rs, FILE.rs::FUNCTION, or a built-in name; may be given
    /// several times
    #[arg(long, value_name = "KERNEL")]
    pub from: Vec<String>,
    /// Hand-written version with loops of each --from kernel, in order
    #[arg(long, value_name = "KERNEL", requires = "from")]
    pub by_hand: Vec<String>,
    /// GPU such as amd:navi21, or all of a vendor such as nvidia (see `straightline isa`); or `device`, the GPU of this
    /// machine by its own driver; may be given several times; by default every GPU that this machine can compile for
    #[arg(long, value_name = "VENDOR[:GPU]", alias = "family")]
    pub gpu: Vec<Gpus>,
}

/// GPUs of one argument.
#[derive(Clone, Debug)]
pub struct Gpus(pub Vec<Gpu>);

impl Gpus {
    /// Returns the GPUs of all arguments, each once.
    pub fn distinct(all: &[Gpus]) -> Vec<Gpu> {
        let gpus: BTreeSet<Gpu> = all.iter().flat_map(|gpus| gpus.0.iter().copied()).collect();
        gpus.into_iter().collect()
    }
}

impl FromStr for Gpus {
    type Err = String;

    fn from_str(text: &str) -> Result<Gpus, String> {
        Gpu::parse_several(text).map(Gpus)
    }
}

/// Arguments of `choose`.
#[derive(Clone, Debug, Args)]
pub struct ChooseArgs {
    /// List of candidates that `build.rs` wrote beside the shaders: NAME.candidates.txt
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub list: PathBuf,
    /// GPU such as amd:navi21, or all of a vendor such as nvidia (see `straightline isa`); several with commas
    #[arg(long, value_name = "VENDOR[:GPU]", required = true, value_delimiter = ',')]
    pub isa: Vec<Gpus>,
    /// File of choices to add each vendor's to
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub out: Option<PathBuf>,
}

/// Arguments of `isa`.
#[derive(Clone, Debug, Args)]
pub struct CompilersArgs {
    /// GPU such as amd:navi21, or all of a vendor such as nvidia; by default all
    #[arg(value_name = "VENDOR[:GPU]")]
    pub gpu: Vec<Gpus>,
    /// List the GPUs: what the command does in any case
    #[arg(long)]
    pub list: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Debug, Args)]
pub struct AllArgs {
    /// Sizes and rounds of the documents: hours
    #[arg(long, conflicts_with = "quick")]
    pub full: bool,
    /// Restrict to this record, by its name in study/records without extension; may be given several times
    #[arg(long, value_name = "RECORD")]
    pub only: Vec<String>,
}

#[derive(Clone, Debug, Args)]
pub struct FrameArgs {
    /// Record of `budget --record`, with the passes of a frame
    #[arg(long, value_name = "RECORD")]
    pub passes: PathBuf,
    /// Record of `study error` of the same scene, at the same size and on the same adapter
    #[arg(long, value_name = "RECORD")]
    pub errors: PathBuf,
    /// Milliseconds to shade one sample of every pixel; up to six values, one panel each
    #[arg(long, value_name = "MS,...", value_delimiter = ',', default_values_t = straightline_study::frame::SHADING_MS, value_parser = shading)]
    pub shading: Vec<f64>,
    /// Restrict to this method, by its name; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
}

/// Parses a cost of shading, in milliseconds.
fn shading(text: &str) -> Result<f64, String> {
    let cost = text.parse().ok().filter(|ms| (0.0..=1e6).contains(ms));
    cost.ok_or_else(|| "use milliseconds from 0 to 1000000".to_owned())
}

#[derive(Clone, Debug, Default, Args)]
pub struct ErrorArgs {
    /// Additional method to compare: options of `sraa`, `stalker` or `tabula_rasa`, or a kernel that reads color, depth and
    /// normal; may be given several times
    #[arg(long = "method", value_name = "NAME=KERNEL[,OPTION=VALUE]...")]
    pub methods: Vec<String>,
    /// Restrict to this built-in method, by its name; captures have few of them; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Add bloom and tone mapping as in a game: methods run before them, filters of the displayed picture after; SRAA and
    /// supersampling are also tried after them
    #[arg(long)]
    pub post: bool,
    /// Restrict to 1x, the presets of SRAA, and supersampling
    #[arg(long)]
    pub presets: bool,
    /// Built-in scene (see `scenes`); may be given several times; by default those that are not drawn on request
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// All built-in scenes, also those that are drawn on request
    #[arg(long, conflicts_with = "scene")]
    pub wide: bool,
    /// Model to render: .gltf, .glb or .obj; may be given several times
    #[arg(long, value_name = "FILE")]
    pub mesh: Vec<PathBuf>,
    /// Capture with reference.exr (docs/captures.md), compared at its own size; may be given several times
    #[arg(long, value_name = "DIR")]
    pub capture: Vec<PathBuf>,
}

#[derive(Clone, Debug, Args)]
pub struct FilmArgs {
    /// Method to film, by its name in `study error`, or as `study error --method` takes it; may be given several times
    ///
    /// Methods are arranged row by row. By default 1x, MLAA and SRAA 4. A reference of 64 samples a pixel is added beside
    /// them.
    #[arg(long = "method", value_name = "NAME[=KERNEL[,OPTION=VALUE]...]")]
    pub methods: Vec<String>,
    /// Built-in scene to film (see `scenes`)
    #[arg(long, value_name = "NAME", default_value = "roof", conflicts_with = "mesh")]
    pub scene: String,
    /// Model to film instead: .gltf, .glb or .obj
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Number of frames
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(2..=1000))]
    pub frames: u32,
    /// Pixels by which the picture moves from frame to frame, to the right and down
    #[arg(long, value_name = "X,Y", default_value = "0.125,0.0625", value_parser = step, allow_hyphen_values = true)]
    pub step: Vec2,
}

#[derive(Clone, Debug, Args)]
pub struct MotionArgs {
    /// Method to compare, by its name in this study's record, or as `study error --method` takes it for `sraa`; may be
    /// given several times
    ///
    /// By default SRAA with 4 and 16 samples, in its presets, with history and before temporal antialiasing; one sample a pixel
    /// without and with temporal antialiasing; and supersampling.
    #[arg(long = "method", value_name = "NAME[=KERNEL[,OPTION=VALUE]...]")]
    pub methods: Vec<String>,
    /// Built-in scene (see `scenes`); may be given several times; by default railings, roof and posters
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// Number of compared frames, after sixteen that only fill the history
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(2..=1000))]
    pub frames: u32,
}

/// Parses two finite numbers of pixels, each at most 64.
fn step(text: &str) -> Result<Vec2, String> {
    let parsed = text
        .split_once(',')
        .and_then(|(x, y)| Some(Vec2::new(x.trim().parse().ok()?, y.trim().parse().ok()?)));
    match parsed {
        Some(step) if step.is_finite() && step.abs().max_element() <= 64.0 => Ok(step),
        _ => Err("two numbers from -64 to 64 are needed, as in 0.125,0.0625".to_owned()),
    }
}

#[derive(Clone, Debug, Args)]
pub struct PrecisionArgs {
    #[command(flatten)]
    pub kernel: KernelArgs,
    /// GPU whose compiler states the cost, such as amd:navi21, or all of a vendor such as nvidia (see `straightline isa`);
    /// may be given several times
    #[arg(long, value_name = "VENDOR[:GPU]", required = true)]
    pub isa: Vec<Gpus>,
    /// Bound of the error: largest difference from f64 without the thousandth of the pixels that differ most; of colours
    /// beyond 1 relative to them
    #[arg(long, value_name = "NUMBER", default_value = "0.004", value_parser = bound)]
    pub max_error: f64,
    #[command(flatten)]
    pub inputs: CardArgs,
}

/// Parses a bound of an error: a positive number.
fn bound(text: &str) -> Result<f64, String> {
    let bound = text
        .parse::<f64>()
        .ok()
        .filter(|bound| *bound > 0.0 && bound.is_finite());
    bound.ok_or_else(|| "a positive number is needed, such as 0.004".to_owned())
}

#[derive(Clone, Debug, Default, Args)]
pub struct HardArgs {
    /// Restrict to this case; may be given several times; by default all of them
    #[arg(long = "case", value_name = "NAME")]
    pub cases: Vec<String>,
    /// List the cases and their difficulty, and run none
    #[arg(long)]
    pub list: bool,
    /// Restrict to this precision, f16 or f32; by default both
    #[arg(long, value_name = "f16|f32")]
    pub precision: Option<Precision>,
}
