//! Facts on exact operations: which are written in one statement with their mark, and which arithmetic goes on from.

use crate::compiled::Compiled;
use straightline_evaluator::ir::{NodeId, Op};

/// Facts about exact operations, by node.
pub struct Exactness {
    parts: Vec<bool>,
    goes_on: Vec<bool>,
}

impl Exactness {
    /// Of the operations of a kernel.
    pub fn from_compiled(compiled: &Compiled) -> Exactness {
        let (graph, schedule) = (&compiled.graph, &compiled.schedule);
        let mut parts = vec![false; graph.nodes.len()];
        let mut goes_on = vec![false; graph.nodes.len()];
        // The next iteration uses the values that a loop carries, and the statements after a branch use its results.
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
                // Bits, whole numbers and what is given to the host are of one rounding.
                Op::Convert | Op::Bitcast => false,
                op => !(op.is_effect() || op.is_read()),
            };
            for arg in &node.args {
                goes_on[arg.0 as usize] |= further;
            }
        }
        Exactness { parts, goes_on }
    }

    /// Tells if an operation is written in the statement of its mark.
    pub fn is_part(&self, id: NodeId) -> bool {
        self.parts[id.0 as usize]
    }

    /// Tells if arithmetic goes on from a value.
    pub fn goes_on(&self, id: NodeId) -> bool {
        self.goes_on[id.0 as usize]
    }
}
