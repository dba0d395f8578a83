//! Record of a sweep: one kernel in every combination of options and forms.

use super::{Circumstances, Record};
use crate::statistics::{Interval, Noise, mark_ratio};
use crate::sweep::Axis;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use straightline_isa::Figures;
use straightline_table::{Cell, Column, Table, TableBuilder};

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
    /// Figures of the compilers that were asked, by the GPU's name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub machine: BTreeMap<String, MachineFigures>,
}

/// A GPU compiler's figures for a shader, or the reason why there are none.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MachineFigures {
    /// All instructions.
    pub instructions: u64,
    /// Registers of a lane, as the compiler counts them.
    pub registers: u64,
    /// Waves, warps, threads or lanes at once.
    pub at_once: u64,
    /// Registers that did not fit and lie in memory.
    pub spilled: u64,
    /// Cycles of a wave among many, of compilers that state them. Those of loops are guesses.
    pub cycles: Option<u64>,
    /// Loops that the compiler kept, of compilers that say it.
    pub loops: Option<u64>,
    /// Reason why there are no figures.
    pub refused: Option<String>,
}

impl From<&Figures> for MachineFigures {
    fn from(figures: &Figures) -> MachineFigures {
        MachineFigures {
            instructions: figures.instructions,
            registers: figures.vector_registers,
            at_once: figures.occupancy,
            spilled: figures.spilled,
            cycles: Some(figures.inverse_throughput).filter(|cycles| *cycles > 0),
            loops: figures.loops,
            refused: None,
        }
    }
}

impl MachineFigures {
    /// Figures that there are not.
    pub fn refused(why: String) -> MachineFigures {
        MachineFigures {
            refused: Some(why),
            ..MachineFigures::default()
        }
    }
}

/// A column of a compiler's figures: its title, whether readers see it, and the figure.
type MachineColumn = (&'static str, bool, fn(&MachineFigures) -> Option<u64>);

const MACHINE_COLUMNS: [MachineColumn; 6] = [
    ("instructions", true, |of| Some(of.instructions)),
    ("cycles", true, |of| of.cycles),
    ("registers", true, |of| Some(of.registers)),
    ("at once", false, |of| Some(of.at_once)),
    ("spilled", false, |of| Some(of.spilled)),
    ("loops kept", true, |of| of.loops),
];

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

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
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
    /// Compilers that were asked: each GPU's name, and the driver's name for it with its version.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub compilers: BTreeMap<String, String>,
    /// All variants.
    pub variants: Vec<Swept>,
}

impl Record for SweepRecord {
    const STEM: &'static str = "sweep";

