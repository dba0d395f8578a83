//! `study`: unroll against loop, speed against error, hard cases, sweeps; records, and one page of them all.

pub mod error;
mod film;
mod frame;
mod hard;
pub mod isa;
mod loops;
mod motion;
mod progress;
mod sweep;

use super::{command, tune};
use crate::args::{CommonArgs, Study, StudyArgs, TuneArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::UVec2;
use std::path::Path;
use std::time::SystemTime;
use straightline_bench::execute::Clock;
use straightline_codegen::files;
use straightline_study::progress::Progress;
use straightline_study::record::Circumstances;
use straightline_study::report;

pub use progress::ProgressBars;

/// Measures, and writes records and the page.
pub fn run(args: &StudyArgs) -> Result<(), Failure> {
    let common = &args.common;
    let writes_nothing = match &args.study {
        Some(Study::Hard(args)) => args.list,
        Some(Study::Compare(_)) => true,
        _ => false,
    };
    if !writes_nothing {
        files::try_folder(&common.out).map_err(Failure::of)?;
    }
    let mut progress = ProgressBars::new();
    match &args.study {
        Some(Study::Loops(loops)) => loops::run(common, loops, &mut progress)?,
        Some(Study::Error(error)) => error::run(common, error, &mut progress)?,
        Some(Study::Frame(args)) => frame::run(common, args)?,
        Some(Study::Film(film)) => return film::run(common, film, &mut progress),
        Some(Study::Motion(args)) => return motion::run(common, args, &mut progress),
        Some(Study::Hard(args)) if args.list => return hard::list(args),
        Some(Study::Hard(args)) => hard::run(common, args, &mut progress)?,
        Some(Study::Isa(args)) => isa::run(common, args, &mut progress)?,
        Some(Study::Sweep(args)) => return sweep::run(common, args, &mut progress),
        Some(Study::Merge(args)) => return sweep::merge(common, args),
        Some(Study::Compare(args)) => return sweep::compare(args),
        Some(Study::Report) => {}
        None => all(common, &mut progress)?,
    }
    page(&common.out)
}

/// Scenes that need different things: the flat one, thin things, and creases that depth does not tell.
const TUNED: [&str; 3] = ["floor", "tubes", "creases"];

/// Every study, until Ctrl-C.
fn all(common: &CommonArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    hard::run(common, &Default::default(), progress)?;
    if !progress.stopped() {
        loops::run(common, &Default::default(), progress)?;
    }
    if !progress.stopped() {
        error::run(common, &Default::default(), progress)?;
    }
    for scene in TUNED {
        if !progress.stopped() {
            tune::run(&TuneArgs::of_study(scene, common))?;
        }
    }
    Ok(())
}

/// The page of all records in a folder.
pub fn page(folder: &Path) -> Result<(), Failure> {
    let path = report::write(folder).map_err(Failure::of)?;
    outln!("{}", path.display());
    Ok(())
}

/// Circumstances of this run for a record. `complete` is to be put right when it ends.
pub fn circumstances(common: &CommonArgs, gpu: &Gpu) -> Circumstances {
    circumstances_of(gpu, common.size(), common.rounds())
}

/// Circumstances of this run with a picture's size and rounds of timing.
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

/// Circumstances of a run without a device.
pub fn on_processor(size: UVec2, rounds: u32) -> Circumstances {
    Circumstances {
        command: command(),
        date: now(),
        adapter: "none: interpreter only".to_owned(),
        processor: processor(),
        clock: Clock::WallClock,
        size: size.to_array(),
        rounds,
        complete: true,
    }
}

/// The time, as records have it: RFC 3339, UTC.
fn now() -> String {
    humantime::format_rfc3339_seconds(SystemTime::now()).to_string()
}

/// Name of the processor, and its number of threads.
fn processor() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = told.lines().find_map(|line| line.strip_prefix("model name"));
    let name = name.map_or("unknown processor", |name| name.trim_start_matches([' ', '\t', ':']));
    format!("{name}, {threads} threads")
}
