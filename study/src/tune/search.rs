//! Every variant's counts and error, and the time of some.

use super::features::{NAMES, Static};
use super::space::{Offer, SampleSet, Space, Variant};
use super::subject::Subject;
use super::{EQUAL_DB, ErrorMetric, Question, Term, TuneError, model};
use crate::execute::{Bench, Bound, ExecuteError, Inputs, Job, Ratio, Times};
use crate::gbuffer;
use crate::metrics;
use crate::record::Model;
use crate::watch::Watch;
use glam::{UVec2, Vec4};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use straightline_codegen::{Compiled, Kernel, Precision, Stage};
use straightline_kernels::prelude::Frame;
use straightline_runtime::Pass;

/// Variants that times are learned from, and on which the model is then tested; less in a small space.
const LEARNED_FROM: usize = 32;
const TESTED_ON: usize = 12;

/// Rounds in which half precision is compared with whole.
const PROBED: u32 = 3;

/// Statements of an invocation beyond which a block is not searched.
const LONGEST: f64 = 2500.0;

/// PSNR that counts as no difference at all; equal pictures would have an infinite one.
const NO_DIFFERENCE_DB: f64 = 100.0;

/// Bytes of a geometry sample: depth as `r32float`, a normal as `rgba16float`, as `straightline budget` counts.
const DEPTH_BYTES: u64 = 4;
const NORMAL_BYTES: u64 = 8;

/// What a variant of one set of samples reads, on the device.
#[derive(Debug)]
struct Ground {
    bound: Bound,
    /// Uniforms; the images are on the device.
    inputs: Inputs,
    layers: u64,
}

/// A shader with what it reads.
type Ready = (Pass, Bound);

/// Error by the metric, and pixels that are not finite.
type Seen = (f64, usize);

/// A variant and what is known of it.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub variant: Variant,
    pub known: Option<Static>,
    pub error: Option<Seen>,
    /// Why it cannot be emitted or run.
    pub refused: Option<String>,
    /// Milliseconds, by the model.
    pub predicted: f64,
    pub time: Option<Times>,
    pub ratio: Option<Ratio>,
}

/// A search under way.
#[derive(Debug)]
pub struct Search {
    pub(super) bench: Bench,
    pub(super) kernel: Kernel,
    pub(super) defaults: BTreeMap<String, String>,
    pub(super) space: Space,
    pub(super) question: Question,
    pub(super) name: String,
    pub(super) referred_to: String,
    pub(super) size: UVec2,
    pub(super) entries: Vec<Entry>,
    pub(super) index: BTreeMap<Variant, usize>,
    grounds: Vec<Ground>,
    color: Frame<Vec4>,
    finite_colors: bool,
    reference: Option<Frame<Vec4>>,
    /// Errors beyond this are no errors.
    ceiling_db: f64,
    ready: BTreeMap<usize, Ready>,
    pub(super) model: Model,
    /// The most general variant in half precision, where that is slower.
    slow_half: Option<Variant>,
    /// What was measured last, and decides.
    pub(super) finalists: Vec<usize>,
}

