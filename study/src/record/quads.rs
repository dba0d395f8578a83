//! Results of the study of pixel quads.

use super::{Circumstances, Record};
use crate::statistics::{Interval, Noise, mark_ratio};
use serde::{Deserialize, Serialize};
use straightline_manifest::Stage;
use straightline_table::{Cell, Column, Table};

/// Quad filters, in every variant and with every transport.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuadsRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Description of the device's quads, and the transport that they allow.
    pub quads: String,
    /// Number of the scene's triangles, with which shadow filters are drawn.
    pub triangles: usize,
    /// Median milliseconds of the pass that draws the coordinates for dispatched shadow filters. Included in those filters'
    /// times.
    pub coordinates_ms: f64,
    /// Every variant, grouped by filter; the first variant of a filter is the baseline of the others.
    pub ways: Vec<QuadWay>,
}

/// A variant of a filter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuadWay {
    /// The filter.
    pub filter: String,
    /// Name of the variant: the data that it shares.
    pub way: String,
    /// Communication of lanes: `none`, or a transport.
    pub transport: String,
    /// Hash of its WGSL: FNV-1a of 64 bits; `None` in records from before it was introduced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hash: Option<String>,
    /// Compute or fragment.
    pub stage: Stage,
    /// `true` if the filter is drawn with the scene's triangles, or reads the output of another pass that draws them.
    pub forward: bool,
    /// Texture reads per pixel, or per invocation if one invocation computes four pixels.
    pub reads: u32,
    /// Quad swaps of an invocation.
    pub messages: u32,
    /// Statements of the shader.
    pub statements: u32,
    /// Median milliseconds over all rounds.
    pub median_ms: f64,
    /// The time of each round.
    pub rounds_ms: Vec<f64>,
    /// Speedup over the filter's first variant, round by round: the median, and its 95 % confidence interval.
    pub speedup: Interval,
    /// Mean over all pixels of the largest difference of a colour's components to the filter's first variant. For shadow
    /// filters, over all pixels that triangles cover.
    pub mean_difference: f64,
    /// The largest such difference.
    pub largest_difference: f64,
}

impl Record for QuadsRecord {
    const STEM: &'static str = "quads";

    fn to_table(&self) -> Table {
        let noise = self.noise();
        Table::of(&self.ways)
            .column("filter", |way| &way.filter)
            .column(Column::from("way").left(), |way| &way.way)
            .column(Column::from(("transport", "messages by")).left(), |way| &way.transport)
            .column(Column::from("stage").left(), |way| way.stage.name())
            .column("reads", |way| way.reads)
            .column("messages", |way| way.messages)
            .column("statements", |way| way.statements)
            .fixed(("median_ms", "ms"), 2, |way| way.median_ms)
            .column(Column::interval("speedup"), |way| {
                Cell::interval(way.speedup.to_array(), 2).suffixed(mark_ratio(noise, way.speedup.median))
            })
            .scientific(("mean_difference", "mean off"), 1, |way| way.mean_difference)
            .scientific(("largest_difference", "largest"), 1, |way| way.largest_difference)
            .column(Column::exact("hash"), |way| way.hash.as_ref())
            .finish()
    }
}

impl QuadsRecord {
    /// Returns the noise that equal shaders of a filter show; `None` if no two are equal.
    pub fn noise(&self) -> Option<Noise> {
        let ways = self.ways.iter();
        Noise::from_run(ways.filter_map(|way| {
            Some((
                format!("{} {}", way.filter, way.hash.as_ref()?),
                way.rounds_ms.as_slice(),
            ))
        }))
    }
}
