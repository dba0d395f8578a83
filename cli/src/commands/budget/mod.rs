//! `budget`: the cost of a frame with and without SRAA, in time, memory and reads (the paper's tables 1 and 2), and the
//! shading cost above which SRAA pays.

mod frame;
mod measure;
mod print;

use super::study::{ProgressBars, circumstances_of};
use crate::args::BudgetArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use frame::{Comparison, FrameCost};
use measure::{Filter, PassTime, Together};
use serde::Serialize;
use straightline_codegen::files;
use straightline_study::progress::Progress;
use straightline_study::record::Circumstances;

/// Formats of a geometry sample: name, bytes, and the context that assumes it.
const FORMATS: [(&str, u64); 3] = [
    ("24-bit depth, RGB8 normal (the paper's MB)", 6),
    ("rgba16float, normals=packed", 8),
    ("r32float depth, rgba16float normal", 12),
];

/// Memory and work of one method.
#[derive(Clone, Debug, Serialize)]
struct Cost {
    method: String,
    geometry_samples: u64,
    shading_samples: u64,
    /// Bytes for each of [`FORMATS`].
    gbuffer_bytes: Vec<u64>,
    reads: Option<u32>,
}

#[derive(Clone, Debug, Serialize)]
struct Record {
    #[serde(flatten)]
    circumstances: Circumstances,
    /// Name of the built-in scene, or the model's file.
    scene: String,
    triangles: usize,
    /// Shading evaluations per sample.
    shading_cost: u32,
    /// The paper's table 2 for this scene on this device.
    frames: Vec<FrameCost>,
    comparisons: Vec<Comparison>,
    /// Passes that make up the frames.
    passes: Vec<PassTime>,
    filters: Vec<Filter>,
    /// `null` with timestamps, which surround single passes only.
    together: Option<Together>,
    costs: Vec<Cost>,
}

/// Counts, measures and prints.
pub fn measure_budget(args: &BudgetArgs) -> Result<(), Failure> {
    if let Some(path) = &args.record {
        files::try_file(path, true).map_err(Failure::from_error)?;
    }
    let world = scene::load_viewed(&args.view)?;
    let gpu = Gpu::require(&args.adapter)?;
    let mut progress = ProgressBars::new();
    let measured = measure::measure_passes(args, &world, &gpu, &mut progress)?;
    let mut circumstances = circumstances_of(&gpu, args.size, args.rounds);
    circumstances.complete = !progress.is_stopped();
    drop(progress);
    let record = Record {
        circumstances,
        scene: args.view.scene_name(),
        triangles: world.triangles.len(),
        shading_cost: args.shading_cost,
        frames: frame::frame_costs(&measured)?,
        comparisons: frame::compare_methods(&measured)?,
        costs: method_costs(args, &measured.filters),
        passes: measured.passes,
        together: measured.together,
        filters: measured.filters,
    };
    if let Some(path) = &args.record {
        let text = serde_json::to_string_pretty(&record).map_err(Failure::from_error)? + "\n";
        files::write_file(path, text.as_bytes()).map_err(Failure::from_error)?;
    }
    print::print_record(args, &record)
}

fn method_costs(args: &BudgetArgs, filters: &[Filter]) -> Vec<Cost> {
    let pixels = u64::from(args.size.x) * u64::from(args.size.y);
    let reads = |pattern: &str| {
        let is_default = |f: &&Filter| f.metric == measure::DEFAULT_METRIC && f.shading == "centre";
        let default = filters.iter().filter(is_default).find(|f| f.pattern == pattern);
        default.map(|filter| filter.reads)
    };
    let cost = |method: &str, geometry: u64, shading: u64, reads: Option<u32>| Cost {
        method: method.to_owned(),
        geometry_samples: geometry,
        shading_samples: shading,
        gbuffer_bytes: FORMATS.iter().map(|(_, bytes)| pixels * geometry * bytes).collect(),
        reads,
    };
    vec![
        cost("1x, no antialiasing", 1, 1, None),
        cost("SRAA 4", 4, 1, reads("latin4")),
        cost("SRAA 16", 16, 1, reads("latin16")),
        cost("4x shading", 4, 4, None),
        cost("16x shading", 16, 16, None),
    ]
}
