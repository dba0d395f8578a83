//! Record of numerical stability on hard cases.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_kernels::OptionText;
use straightline_table::{Cell, Table};

/// Executor of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Executor {
    /// The interpreter.
    Interpreter,
    /// The interpreter, with subnormal numbers flushed to zero after every operation.
    InterpreterFlushed,
    /// The interpreter, as inexact as WGSL permits. Every inexact result is rounded pseudo-randomly up or down, which
    /// covers a compiler's reordered additions and fused products. Functions are off by their whole ULPs. Subnormal numbers
    /// are flushed to zero. For a NaN and a number, `min` and `max` return the NaN.
    InterpreterLoose,
    /// The emitted shader on the adapter that the record names.
    Gpu,
}

/// A kernel on a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardResult {
    /// Name of the kernel with its distinguishing options: `sraa default`, `sraa paper`, `stalker`.
    pub kernel: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// `f16` or `f32`.
    pub precision: String,
    /// Executor of the run.
    pub executor: Executor,
    /// Number of pixels of the output.
    pub pixels: usize,
    /// Number of those pixels that are not finite.
    pub non_finite: usize,
    /// Largest absolute difference to the oracle in `f64`, over pixels that are finite in both; `None` if the oracle has no
    /// finite result.
    pub difference: Option<f64>,
    /// Difference in units of the last place of the result's precision, at the oracle's value.
    pub ulps: Option<f64>,
    /// Origin of the first NaN or infinity: source line and operation, by the interpreter.
    pub born: Option<String>,
    /// Largest permitted absolute difference of this kernel on this case; `None` if it is only recorded.
    pub bound: Option<f64>,
    /// `true` if the run kept the bound, and is finite where that is required.
    pub kept: bool,
    /// `true` if the run must be finite and within its bound: in `f32`, all forms except those that reproduce the printed
    /// listing.
    pub promised: bool,
    /// In `f16`, where `bound` is the visible difference: the largest error by error analysis, if there is one.
    pub analysed: Option<f64>,
    /// Reason why it was not run: the adapter lacks a feature, or the form is rejected.
    pub refused: Option<String>,
}

/// A case and its results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardCase {
    /// Name, one word or several with hyphens.
    pub name: String,
    /// Description of the difficulty.
    pub about: String,
    /// `true` if the case occurs in real scenes, so that half precision is judged by it.
    pub common: bool,
    /// Results of all kernels, precisions and executors.
    pub results: Vec<HardResult>,
}

/// Verdict on a form of a kernel in half precision.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HalfVerdict {
    /// The kernel, as in [`HardResult::kernel`].
    pub kernel: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// Case with the largest error relative to the visible difference there.
    pub worst: Option<String>,
    /// Difference in that case; `None` if nothing was finite.
    pub difference: Option<f64>,
    /// Largest difference in that case on a device as inexact as WGSL permits; not used for the verdict.
    pub loosest: Option<f64>,
    /// Least visible difference there: 1/255 of the brightest colour.
    pub limit: Option<f64>,
    /// Number of common cases with a visible error, of `cases`.
    pub broken: usize,
    /// Number of common cases.
    pub cases: usize,
    /// Reason for rejecting half precision; `None` if it is acceptable.
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
    /// Returns the results that must be finite and within their bounds but are not, each with its case.
    pub fn broken_results(&self) -> impl Iterator<Item = (&HardCase, &HardResult)> {
        let results = self
            .cases
            .iter()
            .flat_map(|case| case.results.iter().map(move |r| (case, r)));
        results.filter(|(_, r)| r.promised && !r.kept)
    }

    /// Returns the non-finite pixels in `f32`: of results that promise finiteness, and of the others.
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

    fn to_table(&self) -> Table {
        let rows = self.cases.iter();
        let rows = rows.flat_map(|case| case.results.iter().map(move |result| (&case.name, result)));
        let off = |value: Option<f64>| value.map(|value| Cell::scientific(value, 1));
        Table::of(rows)
            .column("case", |(case, _)| *case)
            .column("kernel", |(_, r)| &r.kernel)
            .column("precision", |(_, r)| &r.precision)
            .column("executor", |(_, r)| super::json_name(&r.executor))
            .column("pixels", |(_, r)| r.pixels)
            .column("non_finite", |(_, r)| r.non_finite)
            .column("difference", |(_, r)| off(r.difference))
            .column("ulps", |(_, r)| off(r.ulps))
            .column("bound", |(_, r)| off(r.bound))
            .column("kept", |(_, r)| r.kept)
            .column("promised", |(_, r)| r.promised)
            .column("born", |(_, r)| r.born.as_ref())
            .column("refused", |(_, r)| r.refused.as_ref())
            .finish()
    }
}
