//! Record of a search for values that may be computed in half precision.

use super::{Circumstances, MachineFigures, Record};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use straightline_kernels::OptionText;
use straightline_table::{Cell, Column, Table};

/// A kernel with some values in half precision.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lowered {
    /// Names of the values, as for the setting `half`.
    pub half: BTreeSet<String>,
    /// Largest difference from `f64`, without the thousandth of the pixels that differ most; beyond 1 relative. `None` if a
    /// pixel is not finite that is finite in full precision.
    pub error: Option<f64>,
    /// Figures of GPU compilers, by GPU.
    pub machine: BTreeMap<String, MachineFigures>,
    /// Costs over those of full precision, by GPU: cycles where a compiler states them, else instructions.
    pub ratios: BTreeMap<String, f64>,
}

/// The cheapest choice for some GPUs within the bound of the error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proposal {
    /// The GPUs.
    pub gpus: Vec<String>,
    /// The choice; full precision if none is cheaper.
    pub lowered: Lowered,
}

/// Search for the cheapest choice of values in half precision within a bound of the error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PrecisionRecord {
    /// Circumstances of the run.
    pub circumstances: Circumstances,
    /// Name of the kernel.
    pub kernel: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// Inputs of the kernel, in words.
    pub input: String,
    /// Bound of the error.
    pub max_error: f64,
    /// Drivers' names for the GPUs.
    pub devices: BTreeMap<String, String>,
    /// Full precision, each name by itself, and all names.
    pub choices: Vec<Lowered>,
    /// The cheapest choice for each GPU, and last for all of them.
    pub proposals: Vec<Proposal>,
    /// Number of choices that were judged.
    pub judged: usize,
}

impl PrecisionRecord {
    /// Every choice with its role: `nothing`, a name, `all`, or the GPUs that it is proposed for.
    fn rows(&self) -> Vec<(String, &Lowered)> {
        let last = self.choices.len().saturating_sub(1);
        let judged = self.choices.iter().enumerate().map(|(k, lowered)| {
            let role = match lowered.half.len() {
                0 => "nothing".to_owned(),
                _ if k == last && k > 1 => "all".to_owned(),
                _ => Vec::from_iter(lowered.half.iter().cloned()).join(" "),
            };
            (role, lowered)
        });
        let proposed = self.proposals.iter().map(|proposal| match &proposal.gpus[..] {
            [gpu] => (format!("for {gpu}"), &proposal.lowered),
            _ => ("for all of them".to_owned(), &proposal.lowered),
        });
        judged.chain(proposed).collect()
    }
}

impl Record for PrecisionRecord {
    const STEM: &'static str = "precision";

    fn to_table(&self) -> Table {
        let rows = self.rows();
        Table::of(&rows)
            .column("in half precision", |(role, _)| role)
            .column(Column::exact("half"), |(_, of)| {
                Vec::from_iter(of.half.iter().cloned()).join(" ")
            })
            .column("error", |(_, of)| match of.error {
                Some(error) => Cell::from(format!("{error:.1e}")),
                None => Cell::from("not finite"),
            })
            .columns(
                self.devices.keys(),
                |gpu| (*gpu).clone(),
                |(_, of), gpu| of.ratios.get(*gpu).map(|ratio| Cell::fixed(*ratio, 3)),
            )
            .columns(
                self.devices.keys(),
                |gpu| Column::exact(format!("{gpu} registers")),
                |(_, of), gpu| of.machine.get(*gpu).map(|figures| figures.registers),
            )
            .finish()
    }
}
