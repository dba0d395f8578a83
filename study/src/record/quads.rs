//! Results of the study of pixel quads.

use super::{Circumstances, Record};
use crate::sweep::Interval;
use serde::{Deserialize, Serialize};
use straightline_manifest::Stage;

/// Filters of pixel quads, each computed in every way by every transport.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuadsRecord {
    /// Circumstances.
    #[serde(flatten)]
    pub circumstances: Circumstances,
    /// Description of the device's quads, and the transport that they allow.
    pub quads: String,
    /// The scene's triangles, which shadow filters are drawn with.
    pub triangles: usize,
    /// Milliseconds of the pass that draws the coordinates that dispatched shadow filters read: the median of all rounds. It
    /// is part of those filters' times.
    pub coordinates_ms: f64,
    /// Every way, a filter's one after the other; the first of a filter is what others are compared with.
    pub ways: Vec<QuadWay>,
}

/// A way to compute a filter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuadWay {
    /// The filter.
    pub filter: String,
    /// Name of the way: the data that it shares.
    pub way: String,
    /// Communication of lanes: `none`, or a transport.
    pub transport: String,
    /// Compute or fragment.
    pub stage: Stage,
    /// True if the filter is drawn with the scene's triangles, or reads what another pass has drawn of them.
    pub forward: bool,
    /// Reads of textures, of a pixel; of an invocation for four pixels, if it is one.
    pub reads: u32,
    /// Messages of an invocation.
    pub messages: u32,
    /// Statements of the shader.
    pub statements: u32,
    /// Milliseconds: the median of all rounds.
    pub median_ms: f64,
    /// The time of each round.
    pub rounds_ms: Vec<f64>,
    /// Speedup over the filter's first way, round by round: the median, and the interval in which it lies
    /// with a probability of 95 %.
    pub speedup: Interval,
    /// The mean over all pixels of the largest difference of a colour's components to the filter's first way. In shadow filters,
    /// over all pixels that triangles cover.
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
