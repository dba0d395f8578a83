//! Static counts of the operations that one invocation executes.

use super::ranges;
use super::schedule::{Block, Schedule, Step};
use crate::ir::{Graph, Memory, NodeId, Op, SharedArray, Type};
use std::collections::BTreeMap;
use straightline_manifest::Counts;

/// The texture that a filter filters. Its reads are counted separately.
const FILTERED: &str = "color";

/// Counts the operations that one invocation executes. A loop with a runtime trip count counts as one iteration.
/// `statements` and `max_live` are known only after emission and are left 0.
pub fn count_operations(graph: &Graph, schedule: &Schedule) -> Counts {
    let run = Counter { graph }.block(&schedule.body);
    let reads: BTreeMap<String, u32> = run.reads;
    let colour_reads = reads.get(FILTERED).copied().unwrap_or(0);
    Counts {
        basic_blocks: basic_blocks(graph, &schedule.body),
        loops: count_loops(&schedule.body),
        texture_reads: reads
            .values()
            .fold(0, |sum: u32, n| sum.saturating_add(*n))
            .saturating_sub(colour_reads),
        colour_reads,
        reads,
        tallies: run.tallies,
        transcendentals: run.transcendentals,
        messages: run.messages,
        writes: run.writes,
        shared_reads: run.shared_reads,
        barriers: run.barriers,
        shared_memory: shared_memory(graph, schedule),
        exact: run.exact,
        alu: run.alu,
        statements: 0,
        max_live: 0,
        max_live_at: String::new(),
    }
}

#[derive(Clone, Default)]
struct RunCounts {
    reads: BTreeMap<String, u32>,
    tallies: BTreeMap<String, u32>,
    transcendentals: u32,
    messages: u32,
    writes: u32,
    shared_reads: u32,
    barriers: u32,
    exact: u32,
    alu: u32,
}

impl RunCounts {
    fn add(&mut self, other: &RunCounts, times: u32) {
        for (name, n) in &other.reads {
            let slot = self.reads.entry(name.clone()).or_default();
            *slot = slot.saturating_add(n.saturating_mul(times));
        }
        for (name, n) in &other.tallies {
            let slot = self.tallies.entry(name.clone()).or_default();
            *slot = slot.saturating_add(n.saturating_mul(times));
        }
        self.transcendentals = self
            .transcendentals
            .saturating_add(other.transcendentals.saturating_mul(times));
        self.messages = self.messages.saturating_add(other.messages.saturating_mul(times));
        self.writes = self.writes.saturating_add(other.writes.saturating_mul(times));
        self.shared_reads = self
            .shared_reads
            .saturating_add(other.shared_reads.saturating_mul(times));
        self.barriers = self.barriers.saturating_add(other.barriers.saturating_mul(times));
        self.exact = self.exact.saturating_add(other.exact.saturating_mul(times));
        self.alu = self.alu.saturating_add(other.alu.saturating_mul(times));
    }

    /// Maximum of two alternatives in each figure.
    fn max(mut self, other: RunCounts) -> RunCounts {
        for (name, n) in other.reads {
            let slot = self.reads.entry(name).or_default();
            *slot = n.max(*slot);
        }
        for (name, n) in other.tallies {
            let slot = self.tallies.entry(name).or_default();
            *slot = n.max(*slot);
        }
        self.transcendentals = self.transcendentals.max(other.transcendentals);
        self.messages = self.messages.max(other.messages);
        self.writes = self.writes.max(other.writes);
        self.shared_reads = self.shared_reads.max(other.shared_reads);
        self.barriers = self.barriers.max(other.barriers);
        self.exact = self.exact.max(other.exact);
        self.alu = self.alu.max(other.alu);
        self
    }
}

struct Counter<'g> {
    graph: &'g Graph,
}

