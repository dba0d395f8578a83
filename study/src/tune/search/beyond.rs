//! Variants that go beyond the paper. All combinations would be eight times as many pictures: only what is promising without is
//! extended, and what is next to the best.

use super::{Entry, Search, index_variants};
use crate::progress::Progress;
use crate::tune::space::Variant;
use crate::tune::{Term, TuneError};
use std::collections::{BTreeMap, BTreeSet};

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

    /// Extends what is next to the best variant, and to the one within the budget that is predicted to be cheapest. Whether
    /// all was done.
    pub(in crate::tune) fn refine(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        for _ in 0..LOOKS {
            let known = self.entries.len();
            let usable = self.usable();
            let best = usable
                .iter()
                .min_by(|a, b| self.loss_or_infinity(**a).total_cmp(&self.loss_or_infinity(**b)));
            let within = usable.iter().filter(|k| self.is_within(**k));
            let cheapest = within.min_by(|a, b| self.entries[**a].predicted.total_cmp(&self.entries[**b].predicted));
            let around = best.into_iter().chain(cheapest);
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

    /// Adds those of some variants that go beyond the paper and are not known yet, with their counts, errors and
    /// predictions. Whether all was done.
    pub(in crate::tune) fn add(&mut self, wanted: &[Variant], progress: &mut dyn Progress) -> Result<bool, TuneError> {
        let is_new = |v: &Variant| self.space.without_extensions(*v) != *v && !self.index.contains_key(v);
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
