//! `study sweep`: one kernel in every combination of options and forms; and the commands that read such records.

mod environment;
pub mod given;
mod print;

use super::isa::start_compiler;
use super::{ProgressBars, circumstances_of};
use crate::args::{CommonArgs, Gpus, MergeArgs, RecordsArgs, SweepArgs};
use crate::failure::{Failure, format_count};
use crate::gpu::Gpu;
use given::Given;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;
use straightline_codegen::{Compiled, Kernel};
use straightline_manifest::hash_of_text;
use straightline_study::progress::Progress;
use straightline_study::record::{Record, Shard, SweepRecord};
use straightline_study::sweep::{self, RESERVED, Rival, Space, Sweep, SweepError};

/// Minimum time for one measurement of a shader.
const LEAST: Duration = Duration::from_millis(40);

/// Measures, writes the record, and prints it.
pub fn measure_sweep(common: &CommonArgs, args: &SweepArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let kernel = args
        .source
        .iter()
        .fold(Kernel::from_argument(&args.kernel), |kernel, path| {
            kernel?.with_file(path)
        })?;
    let space = build_space(args, &kernel)?;
    let sweep = Sweep {
        baseline: build_baseline(args, &kernel)?,
        kernel,
        space,
        rivals: args
            .against
            .iter()
            .map(|file| Rival { pattern: file.clone() })
            .collect(),
        rounds: common.timing_rounds(),
        until: args.until,
        least: LEAST,
        shard: args.shard,
    };
    let compiled = first_of_groups(&sweep)?;
    let given = Given::new(common, &args.inputs, common.picture_size(), &compiled);
    let size = given.picture_size(&compiled[0])?;
    let gpu = Gpu::require(&common.adapter)?;
    let give = |compiled: &Compiled| given.variant_inputs(compiled).map_err(to_sweep_error);
    let compilers = Gpus::distinct(&args.isa).into_iter().map(start_compiler);
    let mut compilers: Vec<_> = compilers.collect::<Result<_, _>>().map_err(Failure::from_error)?;
    let variants = sweep
        .measure(&gpu.bench(), &give, &mut compilers, progress)
        .map_err(to_failure)?;
    let mut circumstances = circumstances_of(&gpu, size, common.timing_rounds());
    circumstances.complete = !progress.is_stopped();
    let record = SweepRecord {
        circumstances,
        environment: environment::collect_environment(),
        kernel: sweep.kernel.name().to_owned(),
        source: hash_of_text(
            &sweep
                .kernel
                .files()
                .iter()
                .map(|file| file.text.as_str())
                .collect::<String>(),
        ),
        input: given.to_string(),
        axes: sweep.space.axes(),
        baseline: sweep.baseline,
        until: args.until,
        shard: args.shard,
        compilers: compilers
            .iter()
            .map(|compiler| (compiler.gpu().to_string(), compiler.device().to_owned()))
            .collect(),
        variants,
    };
    progress.clear_bar();
    record.write(&common.out).map_err(Failure::from_error)?;
    print::print_record(&record);
    print_paths(common);
    check_complete(&record, args.shard)
}

/// Fails for an interrupted record, so that an engine which runs shards takes this one again.
fn check_complete(record: &SweepRecord, shard: Option<Shard>) -> Result<(), Failure> {
    let of = shard.map_or("the sweep".to_owned(), |shard| format!("shard {shard}"));
    match record.circumstances.complete {
        true => Ok(()),
        false => Err(Failure::Interrupted(format!(
            "{of} was interrupted: its record is not complete"
        ))),
    }
}

/// Writes all shards as one record. Names every record that cannot be read.
pub fn merge_shards(common: &CommonArgs, args: &MergeArgs) -> Result<(), Failure> {
    let (mut records, mut unreadable) = (Vec::new(), Vec::new());
    for path in &args.records {
        match SweepRecord::read(path) {
            Ok(record) => records.push(record),
            Err(error) => unreadable.push(error.to_string()),
        }
    }
    if !unreadable.is_empty() {
        return Err(Failure::Failed(unreadable.join("\n")));
    }
    let record = sweep::join_shards(&records).map_err(Failure::from_error)?;
    record.write(&common.out).map_err(Failure::from_error)?;
    print::print_record(&record);
    print_paths(common);
    Ok(())
}

