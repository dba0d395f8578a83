//! Records of sweeps beside each other: shards joined, runs compared.

use crate::record::{Measured, Shard, SweepRecord, Swept};
use crate::statistics::{Interval, ratios_by_round};
use std::collections::BTreeMap;

/// Why records do not belong together.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum JoinError {
    /// There is none.
    #[error("there is no record to join")]
    None,
    /// A record is whole, or of a sweep in another number of shards.
    #[error("the record of {date} is no shard of {count}")]
    NoShard {
        /// Time at which the record's run began.
        date: String,
        /// Of how many the first is one.
        count: u32,
    },
    /// Two are the same shard.
    #[error("shard {index} is there twice")]
    Twice {
        /// Index of the shard.
        index: u32,
    },
    /// Shards are missing.
    #[error("shards are missing: {}", missing.join(", "))]
    Missing {
        /// Names of the missing shards.
        missing: Vec<String>,
    },
    /// Two records differ in what must be the same.
    #[error("the records have different {what}: `{first}` and `{second}`")]
    Differ {
        /// In what.
        what: &'static str,
        /// That of the first.
        first: String,
        /// That of the other.
        second: String,
    },
}

/// Names and values that must be the same in records that are put together.
fn shared_properties(record: &SweepRecord) -> [(&'static str, String); 9] {
    let axes = record.axes.iter();
    let axes = axes.map(|axis| format!("{}={}", axis.name, axis.values.join(",")));
    let circumstances = &record.circumstances;
    [
        ("kernels", record.kernel.clone()),
        ("source texts", record.source.clone()),
        ("axes", axes.collect::<Vec<_>>().join(" ")),
        ("baselines", format!("{:?}", record.baseline)),
        ("inputs", record.input.clone()),
        ("sizes", format!("{}x{}", circumstances.size[0], circumstances.size[1])),
        ("adapters", circumstances.adapter.clone()),
        ("processors", circumstances.processor.clone()),
        ("generators", record.environment.generator.clone()),
    ]
}

/// All shards of a sweep as one record; its circumstances are those of the first.
///
/// # Errors
///
/// If one is missing, is there twice, or was not measured under the same circumstances.
pub fn join_shards(records: &[SweepRecord]) -> Result<SweepRecord, JoinError> {
    let first = records.first().ok_or(JoinError::None)?;
    let count = first.shard.map_or(0, |shard| shard.count);
    let mut shards: BTreeMap<u32, &SweepRecord> = BTreeMap::new();
    for record in records {
        let Some(Shard { index, .. }) = record.shard.filter(|shard| shard.count == count) else {
            return Err(JoinError::NoShard {
                date: record.circumstances.date.clone(),
                count,
            });
        };
        for ((what, one), (_, other)) in shared_properties(first).into_iter().zip(shared_properties(record)) {
            if one != other {
                return Err(JoinError::Differ {
                    what,
                    first: one,
                    second: other,
                });
            }
        }
        if shards.insert(index, record).is_some() {
            return Err(JoinError::Twice { index });
        }
    }
    let missing = (1..=count).filter(|index| !shards.contains_key(index));
    let missing: Vec<String> = missing.map(|index| format!("{index}/{count}")).collect();
    if !missing.is_empty() {
        return Err(JoinError::Missing { missing });
    }
    let mut whole = first.clone();
    whole.shard = None;
    whole.circumstances.complete = records.iter().all(|record| record.circumstances.complete);
    let mut variants: Vec<Swept> = shards.values().flat_map(|record| record.variants.clone()).collect();
    variants.sort_by_key(|variant| sort_key(first, variant));
    whole.variants = variants;
    Ok(whole)
}

/// Place of a variant in the order of the axes: rivals come after those they are compared with.
fn sort_key(record: &SweepRecord, variant: &Swept) -> Vec<usize> {
    let compared_apart = |name: &str| !record.baseline.contains_key(name);
    let at = |apart: bool| {
        let axes = record
            .axes
            .iter()
            .filter(move |axis| compared_apart(&axis.name) == apart);
        axes.map(|axis| {
            let value = variant.settings.get(&axis.name);
            axis.values.iter().position(|known| Some(known) == value).unwrap_or(0)
        })
    };
    let rival = usize::from(variant.rival.is_some());
    at(true).chain([rival]).chain(at(false)).collect()
}

/// A variant in two records.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The value of every axis.
    pub settings: BTreeMap<String, String>,
    /// The file, if it is a rival.
    pub rival: Option<String>,
    /// Speedups of the two over their baselines.
    pub speedup: [f64; 2],
    /// The second's by the first's, and in which interval that lies.
    pub quotient: Interval,
    /// True if the interval is beyond the tolerance.
    pub differs: bool,
}

/// Compares two records on the variants that both have, other than their baselines. Of all intervals together 95 in a hundred
/// hold what they should (Bonferroni); each is of rounds of these two runs, and does not know how runs differ. `tolerance` is a
/// part of one: smaller differences count as the same.
///
/// # Errors
///
/// If they are not of one kernel and one baseline.
pub fn compare_records(first: &SweepRecord, second: &SweepRecord, tolerance: f64) -> Result<Vec<Compared>, JoinError> {
    for ((what, one), (_, other)) in shared_properties(first).into_iter().zip(shared_properties(second)) {
        if ["kernels", "baselines"].contains(&what) && one != other {
            return Err(JoinError::Differ {
                what,
                first: one,
                second: other,
            });
        }
    }
    let pairs: Vec<(&Swept, [Vec<f64>; 2])> = first
        .variants
        .iter()
        .filter_map(|variant| {
            let same = |other: &&Swept| other.settings == variant.settings && other.rival == variant.rival;
            let other = second.variants.iter().find(same)?;
            Some((
                variant,
                [baseline_speedups(first, variant)?, baseline_speedups(second, other)?],
            ))
        })
        .collect();
    let confidence = 1.0 - 0.05 / pairs.len().max(1) as f64;
    let compared = pairs.into_iter().filter_map(|(variant, [one, other])| {
        let quotient = Interval::of_quotient(&other, &one, confidence)?;
        let median = |of: &[f64]| Interval::of_median(of, confidence).map(|of| of.median);
        Some(Compared {
            settings: variant.settings.clone(),
            rival: variant.rival.clone(),
            speedup: [median(&one)?, median(&other)?],
            quotient,
            differs: quotient.low > 1.0 + tolerance || quotient.high < 1.0 - tolerance,
        })
    });
    Ok(compared.collect())
}

/// Speedup of a variant over its baseline, round by round; `None` of a baseline.
fn baseline_speedups(record: &SweepRecord, variant: &Swept) -> Option<Vec<f64>> {
    let is_base = |of: &&Swept| {
        let mut settings = of.settings.iter();
        let same = settings.all(|(name, value)| match record.baseline.get(name) {
            Some(base) => value == base,
            None => variant.settings.get(name) == Some(value),
        });
        of.rival.is_none() && same
    };
    let base = record.variants.iter().find(is_base)?;
    if std::ptr::eq(base, variant) {
        return None;
    }
    let rounds = |of: &Option<Measured>| of.as_ref().map(|measured| measured.rounds_ms.clone());
    let (base, own) = (rounds(&base.measured)?, rounds(&variant.measured)?);
    Some(ratios_by_round(&base, &own))
}
