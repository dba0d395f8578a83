//! A kernel in every combination of its options and of forms: the cost of each beside a baseline, and its error.
//!
//! Variants that differ in nothing but what the baseline names are a group. All of a group are timed in turn, round by round,
//! and the speedup of one over the group's baseline is taken of each round by itself, so that whatever slows a whole
//! round down cancels.

mod group;
mod joined;
mod machine;
mod rival;
mod space;

use crate::progress::Progress;
use crate::record::{Shard, Swept};
use std::collections::BTreeMap;
use std::time::Duration;
use straightline_bench::execute::{Bench, ExecuteError, Inputs};
use straightline_codegen::{Compiled, Kernel};
use straightline_isa::{Compiler, IsaError};

pub use joined::{Compared, JoinError, compare_records, join_shards};
pub use rival::Rival;
pub use space::{Axis, Loops, RESERVED, Space, Variant, parse_values, spell_value, varied_knob};

/// Subject of a sweep, and the way to measure it.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The kernel.
    pub kernel: Kernel,
    /// Variants of the kernel.
    pub space: Space,
    /// Axes, each with the value that distinguishes the variants with which the others of their groups are compared.
    pub baseline: BTreeMap<String, String>,
    /// Hand-written shaders that are measured along.
    pub rivals: Vec<Rival>,
    /// Rounds of timing; with `until` at most so many.
    pub rounds: u32,
    /// Rounds of a group end when no interval is wider than so many parts of the median, either way.
    pub until: Option<f64>,
    /// A shader that is done sooner is run several times in a row for one time.
    pub least: Duration,
    /// The part that is measured.
    pub shard: Option<Shard>,
}

/// Why a sweep could not be made.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// The request contradicts itself.
    #[error("{0}")]
    Bad(String),
    /// Something cannot be read or given.
    #[error("{0}")]
    Given(String),
    /// The device failed.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// A compiler ended.
    #[error(transparent)]
    Compiler(#[from] IsaError),
    /// Nothing could be measured.
    #[error("none of {variants} variants could be made and run; the first: {why}")]
    Nothing {
        /// Number of variants tried.
        variants: usize,
        /// Reason.
        why: String,
    },
}

/// Gives a kernel what it reads.
pub type Give<'a> = dyn Fn(&Compiled) -> Result<Inputs, SweepError> + 'a;

impl Sweep {
    /// Variants in groups of those that are compared with each other: all of them, or those of the shard.
    ///
    /// # Errors
    ///
    /// [`SweepError::Bad`] if the baseline is none, or there are fewer groups than shards.
    pub fn groups(&self) -> Result<Vec<Vec<Variant>>, SweepError> {
        let axes = self.space.axes();
        for (name, value) in &self.baseline {
            let Some(axis) = axes.iter().find(|axis| axis.name == *name) else {
                let known: Vec<&str> = axes.iter().map(|axis| axis.name.as_str()).collect();
                return Err(SweepError::Bad(format!(
                    "the baseline names `{name}`, which is not varied; there are {}",
                    known.join(", ")
                )));
            };
            if !axis.values.contains(value) {
                return Err(SweepError::Bad(format!(
                    "the baseline has {name}={value}, and the values of `{name}` are {}",
                    axis.values.join(", ")
                )));
            }
        }
        let mut groups: Vec<(BTreeMap<String, String>, Vec<Variant>)> = Vec::new();
        for variant in self.space.variants() {
            let mut same = variant.axis_values();
            same.retain(|name, _| !self.baseline.contains_key(name));
            match groups.iter_mut().find(|(known, _)| *known == same) {
                Some((_, group)) => group.push(variant),
                None => groups.push((same, vec![variant])),
            }
        }
        let Some(Shard { index, count }) = self.shard else {
            return Ok(groups.into_iter().map(|(_, group)| group).collect());
        };
        if groups.len() < count as usize {
            return Err(SweepError::Bad(format!(
                "{} groups of variants that are compared with each other cannot be measured in {count} shards; ask for fewer, or \
                 for another baseline",
                groups.len()
            )));
        }
        let own = groups.into_iter().enumerate();
        let own = own.filter(|(k, _)| *k as u32 % count == index - 1);
        Ok(own.map(|(_, (_, group))| group).collect())
    }

    fn is_baseline(&self, variant: &Variant) -> bool {
        let settings = variant.axis_values();
        self.baseline
            .iter()
            .all(|(name, value)| settings.get(name) == Some(value))
    }

    /// Measures group by group; what a variant reads is given by `give`, and `compilers` are asked about each. Stopped by `watch`, it has the groups that were
    /// measured until then.
    ///
    /// # Errors
    ///
    /// Those of [`groups`](Self::groups) and of `give`; [`SweepError::Nothing`]; a compiler ended. A variant that is refused is in the result,
    /// with the reason.
    pub fn measure(
        &self,
        bench: &Bench,
        give: &Give<'_>,
        compilers: &mut [Compiler],
        progress: &mut dyn Progress,
    ) -> Result<Vec<Swept>, SweepError> {
        let groups = self.groups()?;
        for rival in &self.rivals {
            rival.check(&self.space, &self.baseline, &groups)?;
        }
        let count = groups.len();
        let mut all = Vec::new();
        for (k, group) in groups.iter().enumerate() {
            if progress.is_stopped() {
                break;
            }
            let label = format!("{} {} of {count}", self.kernel.name(), k + 1);
            progress.begin(&label, group.len() + self.rivals.len() + 1 + self.rounds as usize);
            match group::measure_group(self, bench, group, give, compilers, progress)? {
                Some(swept) => all.extend(swept),
                None => break,
            }
        }
        match all.iter().find_map(|swept| swept.refused.clone()) {
            Some(why) if all.iter().all(|swept| swept.measured.is_none()) => Err(SweepError::Nothing {
                variants: all.len(),
                why,
            }),
            _ => Ok(all),
        }
    }
}
