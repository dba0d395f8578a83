//! Record of the search for the cheapest shader of a scene.

use super::{Circumstances, Record, format_megabytes, join_options};
use crate::statistics::Interval;
use crate::tune::Cost;
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Times;
use straightline_kernels::OptionText;
use straightline_table::{Cell, Column, Table, TableBuilder};

/// A variant of the search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// Description of the variant, with each of its values: `16 samples, planes-normals, ...`.
    pub name: String,
    /// Preset that the variant is, or that it differs from by some of its terms.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<String>,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// `f16` or `f32`.
    pub precision: String,
    /// Mathematics policy of the variant: `exact` or `fast`.
    #[serde(default = "exact", skip_serializing_if = "is_exact")]
    pub math: String,
    /// Width and height of the block of one invocation, in pixels.
    pub block: [u32; 2],
    /// Error by the record's metric: dB of PSNR or mean FLIP.
    pub error: f64,
    /// Number of pixels that are not finite.
    pub non_finite: usize,
    /// Texture reads a pixel.
    pub reads: f64,
    /// Statements a pixel.
    pub statements: f64,
    /// Bytes of the G-buffer that the variant reads.
    pub gbuffer_bytes: u64,
    /// Cost predicted by the model, in milliseconds, or in cycles if a compiler is the measure; 0 if there is no model yet.
    #[serde(alias = "predicted_ms")]
    pub predicted: f64,
    /// Measured time, if the variant was timed.
    pub time: Option<Times>,
    /// Cycles of a wave per pixel of its invocations, if a compiler is the measure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycles: Option<f64>,
    /// Speedup over the most general variant, if it was measured.
    pub ratio: Option<Interval>,
    /// `true` if no other variant is both faster and better.
    pub front: bool,
}

fn exact() -> String {
    "exact".to_owned()
}

fn is_exact(math: &str) -> bool {
    math == "exact"
}

/// A term that the chosen shader omits, or that it adds to the most general variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeftOut {
    /// Name of the term: normals, planes, 16 samples, mask, f32, placing.
    pub term: String,
    /// Cost of omitting the term, by the record's metric: dB or mean FLIP; a loss is positive.
    pub cost: f64,
}

/// The most general variant with one of its terms omitted or replaced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TermWorth {
    /// Name of the omitted term.
    pub term: String,
    /// Replacement of the term.
    pub instead: String,
    /// Cost of the replacement in error, by the record's metric; a loss is positive.
    pub cost: f64,
    /// Speedup of the replacement, if that variant was run.
    pub ratio: Option<Interval>,
    /// Index of the variant.
    pub candidate: usize,
}

/// A variant that could not be emitted or run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refused {
    /// The variant, in words.
    pub variant: String,
    /// Reason.
    pub reason: String,
}

/// A model of time, linear in static counts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Model {
    /// Names of the counts, with milliseconds per count and million pixels, or cycles per count and pixel.
    pub terms: Vec<(String, f64)>,
    /// Number of variants in the training set.
    pub learned_from: usize,
    /// Number of variants in the test set, disjoint from the training set.
    pub tested_on: usize,
    /// Mean of |predicted - measured| / measured over the test set.
    pub mean_error: f64,
    /// Maximum of the same.
    pub largest_error: f64,
}

/// Result of tuning a shader to a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TuneRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Measure of cost: `time`, or `isa:` and a GPU whose compiler provides cycles or instructions.
    #[serde(default = "time")]
    pub cost: String,
    /// The GPU that is compiled for, and the compiler's version. Pictures, and therefore errors, still come from the
    /// adapter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compiled_for: Option<String>,
    /// The scene's name, or the capture's path.
    pub scene: String,
    /// `psnr` or `flip`.
    pub metric: String,
    /// The requested budget: permitted loss against the best variant, in dB of PSNR or mean FLIP.
    pub max_error: f64,
    /// The best error of all variants. Without a reference in the capture, the general variant's picture is the reference,
    /// so that variant cannot be judged; the best is then that of the others, at most 48.13 dB.
    pub best: f64,
    /// Reference that variants are compared with: the mean of a number of samples, the capture's reference, or the general
    /// variant.
    pub reference: String,
    /// Error of the picture before the filter, by the metric.
    pub unfiltered: f64,
    /// Options fixed for all variants.
    pub fixed: Vec<OptionText>,
    /// Every variant.
    pub candidates: Vec<Candidate>,
    /// Index of the chosen variant; `None` if none is within the budget.
    pub chosen: Option<usize>,
    /// Index of the most general variant.
    pub general: usize,
    /// Terms that the chosen variant omits.
    pub left_out: Vec<LeftOut>,
    /// Terms that the chosen variant adds to the most general one, and the loss without them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub needed: Vec<LeftOut>,
    /// Worth of each term of the most general variant: that variant without the term.
    pub terms: Vec<TermWorth>,
    /// Variants that could not be emitted or run.
    pub refused: Vec<Refused>,
    /// Parts excluded from the search, with the reasons.
    pub not_searched: Vec<String>,
    /// Model that predicted the times; without terms if the run was interrupted earlier.
    pub model: Model,
}

