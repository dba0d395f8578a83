//! Which values get a statement of their own, and which are written where they are used.

use crate::ir::{Graph, NodeId, Op, Origin, RegionId};
use crate::passes::Schedule;

/// Decides by use and origin alone; the emitter adds statements where an expression would grow too long.
pub struct Plan<'a> {
    graph: &'a Graph,
    /// By node: uses, those of a tally counted for what it tallies.
    uses: Vec<u32>,
    /// By node: whether it is used in another region than it is evaluated in.
    crosses: Vec<bool>,
    /// By node: where it comes from, for naming.
    origins: Vec<Option<&'a Origin>>,
}

impl<'a> Plan<'a> {
    /// Plans a scheduled graph.
    pub fn new(graph: &'a Graph, schedule: &Schedule) -> Plan<'a> {
        let mut plan = Plan {
            graph,
            uses: schedule.uses.clone(),
            crosses: vec![false; graph.nodes.len()],
            origins: graph.ids().map(|id| graph.origin(id)).collect(),
        };
        let live: Vec<NodeId> = graph
            .ids()
            .filter(|id| schedule.place[id.0 as usize].is_some())
            .collect();
        for id in &live {
            let here = schedule.place[id.0 as usize];
            for arg in &graph.node(*id).args {
                plan.used_in(*arg, here, schedule);
            }
            for region in graph.regions_of(*id) {
                for result in &graph.region(region).results {
                    plan.used_in(*result, Some(region), schedule);
                }
            }
        }
        // A tally is what it tallies: uses and name pass on to it, last to first so that chains do too.
        for id in live
            .iter()
            .rev()
            .filter(|id| matches!(graph.node(**id).op, Op::Tally(_)))
        {
            let (slot, arg) = (id.0 as usize, graph.node(*id).args[0].0 as usize);
            plan.uses[arg] = plan.uses[arg] - 1 + plan.uses[slot];
            plan.crosses[arg] |= plan.crosses[slot];
            plan.origins[arg] = plan.origins[arg].or(plan.origins[slot]);
        }
        plan
    }

    fn used_in(&mut self, id: NodeId, region: Option<RegionId>, schedule: &Schedule) {
        self.crosses[id.0 as usize] |= schedule.place[id.0 as usize] != region;
    }

    /// Where a node comes from.
    pub fn origin(&self, id: NodeId) -> Option<&'a Origin> {
        self.origins[id.0 as usize]
    }

    /// Whether a node is evaluated in a statement of its own.
    pub fn is_statement(&self, id: NodeId) -> bool {
        let node = self.graph.node(id);
        match node.op {
            Op::Const(_)
            | Op::Pixel
            | Op::FrameSize
            | Op::Uniform(_)
            | Op::Varying(_)
            | Op::Param(..)
            | Op::Result(_)
            | Op::Tally(_) => false,
            Op::Loop(_) | Op::If(..) | Op::MakeArray | Op::ArraySet => false,
            Op::ArrayGet => true,
            ref op if op.is_read() => true,
            Op::Extract(_) | Op::Splat if self.is_atom(node.args[0]) => false,
            _ => {
                let slot = id.0 as usize;
                self.uses[slot] > 1 || self.crosses[slot] || self.origins[slot].is_some_and(|o| !o.name.is_empty())
            }
        }
    }

    /// Whether a node's text is a name or a literal.
    fn is_atom(&self, id: NodeId) -> bool {
        let node = self.graph.node(id);
        match node.op {
            Op::Const(_)
            | Op::Pixel
            | Op::FrameSize
            | Op::Uniform(_)
            | Op::Varying(_)
            | Op::Param(..)
            | Op::Result(_) => true,
            Op::Tally(_) => self.is_atom(node.args[0]),
            Op::Extract(_) | Op::Splat => self.is_atom(node.args[0]),
            _ => self.is_statement(id),
        }
    }
}
