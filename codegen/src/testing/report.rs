//! Reports of failures: the assertion underlined, the arguments, and the results of all runners.

use super::file::TestKernel;
use super::outcome::{Outcome, Violation};
use super::run::divergence_of;
use super::verdict::Failure;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors};
use straightline_evaluator::front::testing::{Site, SiteKind, VALUE_NAMES};
use straightline_kernels::properties::{Case, case_text};

/// A case in which an assertion fails.
pub struct Failing<'a> {
    pub kernel: &'a TestKernel,
    /// The case.
    pub case: &'a Case,
    /// The runner on which it fails, by its position in `results`.
    pub by: usize,
    /// Each runner with its outcome of the case; the last is the interpreter in `f64`.
    pub results: Vec<(String, Option<Outcome>)>,
}

/// Reports a failure.
pub fn report_failure(failing: &Failing<'_>) -> Failure {
    let (runner, outcome) = &failing.results[failing.by];
    let what = format!("`{}` fails by the {runner}", failing.kernel.test.path);
    let (errors, violation) = failing.describe(
        |span| Diagnostic::error_at(Code::Assertion, span, what),
        outcome.as_ref(),
    );
    let text = |side: usize| violation?.values[side].as_ref().map(|value| value.text());
    Failure {
        errors,
        runner: Some(runner.clone()),
        inputs: failing.inputs(),
        values: [text(0), text(1)],
        ulps: violation.and_then(ulps_of),
        psnr: None,
    }
}

/// Remarks on an assertion that fails in `f64` alone.
pub fn report_double(failing: &Failing<'_>) -> Errors {
    let outcome = failing.results[failing.by].1.as_ref();
    let what = format!(
        "an assertion of `{}` holds in f32 and fails in f64",
        failing.kernel.test.path
    );
    failing.describe(|span| Diagnostic::remark_at(span, what), outcome).0
}

impl Failing<'_> {
    fn inputs(&self) -> Vec<String> {
        case_text(&self.kernel.test.arguments, self.case)
    }

    /// The diagnostic of a failed assertion, begun by `start` at its place.
    fn describe<'o>(
        &self,
        start: impl FnOnce(straightline_evaluator::diagnostic::Span) -> Diagnostic,
        outcome: Option<&'o Outcome>,
    ) -> (Errors, Option<&'o Violation>) {
        let violation = outcome.and_then(Outcome::violation);
        let site = violation.and_then(|violation| self.kernel.sites.get(violation.site));
        let span = site.map_or(self.kernel.test.span, |site| site.span);
        let mut error = start(span);
        if let (Some(site), Some(violation)) = (site, violation) {
            error = error.label(label_of(site, violation));
        }
        let inputs = self.inputs();
        if !inputs.is_empty() {
            error = error.note(format!("for these arguments:\n    {}", inputs.join("\n    ")));
        }
        for (k, (name, outcome)) in self.results.iter().enumerate() {
            if k != self.by {
                let text = self.outcome_text(outcome.as_ref(), violation);
                error = error.note(format!("{name}: {text}"));
            }
        }
        if let Some(found) = divergence_of(self.kernel, self.case) {
            let text = found.describe(&self.kernel.compiled.graph);
            // The values of an assertion have no names in the file.
            let values = site.map_or(&[][..], |site| &site.values);
            let named = VALUE_NAMES.iter().zip(values);
            error = error.note(named.fold(text, |text, (name, value)| text.replace(name, value)));
        }
        (Errors::new(vec![error], &self.kernel.files), violation)
    }

    /// The outcome by another runner than that by which `found` is.
    fn outcome_text(&self, outcome: Option<&Outcome>, found: Option<&Violation>) -> String {
        match outcome {
            None => "could not be run".to_owned(),
            Some(Outcome::Held) => "all assertions hold".to_owned(),
            Some(Outcome::PassedOver) => "`assume` passes over the case".to_owned(),
            Some(Outcome::Failed(violation)) if found.is_some_and(|found| found.is_alike(violation)) => {
                "fails with the same values".to_owned()
            }
            Some(Outcome::Failed(violation)) => match self.kernel.sites.get(violation.site) {
                Some(site) => format!("fails in line {}: {}", site.span.line, label_of(site, violation)),
                None => "fails".to_owned(),
            },
        }
    }
}

/// The values of a failed assertion in a sentence.
pub(super) fn label_of(site: &Site, violation: &Violation) -> String {
    let values: Vec<String> = site
        .values
        .iter()
        .zip(&violation.values)
        .filter_map(|(text, value)| {
            let value = value.as_ref()?.text();
            // A literal need not be said twice.
            (*text != value && !text.is_empty()).then(|| format!("`{text}` is {value}"))
        })
        .collect();
    if values.is_empty() {
        return match site.kind {
            SiteKind::Equal => "the values differ".to_owned(),
            SiteKind::NotEqual => "the values are equal".to_owned(),
            _ => "this does not hold".to_owned(),
        };
    }
    let mut label = values.join(", ");
    if let Some(ulps) = ulps_of(violation)
        && matches!(site.kind, SiteKind::Close | SiteKind::Equal)
    {
        label += &format!(": {ulps} {} apart", if ulps == 1 { "ULP" } else { "ULPs" });
    }
    if site.kind == SiteKind::Close {
        label += &format!(", and `{}` is allowed", site.tolerance);
    }
    label
}

fn ulps_of(violation: &Violation) -> Option<u32> {
    let [Some(left), Some(right)] = &violation.values else {
        return None;
    };
    left.ulps_to(right)
}
