//! Runtime values of type `usize`, 64 bits natively, in the 32 bits of a shader.
//!
//! A `usize` becomes an `i32` if its bits fit there, otherwise a `u32` with the lower bits of the native value. An
//! operation that depends on more than lower bits (`/`, `%`, `<`, `as f32`, ...) is translated if the possible values of
//! its operands prove that it has the native result. An index that may be too large for that is first clamped to a bound
//! beyond every array and buffer. All other operations are rejected.

mod analysis;
mod extent;
mod lower;
mod refuse;

use crate::ir::{Graph, NodeId, Rebuild, rebuild_replacing};
use analysis::{Analysis, is_wide};
use std::collections::{HashMap, HashSet};

pub use refuse::Refusal;

/// Facts about values of type `usize`, from the evaluation.
#[derive(Default)]
pub struct Facts {
    /// Computed counters, with the start and the end of their ranges.
    pub counters: HashMap<NodeId, (NodeId, NodeId)>,
    /// Differences that wrap intentionally.
    pub wrapping: HashSet<NodeId>,
}

/// Caps for numbers that are too large to compute with.
const CAPS: [i128; 4] = [1 << 30, 1 << 28, 1 << 24, 1 << 20];

/// Returns the kernel without `usize`; `None` if it has none.
///
/// # Errors
///
/// Operations whose results may differ from the native ones.
pub fn narrow_usize(graph: &Graph, facts: &Facts) -> Result<Option<Graph>, Vec<Refusal>> {
    if !graph.node_ids().any(|id| is_wide(graph, id)) {
        return Ok(None);
    }
    let mut caps: HashMap<NodeId, i128> = HashMap::new();
    loop {
        let analysis = Analysis::from_graph(graph, facts, &caps);
        let mut lower = lower::Lower::new(&analysis, &caps);
        let rebuild = Rebuild {
            rules: &super::Exact,
            share_loads: false,
        };
        let narrowed = rebuild_replacing(graph, &rebuild, &mut lower);
        let refused = lower.into_refused();
        if refused.is_empty() {
            return Ok(Some(narrowed));
        }
        let leaves = refuse::source_conversions(graph, &refused);
        let mut next = caps.clone();
        for leaf in leaves {
            let before = caps.get(&leaf).copied().unwrap_or(i128::MAX);
            if let Some(cap) = CAPS.into_iter().find(|cap| *cap < before) {
                next.insert(leaf, cap);
            }
        }
        if next == caps {
            // Report the original extents, not those of attempted caps. An operation that a cap fixes is no error.
            let none = HashMap::new();
            let analysis = Analysis::from_graph(graph, facts, &none);
            let mut lower = lower::Lower::new(&analysis, &none);
            rebuild_replacing(graph, &rebuild, &mut lower);
            let mut first = lower.into_refused();
            first.retain(|id| refused.contains(id));
            let refused = if first.is_empty() { refused } else { first };
            return Err(refuse::collect_refusals(graph, &refused));
        }
        caps = next;
    }
}
