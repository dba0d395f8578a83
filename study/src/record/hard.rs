//! Numerical stability on hard cases.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};

/// What computed it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Executor {
    /// The interpreter.
    Interpreter,
    /// The interpreter, subnormal numbers flushed to zero after every operation.
    InterpreterFlushed,
    /// The emitted shader on the adapter that the record names.
    Gpu,
}

/// A kernel on a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardResult {
    /// The kernel with what distinguishes its options: `sraa default`, `sraa paper`, `stalker`.
    pub kernel: String,
    /// Options that are not the default.
    pub options: Vec<(String, String)>,
    /// `f16` or `f32`.
    pub precision: String,
    /// What computed it.
    pub executor: Executor,
    /// Pixels of the output, and how many of them are not finite.
    pub pixels: usize,
    /// See `pixels`.
    pub non_finite: usize,
    /// Largest absolute difference to the oracle in `f64`, of pixels that are finite in both; `None` where the oracle has no
    /// finite answer.
    pub difference: Option<f64>,
    /// The same in units of the last place of the result's precision, at the oracle's value.
    pub ulps: Option<f64>,
    /// Where the first NaN or infinity was born: source line and operation, by the interpreter.
    pub born: Option<String>,
    /// The largest absolute difference that this kernel must keep on this case; `None` where it is only watched.
    pub bound: Option<f64>,
    /// Whether it kept the bound, and is finite where that is asked of it.
    pub kept: bool,
    /// Why it was not run: the adapter lacks something, or the form is refused.
    pub refused: Option<String>,
}

/// A case and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardCase {
    /// Its name, one word or several with hyphens.
    pub name: String,
    /// What is hard about it.
    pub about: String,
    /// All kernels, precisions and executors.
    pub results: Vec<HardResult>,
}

/// All cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HardRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// The cases.
    pub cases: Vec<HardCase>,
}

impl Record for HardRecord {
    const STEM: &'static str = "hard";

    fn table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
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
                    super::name(&r.executor),
                    r.pixels.to_string(),
                    r.non_finite.to_string(),
                    optional(r.difference),
                    optional(r.ulps),
                    optional(r.bound),
                    r.kept.to_string(),
                    r.born.clone().unwrap_or_default(),
                    r.refused.clone().unwrap_or_default(),
                ]
            })
        });
        (head, rows.collect())
    }
}
