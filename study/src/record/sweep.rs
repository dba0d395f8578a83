//! Record of a sweep: one kernel in every combination of options and forms.

use super::{Circumstances, Record};
use crate::sweep::{Axis, Interval};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Environment of a sweep, beyond its circumstances.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Environment {
    /// Version of Straightline.
    pub generator: String,
    /// Operating system and architecture.
    pub system: String,
    /// Frequency governor of the first processor, if the system reports one.
    pub governor: Option<String>,
    /// Commit of the repository in which the sweep ran, with `+` if it had changes; `None` outside of one.
    pub commit: Option<String>,
}

/// Measurements of a shader.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measured {
    /// Hash of its WGSL: FNV-1a of 64 bits.
    pub hash: String,
    /// Number of loops left; `None` for a text that was not emitted.
    pub loops: Option<u32>,
    /// Statements; `None` for a text that was not emitted.
    pub statements: Option<u32>,
    /// Texture and buffer reads of one invocation; `None` for a text that was not emitted.
    pub reads: Option<u32>,
    /// Bytes of SPIR-V; `None` for a text that was not emitted.
    pub spirv_bytes: Option<usize>,
    /// Milliseconds of a frame, round by round.
    pub rounds_ms: Vec<f64>,
    /// Median of the rounds.
    pub median_ms: f64,
    /// Speedup over the baseline in the same round: the median, and its 95 % confidence interval. `None` without a
    /// baseline.
    pub speedup: Option<Interval>,
    /// Largest difference of a component to the same kernel in `f64`.
    pub difference: f64,
    /// Largest difference without the thousandth of the pixels that differ most.
    pub difference_999: f64,
}

/// A variant: its measurements, or the reason why there are none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Swept {
    /// Value of every axis. For a rival, those of the variants that it is compared with.
    pub settings: BTreeMap<String, String>,
    /// File of a hand-written shader that replaces the emitted one.
    pub rival: Option<String>,
    /// Measurements, if it could be created and run.
    pub measured: Option<Measured>,
    /// Reason why there are no measurements.
    pub refused: Option<String>,
}

/// Part of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Shard {
    /// Index of the part, from 1.
    pub index: u32,
    /// Number of parts.
    pub count: u32,
}

/// A kernel in every combination of the varied settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SweepRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Environment of the run.
    pub environment: Environment,
    /// The kernel.
    pub kernel: String,
    /// Hash of the kernel's source texts: FNV-1a of 64 bits.
    pub source: String,
    /// Input of the kernel.
    pub input: String,
    /// Varied axes, options first.
    pub axes: Vec<Axis>,
    /// Axes and their values that identify the baseline, which variants with otherwise equal settings are compared with.
    pub baseline: BTreeMap<String, String>,
    /// Target half-width of all ratios' intervals, as a share of the median. Rounds end when it is reached, or after
    /// `rounds` rounds.
    pub until: Option<f64>,
    /// Part of the sweep; `None` for a whole sweep.
    pub shard: Option<Shard>,
    /// All variants.
    pub variants: Vec<Swept>,
}

impl Record for SweepRecord {
    const STEM: &'static str = "sweep";

    /// Formats a tidy table: a row for each variant and round, and one for a rejected variant.
    fn to_table(&self) -> (Vec<&str>, Vec<Vec<String>>) {
        const FIGURES: [&str; 13] = [
            "rival",
            "round",
            "ms",
            "median_ms",
            "speedup",
            "speedup_low",
            "speedup_high",
            "loops",
            "statements",
            "reads",
            "spirv_bytes",
            "off_f64_largest",
            "refused",
        ];
        let mut head: Vec<&str> = self.axes.iter().map(|axis| axis.name.as_str()).collect();
        head.extend(FIGURES);
        let rows = self.variants.iter().flat_map(|variant| self.rows(variant));
        (head, rows.collect())
    }
}

impl SweepRecord {
    /// Returns the JSON Schema of the record's file, as JSON.
    ///
    /// # Errors
    ///
    /// If it cannot be written as JSON.
    pub fn schema() -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(&schemars::schema_for!(SweepRecord))? + "\n")
    }

    /// Returns whether a variant is the baseline of others.
    pub fn is_baseline(&self, variant: &Swept) -> bool {
        let mut baseline = self.baseline.iter();
        variant.rival.is_none() && baseline.all(|(name, value)| variant.settings.get(name) == Some(value))
    }

    fn rows(&self, variant: &Swept) -> Vec<Vec<String>> {
        let setting = |axis: &Axis| variant.settings.get(&axis.name).cloned().unwrap_or_default();
        let mut begin: Vec<String> = self.axes.iter().map(setting).collect();
        begin.push(variant.rival.clone().unwrap_or_default());
        let Some(measured) = &variant.measured else {
            begin.extend(vec![String::new(); 11]);
            begin.push(variant.refused.clone().unwrap_or_default());
            return vec![begin];
        };
        let count = |count: Option<u32>| count.map_or(String::new(), |count| count.to_string());
        let ratio = measured.speedup;
        let of = |get: fn(&Interval) -> f64| {
            ratio
                .as_ref()
                .map_or(String::new(), |ratio| format!("{:.4}", get(ratio)))
        };
        let end = [
            format!("{:.5}", measured.median_ms),
            of(|ratio| ratio.median),
            of(|ratio| ratio.low),
            of(|ratio| ratio.high),
            count(measured.loops),
            count(measured.statements),
            count(measured.reads),
            measured.spirv_bytes.map_or(String::new(), |bytes| bytes.to_string()),
            format!("{:.3e}", measured.difference),
            String::new(),
        ];
        let row = |(round, ms): (usize, &f64)| {
            let own = [(round + 1).to_string(), format!("{ms:.5}")];
            [begin.as_slice(), &own, &end].concat()
        };
        measured.rounds_ms.iter().enumerate().map(row).collect()
    }
}
