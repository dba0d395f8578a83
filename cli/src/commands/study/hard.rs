//! `study hard`: numerical stability on hard cases.

use super::{ProgressBars, on_processor, run_circumstances};
use crate::args::{CommonArgs, HardArgs};
use crate::failure::Failure;
use crate::gpu::{Gpu, INSTALL};
use std::collections::BTreeMap;
use straightline_codegen::Precision;
use straightline_study::hard::{self, Selection};
use straightline_study::record::{HardRecord, HardResult, Record};
use straightline_table::Table;

/// Runs hard cases, prints their results, and writes the record.
pub fn run_hard_cases(common: &CommonArgs, args: &HardArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let selection = select_cases(args)?;
    let gpu = Gpu::open(&common.adapter)?;
    let circumstances = match &gpu {
        Some(gpu) => run_circumstances(common, gpu),
        None => {
            errln!("there is no GPU adapter, so only the interpreter runs the cases; {INSTALL}");
            on_processor(common.picture_size(), common.timing_rounds())
        }
    };
    let bench = gpu.as_ref().map(Gpu::bench);
    let record = hard::run_cases(&selection, bench.as_ref(), circumstances, progress).map_err(Failure::from_error)?;
    progress.clear_bar();
    record.write(&common.out).map_err(Failure::from_error)?;
    out!("{}", result_matrix(&record, &selection));
    out!("{}", result_summary(&record));
    outln!("written: {}", common.out.join("hard.json").display());
    match record.broken_results().next() {
        None => Ok(()),
        Some((case, r)) => super::write_page(&common.out).and(Err(Failure::Failed(format!(
            "{} results in default options break what they promise; the first: {} on `{}` by {}, {}",
            record.broken_results().count(),
            r.kernel,
            case.name,
            executor_name(r),
            describe_broken(r)
        )))),
    }
}

/// Prints the names of the cases.
pub fn list_cases(args: &HardArgs) -> Result<(), Failure> {
    for case in select_cases(args)?.cases {
        outln!("{:<32} {}", case.name, case.about);
    }
    Ok(())
}

fn select_cases(args: &HardArgs) -> Result<Selection, Failure> {
    let mut selection = Selection::default();
    if !args.cases.is_empty() {
        let named = args.cases.iter().map(|name| hard::find_case(name));
        selection.cases = named
            .collect::<Result<_, _>>()
            .map_err(|error| Failure::Usage(error.to_string()))?;
    }
    selection.precisions = args.precision.map_or(Precision::ALL.to_vec(), |one| vec![one]);
    Ok(selection)
}

/// Formats the results of one kernel on one case, over all executors.
fn result_cell<'a>(results: impl Iterator<Item = &'a HardResult>) -> String {
    let ran: Vec<&HardResult> = results.filter(|r| r.refused.is_none()).collect();
    let non_finite = ran.iter().map(|r| r.non_finite).max();
    match non_finite {
        None => String::new(),
        Some(0) if ran.iter().all(|r| r.kept) => ".".to_owned(),
        Some(0) => "o".to_owned(),
        Some(_) => "X".to_owned(),
    }
}

/// Formats a table for each precision, with cases as rows and kernels as columns.
fn result_matrix(record: &HardRecord, selection: &Selection) -> String {
    let mut text = String::new();
    for precision in &selection.precisions {
        let letters = ('a'..='z').chain('A'..='Z');
        let forms: Vec<(char, &str)> = letters
            .zip(selection.forms.iter().map(|form| form.name.as_str()))
            .collect();
        text +=
            &format!("\n{precision}: . finite and within bounds, o out of bounds, X not finite, empty: not for it\n");
        for (letter, form) in &forms {
            text += &format!("  {letter}  {form}\n");
        }
        let table = Table::of(&record.cases)
            .column("case", |case| &case.name)
            .columns(
                &forms,
                |(letter, _)| letter.to_string(),
                |case, (_, form)| {
                    let own = case.results.iter();
                    result_cell(own.filter(|r| r.kernel == *form && r.precision == precision.to_string()))
                },
            )
            .finish();
        text += &format!("\n{}", table.to_text());
    }
    text
}

/// Formats the counts, the result of each kernel that is closest to its bound, and the kernels that may run in half
/// precision.
fn result_summary(record: &HardRecord) -> String {
    let [promised, others] = record.non_finite();
    let results = record.cases.iter().flat_map(|case| &case.results);
    let ran = results.clone().filter(|r| r.refused.is_none()).count();
    let mut text = format!(
        "\n{} cases, {ran} results on {}{}\n\
         default options, f32: {promised} pixels that are not finite, {} results out of bounds\n\
         as printed (`paper`), f32: {others} pixels that are not finite\n",
        record.cases.len(),
        record.circumstances.adapter,
        if record.circumstances.complete {
            ""
        } else {
            "; not complete"
        },
        record.broken_results().count(),
    );
    let refused: BTreeMap<&str, usize> =
        results
            .filter_map(|r| r.refused.as_deref())
            .fold(BTreeMap::new(), |mut counts, why| {
                *counts.entry(why).or_default() += 1;
                counts
            });
    for (why, count) in refused {
        text += &format!(
            "{count} results were not computed: {}\n",
            why.lines().next().unwrap_or_default()
        );
    }
    let mut closest: BTreeMap<&str, (f64, String)> = BTreeMap::new();
    for case in &record.cases {
        for r in case.results.iter().filter(|r| r.promised && r.refused.is_none()) {
            let (Some(off), Some(bound)) = (r.difference, r.bound) else {
                continue;
            };
            let share = if bound > 0.0 { off / bound } else { off };
            let entry = closest.entry(&r.kernel).or_insert((-1.0, String::new()));
            if share > entry.0 {
                *entry = (
                    share,
                    format!("{off:.1e} of {bound:.1e}, {}, {}", case.name, executor_name(r)),
                );
            }
        }
    }
    for (kernel, (share, what)) in closest {
        text += &format!("closest to its bound: {kernel:<20} {:>5.1} % ({what})\n", 100.0 * share);
    }
    for verdict in &record.half {
        text += &match &verdict.reason {
            None => format!(
                "half precision: {:<20} keeps what can be seen in {} cases\n",
                verdict.kernel, verdict.cases
            ),
            Some(why) => format!("half precision: {:<20} no: {why}\n", verdict.kernel),
        };
    }
    for (case, r) in record.broken_results().take(20) {
        text += &format!(
            "broken: {} on `{}` by {}: {}\n",
            r.kernel,
            case.name,
            executor_name(r),
            describe_broken(r)
        );
    }
    text
}

fn executor_name(r: &HardResult) -> String {
    serde_json::to_value(r.executor).map_or(String::new(), |v| v.as_str().unwrap_or_default().to_owned())
}

fn describe_broken(r: &HardResult) -> String {
    match (r.non_finite, r.difference, r.bound) {
        (0, Some(off), Some(bound)) => format!("off by {off:.2e} where a pixel may be off by {bound:.2e} at most"),
        (0, ..) => "out of its bound".to_owned(),
        (count, ..) => {
            let born = r.born.as_ref().map_or(String::new(), |born| format!(", {born}"));
            format!("{count} of {} pixels are not finite{born}", r.pixels)
        }
    }
}