impl Counter<'_> {
    fn block(&self, block: &Block) -> RunCounts {
        let mut run = RunCounts::default();
        for step in &block.steps {
            match step {
                Step::Eval(id) => self.node(*id, &mut run),
                Step::Loop { node, body } => run.add(&self.block(body), max_trip_count(self.graph, *node).unwrap_or(1)),
                Step::If { then, otherwise, .. } => run.add(&self.block(then).max(self.block(otherwise)), 1),
            }
        }
        run
    }

    fn node(&self, id: NodeId, run: &mut RunCounts) {
        match &self.graph.node(id).op {
            op if op.is_read() => {
                let texture = op.texture().map(|t| &self.graph.textures[t as usize].name);
                let buffer = op.buffer().map(|b| &self.graph.buffers[b as usize].name);
                if let Some(name) = texture.or(buffer) {
                    let slot = run.reads.entry(name.clone()).or_default();
                    *slot = slot.saturating_add(1);
                }
            }
            Op::Tally(name) => {
                let slot = run
                    .tallies
                    .entry(self.graph.tallies[*name as usize].clone())
                    .or_default();
                *slot = slot.saturating_add(1);
            }
            Op::Exact => run.exact = run.exact.saturating_add(1),
            Op::Unary(op) if op.is_transcendental() => run.transcendentals = run.transcendentals.saturating_add(1),
            Op::Binary(crate::ir::BinaryOp::Pow | crate::ir::BinaryOp::Atan2) => {
                run.transcendentals = run.transcendentals.saturating_add(1)
            }
            Op::SharedLoad(_) => run.shared_reads = run.shared_reads.saturating_add(1),
            Op::Barrier { .. } => run.barriers = run.barriers.saturating_add(1),
            Op::Store(Memory::Shared(_))
            | Op::Atomic {
                memory: Memory::Shared(_),
                ..
            } => {}
            effect if effect.is_effect() => run.writes = run.writes.saturating_add(1),
            Op::QuadSwap(_) | Op::Derivative(_) => run.messages = run.messages.saturating_add(1),
            Op::Unary(_) | Op::Binary(_) | Op::Dot | Op::Cross | Op::Clamp | Op::Select | Op::Convert | Op::Bitcast => {
                run.alu = run.alu.saturating_add(1)
            }
            _ => {}
        }
    }
}

/// Bytes of shared memory that are used.
fn shared_memory(graph: &Graph, schedule: &Schedule) -> u32 {
    let live = |id: &NodeId| schedule.has_node(*id);
    let used = |k: usize| {
        let memory = Some(Memory::Shared(k as u32));
        graph
            .node_ids()
            .filter(live)
            .any(|id| graph.node(id).op.memory() == memory)
    };
    let shared = graph.shared.iter().enumerate();
    let bytes: u64 = shared
        .filter(|(k, _)| used(*k))
        .map(|(_, s)| SharedArray::byte_size(s))
        .sum();
    u32::try_from(bytes).unwrap_or(u32::MAX)
}

/// Layers supported by the largest GPUs. An index with a larger bound counts as unbounded.
const MAX_LAYERS: i64 = 2048;

/// Number of layers, or samples, of a texture that reads can reach: one more than the largest index; 1 if only their number
/// is queried. Returns `None` if an index is not bounded by a compile-time constant.
pub fn layers_read(graph: &Graph, texture: u32) -> Option<u32> {
    let mut layers = 1;
    if !graph.textures[texture as usize].is_counted() {
        return Some(layers);
    }
    for id in graph.node_ids() {
        let node = graph.node(id);
        if matches!(node.op, Op::Load { texture: t, .. } if t == texture)
            && let Some(layer) = node.args.get(1)
        {
            let (_, largest) = ranges::integer_bounds(graph, *layer).filter(|(_, largest)| *largest < MAX_LAYERS)?;
            layers = layers.max(u32::try_from(largest.max(0)).ok()?.checked_add(1)?);
        }
    }
    Some(layers)
}

/// Returns the maximum trip count of a loop, if both bounds are known.
pub(super) fn max_trip_count(graph: &Graph, node: NodeId) -> Option<u32> {
    let endless = graph.constant_bits(graph.node(node).args[1]) == Some([Graph::ENDLESS as u32, 0, 0, 0]);
    if endless && graph.region(graph.regions_of(node)[0]).stop.is_some() {
        return None;
    }
    let bound = |arg: usize| {
        let id = graph.node(node).args[arg];
        let bits = graph.constant_bits(id)?[0];
        Some(match graph.ty(id) {
            Type::U32 => i64::from(bits),
            _ => i64::from(bits as i32),
        })
    };
    // The difference always fits a u32.
    Some((bound(1)? - bound(0)?).max(0) as u32)
}

fn basic_blocks(graph: &Graph, block: &Block) -> u32 {
    let inner = block.steps.iter().map(|step| match step {
        Step::Eval(_) => 0,
        // The test, the body, and the code after it.
        Step::Loop { node, body } => {
            let stops = graph.region(graph.regions_of(*node)[0]).stop.is_some();
            2 + u32::from(stops) + basic_blocks(graph, body)
        }
        Step::If { then, otherwise, .. } if otherwise.steps.is_empty() => 1 + basic_blocks(graph, then),
        Step::If { then, otherwise, .. } => 1 + basic_blocks(graph, then) + basic_blocks(graph, otherwise),
    });
    1 + inner.sum::<u32>()
}

fn count_loops(block: &Block) -> u32 {
    let inner = block.steps.iter().map(|step| match step {
        Step::Eval(_) => 0,
        Step::Loop { body, .. } => 1 + count_loops(body),
        Step::If { then, otherwise, .. } => count_loops(then) + count_loops(otherwise),
    });
    inner.sum()
}
