//! `quads`: benefit of sharing work over pixel quads, by filter and transport.

pub mod pictures;

use super::study::{ProgressBars, circumstances_of};
use crate::args::QuadsArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use std::time::Duration;
use straightline_codegen::files;
use straightline_study::progress::Progress;
use straightline_study::quads::{QuadsError, Setup, study_quads};
use straightline_study::record::{QuadsRecord, Record};
use straightline_study::statistics::describe_noise;

/// Minimum time for one measurement of a shader, as in `study loops`.
const LEAST: Duration = Duration::from_millis(40);

/// Measures every variant of every filter on a rendered frame, in one run.
pub fn measure_quads(args: &QuadsArgs) -> Result<(), Failure> {
    if let Some(path) = &args.record {
        files::try_file(path, true).map_err(Failure::from_error)?;
    }
    if let Some(folder) = &args.pictures {
        files::try_folder(folder).map_err(Failure::from_error)?;
    }
    let gpu = Gpu::require(&args.adapter)?;
    let scene = scene::load_scene(args.mesh.as_deref(), "roof")?;
    let setup = Setup {
        size: args.size,
        texels: args.texels,
        rounds: args.rounds,
        least: LEAST,
    };
    let bench = gpu.bench();
    let mut circumstances = circumstances_of(&gpu, args.size, args.rounds);
    let mut progress = ProgressBars::new();
    let studied = study_quads(&bench, &scene, &setup, &mut progress).map_err(|error| match error {
        QuadsError::Kernel(errors) => Failure::Kernel(errors),
        other => Failure::from_error(other),
    })?;
    circumstances.complete = !progress.is_stopped();
    drop(progress);
    if let Some(folder) = &args.pictures {
        pictures::write_pictures(&bench, folder, &studied)?;
    }
    print(args, &studied.to_record(circumstances))
}

fn print(args: &QuadsArgs, record: &QuadsRecord) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(record).map_err(Failure::from_error)? + "\n";
    if let Some(path) = &args.record {
        files::write_file(path, json.as_bytes()).map_err(Failure::from_error)?;
    }
    if args.json {
        out!("{json}");
        return Ok(());
    }
    let circumstances = &record.circumstances;
    let [width, height] = circumstances.size;
    outln!(
        "{}, {width}x{height}, {} rounds in turn, {}\n{}\n",
        circumstances.adapter,
        circumstances.rounds,
        circumstances.date,
        record.quads
    );
    out!("{}", record.to_table().to_text());
    outln!("\n{}", describe_noise(record.noise()));
    outln!(
        "Speedup: over the filter's first way, round by round, with the interval of 95 %. Shadow filters draw {} triangles; \
         those in compute read coordinates, and the pass that draws them, {:.2} ms, is in their times.",
        record.triangles,
        record.coordinates_ms
    );
    Ok(())
}
