//! Arguments of `tune`.

use super::{AdapterArgs, CommonArgs, pair, size};
use clap::Args;
use glam::UVec2;
use std::path::PathBuf;
use straightline_codegen::emit::Target;
use straightline_manifest::Format;
use straightline_study::tune::{Cost, ErrorMetric};

#[derive(Debug, Args)]
pub struct TuneArgs {
    #[command(flatten)]
    pub subject: SubjectArgs,
    /// Error to trade for speed, relative to the best variant: dB of PSNR, or mean FLIP
    #[arg(long, value_name = "X", allow_negative_numbers = true, value_parser = budget)]
    pub max_error: f64,
    /// Metric of the error: psnr or flip
    #[arg(long, value_name = "METRIC", default_value = "psnr", value_parser = |s: &str| s.parse::<ErrorMetric>())]
    pub metric: ErrorMetric,
    /// Measure of cost: time on the adapter, or isa:amd:navi21 for cycles by Mesa's compiler
    ///
    /// The GPU need not be present; `straightline isa` lists those that can be asked about. For GPUs of other vendors than AMD
    /// the cost is instructions, of variants without loops.
    #[arg(long, value_name = "COST", default_value_t = Cost::Time, value_parser = |s: &str| s.parse::<Cost>())]
    pub cost: Cost,
    /// Width and height of a scene or model in pixels; by default 640x360; a capture has its own size
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with = "capture")]
    pub size: Option<UVec2>,
    /// Repetitions of the final timing; each runs every shader once, in turn
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Value of an option for all variants, which takes the option out of the search; may be given several times
    #[arg(long = "set", value_name = "OPTION=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// Languages of the shader, separated by commas: wgsl, glsl450, glsl430, glsl330, essl310, essl300, spirv, hlsl, msl
    #[arg(long, value_name = "LANGUAGES", value_delimiter = ',', default_value = "wgsl", value_parser = |s: &str| s.parse::<Target>())]
    pub target: Vec<Target>,
    /// Texel format of the shader's output: rgba8unorm, rgba16float or rgba32float
    #[arg(long, value_name = "FORMAT", default_value = "rgba16float", value_parser = |s: &str| s.parse::<Format>())]
    pub format: Format,
    /// Output folder for the shader and its record; created if missing
    ///
    /// The shader is sraa-SCENE.wgsl and .json, the record tune-SCENE.json and .csv. If shading positions are placed, the
    /// placing shader is sraa-place-SCENE.wgsl and .json.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Print the record as JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

impl TuneArgs {
    /// Returns the arguments with which `study` tunes for a built-in scene: within a decibel of the best.
    pub fn of_study(scene: &str, common: &CommonArgs) -> TuneArgs {
        TuneArgs {
            subject: SubjectArgs {
                capture: None,
                scene: Some(scene.to_owned()),
                mesh: None,
            },
            max_error: 1.0,
            metric: ErrorMetric::Psnr,
            cost: Cost::Time,
            size: common.size.or(common.quick.then_some(UVec2::new(320, 180))),
            rounds: common.timing_rounds(),
            set: Vec::new(),
            target: vec![Target::Wgsl],
            format: Format::default(),
            out: common.out.clone(),
            json: false,
            adapter: common.adapter.clone(),
        }
    }
}

/// Scene, model or capture to tune for.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct SubjectArgs {
    /// Folder of a captured frame (docs/captures.md)
    #[arg(long, value_name = "DIR")]
    pub capture: Option<PathBuf>,
    /// Built-in scene (see `scenes`)
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// Model: .gltf, .glb or .obj
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
}

fn budget(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err(format!(
            "`{text}` is no budget: give a number that is not negative, such as 0.5 (dB) or, with --metric flip, 0.002"
        )),
    }
}
