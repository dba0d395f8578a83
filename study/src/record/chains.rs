//! Record of chains of passes, stored and fused.

use super::{Circumstances, Record};
use crate::statistics::Interval;
use serde::{Deserialize, Serialize};
use straightline_bench::execute::Times;
use straightline_kernels::OptionText;
use straightline_table::{Cell, Column, Table};

/// A chain with some pictures computed where they are read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainForm {
    /// The setting `fuse`.
    pub fuse: String,
    /// Pictures that are computed where they are read.
    pub fused: Vec<String>,
    /// Pictures that workgroups compute for later ones, in their memory.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shared: Vec<String>,
    /// Number of passes.
    pub passes: usize,
    /// Bytes of the textures between them.
    pub bytes: u64,
    /// Largest difference to the chain whose pictures are stored in 32-bit floats.
    pub difference: f64,
    /// Time of all passes.
    pub time: Times,
    /// Speedup over the chain without fused pictures.
    pub speedup: Interval,
}

/// A chain in every form.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainForms {
    /// Name of the chain.
    pub chain: String,
    /// Options that differ from their defaults.
    pub options: Vec<OptionText>,
    /// Its forms, that without fused pictures first.
    pub forms: Vec<ChainForm>,
}

/// Chains of passes, stored and fused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChainsRecord {
    /// Circumstances of the run.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// The chains.
    pub chains: Vec<ChainForms>,
}

impl Record for ChainsRecord {
    const STEM: &'static str = "chains";

    fn to_table(&self) -> Table {
        let rows = self
            .chains
            .iter()
            .flat_map(|chain| chain.forms.iter().map(move |form| (&chain.chain, form)));
        Table::of(rows)
            .column(Column::from("chain").grouped(), |(chain, _)| *chain)
            .column(Column::from("fuse").left(), |(_, form)| &form.fuse)
            .column("passes", |(_, form)| form.passes)
            .column(("bytes", "MB between passes"), |(_, form)| {
                Cell::new(form.bytes.to_string(), format!("{:.1}", form.bytes as f64 / 1e6))
            })
            .fixed(("median_ms", "ms"), 2, |(_, form)| form.time.median_ms)
            .column(Column::interval("speedup"), |(_, form)| {
                Cell::interval(form.speedup.to_array(), 2)
            })
            .scientific(("difference", "off 32-bit pictures"), 1, |(_, form)| form.difference)
            .column(Column::from("fused").left(), |(_, form)| form.fused.join(" "))
            .column(Column::from("shared").left(), |(_, form)| form.shared.join(" "))
            .finish()
    }
}
