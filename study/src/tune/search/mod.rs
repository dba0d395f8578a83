//! A search under way: every variant, what is known of it, and how it is run.

mod beyond;
mod count;
mod cycles;
mod ground;
mod pictures;
mod time;

use super::features::Static;
use super::space::{SampleSet, Space, Variant};
use super::subject::Subject;
use super::{EQUAL_DB, ErrorMetric, Gauge, Question, Term, TuneError};
use crate::builtin::load_builtin;
use crate::record::Model;
use crate::statistics::Interval;
use glam::{UVec2, Vec4};
use ground::{Ground, Placing, build_offer, no_blocks, sample_set};
use std::collections::BTreeMap;
use straightline_bench::execute::{Bench, ExecuteError, Times, Uploaded};
use straightline_codegen::{Compiled, Kernel, Precision, Stage};
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics;
use straightline_runtime::Pass;

/// PSNR that counts as no difference at all; equal pictures would have an infinite one.
const NO_DIFFERENCE_DB: f64 = 100.0;

/// A shader with what it reads.
type Ready = (Pass, Uploaded);

/// Error by the metric, and pixels that are not finite.
type Seen = (f64, usize);

/// A variant and what is known of it.
#[derive(Clone, Debug)]
pub(in crate::tune) struct Entry {
    pub variant: Variant,
    pub known: Option<Static>,
    pub error: Option<Seen>,
    /// Why it cannot be emitted or run.
    pub refused: Option<String>,
    /// Milliseconds, or cycles, by the model.
    pub predicted: f64,
    pub time: Option<Times>,
    /// Cycles of a wave and pixel of its invocations, where a compiler is asked.
    pub cycles: Option<f64>,
    pub ratio: Option<Interval>,
}

impl Entry {
    fn new(variant: Variant) -> Entry {
        Entry {
            variant,
            known: None,
            error: None,
            refused: None,
            predicted: 0.0,
            time: None,
            cycles: None,
            ratio: None,
        }
    }
}

/// A search under way.
#[derive(Debug)]
pub struct Search {
    pub(in crate::tune) bench: Bench,
    pub(in crate::tune) kernel: Kernel,
    pub(in crate::tune) defaults: OptionValues,
    pub(in crate::tune) space: Space,
    pub(in crate::tune) question: Question,
    pub(in crate::tune) gauge: Gauge,
    pub(in crate::tune) name: String,
    pub(in crate::tune) referred_to: String,
    pub(in crate::tune) size: UVec2,
    pub(in crate::tune) entries: Vec<Entry>,
    pub(in crate::tune) index: BTreeMap<Variant, usize>,
    grounds: Vec<Ground>,
    color: Frame<Vec4>,
    finite_colors: bool,
    reference: Option<Frame<Vec4>>,
    /// Errors beyond this are no errors.
    ceiling_db: f64,
    ready: BTreeMap<usize, Ready>,
    pub(in crate::tune) model: Model,
    /// The most general variant in half precision, where that is slower.
    slow_half: Option<Variant>,
    /// Variants that were measured last; they decide.
    pub(in crate::tune) finalists: Vec<usize>,
}

impl Search {
    /// Puts onto the device what all variants read.
    ///
    /// # Errors
    ///
    /// If an option is wrong, or the capture lacks what the options need.
    pub fn new(bench: &Bench, subject: Subject, question: &Question, gauge: Gauge) -> Result<Search, TuneError> {
        let kernel = load_builtin("sraa")?;
        let mut space = Space::new(&build_offer(&kernel, &subject, question)?).map_err(TuneError::Space)?;
        if let Some(why) = no_blocks(&kernel, &space) {
            space.leave_aside(Term::Block, format!("blocks: {why}"));
        }
        let size = subject.size();
        let Some(color) = subject.captures.first().map(|capture| capture.color.clone()) else {
            return Err(TuneError::Space("there is no capture to tune for".to_owned()));
        };
        let mut colors = std::iter::once(&color).chain(subject.placed.iter().map(|placed| &placed.color));
        let finite_colors = colors.all(|color| metrics::non_finite(color) == 0);
        let sets = subject.captures.iter().map(|capture| sample_set(&kernel, capture));
        let sets = sets.collect::<Result<Vec<_>, _>>()?;
        let mut grounds = Vec::new();
        for (place, value) in space.term_values(Term::Samples).iter().enumerate() {
            // Of the captures, one whose options a value has.
            let is_own = |set: &SampleSet| {
                let mut options = set.options.iter().filter(|(name, _)| name != "shading");
                options.all(|option| value.options.contains(option))
            };
            let Some(k) = sets.iter().position(is_own) else {
                continue;
            };
            let may_be_placed = space.term_values(Term::Placing).iter().any(|v| v.beyond);
            let placed = subject.placed.get(k).filter(|_| may_be_placed);
            let view = (&subject.captures[k], placed);
            grounds.push(Ground::new(bench, (&kernel, &space), place, view)?);
        }
        let mut variants = space.base_variants();
        let presets = space.preset_variants().into_iter().filter(|v| !variants.contains(v));
        variants.extend(presets.collect::<Vec<_>>());
        let entries: Vec<Entry> = variants.into_iter().map(Entry::new).collect();
        Ok(Search {
            bench: bench.clone(),
            defaults: kernel.option_values(&[])?,
            kernel,
            question: question.clone(),
            gauge,
            name: subject.name,
            referred_to: subject.referred_to,
            size,
            index: index_variants(&entries),
            entries,
            space,
            grounds,
            finite_colors,
            color,
            ceiling_db: match subject.reference {
                Some(_) => NO_DIFFERENCE_DB,
                None => EQUAL_DB,
            },
            reference: subject.reference,
            ready: BTreeMap::new(),
            model: Model::default(),
            slow_half: None,
            finalists: Vec::new(),
        })
    }

