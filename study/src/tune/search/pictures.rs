//! Pictures of variants, and their errors.

use super::{Entry, Ready, Search, Seen, chunk_size};
use crate::progress::Progress;
use crate::tune::space::Variant;
use crate::tune::{Term, TuneError};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use straightline_codegen::Precision;
use straightline_oracle::metrics;

/// Rounds in which half precision is compared with whole.
const PROBED: u32 = 3;

impl Search {
    /// Counts every variant and measures its error. Whether all was done, or the progress stopped it.
    ///
    /// # Errors
    ///
    /// If the most general variant cannot be run.
    pub fn measure_pictures(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        if !self.count_variants(progress)? {
            return Ok(false);
        }
        let general = self.prepare(self.space.general())?;
        let picture = self.bench.picture_of(&general.0, &general.1, self.size)?;
        if self.reference.is_none() {
            self.reference = Some(picture);
        }
        if !self.probe_half(progress)? {
            return Ok(false);
        }
        Ok(self.measure_errors("pictures", progress)? && self.extend_best(progress)?)
    }

    /// Measures the errors of all variants that have none yet. Whether all was done.
    pub(super) fn measure_errors(&mut self, what: &str, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let is_open = |entry: &&Entry| entry.error.is_none() && entry.refused.is_none();
        let mut apart: BTreeSet<Variant> = self
            .entries
            .iter()
            .filter(is_open)
            .map(|e| self.seen_as(e.variant))
            .collect();
        let mut found: BTreeMap<Variant, Result<Seen, String>> = BTreeMap::new();
        // Variants whose error is known are not drawn again.
        apart.retain(|variant| {
            let known = self.index.get(variant).and_then(|k| self.entries[*k].error);
            found.extend(known.map(|error| (*variant, Ok(error))));
            known.is_none()
        });
        let mut apart: Vec<Variant> = apart.into_iter().collect();
        // First the variant without which nothing is known, then the presets.
        let (general, presets) = (self.space.general(), self.space.preset_variants());
        apart.sort_by_key(|v| (*v != general, !presets.contains(v)));
        progress.begin(what, apart.len());
        let mut finished = true;
        for some in apart.chunks(chunk_size()) {
            if progress.is_stopped() {
                finished = false;
                break;
            }
            let judged: Vec<_> = some.par_iter().map(|v| (*v, self.variant_error(*v))).collect();
            for (variant, result) in judged {
                found.insert(variant, result);
                progress.step();
            }
        }
        for k in 0..self.entries.len() {
            let (entry, seen) = (&self.entries[k], self.seen_as(self.entries[k].variant));
            if !is_open(&entry) {
                continue;
            }
            match found.get(&seen) {
                Some(Ok(error)) => self.entries[k].error = Some(*error),
                Some(Err(reason)) => self.entries[k].refused = Some(reason.clone()),
                None => {}
            }
        }
        Ok(finished)
    }

    /// Tests whether half precision is worth a search here: runs the most general variant in it. Where that is slower, the
    /// others are not run in it. Returns whether all was done.
    fn probe_half(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let general = self.space.general();
        let mut precisions = 0..self.space.term_values(Term::Precision).len();
        let half = precisions.find(|k| self.space.term_values(Term::Precision)[*k].precision == Precision::F16);
        let Some(half) = half
            .map(|k| general.with_value(Term::Precision, k))
            .filter(|half| *half != general)
        else {
            return Ok(true);
        };
        let Some(index) = self.index.get(&half).copied() else {
            return Ok(true);
        };
        if !self.measure_variants(&[index], PROBED, "half precision", progress)? {
            return Ok(false);
        }
        match self.entries[index].ratio {
            Some(ratio) if ratio.median < 1.0 => {
                self.space.left_aside.push(format!(
                    "half precision, but for the most general variant: it takes {:.1} times as long as f32 here",
                    1.0 / ratio.median
                ));
                let whole = general.value_index(Term::Precision);
                let kept = |v: Variant| v == half || v.value_index(Term::Precision) == whole;
                self.retain_entries(|entry| kept(entry.variant));
                self.slow_half = Some(half);
            }
            _ => {}
        }
        Ok(true)
    }

    /// A variant ready to run, and its error.
    pub(super) fn run_variant(&self, variant: Variant) -> Result<(Ready, Seen), String> {
        let ready = self.prepare(variant).map_err(|error| error.to_string())?;
        let picture = self.bench.picture_of(&ready.0, &ready.1, self.size);
        let picture = picture.map_err(|error| error.to_string())?;
        let error = self
            .reference
            .as_ref()
            .map_or(0.0, |reference| self.capped_error(&picture, reference));
        Ok((ready, (error, metrics::non_finite(&picture))))
    }

    fn variant_error(&self, variant: Variant) -> Result<Seen, String> {
        self.run_variant(variant).map(|(_, error)| error)
    }
}
