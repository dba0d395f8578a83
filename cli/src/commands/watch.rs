//! `watch`: emits a kernel again whenever one of its files is saved.

use super::{emit, run};
use crate::args::WatchArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::output;
use std::path::PathBuf;
use std::time::{Duration, Instant, SystemTime};

/// Time between two checks of the files. Each check only reads the times of a few files, on any file system.
const INTERVAL: Duration = Duration::from_millis(100);

/// Time of the last write to a file, and its length; `None` if they cannot be determined.
type Stamp = Option<(SystemTime, u64)>;

/// Emits the kernel, and again after every change, until interrupted or until its output is closed.
pub fn watch_kernel(args: &WatchArgs) -> Result<(), Failure> {
    let paths = kernel_files(args)?;
    refuse_inputs_without_picture(args)?;
    let mut gpu = None;
    let mut seen = file_stamps(&paths);
    loop {
        // The stamps are taken before compiling, so that a file saved meanwhile counts as changed.
        emit_once(args, &mut gpu);
        seen = wait_for_change(&paths, &seen);
        if output::is_refused() {
            return Ok(());
        }
    }
}

/// Returns the kernel's files.
fn kernel_files(args: &WatchArgs) -> Result<Vec<PathBuf>, Failure> {
    let kernel = &args.emit.kernel.kernel;
    let file = match kernel.split_once(".rs::") {
        Some((path, _)) => format!("{path}.rs"),
        None => kernel.clone(),
    };
    if !file.ends_with(".rs") {
        return Err(Failure::Usage(format!(
            "`{kernel}` is no file, and only files change: give FILE.rs or FILE.rs::FUNCTION"
        )));
    }
    let paths: Vec<PathBuf> = [PathBuf::from(file)]
        .into_iter()
        .chain(args.emit.kernel.source.iter().cloned())
        .collect();
    // Later, a file may be missing while it is being saved; at the start, its name is wrong.
    args.emit.kernel.locate_kernel()?;
    Ok(paths)
}

fn refuse_inputs_without_picture(args: &WatchArgs) -> Result<(), Failure> {
    let given = &args.given;
    let some = !given.input.is_empty() || !given.uniform.is_empty() || !given.buffer.is_empty() || given.size.is_some();
    match args.picture.is_none() && some {
        true => Err(Failure::Usage(
            "--input, --uniform, --buffer and --size are for the picture: add --picture FILE.png".to_owned(),
        )),
        false => Ok(()),
    }
}

/// Emits once, and prints one line about the written files, or the errors.
fn emit_once(args: &WatchArgs, gpu: &mut Option<Gpu>) {
    let start = Instant::now();
    match write_outputs(args, gpu) {
        Ok((name, written)) => {
            let time = start.elapsed().as_millis();
            outln!("{name}: wrote {} in {time} ms", written.join(", "));
        }
        // The exit status is ignored: watching goes on.
        Err(failure) => drop(failure.report()),
    }
}

fn write_outputs(args: &WatchArgs, gpu: &mut Option<Gpu>) -> Result<(String, Vec<String>), Failure> {
    let ready = emit::compile_kernel(&args.emit)?;
    let mut files = emit::write_shaders(&args.emit, &ready)?;
    if let Some(run) = args.to_run_args() {
        files.append(&mut run::run_compiled(&run, &ready.compiled, gpu)?.files);
    }
    let written = files.iter().map(|path| path.display().to_string());
    Ok((ready.compiled.kernel, written.collect()))
}

/// Waits until the files differ from `seen`, and have not changed for a while: an editor may save in several steps.
fn wait_for_change(paths: &[PathBuf], seen: &[Stamp]) -> Vec<Stamp> {
    let mut last = seen.to_vec();
    loop {
        std::thread::sleep(INTERVAL);
        let now = file_stamps(paths);
        if now == last && now != seen {
            return now;
        }
        last = now;
        if output::is_refused() {
            return last;
        }
    }
}

fn file_stamps(paths: &[PathBuf]) -> Vec<Stamp> {
    let stamp = |path: &PathBuf| {
        let metadata = std::fs::metadata(path).ok()?;
        Some((metadata.modified().ok()?, metadata.len()))
    };
    paths.iter().map(stamp).collect()
}
