//! Runs the selected cases, forms and precisions in all executors.

use super::case::Case;
use super::form::KernelForm;
use super::judge::{Trial, compile_form};
use super::verdict::half_verdicts;
use super::{HardError, cases};
use crate::progress::Progress;
use crate::record::{Circumstances, Executor, HardCase, HardRecord, HardResult};
use rayon::prelude::*;
use std::collections::BTreeMap;
use straightline_bench::execute::{Bench, ExecuteError};
use straightline_codegen::{Compiled, Precision, Stage};
use straightline_kernels::OptionText;
use straightline_manifest::Manifest;
use straightline_runtime::Pass;

/// Cases, forms and precisions to run.
#[derive(Clone, Debug)]
pub struct Selection {
    /// Cases.
    pub cases: Vec<Case>,
    /// Forms of kernels.
    pub forms: Vec<KernelForm>,
    /// Precisions.
    pub precisions: Vec<Precision>,
}

impl Default for Selection {
    /// Selects everything.
    fn default() -> Self {
        Selection {
            cases: cases::all_cases(),
            forms: KernelForm::all(),
            precisions: Precision::ALL.to_vec(),
        }
    }
}

/// Kernel and options.
type Key = (String, Vec<OptionText>);

/// A compiled shader, or the reason why the device does not support it.
type Shader = Result<(Pass, Manifest), String>;

/// Runs the selection in the interpreters, and on the device if there is one. If `watch` stops the run, the remaining
/// results are missing and the record is incomplete.
///
/// # Errors
///
/// If a kernel cannot be compiled or run at all. A bad result is not an error: it is in the record.
pub fn run_cases(
    selection: &Selection,
    bench: Option<&Bench>,
    mut circumstances: Circumstances,
    progress: &mut dyn Progress,
) -> Result<HardRecord, HardError> {
    let compiled = compile_forms(selection, progress)?;
    let mut shaders: BTreeMap<(Key, Precision), Shader> = BTreeMap::new();
    let mut done = Vec::new();
    progress.begin("hard cases", selection.cases.len());
    for case in &selection.cases {
        if progress.is_stopped() {
            break;
        }
        let trials = build_trials(case, &selection.forms)?;
        let mut results: Vec<Vec<HardResult>> = trials
            .par_iter()
            .map(|(key, trial)| {
                let precisions = selection.precisions.iter();
                let found =
                    precisions.filter_map(|precision| Some(trial.run_interpreters(compiled.get(key)?, *precision)));
                Ok(found.collect::<Result<Vec<_>, HardError>>()?.concat())
            })
            .collect::<Result<_, HardError>>()?;
        for ((key, trial), results) in trials.iter().zip(&mut results) {
            for precision in &selection.precisions {
                let Some(bench) = bench else {
                    results.push(trial.record_refusal(*precision, Executor::Gpu, "there is no adapter"));
                    continue;
                };
                let shader = shaders.entry((key.clone(), *precision)).or_insert_with(|| {
                    let kernel = compiled.get(key).ok_or("it was not compiled")?;
                    let half = bench.clone().with_precision(*precision);
                    half.compile_pass(kernel, Stage::Compute)
                        .map_err(|error: ExecuteError| error.to_string())
                });
                results.push(match shader {
                    Ok((pass, manifest)) => trial.run_device(bench, pass, manifest, *precision)?,
                    Err(why) => trial.record_refusal(*precision, Executor::Gpu, why),
                });
            }
        }
        done.push(HardCase {
            name: case.name.to_owned(),
            about: case.about.to_owned(),
            common: case.common,
            results: results.concat(),
        });
        progress.step();
    }
    circumstances.complete = done.len() == selection.cases.len();
    Ok(HardRecord {
        circumstances,
        half: half_verdicts(&selection.forms, &done)?,
        cases: done,
    })
}

/// Runs a form on a case in `f32` by every interpreter, judged by the bounds of another form, to test whether these detect
/// the difference.
///
/// # Errors
///
/// If either cannot be compiled or run.
pub fn judged_as(case: &Case, form: &KernelForm, promise: &KernelForm) -> Result<Vec<HardResult>, HardError> {
    let compiled = compile_form(form, &form.options)?;
    Trial::new(case, promise, promise.options.clone())?.run_interpreters(&compiled, Precision::F32)
}

/// Returns the forms that a case applies to.
pub fn build_trials<'a>(case: &'a Case, forms: &'a [KernelForm]) -> Result<Vec<(Key, Trial<'a>)>, HardError> {
    let for_it = forms.iter().filter_map(|form| Some((form, form.in_case(case)?)));
    for_it
        .map(|(form, options)| {
            let key = (form.kernel.clone(), options.clone());
            Ok((key, Trial::new(case, form, options)?))
        })
        .collect()
}

/// Compiles every form with the options of every applicable case, once.
fn compile_forms(selection: &Selection, progress: &mut dyn Progress) -> Result<BTreeMap<Key, Compiled>, HardError> {
    let mut needed: BTreeMap<Key, &KernelForm> = BTreeMap::new();
    for case in &selection.cases {
        for form in &selection.forms {
            if let Some(options) = form.in_case(case) {
                needed.insert((form.kernel.clone(), options), form);
            }
        }
    }
    let needed: Vec<(Key, &KernelForm)> = needed.into_iter().collect();
    progress.begin("compiling kernels", needed.len());
    let mut all = BTreeMap::new();
    for some in needed.chunks(8) {
        if progress.is_stopped() {
            break;
        }
        let compiled = some
            .par_iter()
            .map(|(key, form)| Ok((key.clone(), compile_form(form, &key.1)?)));
        all.extend(compiled.collect::<Result<Vec<_>, HardError>>()?);
        some.iter().for_each(|_| progress.step());
    }
    Ok(all)
}
