//! Static counts of variants.

use super::{Entry, Search, chunk_size};
use crate::progress::Progress;
use crate::tune::features::Static;
use crate::tune::space::Variant;
use crate::tune::{Term, TuneError};
use rayon::prelude::*;
use std::collections::BTreeMap;
use straightline_codegen::Precision;

/// Statements of an invocation beyond which a block is not searched.
const LONGEST: f64 = 2500.0;

impl Search {
    /// Static counts of every variant that has none yet, but of blocks that would be too long.
    pub(super) fn count_variants(&mut self, progress: &mut dyn Progress) -> Result<bool, TuneError> {
        // Both precisions share one graph; single pixels come before blocks, which are judged by them.
        let mut alike: BTreeMap<Variant, Vec<usize>> = BTreeMap::new();
        let unknown = self
            .entries
            .iter()
            .enumerate()
            .filter(|(_, e)| e.known.is_none() && e.refused.is_none());
        for (k, entry) in unknown {
            alike
                .entry(entry.variant.with_value(Term::Precision, 0))
                .or_default()
                .push(k);
        }
        let mut graphs: Vec<Variant> = alike.keys().copied().collect();
        graphs.sort_by_key(|variant| variant.value_index(Term::Block));
        progress.begin("counts", graphs.len());
        let mut too_long = 0;
        for some in graphs.chunks(4 * chunk_size()) {
            if progress.is_stopped() {
                return Ok(false);
            }
            let counted: Vec<_> = some
                .par_iter()
                .map(|graph| (*graph, self.count_variant(*graph)))
                .collect();
            for (graph, counted) in counted {
                let counted = match counted {
                    // Some options of a preset go with no other value of a term.
                    Err(TuneError::Kernel(errors)) if graph.has_preset_options() => {
                        for k in &alike[&graph] {
                            self.entries[*k].refused = Some(errors.first_message().to_owned());
                        }
                        progress.step();
                        continue;
                    }
                    counted => counted?,
                };
                too_long += usize::from(counted.is_none());
                for k in &alike[&graph] {
                    let half = self.space.precision(self.entries[*k].variant) == Precision::F16;
                    self.entries[*k].known = counted.clone().map(|known| if half { known.in_half() } else { known });
                }
                progress.step();
            }
        }
        if too_long > 0 {
            self.space.left_aside.push(format!(
                "blocks of more than {LONGEST} statements, which drivers take long to compile: {too_long} variants in each precision"
            ));
        }
        let is_searched = |entry: &Entry| entry.known.is_some() || entry.refused.is_some();
        if !self.entries.iter().all(is_searched) {
            self.retain_entries(is_searched);
        }
        Ok(true)
    }

    /// Counts of a variant; `None` of a block that would be too long.
    fn count_variant(&self, variant: Variant) -> Result<Option<Static>, TuneError> {
        let [width, height] = self.space.variant_value(variant, Term::Block).block;
        let single = self.index.get(&variant.with_value(Term::Block, 0));
        let single = single.and_then(|k| self.entries[*k].known.as_ref());
        if let Some(single) = single.filter(|_| width * height > 1)
            && single.statements * f64::from(width * height) > LONGEST
        {
            return Ok(None);
        }
        let filter = Static::from_compiled(&self.compile(variant)?);
        Ok(Some(match self.placing_for(variant) {
            Some(placing) => filter.after_placing(placing.known.clone()),
            None => filter,
        }))
    }
}