    /// Returns whether the most general variant's picture is there; without it nothing can be said.
    pub fn has_general(&self) -> bool {
        self.entries.first().is_some_and(|entry| entry.error.is_some())
    }

    /// Leaves entries out. Passes are known by their entries' places, and are made anew.
    fn retain_entries(&mut self, kept: impl Fn(&Entry) -> bool) {
        self.entries.retain(kept);
        self.index = index_variants(&self.entries);
        self.ready.clear();
    }

    /// Variants that can be run, whose pixels are all finite, and that may be chosen.
    pub(in crate::tune) fn usable(&self) -> Vec<usize> {
        let usable = |k: &usize| {
            let entry = &self.entries[*k];
            entry.refused.is_none()
                && entry.known.is_some()
                && matches!(entry.error, Some((_, 0)))
                && Some(entry.variant) != self.slow_half
        };
        (0..self.entries.len()).filter(usable).collect()
    }

    /// Error of the picture as it is without any filter.
    pub(in crate::tune) fn unfiltered_error(&self) -> f64 {
        self.reference
            .as_ref()
            .map_or(0.0, |reference| self.capped_error(&self.color, reference))
    }

    /// Bytes of G-buffer that a variant reads.
    pub(in crate::tune) fn gbuffer_bytes(&self, variant: Variant) -> u64 {
        let metric = self.space.variant_value(variant, Term::Metric).label.as_str();
        let (is_placed, is_apart) = (
            self.space.is_placed(variant),
            self.space.variant_value(variant, Term::Light).beyond,
        );
        let bytes = self
            .ground_for(variant)
            .map_or(0, |ground| ground.bytes_per_pixel(metric, is_placed, is_apart));
        bytes * u64::from(self.size.x) * u64::from(self.size.y)
    }

    fn ground_for(&self, variant: Variant) -> Option<&Ground> {
        self.grounds.get(variant.value_index(Term::Samples))
    }

    /// The pass that goes before a variant, if its pixels are shaded where that says.
    pub(in crate::tune) fn placing_for(&self, variant: Variant) -> Option<&Placing> {
        let ground = self.ground_for(variant).filter(|_| self.space.is_placed(variant))?;
        ground.placing.as_ref()
    }

    pub(in crate::tune) fn compile(&self, variant: Variant) -> Result<Compiled, TuneError> {
        Ok(self.kernel.compile(&self.space.variant_settings(variant))?)
    }

    pub(in crate::tune) fn megapixels(&self) -> f64 {
        f64::from(self.size.x) * f64::from(self.size.y) / 1.0e6
    }

    fn capped_error(&self, picture: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
        let error = self.question.metric.measure_error(picture, reference);
        match self.question.metric {
            ErrorMetric::Psnr => error.min(self.ceiling_db),
            ErrorMetric::Flip => error,
        }
    }

    /// The variant whose picture stands for this one's.
    fn seen_as(&self, variant: Variant) -> Variant {
        self.space.picture_of(variant, self.finite_colors)
    }

    fn prepare(&self, variant: Variant) -> Result<Ready, TuneError> {
        let ground = self.ground_for(variant);
        let ground = ground.ok_or_else(|| ExecuteError::Input("there is no such set of samples".to_owned()))?;
        let precision: Precision = self.space.precision(variant);
        let compiled = self.compile(variant)?;
        let bench = self.bench.clone().with_precision(precision);
        let (pass, manifest) = bench.compile_pass(&compiled, Stage::Compute)?;
        let there = self
            .placing_for(variant)
            .map_or(&ground.uploaded, |placing| &placing.uploaded);
        let uploaded = bench.share_inputs(&manifest, &ground.inputs, there)?;
        Ok((pass, uploaded))
    }
}

/// Variants that are worked on at once, between looks at the progress.
fn chunk_size() -> usize {
    2 * rayon::current_num_threads().max(1)
}

/// Maps each variant to the index of its entry.
fn index_variants(entries: &[Entry]) -> BTreeMap<Variant, usize> {
    let places = entries.iter().enumerate();
    places.map(|(k, entry)| (entry.variant, k)).collect()
}
