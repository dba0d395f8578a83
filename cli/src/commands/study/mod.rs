//! `study`: unrolled against looped forms, speed against error, hard cases and sweeps; with records, and one page for all
//! of them.

mod all;
mod chains;
pub mod error;
mod film;
mod frame;
mod hard;
pub mod isa;
mod loops;
mod motion;
mod precision;
mod progress;
mod sweep;
mod uniforms;

use super::{command_line, tune};
use crate::args::{CommonArgs, Study, StudyArgs, TuneArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::UVec2;
use std::path::Path;
use std::time::SystemTime;
use straightline_bench::execute::Clock;
use straightline_codegen::files;
use straightline_study::progress::Progress;
use straightline_study::record::{Circumstances, IntervalKind};
use straightline_study::report;

pub use progress::ProgressBars;

/// Measures, and writes records and the page.
pub fn run_study(args: &StudyArgs) -> Result<(), Failure> {
    let common = &args.common;
    let writes_nothing = match &args.study {
        Some(Study::Hard(args)) => args.list,
        Some(Study::Compare(_)) => true,
        _ => false,
    };
    if !writes_nothing {
        files::try_folder(&common.out).map_err(Failure::from_error)?;
    }
    let mut progress = ProgressBars::new();
    match &args.study {
        Some(Study::Loops(loops)) => loops::measure_loops(common, loops, &mut progress)?,
        Some(Study::Error(error)) => error::compare_methods(common, error, &mut progress)?,
        Some(Study::Frame(args)) => frame::compose_frames(common, args)?,
        Some(Study::Film(film)) => return film::film_methods(common, film, &mut progress),
        Some(Study::Motion(args)) => return motion::compare_motion(common, args, &mut progress),
        Some(Study::Hard(args)) if args.list => return hard::list_cases(args),
        Some(Study::Hard(args)) => hard::run_hard_cases(common, args, &mut progress)?,
        Some(Study::Isa(args)) => isa::measure_isa(common, args, &mut progress)?,
        Some(Study::Chains(args)) => return chains::measure_chains(common, args, &mut progress),
        Some(Study::Precision(args)) => return precision::find_precision(common, args, &mut progress),
        Some(Study::Sweep(args)) => return sweep::measure_sweep(common, args, &mut progress),
        Some(Study::Merge(args)) => return sweep::merge_shards(common, args),
        Some(Study::Compare(args)) => return sweep::compare_records(args),
        Some(Study::All(args)) => return all::take_records(common, args, &progress),
        Some(Study::Report) => {}
        None => run_all_studies(common, &mut progress)?,
    }
    write_page(&common.out)
}

/// Scenes with different demands: a flat one, thin objects, and creases that depth does not show.
const TUNED: [&str; 3] = ["floor", "tubes", "creases"];

/// Every study, until Ctrl-C.
fn run_all_studies(common: &CommonArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    hard::run_hard_cases(common, &Default::default(), progress)?;
    if !progress.is_stopped() {
        loops::measure_loops(common, &Default::default(), progress)?;
    }
    if !progress.is_stopped() {
        error::compare_methods(common, &Default::default(), progress)?;
    }
    for scene in TUNED {
        if !progress.is_stopped() {
            tune::tune_shader(&TuneArgs::of_study(scene, common))?;
        }
    }
    Ok(())
}

/// Writes the page of all records in a folder.
pub fn write_page(folder: &Path) -> Result<(), Failure> {
    let path = report::write_report(folder).map_err(Failure::from_error)?;
    outln!("{}", path.display());
    Ok(())
}

/// Returns the circumstances of this run for a record. `complete` is corrected when the run ends.
pub fn run_circumstances(common: &CommonArgs, gpu: &Gpu) -> Circumstances {
    circumstances_of(gpu, common.picture_size(), common.timing_rounds())
}

/// Returns the circumstances of this run with the size of a picture and the rounds of timing.
pub fn circumstances_of(gpu: &Gpu, size: UVec2, rounds: u32) -> Circumstances {
    Circumstances {
        adapter: gpu.describe(),
        clock: match gpu.timestamps {
            true => Clock::GpuTimestamps,
            false => Clock::WallClock,
        },
        ..on_processor(size, rounds)
    }
}

/// Returns the circumstances of a run without a device.
pub fn on_processor(size: UVec2, rounds: u32) -> Circumstances {
    Circumstances {
        command: command_line(),
        date: current_time(),
        adapter: "none: interpreter only".to_owned(),
        processor: processor_name(),
        clock: Clock::WallClock,
        size: size.to_array(),
        rounds,
        intervals: IntervalKind::Blocks,
        complete: true,
    }
}

/// Returns the current time as in records: RFC 3339, UTC.
fn current_time() -> String {
    humantime::format_rfc3339_seconds(SystemTime::now()).to_string()
}

/// Returns the name of the processor, and its number of threads.
fn processor_name() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = told.lines().find_map(|line| line.strip_prefix("model name"));
    let name = name.map_or("unknown processor", |name| name.trim_start_matches([' ', '\t', ':']));
    format!("{name}, {threads} threads")
}
