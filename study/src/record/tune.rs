//! The cheapest shader that a scene needs.

use super::{Circumstances, Record};
use serde::{Deserialize, Serialize};
use straightline_bench::execute::{Ratio, Times};
use straightline_kernels::OptionText;

/// A variant that was tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// The variant in words, each of its values: `16 samples, planes-normals, ...`.
    pub name: String,
    /// Options that are not the default.
    pub options: Vec<OptionText>,
    /// `f16` or `f32`.
    pub precision: String,
    /// Algebra of the variant: `exact` or `fast`.
    #[serde(default = "exact", skip_serializing_if = "is_exact")]
    pub math: String,
    /// Pixels of one invocation.
    pub block: [u32; 2],
    /// Error by the record's metric: dB of PSNR or mean FLIP.
    pub error: f64,
    /// Pixels that are not finite.
    pub non_finite: usize,
    /// Texture reads a pixel.
    pub reads: f64,
    /// Statements a pixel.
    pub statements: f64,
    /// Bytes of G-buffer that it reads.
    pub gbuffer_bytes: u64,
    /// Cost predicted by the model, in milliseconds, or in cycles where a compiler is asked; 0 if there is no model yet.
    #[serde(alias = "predicted_ms")]
    pub predicted: f64,
    /// Measured time, if the variant was timed.
    pub time: Option<Times>,
    /// Cycles of a wave and pixel of its invocations, if a compiler was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycles: Option<f64>,
    /// Speedup over the most general variant, if it was measured.
    pub ratio: Option<Ratio>,
    /// True if no other variant is both faster and better.
    pub front: bool,
}

fn exact() -> String {
    "exact".to_owned()
}

fn is_exact(math: &str) -> bool {
    math == "exact"
}

/// A term that the chosen shader does without, or that it has beyond the most general variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Name of the term: normals, planes, 16 samples, mask, f32, placing.
    pub term: String,
    /// Cost of doing without the term, by the record's metric: dB or mean FLIP, a loss being positive.
    pub cost: f64,
}

/// The most general variant with one of its terms left out or replaced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TermWorth {
    /// Name of the term that is left out.
    pub term: String,
    /// Replacement of the term.
    pub instead: String,
    /// Cost of the replacement in error, by the record's metric, a loss being positive.
    pub cost: f64,
    /// Speedup then, if that variant was run.
    pub ratio: Option<Ratio>,
    /// Index of the variant.
    pub candidate: usize,
}

/// A variant that could not be emitted or run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refused {
    /// The variant, in words.
    pub variant: String,
    /// Why.
    pub reason: String,
}

/// A model of time, linear in static counts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Model {
    /// Counts, and milliseconds for each of them and million pixels, or cycles for each of them and pixel.
    pub terms: Vec<(String, f64)>,
    /// Variants that it was learned from.
    pub learned_from: usize,
    /// Variants that it was tested on, none of them learned from.
    pub tested_on: usize,
    /// Mean of |predicted - measured| / measured over those.
    pub mean_error: f64,
    /// The largest of them.
    pub largest_error: f64,
}

/// Result of tuning a shader to a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TuneRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// By what variants are compared: `time`, or `isa:` and a family of GPUs whose compiler gives cycles.
    #[serde(default = "time")]
    pub cost: String,
    /// The GPU that is compiled for, and the compiler's version. Pictures, and so errors, are of the adapter all the same.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compiled_for: Option<String>,
    /// The scene's name, or the capture's path.
    pub scene: String,
    /// `psnr` or `flip`.
    pub metric: String,
    /// The budget as it was asked for: what may be lost against the best variant, dB of PSNR or mean FLIP.
    pub max_error: f64,
    /// The best error of all variants. Without a reference of the capture's own, the general variant's picture is the
    /// reference, which it cannot be judged by: the best is then that of the others, at most 48.13 dB.
    pub best: f64,
    /// Reference that variants are compared with: the mean of how many samples, the capture's reference, or the general
    /// variant.
    pub reference: String,
    /// Error of the picture before the filter, by the metric.
    pub unfiltered: f64,
    /// Options that are the same for all variants.
    pub fixed: Vec<OptionText>,
    /// Every variant.
    pub candidates: Vec<Candidate>,
    /// Index of the chosen one; `None` if none is within the budget.
    pub chosen: Option<usize>,
    /// Index of the most general one.
    pub general: usize,
    /// Terms that the chosen variant leaves out.
    pub left_out: Vec<LeftOut>,
    /// Terms that the chosen variant has beyond the most general one, and their loss without.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub needed: Vec<LeftOut>,
    /// Worth of each term of the most general variant: that variant without it.
    pub terms: Vec<TermWorth>,
    /// Variants that could not be emitted or run.
    pub refused: Vec<Refused>,
    /// Parts that were not searched, and why.
    pub not_searched: Vec<String>,
    /// Model by which times were predicted; without terms if the run was interrupted before.
    pub model: Model,
}

/// Measure of records from before there was a choice.
fn time() -> String {
    "time".to_owned()
}

impl TuneRecord {
    /// The unit of what variants are compared by.
    pub fn unit(&self) -> &'static str {
        match self.compiled_for {
            Some(_) => "cycles",
            None => "ms",
        }
    }

    /// The best error of variants that do nothing beyond the paper, all of whose pixels are finite.
    pub fn best_of_paper(&self) -> Option<f64> {
        let of_paper = self.candidates.iter().filter(|c| c.non_finite == 0 && !c.goes_beyond());
        let less = self.metric == "flip";
        of_paper
            .map(|c| c.error)
            .reduce(|a, b| if less { a.min(b) } else { a.max(b) })
    }
}

impl Candidate {
    /// Returns the measured cost, in the record's unit, if there is one.
    pub fn measured_cost(&self) -> Option<f64> {
        self.cycles.or(self.time.map(|time| time.median_ms))
    }

    /// Returns whether the variant is placed, searches, or borrows light apart.
    pub fn goes_beyond(&self) -> bool {
        let is_beyond = |(name, value): &OptionText| match name.as_str() {
            "shading" => value == "placed",
            "search" | "demodulate" => value != "none",
            _ => false,
        };
        self.options.iter().any(is_beyond)
    }
}

impl Record for TuneRecord {
    const STEM: &'static str = "tune";

    fn to_table(&self) -> (Vec<&'static str>, Vec<Vec<String>>) {
        let head = vec![
            "options",
            "precision",
            "block",
            "error",
            "reads",
            "statements",
            "gbuffer_bytes",
            "predicted",
            "median_ms",
            "cycles",
            "speedup",
            "front",
            "chosen",
        ];
        let rows = self.candidates.iter().enumerate().map(|(index, c)| {
            let options: Vec<String> = c
                .options
                .iter()
                .map(|(name, value)| format!("{name}={value}"))
                .collect();
            vec![
                options.join(" "),
                c.precision.clone(),
                format!("{}x{}", c.block[0], c.block[1]),
                format!("{:.5}", c.error),
                format!("{:.2}", c.reads),
                format!("{:.2}", c.statements),
                c.gbuffer_bytes.to_string(),
                format!("{:.4}", c.predicted),
                c.time.map_or(String::new(), |t| format!("{:.4}", t.median_ms)),
                c.cycles.map_or(String::new(), |cycles| format!("{cycles:.2}")),
                c.ratio.map_or(String::new(), |r| format!("{:.3}", r.median)),
                c.front.to_string(),
                (self.chosen == Some(index)).to_string(),
            ]
        });
        (head, rows.collect())
    }
}