/// Prints the differences between two records. Fails if there are any.
pub fn compare_records(args: &RecordsArgs) -> Result<(), Failure> {
    let read = |path| SweepRecord::read(path).map_err(Failure::from_error);
    let (first, second) = (read(&args.first)?, read(&args.second)?);
    let compared = sweep::compare_records(&first, &second, args.tolerance).map_err(Failure::from_error)?;
    if compared.is_empty() {
        return Err(Failure::Failed(
            "the records have no variant in common that was measured in both, beside its baseline".to_owned(),
        ));
    }
    print::print_comparison(&first, &compared);
    match compared.iter().filter(|of| of.differs).count() {
        0 => Ok(()),
        differ => Err(Failure::Failed(format!(
            "{differ} of {} differ by more than {:.0} %",
            format_count(compared.len(), "variant"),
            100.0 * args.tolerance
        ))),
    }
}

fn print_paths(common: &CommonArgs) {
    for extension in ["json", "csv"] {
        outln!(
            "{}",
            common.out.join(SweepRecord::STEM).with_extension(extension).display()
        );
    }
}

/// Builds the space of all axes, without duplicate values.
fn build_space(args: &SweepArgs, kernel: &Kernel) -> Result<Space, Failure> {
    let space = Space {
        options: args.set.clone(),
        knobs: args.vary.clone(),
        unroll: args.unroll.clone(),
        loops: args.loops.clone(),
        stages: args.stage.clone(),
        workgroups: args.workgroup.iter().map(|size| size.to_array()).collect(),
        blocks: args.block.iter().map(|size| size.to_array()).collect(),
    };
    let mut knobs = BTreeSet::new();
    if let Some((twice, _)) = space.knobs.iter().find(|(name, _)| !knobs.insert(*name)) {
        return Err(Failure::Usage(format!(
            "--vary {twice} is given twice: give all its values at once"
        )));
    }
    let mut names = BTreeSet::new();
    for (name, _) in &space.options {
        if knobs.contains(name.as_str()) {
            return Err(Failure::Usage(format!(
                "the option `{name}` and --vary {name} would be one axis: sweep one of them at a time"
            )));
        }
        if RESERVED.contains(&name.as_str()) {
            return Err(Failure::Usage(format!(
                "an option called `{name}` cannot be swept: --{name} is another axis; call it differently in the kernel"
            )));
        }
        if !names.insert(name) {
            return Err(Failure::Usage(format!(
                "the option `{name}` is given twice: give all its values at once"
            )));
        }
    }
    let space = space.spelled_by(kernel);
    for axis in space.axes() {
        let mut values = BTreeSet::new();
        if let Some(twice) = axis.values.iter().find(|value| !values.insert(*value)) {
            return Err(Failure::Usage(format!("`{}` has the value `{twice}` twice", axis.name)));
        }
    }
    Ok(space)
}

fn build_baseline(args: &SweepArgs, kernel: &Kernel) -> Result<BTreeMap<String, String>, Failure> {
    let mut baseline = BTreeMap::new();
    for (name, value) in &args.baseline {
        if baseline
            .insert(name.clone(), sweep::spell_value(kernel, name, value))
            .is_some()
        {
            return Err(Failure::Usage(format!("--baseline has `{name}` twice")));
        }
    }
    if let (true, Some(first)) = (baseline.is_empty(), args.unroll.first()) {
        baseline.insert("unroll".to_owned(), first.to_string());
    }
    Ok(baseline)
}

/// Compiles one variant of each group. If none compiles, the kernel or the name of an option is wrong.
fn first_of_groups(sweep: &Sweep) -> Result<Vec<Compiled>, Failure> {
    let mut wrong = None;
    let mut compiled = Vec::new();
    for variant in sweep.groups().map_err(to_failure)?.iter().flatten() {
        match variant.spec().map_err(Failure::Usage)?.compile(&sweep.kernel) {
            Ok(one) => compiled.push(one),
            Err(errors) => wrong = wrong.or(Some(errors)),
        }
    }
    match wrong {
        Some(errors) if compiled.is_empty() => Err(Failure::Kernel(errors)),
        _ => Ok(compiled),
    }
}

fn to_failure(error: SweepError) -> Failure {
    match error {
        SweepError::Bad(message) | SweepError::Given(message) => Failure::Usage(message),
        other => Failure::from_error(other),
    }
}

fn to_sweep_error(failure: Failure) -> SweepError {
    SweepError::Given(match failure {
        Failure::Usage(message) | Failure::Failed(message) | Failure::Interrupted(message) => message,
        Failure::Kernel(errors) => errors.render(false),
    })
}
