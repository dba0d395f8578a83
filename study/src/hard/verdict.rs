//! Verdict on half precision: the kernels whose error stays within what can be seen in every case that scenes have.

use super::case::Case;
use super::form::KernelForm;
use super::judge::compile_form;
use super::run::build_trials;
use super::{HardError, cases};
use crate::record::{Executor, HalfVerdict, HardCase, HardResult};
use rayon::prelude::*;
use straightline_codegen::Precision;
use straightline_kernels::{OptionText, OptionValue, OptionValues};

/// Decides whether a built-in kernel with `options` may compute in half precision: by the interpreter, with and without
/// subnormal numbers, on every case that scenes have. The error on a device that is as inexact as WGSL allows is reported, but
/// decides nothing: known devices are more exact.
///
/// A layout of the G-buffer changes nothing of what is computed and is left out.
///
/// # Errors
///
/// [`HardError::NotStudied`] for a kernel that has no hard cases, for ambient occlusion and bilinear taps, whose pictures here are too
/// small, and for demodulated colours, guides and earlier frames, which none has; others if it does not compile.
pub fn half_precision_verdict(kernel: &str, options: &[OptionText]) -> Result<HalfVerdict, HardError> {
    let options: Vec<_> = options.iter().filter(|(name, _)| name != "layout").cloned().collect();
    let form = KernelForm::from_kernel(kernel, &options).ok_or_else(|| HardError::NotStudied(kernel.to_owned()))?;
    let values = form.option_values(&options)?;
    let is_plain = |value: &OptionValue| value.choice() == Some("none") || value.number() == Some(0.0);
    for name in ["demodulate", "guide", "history"] {
        if let Some(value) = values.get(name).filter(|value| !is_plain(value)) {
            return Err(HardError::NotStudied(format!("{kernel} {name}={value}")));
        }
    }
    // Only larger pictures than those of the cases show the precision that places lose in 11 bits.
    if kernel == "quad_ssao" || values.choice("taps") == Some("bilinear") {
        return Err(HardError::NotStudied(kernel.to_owned()));
    }
    let forms = [form];
    let common: Vec<Case> = cases::all_cases().into_iter().filter(|case| case.common).collect();
    let plain = common.iter().filter(|case| case.options.is_empty());
    let compiled = compile_form(&forms[0], &forms[0].options)?;
    let done = plain.par_bridge().map(|case| {
        let mut results = Vec::new();
        for (_, trial) in build_trials(case, &forms)? {
            results.extend(trial.run_interpreters(&compiled, Precision::F16)?);
        }
        Ok(HardCase {
            name: case.name.to_owned(),
            about: case.about.to_owned(),
            common: true,
            results,
        })
    });
    let mut done = done.collect::<Result<Vec<_>, HardError>>()?;
    done.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(half_verdict(&forms[0], &values, &done))
}

/// The verdict on every form that ran in half precision.
///
/// # Errors
///
/// [`HardError::Kernel`] for a form with an option that its kernel does not take.
pub fn half_verdicts(forms: &[KernelForm], done: &[HardCase]) -> Result<Vec<HalfVerdict>, HardError> {
    let ran = |form: &&KernelForm| done.iter().any(|case| half_results(case, form).next().is_some());
    let ran = forms.iter().filter(ran);
    ran.map(|form| Ok(half_verdict(form, &form.option_values(&form.options)?, done)))
        .collect()
}

fn half_results<'a>(case: &'a HardCase, form: &'a KernelForm) -> impl Iterator<Item = &'a HardResult> {
    let half = case
        .results
        .iter()
        .filter(|r| r.precision == "f16" && r.refused.is_none());
    half.filter(|r| r.kernel == form.name)
}

fn half_verdict(form: &KernelForm, values: &OptionValues, done: &[HardCase]) -> HalfVerdict {
    let common = done.iter().filter(|case| case.common);
    let all: Vec<(&HardCase, &HardResult)> = common
        .flat_map(|c| half_results(c, form).map(move |r| (c, r)))
        .collect();
    let is_loose = |r: &HardResult| r.executor == Executor::InterpreterLoose;
    let results: Vec<_> = all.iter().filter(|(_, r)| !is_loose(r)).copied().collect();
    // Error as a multiple of the limit, greatest for results that are not even finite.
    let excess = |r: &HardResult| match (r.non_finite, r.difference, r.bound) {
        (0, Some(off), Some(limit)) if limit > 0.0 => off / limit,
        (0, ..) => 0.0,
        _ => f64::INFINITY,
    };
    let worst = results.iter().max_by(|a, b| excess(a.1).total_cmp(&excess(b.1)));
    let broken: Vec<&str> = {
        let mut names: Vec<&str> = results
            .iter()
            .filter(|(_, r)| !r.kept)
            .map(|(c, _)| c.name.as_str())
            .collect();
        names.dedup();
        names
    };
    let reason = worst.filter(|_| !broken.is_empty()).map(|(case, r)| {
        let what = match (r.non_finite, r.difference, r.bound) {
            (0, Some(off), Some(limit)) => {
                format!("off by {off:.1e} on `{}`, where {limit:.1e} can be seen", case.name)
            }
            (count, ..) => format!("{count} pixels of `{}` are not finite", case.name),
        };
        let others = match broken.len() {
            1 => String::new(),
            2 => ", and more than can be seen on another".to_owned(),
            n => format!(", and more than can be seen on {} others", n - 1),
        };
        format!("{what}{others}: {}", form.loss_reason(values))
    });
    HalfVerdict {
        kernel: form.name.clone(),
        options: form.options.clone(),
        worst: worst.map(|(case, _)| case.name.clone()),
        difference: worst.and_then(|(_, r)| r.difference),
        loosest: worst.and_then(|(worst, _)| {
            let loose = all.iter().find(|(case, r)| case.name == worst.name && is_loose(r));
            loose.and_then(|(_, r)| r.difference)
        }),
        limit: worst.and_then(|(_, r)| r.bound),
        broken: broken.len(),
        cases: done
            .iter()
            .filter(|case| case.common && half_results(case, form).next().is_some())
            .count(),
        reason,
    }
}
