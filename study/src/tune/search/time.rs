//! Costs of variants: measured of some, predicted of all.

use super::{Search, chunk_size};
use crate::progress::Progress;
use crate::record::Model;
use crate::statistics::Interval;
use crate::tune::features::NAMES;
use crate::tune::{Gauge, TuneError, model};
use crate::turns::run_in_turn;
use rayon::prelude::*;
use std::collections::BTreeSet;
use straightline_bench::execute::{Job, Work};

/// Variants that times are learned from, and on which the model is then tested; less in a small space.
const LEARNED_FROM: usize = 32;
const TESTED_ON: usize = 12;

impl Search {
    /// Measures some variants, learns from them what a count costs, and tests that on others. Whether all was done.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn learn_model(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let usable = self.usable();
        let rows: Vec<Vec<f64>> = usable.iter().filter_map(|k| self.feature_row(*k)).collect();
        let general = self.space.general();
        let mut first: Vec<usize> = vec![0];
        first.extend(self.space.preset_variants().iter().filter_map(|v| self.index.get(v)));
        first.extend(self.space.neighbours(general).iter().filter_map(|v| self.index.get(v)));
        first.retain(|k| usable.contains(k));
        first.sort_unstable();
        first.dedup();
        let wanted = LEARNED_FROM.min(usable.len() * 3 / 4);
        // First among those of the paper's terms, which the larger counts of the others would leave few places.
        let is_bare = |at: usize| {
            let variant = self.entries[usable[at]].variant;
            self.space.without_extensions(variant) == variant
        };
        let bare: Vec<usize> = (0..usable.len()).filter(|at| is_bare(*at)).collect();
        let mut learned = first;
        for (among, wanted) in [(bare, wanted * 2 / 3), ((0..usable.len()).collect(), wanted)] {
            let rows: Vec<Vec<f64>> = among.iter().map(|at| rows[*at].clone()).collect();
            let taken = among
                .iter()
                .enumerate()
                .filter(|(_, at)| learned.contains(&usable[**at]));
            let taken: Vec<usize> = taken.map(|(k, _)| k).collect();
            let missing = wanted.saturating_sub(learned.len());
            let more = model::choose_spanning(&rows, &taken, missing);
            learned.extend(more.iter().map(|k| usable[among[*k]]));
        }
        // Any others: spread over the list by a step that visits all of it.
        let others: Vec<usize> = usable.iter().copied().filter(|k| !learned.contains(k)).collect();
        let tested: Vec<usize> = (0..others.len().min(TESTED_ON))
            .map(|k| others[(k * 2 + 1) * others.len() / (2 * others.len().min(TESTED_ON))])
            .collect();
        let both: Vec<usize> = learned.iter().chain(&tested).copied().collect();
        if !self.measure_variants(&both, self.fewer_rounds(), "measuring, to learn", progress)? {
            return Ok(false);
        }
        let size = self.model_scale();
        // By ratios, round by round, to a shader that ran in every round: a drifting clock is not learned.
        let general = &self.entries[0];
        let general = general
            .cycles
            .or(general.time.as_ref().map(|time| time.median_ms))
            .unwrap_or(0.0)
            / size;
        let measured = |k: &usize| Some((self.feature_row(*k)?, general / self.entries[*k].ratio?.median));
        let (rows, times): (Vec<_>, Vec<_>) = learned.iter().filter_map(measured).unzip();
        let coefficients = model::fit_coefficients(&rows, &times);
        let (rows, times): (Vec<_>, Vec<_>) = tested.iter().filter_map(measured).unzip();
        let predicted: Vec<f64> = rows.iter().map(|row| model::predict_cost(&coefficients, row)).collect();
        let (mean_error, largest_error) = model::relative_errors(&predicted, &times);
        self.model = Model {
            terms: NAMES
                .iter()
                .map(|n| (*n).to_owned())
                .zip(coefficients.iter().copied())
                .collect(),
            learned_from: learned.iter().filter(|k| self.entries[**k].ratio.is_some()).count(),
            tested_on: times.len(),
            mean_error,
            largest_error,
        };
        self.predict();
        Ok(true)
    }

    /// Says of all variants what they take by the model, if there is one.
    pub(super) fn predict(&mut self) {
        let coefficients: Vec<f64> = self.model.terms.iter().map(|(_, coefficient)| *coefficient).collect();
        let size = self.model_scale();
        for k in 0..self.entries.len() {
            if let Some(row) = self.feature_row(k) {
                self.entries[k].predicted = size * model::predict_cost(&coefficients, &row);
            }
        }
    }

    /// Returns the factor of the model's figures: milliseconds grow with the picture, cycles are those of a pixel.
    fn model_scale(&self) -> f64 {
        self.entries[0].cycles.map_or(self.megapixels(), |_| 1.0)
    }

    /// Measures variants, and the most general one with them: their times in turn, or cycles. Each also shows its own picture.
    /// Whether all was done.
    pub(in crate::tune) fn measure_variants(
        &mut self,
        which: &[usize],
        rounds: u32,
        what: &str,
        progress: &mut dyn Progress,
    ) -> Result<bool, TuneError> {
        let mut all: Vec<usize> = std::iter::once(0).chain(which.iter().copied()).collect();
        let mut seen = BTreeSet::new();
        all.retain(|k| seen.insert(*k));
        let fresh: Vec<usize> = all.iter().copied().filter(|k| !self.ready.contains_key(k)).collect();
        progress.begin("compiling", fresh.len());
        for some in fresh.chunks(chunk_size()) {
            if progress.is_stopped() {
                return Ok(false);
            }
            let prepared: Vec<_> = some
                .par_iter()
                .map(|k| (*k, self.run_variant(self.entries[*k].variant)))
                .collect();
            for (k, prepared) in prepared {
                match prepared {
                    Ok((ready, error)) => {
                        self.ready.insert(k, ready);
                        self.entries[k].error = Some(error);
                    }
                    Err(reason) => self.entries[k].refused = Some(reason),
                }
                progress.step();
            }
        }
        all.retain(|k| self.ready.contains_key(k));
        if matches!(self.gauge, Gauge::Compiler(_)) {
            return self.measure_cycles(&all, what, progress);
        }
        let work = |k: &usize| {
            let (pass, uploaded) = &self.ready[k];
            let job = |pass, uploaded| Job {
                pass,
                uploaded,
                size: self.size,
            };
            let place = self.placing_for(self.entries[*k].variant);
            let mut jobs: Vec<Job<'_>> = place.iter().map(|place| job(&place.pass, &place.reads)).collect();
            jobs.push(job(pass, uploaded));
            self.bench.sequence_work(&jobs)
        };
        let mut works: Vec<Work<'_>> = all.iter().map(work).collect::<Result<_, _>>()?;
        progress.begin(what, rounds as usize);
        let timed = run_in_turn(&self.bench, &mut works, rounds, progress)?;
        let complete = timed.rounds.iter().all(|times| times.len() as u32 >= rounds);
        for (job, k) in all.iter().enumerate() {
            self.entries[*k].time = timed.times(job);
            let base = self.entries[all[0]].time.as_ref();
            let both = base.zip(self.entries[*k].time.as_ref());
            let ratio = both.and_then(|(base, own)| Interval::of_ratio(&base.rounds_ms, &own.rounds_ms));
            self.entries[*k].ratio = ratio;
        }
        Ok(complete)
    }

    /// Rounds where nothing is decided yet.
    pub(in crate::tune) fn fewer_rounds(&self) -> u32 {
        (self.question.rounds / 3).max(3)
    }

    fn feature_row(&self, index: usize) -> Option<Vec<f64>> {
        self.entries[index].known.as_ref().map(|known| known.row.clone())
    }
}
