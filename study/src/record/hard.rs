//! Numerical stability on hard cases.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;

/// Executor of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Executor {
    /// The interpreter.
    Interpreter,
    /// The interpreter, subnormal numbers flushed to zero after every operation.
    InterpreterFlushed,
    /// The interpreter, as inexact as WGSL lets a device be: every inexact result is rounded up or down as it happens, which is
    /// how far a compiler's own order of additions and its fused products can move one; functions are off by their whole ULPs;
    /// subnormal numbers are flushed; of a NaN and a number, `min` and `max` give the NaN.
    InterpreterLoose,
    /// The emitted shader on the adapter that the record names.
    Gpu,
}

/// A kernel on a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardResult {
    /// The kernel with what distinguishes its options: `sraa default`, `sraa paper`, `stalker`.
    pub kernel: String,
    /// Options that are not the default.
    pub options: Vec<OptionText>,
    /// `f16` or `f32`.
    pub precision: String,
    /// Executor of the run.
    pub executor: Executor,
    /// Pixels of the output, and how many of them are not finite.
    pub pixels: usize,
    /// See `pixels`.
    pub non_finite: usize,
    /// Largest absolute difference to the oracle in `f64`, of pixels that are finite in both; `None` where the oracle has no
    /// finite answer.
    pub difference: Option<f64>,
    /// Difference in units of the last place of the result's precision, at the oracle's value.
    pub ulps: Option<f64>,
    /// Origin of the first NaN or infinity: source line and operation, by the interpreter.
    pub born: Option<String>,
    /// The largest absolute difference that this kernel must keep on this case; `None` where it is only watched.
    pub bound: Option<f64>,
    /// True if the run kept the bound, and is finite where that is required.
    pub kept: bool,
    /// True if the run must be finite and within its bound: in `f32`, all forms but those that keep what was printed.
    pub promised: bool,
    /// In `f16`, where `bound` is what can be seen: the most that error analysis allows, if there is one.
    pub analysed: Option<f64>,
    /// Why it was not run: the adapter lacks something, or the form is refused.
    pub refused: Option<String>,
}

/// A case and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardCase {
    /// Name, one word or several with hyphens.
    pub name: String,
    /// Description of the difficulty.
    pub about: String,
    /// True if scenes really have this: what half precision is judged by.
    pub common: bool,
    /// All kernels, precisions and executors.
    pub results: Vec<HardResult>,
}

/// Verdict on a form of a kernel in half precision.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HalfVerdict {
    /// The kernel, as in [`HardResult::kernel`].
    pub kernel: String,
    /// Options that are not the default.
    pub options: Vec<OptionText>,
    /// The case that it is farthest off in, measured by what can be seen there.
    pub worst: Option<String>,
    /// Difference in that case; `None` if nothing was finite.
    pub difference: Option<f64>,
    /// Greatest difference in that case on a device that is as inexact as WGSL allows, which decides nothing.
    pub loosest: Option<f64>,
    /// Least visible difference there: 1/255 of the brightest colour.
    pub limit: Option<f64>,
    /// Cases that scenes have and in which it is farther off than can be seen, of `cases`.
    pub broken: usize,
    /// See `broken`.
    pub cases: usize,
    /// Why it is to be refused; `None` if it may.
    pub reason: Option<String>,
}

/// All cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// The cases.
    pub cases: Vec<HardCase>,
    /// Verdicts on half precision, by form.
    pub half: Vec<HalfVerdict>,
}

impl HardRecord {
    /// Results that must be finite and within their bounds and are not, each with its case.
    pub fn broken_results(&self) -> impl Iterator<Item = (&HardCase, &HardResult)> {
        let results = self
            .cases
            .iter()
            .flat_map(|case| case.results.iter().map(move |r| (case, r)));
        results.filter(|(_, r)| r.promised && !r.kept)
    }

    /// Pixels that are not finite, of results that promise that all are and of those that do not, in `f32`.
    pub fn non_finite(&self) -> [usize; 2] {
        let results = self.cases.iter().flat_map(|case| &case.results);
        let single = results.filter(|r| r.precision == "f32");
        single.fold([0, 0], |[promised, others], r| match r.promised {
            true => [promised + r.non_finite, others],
            false => [promised, others + r.non_finite],
        })
    }
}

impl Record for HardRecord {
    const STEM: &'static str = "hard";

    fn to_table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
        let head = vec![
            "case",
            "kernel",
            "precision",
            "executor",
            "pixels",
            "non_finite",
            "difference",
            "ulps",
            "bound",
            "kept",
            "promised",
            "born",
            "refused",
        ];
        let optional = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.3e}"));
        let rows = self.cases.iter().flat_map(|case| {
            case.results.iter().map(move |r| {
                vec![
                    case.name.clone(),
                    r.kernel.clone(),
                    r.precision.clone(),
                    super::json_name(&r.executor),
                    r.pixels.to_string(),
                    r.non_finite.to_string(),
                    optional(r.difference),
                    optional(r.ulps),
                    optional(r.bound),
                    r.kept.to_string(),
                    r.promised.to_string(),
                    r.born.clone().unwrap_or_default(),
                    r.refused.clone().unwrap_or_default(),
                ]
            })
        });
        (head, rows.collect())
    }
}