    /// Formats a tidy table: a row for each variant and round, and one for a rejected variant.
    fn to_table(&self) -> Table {
        let round = |variant: &Swept, k| variant.measured.as_ref()?.rounds_ms.get(k).copied();
        let rounds = |variant: &Swept| variant.measured.as_ref().map_or(1, |measured| measured.rounds_ms.len());
        let rows = self.variants.iter();
        let rows = rows.flat_map(|variant| (0..rounds(variant)).map(move |k| (variant, k)));
        let ms = |(variant, k): &(&Swept, usize)| round(variant, *k);
        self.tabulate(
            rows,
            |row| row.0,
            self.axes.iter(),
            |table| {
                table
                    .column("round", |row| ms(row).map(|_| row.1 + 1))
                    .fixed("ms", 3, |row| ms(row))
            },
        )
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

    /// Returns a table with a row for each measured variant, and the axes that vary.
    pub fn summarise(&self) -> Table {
        let measured = self.variants.iter().filter(|variant| variant.measured.is_some());
        let rounds = |variant: &&Swept| variant.measured.as_ref().map(|measured| measured.rounds_ms.len());
        let table = self.tabulate(
            measured,
            |variant| variant,
            self.varied_axes().into_iter(),
            |table| table.column("rounds", rounds),
        );
        match self.variants.iter().any(|variant| variant.rival.is_some()) {
            true => table,
            false => table.without(&["rival"]),
        }
    }

    /// Returns the axes with several values, or the baseline's axes if no axis has several.
    pub fn varied_axes(&self) -> Vec<&Axis> {
        let several: Vec<&Axis> = self.axes.iter().filter(|axis| axis.values.len() > 1).collect();
        match several.is_empty() {
            true => self
                .axes
                .iter()
                .filter(|axis| self.baseline.contains_key(&axis.name))
                .collect(),
            false => several,
        }
    }

    /// Returns the noise that equal shaders of a group show; `None` if no two are equal.
    pub fn noise(&self) -> Option<Noise> {
        Noise::from_run(self.variants.iter().filter_map(|variant| {
            let measured = variant.measured.as_ref()?;
            let mut group = variant.settings.clone();
            group.retain(|name, _| !self.baseline.contains_key(name));
            // The bound on loops is no part of the text.
            let bound = variant.settings.get("loops").filter(|_| measured.loops != Some(0));
            let shader = format!("{group:?} {} {bound:?}", measured.hash);
            Some((shader, measured.rounds_ms.as_slice()))
        }))
    }

    /// Columns of each compiler that was asked; those that no variant has a figure for are left out.
    fn machine_columns(&self) -> Vec<(&str, MachineColumn)> {
        let has = |gpu: &str, figure: fn(&MachineFigures) -> Option<u64>| {
            let mut measured = self.variants.iter().filter_map(|variant| variant.measured.as_ref());
            measured.any(|measured| measured.machine.get(gpu).and_then(figure).is_some())
        };
        let each = self.compilers.keys();
        let each = each.flat_map(|gpu| MACHINE_COLUMNS.map(|column| (gpu.as_str(), column)));
        each.filter(|(gpu, (.., figure))| has(gpu, *figure)).collect()
    }

    /// Returns a table of variants: their axes, columns of the caller's, and their measurements.
    fn tabulate<'r, R>(
        &'r self,
        rows: impl IntoIterator<Item = R>,
        variant: impl Fn(&R) -> &'r Swept + Copy,
        axes: impl Iterator<Item = &'r Axis>,
        further: impl FnOnce(TableBuilder<R>) -> TableBuilder<R>,
    ) -> Table {
        let noise = self.noise();
        let measured = move |row: &R| variant(row).measured.as_ref();
        let table = Table::of(rows)
            .columns(
                axes,
                |axis| axis.name.clone(),
                |row, axis| variant(row).settings.get(&axis.name).cloned(),
            )
            .column("rival", |row| variant(row).rival.clone());
        further(table)
            .column(("median_ms", "median ms"), |row| {
                measured(row).map(|of| Cell::fixed(of.median_ms, 3))
            })
            .column(Column::interval("speedup"), |row| {
                let ratio = measured(row)?.speedup?;
                let cell = Cell::interval(ratio.to_array(), 2);
                Some(match self.is_baseline(variant(row)) {
                    true => cell.shown_as("baseline"),
                    false => cell.suffixed(mark_ratio(noise, ratio.median)),
                })
            })
            .column("loops", |row| measured(row)?.loops)
            .column("statements", |row| measured(row)?.statements)
            .column("reads", |row| measured(row)?.reads)
            .column(Column::exact("spirv_bytes"), |row| measured(row)?.spirv_bytes)
            .column(("off_f64_999", "off f64, 99.9 %"), |row| {
                measured(row).map(|of| Cell::scientific(of.difference_999, 1))
            })
            .column(("off_f64_largest", "largest"), |row| {
                measured(row).map(|of| Cell::scientific(of.difference, 1))
            })
            .columns(
                self.machine_columns(),
                |(gpu, (title, is_shown, _))| match is_shown {
                    true => Column::from(format!("{gpu} {title}")),
                    false => Column::exact(format!("{gpu} {title}")),
                },
                |row, (gpu, (.., figure))| {
                    let figures = measured(row)?.machine.get(*gpu)?;
                    figures.refused.is_none().then(|| figure(figures))?
                },
            )
            .column(Column::exact("hash"), |row| Some(&measured(row)?.hash))
            .column(Column::exact("refused"), |row| variant(row).refused.clone())
            .finish()
    }
}
