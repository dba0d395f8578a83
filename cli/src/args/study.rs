//! Arguments of `study` and `tune`.

use super::{AdapterArgs, MergeArgs, RecordsArgs, SweepArgs, size};
use clap::{Args, Subcommand};
use glam::{UVec2, Vec2};
use std::path::PathBuf;
use straightline_codegen::Precision;
use straightline_isa::Family;

#[derive(Debug, Args)]
pub struct StudyArgs {
    /// Without one, all of them
    #[command(subcommand)]
    pub study: Option<Study>,
    #[command(flatten)]
    pub common: CommonArgs,
}

/// What every study is asked.
#[derive(Clone, Debug, Args)]
pub struct CommonArgs {
    /// Folder for records (JSON, CSV), pictures and report.html, which shows all records that are in the folder
    #[arg(long, value_name = "DIR", default_value = "study-report", global = true)]
    pub out: PathBuf,
    /// Small pictures, few repetitions: minutes instead of hours, and figures that say less
    #[arg(long, global = true)]
    pub quick: bool,
    /// Width and height in pixels; by default 1280x720, with --quick 480x270
    #[arg(long, value_name = "WxH", value_parser = size, global = true)]
    pub size: Option<UVec2>,
    /// Repetitions of the timing; each runs every shader once, in turn. By default 31, with --quick 11
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000), global = true)]
    pub rounds: Option<u32>,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

impl CommonArgs {
    /// Width and height of pictures.
    pub fn picture_size(&self) -> UVec2 {
        self.size.unwrap_or(match self.quick {
            true => UVec2::new(480, 270),
            false => UVec2::new(1280, 720),
        })
    }

    /// Rounds of timing.
    pub fn timing_rounds(&self) -> u32 {
        self.rounds.unwrap_or(if self.quick { 11 } else { 31 })
    }
}

#[derive(Clone, Debug, Subcommand)]
pub enum Study {
    /// Compare the unrolled and looped forms of each kernel: time, counts, error
    Loops(LoopsArgs),
    /// Compare methods of antialiasing on all scenes: time, and error against 256 samples a pixel
    Error(ErrorArgs),
    /// Put frames together of the records of `budget` and `study error`: time of a whole frame against its error
    Frame(FrameArgs),
    /// Film a slow pan by several methods side by side, and tell how wrong what changes from frame to frame is
    Film(FilmArgs),
    /// Compare SRAA with earlier frames and without, and supersampling, in a still, a pan and a turn, and where something moves
    Motion(MotionArgs),
    /// Run numerically hard cases in every precision, by shader and interpreter
    Hard(HardArgs),
    /// Ask GPU compilers what they make of each kernel, without a GPU
    Isa(IsaArgs),
    /// Measure one kernel in every combination of options, unroll factors, stages, workgroups and blocks
    Sweep(Box<SweepArgs>),
    /// Join the records of all shards of a sweep
    Merge(MergeArgs),
    /// Tell whether two records of a sweep differ: exit status 1 if they do
    Compare(RecordsArgs),
    /// Write the page again from the records in the folder
    Report,
}

#[derive(Clone, Debug, Default, Args)]
pub struct LoopsArgs {
    /// A kernel of your own instead of the built-in choice: FILE.rs or FILE.rs::FUNCTION, or a built-in name. May be given
    /// several times; each is run on a test card
    #[arg(long, value_name = "KERNEL")]
    pub from: Vec<String>,
    /// The same kernel hand-written with its loops, reading the same by the same names: one for each --from, in order
    #[arg(long, value_name = "KERNEL", requires = "from")]
    pub by_hand: Vec<String>,
    /// Value of a uniform of the kernels of --from: NAME=NUMBER, or NAME=X,Y,Z for a vector; may be given several times. One without a
    /// default is 1 otherwise
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = super::pair, requires = "from")]
    pub uniform: Vec<(String, String)>,
    /// Also write what each kernel makes to this folder, and all of it in one picture, `all.png`
    #[arg(long, value_name = "DIR")]
    pub pictures: Option<PathBuf>,
}

#[derive(Clone, Debug, Default, Args)]
pub struct IsaArgs {
    /// A kernel of your own instead of the built-in choice: FILE.rs or FILE.rs::FUNCTION, or a built-in name. May be given
    /// several times
    #[arg(long, value_name = "KERNEL")]
    pub from: Vec<String>,
    /// The same kernel hand-written with its loops: one for each --from, in order
    #[arg(long, value_name = "KERNEL", requires = "from")]
    pub by_hand: Vec<String>,
    /// A family of AMD GPUs: polaris10, vega10, navi10, navi21 or navi31; may be given several times. By default all of them
    #[arg(long, value_name = "NAME")]
    pub family: Vec<Family>,
}

