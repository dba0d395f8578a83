//! From what is known of all variants: which to measure, which to choose, and what to write down.

use super::front::pareto_front;
use super::search::{Entry, Search};
use super::{Chosen, Term, TuneError, Variant};
use crate::builtin::spell_settings;
use crate::progress::Progress;
use crate::record::{Candidate, Circumstances, LeftOut, Refused, TermWorth, TuneRecord};
use crate::statistics::Interval;
use std::collections::BTreeMap;
use straightline_manifest::Tuned;

/// Variants of the predicted front that are measured; a longer one is thinned out evenly.
const OF_THE_FRONT: usize = 14;

/// Variants within the budget that are measured, the ones predicted to be fastest.
const OF_THE_FASTEST: usize = 10;

/// Greatest ratio of predicted times to the predicted winner's at which a neighbour is measured.
const NEAR: f64 = 1.3;

/// Variants within the budget that are measured in all rounds, the fastest in few.
const CONTENDERS: usize = 6;

/// Share of the best ratio from which a variant may count as just as fast, if its spread reaches the best.
const AS_FAST: f64 = 0.9;

/// Decisions at most: what the chosen variant is then compared with may be better than the best that was known.
const DECISIONS: usize = 3;

impl Search {
    /// Measures what may be chosen, and chooses. `None` if the progress stops it before.
    ///
    /// # Errors
    ///
    /// If the device fails, or no variant is within the budget.
    pub fn measure_and_choose(&mut self, progress: &mut dyn Progress) -> Result<Option<usize>, TuneError> {
        if !self.refine(progress)? {
            return Ok(None);
        }
        for _ in 0..DECISIONS {
            if !self.measure_front(progress)? {
                return Ok(None);
            }
            let chosen = self.choose_fastest()?;
            let variant = self.entries[chosen].variant;
            let mut compared: Vec<Variant> = self.space.left_out(variant).into_iter().map(|(_, with)| with).collect();
            for added in self.space.addable_terms(variant) {
                compared.extend([added.without, added.with]);
            }
            if !self.add(&compared, progress)? {
                return Ok(None);
            }
            if self.is_within(chosen) {
                return Ok(Some(chosen));
            }
        }
        self.choose_fastest().map(Some)
    }

    /// Measures the predicted front, the variants within the budget that are predicted to be fastest, and what is next to
    /// them. Whether all was done.
    ///
    /// # Errors
    ///
    /// If the device fails.
    fn measure_front(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let usable = self.usable();
        let points: Vec<(f64, f64)> = usable
            .iter()
            .map(|k| (self.entries[*k].predicted, self.loss(*k).unwrap_or(f64::INFINITY)))
            .collect();
        let on = pareto_front(&points);
        let mut on_front: Vec<usize> = usable.iter().zip(&on).filter(|(_, on)| **on).map(|(k, _)| *k).collect();
        on_front.sort_by(|a, b| self.entries[*a].predicted.total_cmp(&self.entries[*b].predicted));
        let count = on_front.len().min(OF_THE_FRONT);
        let thinned = (0..count).map(|k| on_front[k * (on_front.len() - 1) / (count - 1).max(1)]);
        let mut within: Vec<usize> = usable.iter().copied().filter(|k| self.is_within(*k)).collect();
        within.sort_by(|a, b| self.entries[*a].predicted.total_cmp(&self.entries[*b].predicted));
        let mut which: Vec<usize> = thinned.collect();
        which.extend(within.iter().take(OF_THE_FASTEST));
        // The best of all keeps every budget.
        which.extend(
            usable
                .iter()
                .copied()
                .min_by(|a, b| self.loss_or_infinity(*a).total_cmp(&self.loss_or_infinity(*b))),
        );
        if let Some(winner) = within.first() {
            let limit = NEAR * self.entries[*winner].predicted;
            let near = self.space.neighbours(self.entries[*winner].variant);
            let near = near.iter().filter_map(|v| self.index.get(v)).copied();
            which.extend(near.filter(|k| self.is_within(*k) && self.entries[*k].predicted <= limit));
        }
        which.retain(|k| usable.contains(k));
        if !self.measure_variants(&which, self.fewer_rounds(), "measuring the front", progress)? {
            return Ok(false);
        }
        // The fastest within the budget are measured again, and longer.
        which.retain(|k| self.is_within(*k));
        let speed = |k: &usize| self.entries[*k].ratio.map_or(0.0, |ratio| ratio.median);
        which.sort_by(|a, b| speed(b).total_cmp(&speed(a)).then(a.cmp(b)));
        which.dedup();
        which.truncate(CONTENDERS);
        self.finalists = which.clone();
        self.finalists.push(0);
        self.measure_variants(&which, self.question.rounds, "measuring, to decide", progress)
    }