impl Search {
    /// Puts onto the device what all variants read.
    ///
    /// # Errors
    ///
    /// If an option is wrong, or the capture lacks what the options need.
    pub fn new(bench: &Bench, subject: Subject, question: &Question) -> Result<Search, TuneError> {
        let kernel = Kernel::builtin("sraa")?;
        let first = subject.captures.first();
        let offer = Offer {
            samples: subject.captures.iter().map(sample_set).collect(),
            normals: first.is_some_and(|capture| capture.normal.is_some()),
            camera: first.is_some_and(|capture| capture.camera.is_some()),
            no_half: question.no_half.clone(),
            fixed: question.fixed.clone(),
        };
        let space = Space::new(&offer).map_err(TuneError::Space)?;
        let size = subject.size();
        let Some(color) = first.map(|capture| capture.color.clone()) else {
            return Err(TuneError::Space("there is no capture to tune for".to_owned()));
        };
        let mut grounds = Vec::new();
        for (place, value) in space.values(Term::Samples).iter().enumerate() {
            // Of the captures, one whose options a value has.
            let own = subject.captures.iter().find(|c| sample_set(c).options == value.options);
            let Some(capture) = own else { continue };
            let richest = space.general().with(Term::Samples, place);
            let compiled = kernel.compile(&space.settings(richest))?;
            let inputs = gbuffer::inputs(capture, &compiled.options)?;
            let (pass, manifest) = bench.pass(&compiled, Stage::Compute)?;
            let bound = bench.bind(&pass, &manifest, &inputs)?;
            grounds.push(Ground {
                bound,
                inputs: Inputs {
                    images: Vec::new(),
                    ..inputs
                },
                layers: capture.layer_count() as u64,
            });
        }
        let entry = |variant| Entry {
            variant,
            known: None,
            error: None,
            refused: None,
            predicted: 0.0,
            time: None,
            ratio: None,
        };
        let entries: Vec<Entry> = space.variants().into_iter().map(entry).collect();
        let defaults = kernel.options()?.into_iter().map(|info| (info.name, info.default));
        Ok(Search {
            bench: bench.clone(),
            defaults: defaults.collect(),
            kernel,
            question: question.clone(),
            name: subject.name,
            referred_to: subject.referred_to,
            size,
            index: entries
                .iter()
                .enumerate()
                .map(|(k, entry)| (entry.variant, k))
                .collect(),
            entries,
            space,
            grounds,
            finite_colors: metrics::non_finite(&color) == 0,
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

    /// Whether the most general variant's picture is there, without which nothing can be said.
    pub fn has_general(&self) -> bool {
        self.entries.first().is_some_and(|entry| entry.error.is_some())
    }

    /// Counts every variant and measures its error. Whether all was done, or the watch stopped it.
    ///
    /// # Errors
    ///
    /// If the most general variant cannot be run.
    pub fn pictures(&mut self, watch: &mut dyn Watch) -> Result<bool, TuneError> {
        if !self.count(watch)? {
            return Ok(false);
        }
        let general = self.prepare(self.space.general())?;
        let picture = self.bench.picture_of(&general.0, &general.1, self.size)?;
        if self.reference.is_none() {
            self.reference = Some(picture);
        }
        if !self.probe_half(watch)? {
            return Ok(false);
        }
        let apart: BTreeSet<Variant> = self.entries.iter().map(|e| self.seen_as(e.variant)).collect();
        let apart: Vec<Variant> = apart.into_iter().collect();
        let mut found: BTreeMap<Variant, Result<(f64, usize), String>> = BTreeMap::new();
        watch.begin("pictures", apart.len());
        let mut finished = true;
        for some in apart.chunks(chunk()) {
            if watch.stopped() {
                finished = false;
                break;
            }
            let judged: Vec<_> = some.par_iter().map(|v| (*v, self.judged(*v))).collect();
            for (variant, result) in judged {
                found.insert(variant, result);
                watch.step();
            }
        }
        for k in 0..self.entries.len() {
            match found.get(&self.seen_as(self.entries[k].variant)) {
                Some(Ok(error)) => self.entries[k].error = Some(*error),
                Some(Err(reason)) => self.entries[k].refused = Some(reason.clone()),
                None => {}
            }
        }
        Ok(finished)
    }

    /// Whether half precision is worth a search here: the most general variant is run in it. Where that is slower, the others
    /// are not run in it. Whether all was done.
    fn probe_half(&mut self, watch: &mut dyn Watch) -> Result<bool, TuneError> {
        let general = self.space.general();
        let mut precisions = 0..self.space.values(Term::Precision).len();
        let half = precisions.find(|k| self.space.values(Term::Precision)[*k].precision == Precision::F16);
        let Some(half) = half
            .map(|k| general.with(Term::Precision, k))
            .filter(|half| *half != general)
        else {
            return Ok(true);
        };
        let Some(index) = self.index.get(&half).copied() else {
            return Ok(true);
        };
        if !self.measure(&[index], PROBED, "half precision", watch)? {
            return Ok(false);
        }
        match self.entries[index].ratio {
            Some(ratio) if ratio.median < 1.0 => {
                self.space.left_aside.push(format!(
                    "half precision, but for the most general variant: it takes {:.1} times as long as f32 here",
                    1.0 / ratio.median
                ));
                let whole = general.at(Term::Precision);
                let kept = |v: Variant| v == half || v.at(Term::Precision) == whole;
                self.entries.retain(|entry| kept(entry.variant));
                self.index = self
                    .entries
                    .iter()
                    .enumerate()
                    .map(|(k, entry)| (entry.variant, k))
                    .collect();
                // The passes go by places that have changed.
                self.ready.clear();
                self.slow_half = Some(half);
            }
            _ => {}
        }
        Ok(true)
    }

    /// Static counts of every variant but blocks that would be too long.
    fn count(&mut self, watch: &mut dyn Watch) -> Result<bool, TuneError> {
        // One graph for both precisions; single pixels before blocks, which are judged by them.
        let mut alike: BTreeMap<Variant, Vec<usize>> = BTreeMap::new();
        for (k, entry) in self.entries.iter().enumerate() {
            alike.entry(entry.variant.with(Term::Precision, 0)).or_default().push(k);
        }
        let mut graphs: Vec<Variant> = alike.keys().copied().collect();
        graphs.sort_by_key(|variant| variant.at(Term::Block));
        watch.begin("counts", graphs.len());
        let mut too_long = 0;
        for some in graphs.chunks(4 * chunk()) {
            if watch.stopped() {
                return Ok(false);
            }
            let counted: Vec<_> = some.par_iter().map(|graph| (*graph, self.counted(*graph))).collect();
            for (graph, counted) in counted {
                let counted = counted?;
                too_long += usize::from(counted.is_none());
                for k in &alike[&graph] {
                    let half = self.space.precision(self.entries[*k].variant) == Precision::F16;
                    self.entries[*k].known = counted.clone().map(|known| if half { known.in_half() } else { known });
                }
                watch.step();
            }
        }
        if too_long > 0 {
            self.space.left_aside.push(format!(
                "blocks of more than {LONGEST} statements, which drivers take long to compile: {too_long} variants in each precision"
            ));
        }
        self.entries.retain(|entry| entry.known.is_some());
        self.index = self
            .entries
            .iter()
            .enumerate()
            .map(|(k, entry)| (entry.variant, k))
            .collect();
        Ok(true)
    }

    /// Counts of a variant; `None` of a block that would be too long.
    fn counted(&self, variant: Variant) -> Result<Option<Static>, TuneError> {
        let [width, height] = self.space.value(variant, Term::Block).block;
        let single = self.index.get(&variant.with(Term::Block, 0));
        let single = single.and_then(|k| self.entries[*k].known.as_ref());
        if let Some(single) = single.filter(|_| width * height > 1)
            && single.statements * f64::from(width * height) > LONGEST
        {
            return Ok(None);
        }
        Ok(Some(Static::of(&self.compile(variant)?)))
    }

    /// Times some variants, learns from them what a count costs, and tests that on others. Whether all was done.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn learn(&mut self, watch: &mut dyn Watch) -> Result<bool, TuneError> {
        let usable = self.usable();
        let rows: Vec<Vec<f64>> = usable.iter().filter_map(|k| self.row(*k)).collect();
        let place: BTreeMap<usize, usize> = usable.iter().enumerate().map(|(place, k)| (*k, place)).collect();
        let general = self.space.general();
        let mut first: Vec<usize> = vec![0];
        first.extend(self.space.of_defaults(&self.defaults).and_then(|v| self.index.get(&v)));
        first.extend(self.space.neighbours(general).iter().filter_map(|v| self.index.get(v)));
        first.retain(|k| place.contains_key(k));
        first.sort_unstable();
        first.dedup();
        let taken: Vec<usize> = first.iter().map(|k| place[k]).collect();
        let wanted = LEARNED_FROM.min(usable.len() * 3 / 4).saturating_sub(taken.len());
        let mut learned = first;
        learned.extend(model::spanning(&rows, &taken, wanted).iter().map(|at| usable[*at]));
        // Any others: spread over the list by a step that visits all of it.
        let others: Vec<usize> = usable.iter().copied().filter(|k| !learned.contains(k)).collect();
        let tested: Vec<usize> = (0..others.len().min(TESTED_ON))
            .map(|k| others[(k * 2 + 1) * others.len() / (2 * others.len().min(TESTED_ON))])
            .collect();
        let both: Vec<usize> = learned.iter().chain(&tested).copied().collect();
        if !self.measure(&both, (self.question.rounds / 2).max(3), "timing, to learn", watch)? {
            return Ok(false);
        }
        let megapixels = self.megapixels();
        // By ratios, round by round, to a shader that ran in every round: a drifting clock is not learned.
        let general = self.entries[0].time.map_or(0.0, |time| time.median_ms) / megapixels;
        let measured = |k: &usize| Some((self.row(*k)?, general / self.entries[*k].ratio?.median));
        let (rows, times): (Vec<_>, Vec<_>) = learned.iter().filter_map(measured).unzip();
        let coefficients = model::learn(&rows, &times);
        let (rows, times): (Vec<_>, Vec<_>) = tested.iter().filter_map(measured).unzip();
        let predicted: Vec<f64> = rows.iter().map(|row| model::predict(&coefficients, row)).collect();
        let (mean_error, largest_error) = model::errors(&predicted, &times);
        self.model = Model {
            terms: NAMES
                .iter()
                .map(|n| (*n).to_owned())
                .zip(coefficients.iter().copied())
                .collect(),
            learned_from: learned.iter().filter(|k| self.entries[**k].time.is_some()).count(),
            tested_on: times.len(),
            mean_error,
            largest_error,
        };
        for k in 0..self.entries.len() {
            if let Some(row) = self.row(k) {
                self.entries[k].predicted = megapixels * model::predict(&coefficients, &row);
            }
        }
        Ok(true)
    }

    /// Times variants in turn with the most general one, each of which also shows its own picture. Whether all was done.
    pub(super) fn measure(
        &mut self,
        which: &[usize],
        rounds: u32,
        what: &str,
        watch: &mut dyn Watch,
    ) -> Result<bool, TuneError> {
        let mut all: Vec<usize> = std::iter::once(0).chain(which.iter().copied()).collect();
        let mut seen = BTreeSet::new();
        all.retain(|k| seen.insert(*k));
        let fresh: Vec<usize> = all.iter().copied().filter(|k| !self.ready.contains_key(k)).collect();
        watch.begin("compiling", fresh.len());
        for some in fresh.chunks(chunk()) {
            if watch.stopped() {
                return Ok(false);
            }
            let prepared: Vec<_> = some
                .par_iter()
                .map(|k| (*k, self.shown(self.entries[*k].variant)))
                .collect();
            for (k, prepared) in prepared {
                match prepared {
                    Ok((ready, error)) => {
                        self.ready.insert(k, ready);
                        self.entries[k].error = Some(error);
                    }
                    Err(reason) => self.entries[k].refused = Some(reason),
                }
                watch.step();
            }
        }
        all.retain(|k| self.ready.contains_key(k));
        let jobs: Vec<Job<'_>> = all
            .iter()
            .map(|k| Job {
                pass: &self.ready[k].0,
                bound: &self.ready[k].1,
                size: self.size,
            })
            .collect();
        watch.begin(what, rounds as usize);
        let mut complete = false;
        let timed = self.bench.timed(&jobs, rounds, |round| {
            if round > 0 {
                watch.step();
            }
            complete = round == rounds;
            !watch.stopped()
        })?;
        for (job, k) in all.iter().enumerate() {
            self.entries[*k].time = timed.times(job);
            self.entries[*k].ratio = timed.ratio(0, job);
        }
        Ok(complete)
    }

    /// Variants that can be run, whose pixels are all finite, and that may be chosen.
    pub(super) fn usable(&self) -> Vec<usize> {
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
    pub(super) fn unfiltered(&self) -> f64 {
        self.reference
            .as_ref()
            .map_or(0.0, |reference| self.error(&self.color, reference))
    }

    /// Bytes of G-buffer that a variant reads.
    pub(super) fn gbuffer_bytes(&self, variant: Variant) -> u64 {
        let sample = match self.space.value(variant, Term::Metric).label.as_str() {
            "normals" => NORMAL_BYTES,
            "depth" => DEPTH_BYTES,
            _ => DEPTH_BYTES + NORMAL_BYTES,
        };
        let layers = self
            .grounds
            .get(variant.at(Term::Samples))
            .map_or(0, |ground| ground.layers);
        sample * layers * u64::from(self.size.x) * u64::from(self.size.y)
    }

    pub(super) fn compile(&self, variant: Variant) -> Result<Compiled, TuneError> {
        Ok(self.kernel.compile(&self.space.settings(variant))?)
    }

    fn row(&self, index: usize) -> Option<Vec<f64>> {
        self.entries[index].known.as_ref().map(|known| known.row.clone())
    }

    pub(super) fn megapixels(&self) -> f64 {
        f64::from(self.size.x) * f64::from(self.size.y) / 1.0e6
    }

    fn error(&self, picture: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
        let error = self.question.metric.error(picture, reference);
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
        let ground = self.grounds.get(variant.at(Term::Samples));
        let ground = ground.ok_or_else(|| ExecuteError::Input("there is no such set of samples".to_owned()))?;
        let precision: Precision = self.space.precision(variant);
        let compiled = self.compile(variant)?;
        let bench = self.bench.clone().precision(precision);
        let (pass, manifest) = bench.pass(&compiled, Stage::Compute)?;
        let bound = bench.bind_shared(&pass, &manifest, &ground.inputs, &ground.bound)?;
        Ok((pass, bound))
    }

    /// A variant ready to run, and its error.
    fn shown(&self, variant: Variant) -> Result<(Ready, Seen), String> {
        let ready = self.prepare(variant).map_err(|error| error.to_string())?;
        let picture = self.bench.picture_of(&ready.0, &ready.1, self.size);
        let picture = picture.map_err(|error| error.to_string())?;
        let error = self
            .reference
            .as_ref()
            .map_or(0.0, |reference| self.error(&picture, reference));
        Ok((ready, (error, metrics::non_finite(&picture))))
    }

    fn judged(&self, variant: Variant) -> Result<Seen, String> {
        self.shown(variant).map(|(_, error)| error)
    }
}

/// Variants that are worked on at once, between looks at the watch.
fn chunk() -> usize {
    2 * rayon::current_num_threads().max(1)
}

fn sample_set(capture: &crate::capture::Capture) -> SampleSet {
    SampleSet {
        count: capture.samples.len(),
        options: gbuffer::sampled_at(capture),
    }
}
