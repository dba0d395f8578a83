//! Variants that go beyond the paper. All combinations would be eight times as many pictures: only what is promising without is
//! extended, and what is next to the best.

use super::{Entry, Search, index_variants};
use crate::progress::Progress;
use crate::tune::space::Variant;
use crate::tune::{Term, TuneError};
use std::collections::{BTreeMap, BTreeSet};
use straightline_codegen::Precision;

/// Number of times that the neighbours of the best variants so far are looked at.
const LOOKS: usize = 2;

impl Search {
    /// Extends the most general variant, and of every set of samples and metric the one that has the least error without. Whether
    /// all was done.
    pub(super) fn extend_best(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let mut least: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for k in self.usable() {
            let variant = self.entries[k].variant;
            let of = (variant.value_index(Term::Samples), variant.value_index(Term::Metric));
            let best = least.entry(of).or_insert(k);
            if self.loss_or_infinity(k) < self.loss_or_infinity(*best) {
                *best = k;
            }
        }
        let bases = least
            .values()
            .map(|k| self.space.plain_variant(self.entries[*k].variant));
        let bases: BTreeSet<Variant> = bases.chain([self.space.general()]).collect();
        // Without finite tests too, which cost time and, mostly, no picture.
        let tests = 0..self.space.term_values(Term::FiniteTest).len();
        let bases = bases
            .iter()
            .flat_map(|base| tests.clone().map(|test| base.with_value(Term::FiniteTest, test)));
        let wanted: Vec<Variant> = bases.flat_map(|base| self.space.extended_variants(base)).collect();
        self.add(&wanted, progress)
    }

    /// Extends what is next to the best variant, and next to those within the budget that are predicted to be cheapest: of all
    /// variants, and of each preset. Whether all was done.
    pub(in crate::tune) fn refine(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        for _ in 0..LOOKS {
            let known = self.entries.len();
            let usable = self.usable();
            let best = usable
                .iter()
                .min_by(|a, b| self.loss_or_infinity(**a).total_cmp(&self.loss_or_infinity(**b)));
            let presets = self.space.preset_variants();
            // Of no preset: all variants.
            let mut cheapest: BTreeMap<Option<&str>, usize> = BTreeMap::new();
            for k in usable.iter().copied().filter(|k| self.is_within(*k)) {
                let variant = self.entries[k].variant;
                let preset = self.space.preset_name(variant).filter(|_| presets.contains(&variant));
                for of in BTreeSet::from([None, preset]) {
                    let least = cheapest.entry(of).or_insert(k);
                    if self.entries[k].predicted < self.entries[*least].predicted {
                        *least = k;
                    }
                }
            }
            let around = best.into_iter().chain(cheapest.values());
            let wanted: Vec<Variant> = around
                .flat_map(|k| self.space.neighbours(self.entries[*k].variant))
                .collect();
            if !self.add(&wanted, progress)? {
                return Ok(false);
            }
            if self.entries.len() == known {
                break;
            }
        }
        Ok(true)
    }

    /// Adds those of some variants that are not among the first and are not known yet, with their counts, errors and
    /// predictions. Whether all was done.
    pub(in crate::tune) fn add(&mut self, wanted: &[Variant], progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let is_more = |v: &Variant| v.has_preset_options() || self.space.without_extensions(*v) != *v;
        let is_slow = |v: &Variant| self.slow_half.is_some() && self.space.precision(*v) == Precision::F16;
        let is_new = |v: &Variant| is_more(v) && !is_slow(v) && !self.index.contains_key(v);
        let fresh: BTreeSet<Variant> = wanted.iter().copied().filter(is_new).collect();
        if fresh.is_empty() {
            return Ok(true);
        }
        self.entries.extend(fresh.into_iter().map(Entry::new));
        self.index = index_variants(&self.entries);
        if !self.count_variants(progress)? || !self.measure_errors("pictures beyond the paper", progress)? {
            return Ok(false);
        }
        self.predict();
        Ok(true)
    }
}
