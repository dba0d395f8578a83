//! Records of sweeps beside each other: shards joined, runs compared.

use crate::record::{Measured, Shard, SweepRecord, Swept};
use crate::statistics::{Interval, ratios_by_round};
use std::collections::{BTreeMap, BTreeSet};

/// Why records do not belong together.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum JoinError {
    /// There is none.
    #[error("there is no record to join")]
    None,
    /// A record is of a whole sweep.
    #[error("the record of {date} is no shard: it has the whole sweep")]
    Whole {
        /// Time at which the record's run began.
        date: String,
    },
    /// The sweep was divided in several ways.
    #[error("the shards are of different divisions of the sweep: {}", shards.join(", "))]
    Divisions {
        /// Names of the shards.
        shards: Vec<String>,
    },
    /// Two are the same shard.
    #[error("shard {shard} is there twice")]
    Twice {
        /// Name of the shard.
        shard: String,
    },
    /// Shards are missing, or were interrupted.
    #[error("{}; measure them again by `--shard`", describe_gaps(missing, interrupted))]
    Incomplete {
        /// Names of the missing shards.
        missing: Vec<String>,
        /// Names of the shards whose run was interrupted.
        interrupted: Vec<String>,
    },
    /// Records differ in a property that they must share.
    #[error("the {kind} have different {property}: {}", describe_sides(sides))]
    Differ {
        /// Shards of a sweep, or whole records.
        kind: &'static str,
        /// Name of the property, in the plural.
        property: &'static str,
        /// Each value, with the names of the records that have it.
        sides: Vec<(String, Vec<String>)>,
    },
}

fn describe_gaps(missing: &[String], interrupted: &[String]) -> String {
    let lists = [("missing", missing), ("interrupted", interrupted)];
    let lists = lists.iter().filter(|(_, shards)| !shards.is_empty());
    let lists = lists.map(|(state, shards)| format!("shards are {state}: {}", shards.join(", ")));
    lists.collect::<Vec<_>>().join("; ")
}

fn describe_sides(sides: &[(String, Vec<String>)]) -> String {
    let sides = sides.iter();
    let sides = sides.map(|(value, names)| format!("`{value}` ({})", names.join(", ")));
    sides.collect::<Vec<_>>().join(", ")
}

/// Names and values that must be the same in records that are put together.
fn shared_properties(record: &SweepRecord) -> [(&'static str, String); 13] {
    let axes = record.axes.iter();
    let axes = axes.map(|axis| format!("{}={}", axis.name, axis.values.join(",")));
    let (circumstances, environment) = (&record.circumstances, &record.environment);
    let commit = environment.commit.as_deref();
    let until = record.until.map(|until| format!("{} %", 100.0 * until));
    [
        ("kernels", record.kernel.clone()),
        ("source texts", record.source.clone()),
        ("axes", axes.collect::<Vec<_>>().join(" ")),
        ("baselines", format!("{:?}", record.baseline)),
        ("inputs", record.input.clone()),
        ("sizes", format!("{}x{}", circumstances.size[0], circumstances.size[1])),
        ("numbers of rounds", circumstances.rounds.to_string()),
        ("values of --until", until.unwrap_or_else(|| "none".to_owned())),
        ("adapters", circumstances.adapter.clone()),
        ("processors", circumstances.processor.clone()),
        ("compilers", format!("{:?}", record.compilers)),
        ("generators", environment.generator.clone()),
        ("commits", commit.unwrap_or("none").to_owned()),
    ]
}

/// Finds the first property in which named records differ, among those that `counts` accepts.
fn check_shared(
    kind: &'static str,
    records: &[(String, &SweepRecord)],
    counts: impl Fn(&str) -> bool,
) -> Result<(), JoinError> {
    let properties: Vec<_> = records.iter().map(|(_, record)| shared_properties(record)).collect();
    let Some(first) = properties.first() else {
        return Ok(());
    };
    for (k, (property, _)) in first.iter().enumerate().filter(|(_, (property, _))| counts(property)) {
        let mut sides: Vec<(String, Vec<String>)> = Vec::new();
        for ((name, _), own) in records.iter().zip(&properties) {
            match sides.iter_mut().find(|(value, _)| *value == own[k].1) {
                Some((_, names)) => names.push(name.clone()),
                None => sides.push((own[k].1.clone(), vec![name.clone()])),
            }
        }
        if sides.len() > 1 {
            return Err(JoinError::Differ { kind, property, sides });
        }
    }
    Ok(())
}

/// All shards of a sweep as one record; its circumstances are those of the first.
///
/// # Errors
///
/// If one is missing, interrupted or there twice, or was not measured under the same circumstances.
pub fn join_shards(records: &[SweepRecord]) -> Result<SweepRecord, JoinError> {
    let mut shards: BTreeMap<u32, &SweepRecord> = BTreeMap::new();
    let mut named = Vec::new();
    let mut counts = BTreeSet::new();
    for record in records {
        let date = || record.circumstances.date.clone();
        let shard = record.shard.ok_or_else(|| JoinError::Whole { date: date() })?;
        named.push((shard.to_string(), record));
        counts.insert(shard.count);
    }
    if counts.len() > 1 {
        let shards = named.into_iter().map(|(name, _)| name).collect();
        return Err(JoinError::Divisions { shards });
    }
    let count = counts.pop_first().ok_or(JoinError::None)?;
    for (record, (shard, _)) in records.iter().zip(&named) {
        let index = record.shard.map_or(0, |shard| shard.index);
        if shards.insert(index, record).is_some() {
            return Err(JoinError::Twice { shard: shard.clone() });
        }
    }
    check_shared("shards", &named, |_| true)?;
    let missing = (1..=count).filter(|index| !shards.contains_key(index));
    let missing: Vec<String> = missing.map(|index| Shard { index, count }.to_string()).collect();
    let interrupted = named.iter().filter(|(_, record)| !record.circumstances.complete);
    let interrupted: Vec<String> = interrupted.map(|(shard, _)| shard.clone()).collect();
    if !missing.is_empty() || !interrupted.is_empty() {
        return Err(JoinError::Incomplete { missing, interrupted });
    }
    let first = &records[0];
    let mut whole = first.clone();
    whole.shard = None;
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
    let named = [("first".to_owned(), first), ("second".to_owned(), second)];
    check_shared("records", &named, |property| {
        ["kernels", "baselines"].contains(&property)
    })?;
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
