//! Arguments of `study sweep` and of the commands that read its records.

use super::{Gpus, pair, size};
use clap::{Args, ValueHint};
use glam::UVec2;
use std::path::PathBuf;
use straightline_codegen::{ShaderSpec, Stage, Unroll, shorten};
use straightline_study::record::Shard;
use straightline_study::sweep::{Loops, parse_values, varied_knob};

/// Inputs of a kernel that is measured: a test card for all that is not given.
#[derive(Clone, Debug, Args)]
pub struct CardArgs {
    /// Picture for a texture, as for `run`; other textures show a test card; may be given several times
    #[arg(long, value_name = "[NAME=]FILE[,FILE...]")]
    pub input: Vec<String>,
    /// Value of a uniform: NAME=NUMBER, or NAME=X,Y,Z for a vector; may be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = pair)]
    pub uniform: Vec<(String, String)>,
    /// Elements of a buffer: NAME=A,B,C, or NAME=0*256 for 256 equal elements; may be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = pair)]
    pub buffer: Vec<(String, String)>,
}

#[derive(Clone, Debug, Args)]
pub struct SweepArgs {
    /// Kernel to sweep: a built-in one (see `list`), FILE.rs, or FILE.rs::FUNCTION
    #[arg(value_hint = ValueHint::FilePath)]
    pub kernel: String,
    /// Additional file with functions that the kernel calls; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    /// Values of an option, separated by commas, or a range of numbers, 1..9 or 1..=8; may be given several times
    ///
    /// The two ranges are equal. Values that contain commas are separated by semicolons.
    #[arg(help_heading = "What is varied", long = "set", value_name = "OPTION=VALUES", value_parser = options)]
    pub set: Vec<(String, Vec<String>)>,
    /// Values of another setting of `emit`, such as math=exact,fast; may be given several times
    ///
    /// The settings are branches, reads, repeat-loads, share, math, transport and precision.
    #[arg(help_heading = "What is varied", long, value_name = "SETTING=VALUES", value_parser = varied)]
    pub vary: Vec<(&'static str, Vec<String>)>,
    /// Unroll policies: `none`, `full`, or factors such as `2`
    #[arg(help_heading = "What is varied", long, value_name = "POLICIES", value_delimiter = ',', default_value = "none,full", value_parser = |s: &str| s.parse::<Unroll>())]
    pub unroll: Vec<Unroll>,
    /// Bound on loops left in the shader: `bounded`, wgpu counts their iterations, or `unbounded`, so that a driver may
    /// unroll them
    #[arg(help_heading = "What is varied", long, value_name = "KINDS", value_delimiter = ',', default_value = "bounded", value_parser = loops)]
    pub loops: Vec<Loops>,
    /// Pipeline stages
    #[arg(
        help_heading = "What is varied",
        long,
        value_name = "STAGES",
        value_parser = |s: &str| s.parse::<Stage>(),
        value_delimiter = ',',
        default_value = "compute"
    )]
    pub stage: Vec<Stage>,
    /// Width and height of a compute workgroup, in invocations
    #[arg(help_heading = "What is varied", long, value_name = "SIZES", value_delimiter = ',', default_value = "16x16", value_parser = size)]
    pub workgroup: Vec<UVec2>,
    /// Width and height of the pixel block that one compute invocation computes
    #[arg(help_heading = "What is varied", long, value_name = "SIZES", value_delimiter = ',', default_value = "1x1", value_parser = size)]
    pub block: Vec<UVec2>,
    /// Setting of the baseline that variants are compared with; by default the first value of --unroll; may be given
    /// several times
    #[arg(long, value_name = "AXIS=VALUE", value_parser = pair)]
    pub baseline: Vec<(String, String)>,
    /// Hand-written WGSL file to measure as well, with the bindings and entry point of the emitted shader; may be given
    /// several times
    ///
    /// {AXIS} in its name stands for the value of an axis: blur-{radius}.wgsl.
    #[arg(long, value_name = "FILE.wgsl")]
    pub against: Vec<String>,
    #[command(flatten)]
    pub inputs: CardArgs,
    /// GPU to compile each variant for as well, such as amd:navi21, or all of a vendor such as nvidia (see `straightline
    /// isa`): instructions, registers, spills and, of AMD's, cycles; may be given several times
    #[arg(long, value_name = "VENDOR[:GPU]")]
    pub isa: Vec<Gpus>,
    /// Stop before --rounds once the 95 % interval of every ratio is within this share of its median: 2%
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    pub until: Option<f64>,
    /// Part to measure, from 1/N to N/N; `study merge` joins the parts
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub shard: Option<Shard>,
}

#[derive(Clone, Debug, Args)]
pub struct MergeArgs {
    /// `sweep.json` of each shard
    #[arg(value_name = "RECORD", required = true)]
    pub records: Vec<PathBuf>,
}

#[derive(Clone, Debug, Args)]
pub struct RecordsArgs {
    /// `sweep.json` of the first run
    #[arg(value_name = "RECORD")]
    pub first: PathBuf,
    /// `sweep.json` of the second run
    #[arg(value_name = "RECORD")]
    pub second: PathBuf,
    /// Largest difference at which two ratios still count as equal
    #[arg(long, value_name = "PERCENT", default_value = "5%", value_parser = percent)]
    pub tolerance: f64,
}

fn options(text: &str) -> Result<(String, Vec<String>), String> {
    let (name, list) = pair(text)?;
    Ok((name, parse_values(&list)?))
}

fn varied(text: &str) -> Result<(&'static str, Vec<String>), String> {
    let (name, list) = pair(text)?;
    let knob = varied_knob(&name)?;
    let values = parse_values(&list)?;
    values
        .iter()
        .try_for_each(|value| knob.set(&mut ShaderSpec::new(), &[value]))?;
    Ok((knob.name, values))
}

fn loops(text: &str) -> Result<Loops, String> {
    let all = [Loops::Bounded, Loops::Unbounded];
    let found = all.into_iter().find(|loops| loops.name() == text);
    found.ok_or_else(|| format!("`{}` is neither `bounded` nor `unbounded`", shorten(text)))
}

/// Parses a percentage, as a share of 1.
fn percent(text: &str) -> Result<f64, String> {
    let number = text
        .strip_suffix('%')
        .and_then(|number| number.trim().parse::<f64>().ok());
    match number {
        Some(number) if number > 0.0 && number <= 100.0 => Ok(number / 100.0),
        _ => Err(format!(
            "`{}` is not of the form 2%, from above 0 to 100",
            shorten(text)
        )),
    }
}

fn shard(text: &str) -> Result<Shard, String> {
    let parsed = text.split_once('/').and_then(|(index, count)| {
        let (index, count) = (index.parse().ok()?, count.parse().ok()?);
        (1..=count).contains(&index).then_some(Shard { index, count })
    });
    parsed.ok_or_else(|| format!("`{}` is not of the form 2/8, from 1/8 to 8/8", shorten(text)))
}