    /// Returns the fastest variant within the budget among the last measured ones; of variants that are not measurably
    /// slower, the one that reads the fewest bytes of G-buffer.
    ///
    /// # Errors
    ///
    /// [`TuneError::NothingWithin`], with the closest variant.
    fn choose_fastest(&self) -> Result<usize, TuneError> {
        let within = self.finalists.iter().copied().filter(|k| self.is_within(*k));
        let measured: Vec<(usize, Interval)> = within.filter_map(|k| Some((k, self.entries[k].ratio?))).collect();
        let fastest = measured.iter().map(|(_, ratio)| ratio.median).fold(0.0, f64::max);
        let as_fast = measured
            .iter()
            .filter(|(_, ratio)| ratio.median >= AS_FAST * fastest && ratio.high >= fastest);
        let bytes = |k: usize| self.gbuffer_bytes(self.entries[k].variant);
        let cheapest = as_fast.min_by(|(a, one), (b, other)| {
            let by_time = other.median.total_cmp(&one.median);
            bytes(*a).cmp(&bytes(*b)).then(by_time).then(a.cmp(b))
        });
        cheapest.map(|(k, _)| *k).ok_or_else(|| self.nothing_within())
    }

    fn nothing_within(&self) -> TuneError {
        let metric = self.question.metric;
        let spoilt = |e: &&Entry| matches!(e.error, Some((_, bad)) if bad > 0);
        let reason = match self.entries.iter().filter(spoilt).count() {
            0 => "none that was measured keeps it".to_owned(),
            count => format!("{count} of them give pixels that are not finite"),
        };
        let judged = self.entries.iter().filter(|e| e.refused.is_none());
        let judged = judged.filter_map(|e| Some((e, e.error?)));
        let key = |(error, bad): (f64, usize)| (bad, metric.loss(0.0, error));
        let closest = judged.min_by(|a, b| {
            let (a, b) = (key(a.1), key(b.1));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        TuneError::NothingWithin {
            variants: self.entries.len(),
            max_error: self.question.max_error,
            metric,
            reason,
            closest: closest.map_or("none at all".to_owned(), |(entry, (error, bad))| {
                let name = self.space.variant_name(entry.variant);
                format!(
                    "{name}: {}, {bad} pixels that are not finite",
                    metric.format_error(error)
                )
            }),
        }
    }

    /// The best error of all variants whose pixels are finite.
    pub(super) fn best_error(&self) -> f64 {
        let metric = self.question.metric;
        let finite = self.entries.iter().filter(|e| e.refused.is_none());
        let errors = finite.filter_map(|e| e.error).filter(|(_, bad)| *bad == 0);
        let best = errors
            .map(|(error, _)| error)
            .min_by(|a, b| metric.loss(0.0, *a).total_cmp(&metric.loss(0.0, *b)));
        best.or(self.entries.first().and_then(|e| e.error).map(|(error, _)| error))
            .unwrap_or(0.0)
    }

    fn loss(&self, index: usize) -> Option<f64> {
        let (error, _) = self.entries[index].error?;
        Some(self.question.metric.loss(self.best_error(), error))
    }

    pub(super) fn loss_or_infinity(&self, index: usize) -> f64 {
        self.loss(index).unwrap_or(f64::INFINITY)
    }

    pub(super) fn is_within(&self, index: usize) -> bool {
        let entry = &self.entries[index];
        entry.refused.is_none()
            && matches!(entry.error, Some((_, 0)))
            && self.loss(index).is_some_and(|loss| loss <= self.question.max_error)
    }

    /// Returns the loss of `without` against `with`. A block that was too long to be searched has the picture of single pixels.
    fn loss_without(&self, without: Variant, with: Variant) -> Option<f64> {
        let error = |v: Variant| {
            let index = self
                .index
                .get(&v)
                .or_else(|| self.index.get(&v.with_value(Term::Block, 0)))?;
            self.entries[*index].error.map(|(error, _)| error)
        };
        Some(self.question.metric.loss(error(with)?, error(without)?))
    }

    /// Everything that was measured.
    pub fn to_record(&self, circumstances: Circumstances, chosen: Option<usize>) -> TuneRecord {
        let seen: Vec<usize> = (0..self.entries.len())
            .filter(|k| self.entries[*k].error.is_some())
            .collect();
        let place: BTreeMap<usize, usize> = seen.iter().enumerate().map(|(place, k)| (*k, place)).collect();
        let timed: Vec<usize> = seen
            .iter()
            .copied()
            .filter(|k| self.entries[*k].ratio.is_some())
            .collect();
        let usable = self.usable();
        let timed: Vec<usize> = timed.into_iter().filter(|k| usable.contains(k)).collect();
        let points: Vec<(f64, f64)> = timed
            .iter()
            .map(|k| {
                (
                    self.entries[*k].ratio.map_or(f64::INFINITY, |r| 1.0 / r.median),
                    self.loss_or_infinity(*k),
                )
            })
            .collect();
        let on: Vec<usize> = timed
            .iter()
            .zip(pareto_front(&points))
            .filter(|(_, on)| *on)
            .map(|(k, _)| *k)
            .collect();
        let candidate = |k: &usize| {
            let mut candidate = self.to_candidate(&self.entries[*k]);
            candidate.front = on.contains(k);
            candidate
        };
        let refused = self.entries.iter().filter_map(|e| {
            Some(Refused {
                variant: self.space.variant_name(e.variant),
                reason: e.refused.clone()?,
            })
        });
        TuneRecord {
            circumstances,
            cost: self.gauge.cost().to_string(),
            compiled_for: self.gauge.compiled_for().map(str::to_owned),
            scene: self.name.clone(),
            metric: self.question.metric.name().to_owned(),
            max_error: self.question.max_error,
            best: self.best_error(),
            reference: self.referred_to.clone(),
            unfiltered: self.unfiltered_error(),
            fixed: spell_settings(&self.space.fixed),
            candidates: seen.iter().map(candidate).collect(),
            chosen: chosen.and_then(|k| place.get(&k).copied()),
            general: place.get(&0).copied().unwrap_or(0),
            left_out: chosen.map_or(Vec::new(), |k| self.left_out(self.entries[k].variant)),
            needed: chosen.map_or(Vec::new(), |k| self.added_terms(self.entries[k].variant, true)),
            terms: self.term_worths(&place),
            refused: refused.collect(),
            not_searched: self.space.left_aside.clone(),
            model: self.model.clone(),
        }
    }

    fn to_candidate(&self, entry: &Entry) -> Candidate {
        let settings = self.space.variant_settings(entry.variant);
        let mut options = self.space.variant_options(entry.variant);
        options.retain(|(name, value)| self.defaults.get(name) != Some(value));
        let (error, non_finite) = entry.error.unwrap_or_default();
        Candidate {
            name: self.space.variant_name(entry.variant),
            preset: self.space.preset_name(entry.variant).map(str::to_owned),
            options: spell_settings(&options),
            precision: self.space.precision(entry.variant).to_string(),
            math: settings.math.to_string(),
            block: settings.block,
            error,
            non_finite,
            reads: entry.known.as_ref().map_or(0.0, |known| known.reads),
            statements: entry.known.as_ref().map_or(0.0, |known| known.statements),
            gbuffer_bytes: self.gbuffer_bytes(entry.variant),
            predicted: entry.predicted,
            time: entry.time.clone(),
            cycles: entry.cycles,
            ratio: entry.ratio,
            front: false,
        }
    }

    /// Terms that the chosen variant does without, and the gain of putting each back.
    fn left_out(&self, chosen: Variant) -> Vec<LeftOut> {
        let all = self.space.left_out(chosen).into_iter();
        let left_out = all.filter_map(|(term, with)| {
            Some(LeftOut {
                term,
                cost: self.loss_without(chosen, with)?,
            })
        });
        left_out.chain(self.added_terms(chosen, false)).collect()
    }

    /// Terms that a variant has, or has not, beyond the most general one, and the gain of each.
    fn added_terms(&self, variant: Variant, is_there: bool) -> Vec<LeftOut> {
        let all = self.space.addable_terms(variant).into_iter();
        let all = all.filter(|added| added.is_there == is_there);
        all.filter_map(|added| {
            Some(LeftOut {
                cost: self.loss_without(added.without, added.with)?,
                term: added.term,
            })
        })
        .collect()
    }

    /// The most general variant with each of its terms replaced.
    fn term_worths(&self, place: &BTreeMap<usize, usize>) -> Vec<TermWorth> {
        let general = self.space.general();
        let worth = |variant: Variant| {
            let index = self.index.get(&variant)?;
            let term = Term::ALL.into_iter().find(|term| variant.value_index(*term) != 0)?;
            Some(TermWorth {
                term: self.space.variant_value(general, term).label.clone(),
                instead: self.space.variant_value(variant, term).label.clone(),
                cost: self.loss_without(variant, general)?,
                ratio: self.entries[*index].ratio,
                candidate: *place.get(index)?,
            })
        };
        self.space.neighbours(general).into_iter().filter_map(worth).collect()
    }

    /// A variant as it can be emitted, with what its manifest is to say.
    ///
    /// # Errors
    ///
    /// If it cannot be compiled, which it could be before.
    pub fn build_chosen(&self, index: usize, record: &TuneRecord) -> Result<Chosen, TuneError> {
        let entry = &self.entries[index];
        let error = |entry: &Entry| entry.error.map_or(0.0, |(error, _)| error);
        let said = |all: &[LeftOut]| {
            let of = |out: &LeftOut| straightline_manifest::LeftOut {
                term: out.term.clone(),
                cost: out.cost,
            };
            all.iter().map(of).collect()
        };
        Ok(Chosen {
            compiled: self.compile(entry.variant)?,
            place: self.placing_for(entry.variant).map(|placing| placing.compiled.clone()),
            precision: self.space.precision(entry.variant),
            tuned: Tuned {
                scene: record.scene.clone(),
                size: self.size.to_array(),
                metric: record.metric.clone(),
                max_error: record.max_error,
                best: record.best,
                error: error(entry),
                general: error(&self.entries[0]),
                adapter: match &record.compiled_for {
                    Some(gpu) => format!("{gpu}, by its compiler's {}, not run", record.unit()),
                    None => record.circumstances.adapter.clone(),
                },
                speedup: entry.ratio.map_or(1.0, |ratio| ratio.median),
                left_out: said(&record.left_out),
                needed: said(&record.needed),
            },
        })
    }
}
