//! Arguments of `study sweep` and of what reads its records.

use super::{pair, size};
use clap::{Args, ValueHint};
use glam::UVec2;
use std::path::PathBuf;
use straightline_codegen::{ShaderSpec, Stage, Unroll, shorten};
use straightline_study::record::Shard;
use straightline_study::sweep::{Loops, parse_values, varied_knob};

#[derive(Clone, Debug, Args)]
pub struct SweepArgs {
    /// A built-in kernel (see `list`), FILE.rs, or FILE.rs::FUNCTION
    #[arg(value_hint = ValueHint::FilePath)]
    pub kernel: String,
    /// A further file that the kernel calls functions of; may be given several times
    #[arg(long, value_name = "FILE")]
    pub source: Vec<PathBuf>,
    /// Values of an option, separated by commas, or numbers as 1..9 or 1..=8, which are the same; may be given several times.
    /// Where values have commas of their own, semicolons separate them
    #[arg(help_heading = "What is varied", long = "set", value_name = "OPTION=VALUES", value_parser = options)]
    pub set: Vec<(String, Vec<String>)>,
    /// Values of a further setting of `emit`: branches, reads, repeat-loads, share, math, transport or precision, such as
    /// math=exact,fast; may be given several times
    #[arg(help_heading = "What is varied", long, value_name = "SETTING=VALUES", value_parser = varied)]
    pub vary: Vec<(&'static str, Vec<String>)>,
    /// How far loops are unrolled: `none`, `full`, or factors such as `2`
    #[arg(help_heading = "What is varied", long, value_name = "POLICIES", value_delimiter = ',', default_value = "none,full", value_parser = |s: &str| s.parse::<Unroll>())]
    pub unroll: Vec<Unroll>,
    /// What becomes of loops that stay: `bounded`, wgpu counts their iterations, or `unbounded`, so that a driver may unroll them
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
    /// Invocations of a compute workgroup, across and down
    #[arg(help_heading = "What is varied", long, value_name = "SIZES", value_delimiter = ',', default_value = "256x1", value_parser = size)]
    pub workgroup: Vec<UVec2>,
    /// Pixels that one compute invocation computes, across and down
    #[arg(help_heading = "What is varied", long, value_name = "SIZES", value_delimiter = ',', default_value = "1x1", value_parser = size)]
    pub block: Vec<UVec2>,
    /// What distinguishes the variants with which others of the same settings are compared; by default the first value of
    /// --unroll. May be given several times
    #[arg(long, value_name = "AXIS=VALUE", value_parser = pair)]
    pub baseline: Vec<(String, String)>,
    /// A hand-written WGSL file to measure along, with the bindings and the entry point of the emitted shader; {AXIS} in its
    /// name is the value of an axis: blur-{radius}.wgsl. May be given several times
    #[arg(long, value_name = "FILE.wgsl")]
    pub against: Vec<String>,
    /// Picture for a texture, as for `run`; textures without one show a test card. May be given several times
    #[arg(long, value_name = "[NAME=]FILE[,FILE...]")]
    pub input: Vec<String>,
    /// Value of a uniform: NAME=NUMBER, or NAME=X,Y,Z for a vector. May be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = pair)]
    pub uniform: Vec<(String, String)>,
    /// Elements of a buffer: NAME=A,B,C, or NAME=0*256 for so many alike. May be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = pair)]
    pub buffer: Vec<(String, String)>,
    /// Go on, for at most --rounds, until the 95 % interval of every ratio is within so much of its median: 2%
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    pub until: Option<f64>,
    /// Measure one of N parts, from 1/N to N/N; `study merge` joins them
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub shard: Option<Shard>,
}

#[derive(Clone, Debug, Args)]
pub struct MergeArgs {
    /// `sweep.json` of every shard
    #[arg(value_name = "RECORD", required = true)]
    pub records: Vec<PathBuf>,
}

#[derive(Clone, Debug, Args)]
pub struct RecordsArgs {
    /// `sweep.json` of a run
    #[arg(value_name = "RECORD")]
    pub first: PathBuf,
    /// That of another
    #[arg(value_name = "RECORD")]
    pub second: PathBuf,
    /// Ratios that are nearer to each other than this are the same
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

/// A part of one.
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