/// Measure of cost in records that do not state one.
fn time() -> String {
    "time".to_owned()
}

impl TuneRecord {
    /// Returns the unit of cost.
    pub fn unit(&self) -> &'static str {
        self.cost.parse().unwrap_or(Cost::Time).unit()
    }

    /// Returns the best error of variants that do nothing beyond the paper and whose pixels are all finite.
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
        self.cycles.or(self.time.as_ref().map(|time| time.median_ms))
    }

    /// Returns the measured cost, or else the predicted one.
    pub fn best_known_cost(&self) -> f64 {
        self.measured_cost().unwrap_or(self.predicted)
    }

    /// Returns whether the variant places shading, searches, or borrows separated light.
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

    fn to_table(&self) -> Table {
        let rows = 0..self.candidates.len();
        let chosen = |k: &usize| self.chosen == Some(*k);
        self.tabulate(rows.collect(), 2)
            .column(Column::exact("front"), |k| self.candidates[*k].front)
            .column(Column::exact("chosen"), chosen)
            .finish()
    }
}

impl TuneRecord {
    /// Returns a table of some variants, errors with this many decimals.
    fn tabulate(&self, rows: Vec<usize>, decimals: usize) -> TableBuilder<usize> {
        let of = |k: &usize| &self.candidates[*k];
        let unit = self.unit();
        let role = |k: &usize| match (self.chosen == Some(*k), *k == self.general) {
            (true, _) => " ← chosen",
            (_, true) => " ← most general",
            _ => "",
        };
        Table::of(rows)
            .column(Column::shown("variant"), |k| Cell::code(&*of(k).name).suffixed(role(k)))
            .column(Column::exact("options"), |k| join_options(&of(k).options))
            .column(Column::exact("precision"), |k| &of(k).precision)
            .column(Column::exact("math"), |k| &of(k).math)
            .column(Column::exact("block"), |k| {
                format!("{}x{}", of(k).block[0], of(k).block[1])
            })
            .fixed("error", decimals, |k| of(k).error)
            .column(Column::exact("median_ms"), |k| {
                of(k).time.as_ref().map(|t| Cell::fixed(t.median_ms, 2))
            })
            .fixed(Column::exact("cycles"), 2, |k| of(k).cycles)
            .fixed(Column::shown(unit), 2, |k| of(k).measured_cost())
            .column(Column::interval("speedup"), |k| {
                of(k).ratio.map(|r| Cell::interval(r.to_array(), 2))
            })
            .fixed(Column::from("predicted").titled(format!("predicted {unit}")), 2, |k| {
                of(k).predicted
            })
            .fixed("reads", 1, |k| of(k).reads)
            .fixed(Column::exact("statements"), 0, |k| of(k).statements)
            .column(("gbuffer_bytes", "G-buffer MB"), |k| {
                format_megabytes(of(k).gbuffer_bytes, 1)
            })
            .class("chosen", |k| self.chosen == Some(*k))
    }

    /// Returns the table of the front of cost against error, fastest first, and of the most general variant.
    pub fn front_table(&self, decimals: usize) -> Table {
        let mut shown: Vec<usize> = (0..self.candidates.len())
            .filter(|k| self.candidates[*k].front)
            .collect();
        let cost = |k: &usize| self.candidates[*k].best_known_cost();
        shown.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        if self.candidates.get(self.general).is_some_and(|general| !general.front) {
            shown.push(self.general);
        }
        self.tabulate(shown, decimals).finish()
    }

    /// Returns the table of the terms of the most general variant, and of what each is worth.
    pub fn terms_table(&self, loss: impl Fn(f64) -> Cell) -> Table {
        Table::of(&self.terms)
            .column("instead of", |term| &term.term)
            .column(Column::from("with").left(), |term| &term.instead)
            .column("error", |term| loss(term.cost))
            .column(Column::interval("speedup"), |term| {
                term.ratio.map(|r| Cell::interval(r.to_array(), 2))
            })
            .finish()
    }
}
