//! Results of the study of pixel quads.

use super::{Circumstances, Record};
use crate::sweep::Interval;
use serde::{Deserialize, Serialize};
use straightline_manifest::Stage;

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

    fn to_table(&self) -> (Vec<&str>, Vec<Vec<String>>) {
        let head = vec![
            "filter",
            "way",
            "transport",
            "stage",
            "reads",
            "messages",
            "statements",
            "median_ms",
            "speedup",
            "speedup_low",
            "speedup_high",
            "mean_difference",
            "largest_difference",
        ];
        let row = |way: &QuadWay| {
            vec![
                way.filter.clone(),
                way.way.clone(),
                way.transport.clone(),
                way.stage.name().to_owned(),
                way.reads.to_string(),
                way.messages.to_string(),
                way.statements.to_string(),
                way.median_ms.to_string(),
                way.speedup.median.to_string(),
                way.speedup.low.to_string(),
                way.speedup.high.to_string(),
                way.mean_difference.to_string(),
                way.largest_difference.to_string(),
            ]
        };
        (head, self.ways.iter().map(row).collect())
    }
}