#[derive(Clone, Debug, Args)]
pub struct FrameArgs {
    /// Record of `budget --record`: the passes of a frame
    #[arg(long, value_name = "RECORD")]
    pub passes: PathBuf,
    /// Record of `study error` of the same scene, in the same size and on the same adapter
    #[arg(long, value_name = "RECORD")]
    pub errors: PathBuf,
    /// Milliseconds that shading one sample of every pixel takes, up to six: a panel each
    #[arg(long, value_name = "MS,...", value_delimiter = ',', default_values_t = straightline_study::frame::SHADING_MS, value_parser = shading)]
    pub shading: Vec<f64>,
    /// Only this method, by its name; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
}

/// A cost of shading.
fn shading(text: &str) -> Result<f64, String> {
    let cost = text.parse().ok().filter(|ms| (0.0..=1e6).contains(ms));
    cost.ok_or_else(|| "use milliseconds from 0 to 1000000".to_owned())
}

#[derive(Clone, Debug, Default, Args)]
pub struct ErrorArgs {
    /// A method of your own to compare: options of `sraa`, `stalker` or `tabula_rasa`, or a kernel that reads what it likes of color, depth and normal; may be given several times
    #[arg(long = "method", value_name = "NAME=KERNEL[,OPTION=VALUE]...")]
    pub methods: Vec<String>,
    /// Only this of the methods that are there, by its name; may be given several times. Not of captures, which have few
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Bloom and tone mapping follow, as in a game: methods before them, filters of the displayed picture after. SRAA and
    /// supersampling are tried after them too
    #[arg(long)]
    pub post: bool,
    /// A built-in scene (see `scenes`); may be given several times. By default all of them
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// A model: .gltf, .glb or .obj; may be given several times
    #[arg(long, value_name = "FILE")]
    pub mesh: Vec<PathBuf>,
    /// A capture with reference.exr (docs/captures.md); may be given several times. Its size is its own
    #[arg(long, value_name = "DIR")]
    pub capture: Vec<PathBuf>,
}

#[derive(Clone, Debug, Args)]
pub struct FilmArgs {
    /// A method to film, by its name in `study error` or as its --method has one of your own; may be given several times, row
    /// by row. By default 1x, MLAA and SRAA 4. A reference of 64 samples a pixel is beside them
    #[arg(long = "method", value_name = "NAME[=KERNEL[,OPTION=VALUE]...]")]
    pub methods: Vec<String>,
    /// A built-in scene (see `scenes`)
    #[arg(long, value_name = "NAME", default_value = "roof", conflicts_with = "mesh")]
    pub scene: String,
    /// A model instead: .gltf, .glb or .obj
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// How many frames
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(2..=1000))]
    pub frames: u32,
    /// Pixels that the picture moves from a frame to the next, to the right and down
    #[arg(long, value_name = "X,Y", default_value = "0.125,0.0625", value_parser = step, allow_hyphen_values = true)]
    pub step: Vec2,
}

#[derive(Clone, Debug, Args)]
pub struct MotionArgs {
    /// A method to compare, by its name in this study's record or one of your own of `sraa`, as `study error --method` has it; may be
    /// given several times. By default SRAA with 4 and 16 samples, placed and searched, with history, and with all, and supersampling
    #[arg(long = "method", value_name = "NAME[=KERNEL[,OPTION=VALUE]...]")]
    pub methods: Vec<String>,
    /// A built-in scene (see `scenes`); may be given several times. By default railings and roof
    #[arg(long, value_name = "NAME")]
    pub scene: Vec<String>,
    /// How many frames, after four that are only remembered
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(2..=1000))]
    pub frames: u32,
}

/// Two finite numbers of pixels, each at most 64.
fn step(text: &str) -> Result<Vec2, String> {
    let parsed = text
        .split_once(',')
        .and_then(|(x, y)| Some(Vec2::new(x.trim().parse().ok()?, y.trim().parse().ok()?)));
    match parsed {
        Some(step) if step.is_finite() && step.abs().max_element() <= 64.0 => Ok(step),
        _ => Err("two numbers from -64 to 64 are needed, as in 0.125,0.0625".to_owned()),
    }
}

#[derive(Clone, Debug, Default, Args)]
pub struct HardArgs {
    /// Only this case; may be given several times. Without it, all of them
    #[arg(long = "case", value_name = "NAME")]
    pub cases: Vec<String>,
    /// Name the cases, with what is hard about each, and run none
    #[arg(long)]
    pub list: bool,
    /// Only this precision: f16 or f32. Without it, both
    #[arg(long, value_name = "f16|f32")]
    pub precision: Option<Precision>,
}
