//! `study loops`: unrolled against looped forms.

use super::uniforms::Asked;
use super::{ProgressBars, run_circumstances};
use crate::args::{CommonArgs, LoopsArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;
use straightline_codegen::{Kernel, Settings, files};
use straightline_scene::picture;
use straightline_study::loops::{LoopsError, Setup, Studied, Subject, list_subjects, study_loops};
use straightline_study::progress::Progress;
use straightline_study::record::{LoopsRecord, Record};
use straightline_study::statistics::describe_noise;

/// Minimum time for one measurement of a form. On two busy cores the ratios of a form spread by 0.64 of their median at 40
/// ms, by 0.81 at 10 ms, and by 1.06 for a single frame.
const LEAST: Duration = Duration::from_millis(40);

/// Measures, writes the record, and prints it.
pub fn measure_loops(common: &CommonArgs, args: &LoopsArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let mut subjects = choose_subjects(common, &args.from, &args.by_hand)?;
    set_uniforms(&mut subjects, &args.uniform)?;
    if let Some(folder) = &args.pictures {
        files::try_folder(folder).map_err(Failure::from_error)?;
    }
    let gpu = Gpu::require(&common.adapter)?;
    let setup = Setup {
        size: common.picture_size(),
        rounds: common.timing_rounds(),
        least: LEAST,
        pipelines: if common.quick { 1 } else { 3 },
    };
    let mut circumstances = run_circumstances(common, &gpu);
    let studied = study_loops(&gpu.bench(), &subjects, &setup, progress).map_err(to_failure)?;
    circumstances.complete = !progress.is_stopped();
    let record = LoopsRecord {
        circumstances,
        kernels: studied.iter().map(|kernel| kernel.forms.clone()).collect(),
    };
    record.write(&common.out).map_err(Failure::from_error)?;
    if let Some(folder) = &args.pictures {
        write_pictures(folder, &studied)?;
    }
    print(&record);
    Ok(())
}

/// Returns the requested kernels, each with its hand-written version if there is one, or the built-in selection.
pub fn choose_subjects(common: &CommonArgs, from: &[String], by_hand: &[String]) -> Result<Vec<Subject>, Failure> {
    if !by_hand.is_empty() && by_hand.len() != from.len() {
        return Err(Failure::Usage(format!(
            "{} hand-optimised kernels for {} kernels: give one --by-hand for each --from, in the same order, or none",
            by_hand.len(),
            from.len()
        )));
    }
    if from.is_empty() {
        return Ok(list_subjects(common.quick)?);
    }
    let mut own = Vec::new();
    for (k, kernel) in from.iter().enumerate() {
        let by_hand = by_hand.get(k).map(|text| Kernel::from_argument(text)).transpose()?;
        own.push(Subject::from_kernel(Kernel::from_argument(kernel)?, by_hand));
    }
    Ok(own)
}

/// Sets the requested uniforms of each kernel. Fails if a uniform belongs to none of them.
fn set_uniforms(subjects: &mut [Subject], asked: &[(String, String)]) -> Result<(), Failure> {
    if asked.is_empty() {
        return Ok(());
    }
    let mut asked = Asked::new(asked);
    for subject in subjects {
        let compiled = subject.kernel.compile(&Settings::default())?;
        subject.uniforms.extend(asked.values_of(&compiled.graph.uniforms)?);
    }
    asked.check_all_found("kernel of --from")
}

/// Converts errors, keeping the source location of kernel errors.
fn to_failure(error: LoopsError) -> Failure {
    match error {
        LoopsError::Kernel { errors, .. } => Failure::Kernel(errors),
        other => Failure::from_error(other),
    }
}

/// Writes the unrolled picture of each kernel, and all of them in one picture.
fn write_pictures(folder: &Path, studied: &[Studied]) -> Result<(), Failure> {
    let png = |frame| picture::png_bytes(frame).map_err(Failure::from_error);
    let mut set = BTreeMap::new();
    for kernel in studied {
        let stem = kernel.forms.kernel.replace([' ', ','], "_");
        set.insert(format!("{stem}.png"), png(&kernel.picture)?);
    }
    let columns: Vec<_> = studied.iter().map(|k| (k.forms.kernel.as_str(), &k.picture)).collect();
    if columns.is_empty() {
        return Ok(());
    }
    set.insert("all.png".to_owned(), png(&picture::compose_montage(&columns))?);
    files::write_all(folder, &set).map_err(Failure::from_error)?;
    Ok(())
}

fn print(record: &LoopsRecord) {
    let c = &record.circumstances;
    outln!(
        "{}, {}x{}, {} rounds in turn, {}{}\n",
        c.adapter,
        c.size[0],
        c.size[1],
        c.rounds,
        c.date,
        if c.complete { "" } else { "; interrupted" }
    );
    out!("{}", record.to_table().to_text());
    outln!("\nspeedup: over the looped form; median of the rounds, with its 95 % interval");
    outln!("{}", describe_noise(record.noise()));
    for kernel in record.kernels.iter().filter(|kernel| kernel.input.contains(" = ")) {
        outln!("{}: on {}", kernel.kernel, kernel.input);
    }
    for kernel in &record.kernels {
        for (kind, why) in &kernel.absent {
            outln!("{}, {}: {why}", kernel.kernel, kind.display_name());
        }
    }
}
