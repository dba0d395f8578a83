//! The cheapest filter that a scene needs: which terms of SRAA can be left out, what each is worth, and the variant that is
//! fastest within a budget of error.
//!
//! Every variant's error is measured by its picture; its cost, which is time or a compiler's cycles ([`Cost`]), is measured
//! for some, and predicted for all by a model that is learned from those ([`model`]). What the model finds best is then
//! measured, and chosen by that alone.

mod choose;
mod cost;
mod features;
pub mod front;
pub mod model;
mod search;
mod space;
mod steps;
mod subject;

use crate::progress::Progress;
use crate::record::{Circumstances, TuneRecord};
use glam::Vec4;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;
use straightline_bench::execute::{Bench, ExecuteError};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::{Compiled, Precision};
use straightline_isa::IsaError;
use straightline_kernels::OptionText;
use straightline_kernels::prelude::Frame;
use straightline_manifest::Tuned;
use straightline_oracle::metrics;
use straightline_scene::gbuffer::GBufferError;
use straightline_scene::render::RenderError;

pub use cost::{Cost, Gauge};
pub use features::{NAMES as COUNTS, Static};
pub use search::Search;
pub use space::{Added, Offer, Preset, SampleSet, Space, Term, Value, Variant};
pub use subject::{Beyond, PATTERNS, Subject};

/// PSNR of pictures whose red, green and blue are off by one step of 8 bits, root mean square: as good as equal.
pub const EQUAL_DB: f64 = 48.130_803_608_679_1;

/// Metric of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ErrorMetric {
    /// Peak signal-to-noise ratio in dB: more is better.
    Psnr,
    /// Mean of LDR-FLIP, 0 to 1: less is better.
    Flip,
}

impl ErrorMetric {
    /// Every metric.
    pub const ALL: [ErrorMetric; 2] = [ErrorMetric::Psnr, ErrorMetric::Flip];

    /// As on the command line and in records.
    pub fn name(self) -> &'static str {
        match self {
            ErrorMetric::Psnr => "psnr",
            ErrorMetric::Flip => "flip",
        }
    }

    /// Compares a picture with a reference.
    pub fn measure_error(self, test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
        match self {
            ErrorMetric::Psnr => metrics::psnr(test, reference),
            ErrorMetric::Flip => metrics::flip(test, reference),
        }
    }

    /// Returns by how much `error` is worse than `best`; negative if it is better.
    pub fn loss(self, best: f64, error: f64) -> f64 {
        match self {
            ErrorMetric::Psnr => best - error,
            ErrorMetric::Flip => error - best,
        }
    }

    /// Returns the decimals with which errors are shown.
    pub fn decimals(self) -> usize {
        match self {
            ErrorMetric::Psnr => 2,
            ErrorMetric::Flip => 4,
        }
    }

    /// An error as it is printed, with its unit.
    pub fn format_error(self, error: f64) -> String {
        match self {
            ErrorMetric::Psnr => format!("{error:.2} dB"),
            ErrorMetric::Flip => format!("{error:.4}"),
        }
    }
}

impl fmt::Display for ErrorMetric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for ErrorMetric {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = ErrorMetric::ALL.map(ErrorMetric::name);
        ErrorMetric::ALL
            .into_iter()
            .find(|metric| metric.name() == text)
            .ok_or_else(|| format!("there is no metric `{text}`; use {}", known.join(" or ")))
    }
}

/// Request of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Metric of errors.
    pub metric: ErrorMetric,
    /// Greatest loss of the chosen variant against the best one, by the metric.
    pub max_error: f64,
    /// Rounds of timing of the last, decisive measurement.
    pub rounds: u32,
    /// Why half precision is not to be searched; `None` if it is.
    pub no_half: Option<String>,
    /// Options that all variants have.
    pub fixed: Vec<OptionText>,
}

/// Result of a search.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Everything that was measured.
    pub record: TuneRecord,
    /// The cheapest variant within the budget; `None` if the search was stopped before.
    pub chosen: Option<Chosen>,
}

/// A variant that can be emitted.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// The kernel.
    pub compiled: Compiled,
    /// The kernel `sraa_place`, which runs before it and before shading, if pixels are to be shaded where that says. It
    /// computes in `f32`.
    pub place: Option<Compiled>,
    /// Precision that the shader computes in.
    pub precision: Precision,
    /// For its manifest.
    pub tuned: Tuned,
}

/// Why nothing was tuned.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TuneError {
    /// The scene cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The capture cannot feed the filter.
    #[error(transparent)]
    GBuffer(#[from] GBufferError),
    /// The most general variant cannot be run, or the device failed.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// The compiler that is asked for cycles ended.
    #[error(transparent)]
    Compiler(#[from] IsaError),
    /// An option is wrong.
    #[error("{0}")]
    Kernel(#[from] Errors),
    /// There is nothing to search.
    #[error("{0}")]
    Space(String),
    /// No variant keeps the budget.
    #[error(
        "none of {variants} variants is within {} ({metric}) of the best: {reason}; the one that comes closest is {closest}",
        metric.format_error(*max_error)
    )]
    NothingWithin {
        /// Number of variants tried.
        variants: usize,
        /// The budget.
        max_error: f64,
        /// By which metric.
        metric: ErrorMetric,
        /// Reason that keeps them out.
        reason: String,
        /// The nearest variant, with its figures.
        closest: String,
    },
}

/// Searches the variant within the budget that is the cheapest by `gauge`; errors are those of pictures on the bench's device
/// all the same. `None` if the progress stops it before anything is measured.
///
/// # Errors
///
/// [`TuneError`].
pub fn tune_subject(
    bench: &Bench,
    subject: Subject,
    question: &Question,
    gauge: Gauge,
    circumstances: Circumstances,
    progress: &mut dyn Progress,
) -> Result<Option<Outcome>, TuneError> {
    let mut search = Search::new(bench, subject, question, gauge)?;
    let finished = search.measure_pictures(progress)?;
    if !search.has_general() {
        return Ok(None);
    }
    let chosen = match finished && search.learn_model(progress)? {
        true => search.measure_and_choose(progress)?,
        false => None,
    };
    let circumstances = Circumstances {
        complete: chosen.is_some(),
        ..circumstances
    };
    let record = search.to_record(circumstances, chosen);
    let chosen = chosen.map(|index| search.build_chosen(index, &record)).transpose()?;
    Ok(Some(Outcome { record, chosen }))
}
