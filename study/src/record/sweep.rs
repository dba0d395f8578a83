//! A sweep: one kernel in every combination of options and forms.

use super::{Circumstances, Record};
use crate::sweep::{Axis, Interval};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Where a sweep ran, beyond its circumstances.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Environment {
    /// Version of Straightline.
    pub generator: String,
    /// Operating system and architecture.
    pub system: String,
    /// How the first processor chooses its clock, where the system tells.
    pub governor: Option<String>,
    /// Commit of the repository in which it was run, with `+` if that had changes; `None` outside of one.
    pub commit: Option<String>,
}

/// What was measured of a shader.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Measured {
    /// Hash of its WGSL: FNV-1a of 64 bits.
    pub hash: String,
    /// Loops that are left; `None` of a text that was not emitted.
    pub loops: Option<u32>,
    /// Statements; `None` of a text that was not emitted.
    pub statements: Option<u32>,
    /// Texture and buffer reads of one invocation; `None` of a text that was not emitted.
    pub reads: Option<u32>,
    /// Bytes of SPIR-V; `None` of a text that was not emitted.
    pub spirv_bytes: Option<usize>,
    /// Milliseconds of a frame, round by round.
    pub rounds_ms: Vec<f64>,
    /// Their median.
    pub median_ms: f64,
    /// Speedup over the baseline in the same round: median of the rounds, and in which interval it lies
    /// with 95 %. `None` where there is no baseline.
    pub speedup: Option<Interval>,
    /// Largest difference of a component to the same kernel in `f64`.
    pub difference: f64,
    /// The same over all but the thousandth of the pixels that differ most.
    pub difference_999: f64,
}

/// A variant: measured, or why not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Swept {
    /// The value of every axis. Of a rival, those of the variants that it is compared with.
    pub settings: BTreeMap<String, String>,
    /// The file of a hand-written shader that takes the place of an emitted one.
    pub rival: Option<String>,
    /// Figures, if it could be made and run.
    pub measured: Option<Measured>,
    /// Why there are none.
    pub refused: Option<String>,
}

/// One of several parts of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Shard {
    /// Which, from 1.
    pub index: u32,
    /// Of how many.
    pub count: u32,
}

/// A kernel in every combination of what was varied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SweepRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Where it ran.
    pub environment: Environment,
    /// The kernel.
    pub kernel: String,
    /// Hash of the kernel's source texts: FNV-1a of 64 bits.
    pub source: String,
    /// What it read.
    pub input: String,
    /// What was varied: options first.
    pub axes: Vec<Axis>,
    /// The axes, and their values, that distinguish the variant with which others of the same settings are compared.
    pub baseline: BTreeMap<String, String>,
    /// Rounds went on until the intervals of all ratios were so many parts of the median wide, either way, or there were as many
    /// rounds as `rounds` says.
    pub until: Option<f64>,
    /// If it is a part: which. `None` of a whole one.
    pub shard: Option<Shard>,
    /// All variants.
    pub variants: Vec<Swept>,
}

impl Record for SweepRecord {
    const STEM: &'static str = "sweep";

    /// Tidy: a row for each variant and round, and one for a variant that was refused.
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
    /// The JSON Schema of its file, as JSON.
    ///
    /// # Errors
    ///
    /// If it cannot be written as JSON.
    pub fn schema() -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(&schemars::schema_for!(SweepRecord))? + "\n")
    }

    /// Returns whether others are compared with this variant.
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
