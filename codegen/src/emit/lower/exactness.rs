//! Facts about exact operations: those emitted as part of a marked statement, and those that further arithmetic uses.

use crate::compiled::Compiled;
use straightline_evaluator::ir::{NodeId, Op};

/// Facts about exact operations, by node.
pub struct Exactness {
    parts: Vec<bool>,
    goes_on: Vec<bool>,
}

impl Exactness {
    /// Collects the facts for a kernel.
    pub fn from_compiled(compiled: &Compiled) -> Exactness {
        let (graph, schedule) = (&compiled.graph, &compiled.schedule);
        let mut parts = vec![false; graph.nodes.len()];
        let mut goes_on = vec![false; graph.nodes.len()];
        // The next iteration uses a loop's carried values, and the statements after a branch use its results.
        for region in graph.regions.iter().skip(1) {
            region.yielded_values().for_each(|id| goes_on[id.0 as usize] = true);
        }
        for id in graph.node_ids().rev().filter(|id| schedule.has_node(*id)) {
            let node = graph.node(id);
            let further = match &node.op {
                Op::Exact => {
                    let of = node.args[0];
                    parts[of.0 as usize] = schedule.uses[of.0 as usize] == 1 && graph.node(of).op.is_rounding();
                    continue;
                }
                Op::Compose | Op::Splat | Op::Extract(_) | Op::Tally(_) | Op::MakeArray => goes_on[id.0 as usize],
                // Bits, whole numbers and outputs are not rounded further.
                Op::Convert | Op::Bitcast => false,
                op => !(op.is_effect() || op.is_read()),
            };
            for arg in &node.args {
                goes_on[arg.0 as usize] |= further;
            }
        }
        Exactness { parts, goes_on }
    }

    /// Returns whether an operation is emitted as part of its mark's statement.
    pub fn is_part(&self, id: NodeId) -> bool {
        self.parts[id.0 as usize]
    }

    /// Returns whether further arithmetic uses a value.
    pub fn goes_on(&self, id: NodeId) -> bool {
        self.goes_on[id.0 as usize]
    }
}
