//! Region and order of evaluation of each node.
//!
//! A node moves as far out of loops as its arguments allow, and as far into branches as its uses allow (Click's global code
//! motion). Within a block, nodes keep their order of creation, which is that of the source, unless reads come first. Array
//! reads and writes stay where they were created, so that one variable can hold the array and be changed in place. Effects
//! stay in their regions, and so keep their order.

use super::reads::rows_first;
use crate::ir::{Graph, NodeId, Op, RegionId};
use crate::policy::ReadOrder;

/// An order of evaluation: every used node once, after its arguments.
#[derive(Clone, Debug)]
pub struct Schedule {
    /// The body of the kernel.
    pub body: Block,
    /// Number of uses of each value, by node: as an argument or as a region's result.
    pub uses: Vec<u32>,
    /// Region in which each node is evaluated, by node; `None` if unused.
    pub place: Vec<Option<RegionId>>,
}

impl Schedule {
    /// Returns whether a node is evaluated.
    pub fn has_node(&self, id: NodeId) -> bool {
        self.place[id.0 as usize].is_some()
    }
}

/// Steps of one region, in order.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// Steps, first to last.
    pub steps: Vec<Step>,
}

/// A step of a block.
#[derive(Clone, Debug)]
pub enum Step {
    /// Evaluates a node.
    Eval(NodeId),
    /// Runs the loop that `node` represents.
    Loop {
        /// The `Op::Loop` node.
        node: NodeId,
        /// Body of the loop.
        body: Block,
    },
    /// Runs one side of the branch that `node` represents.
    If {
        /// The `Op::If` node.
        node: NodeId,
        /// Side taken if the condition holds.
        then: Block,
        /// Side taken otherwise.
        otherwise: Block,
    },
}

/// Determines region and order of the nodes that the output depends on.
pub fn schedule_graph(graph: &Graph, reads: ReadOrder) -> Schedule {
    let mut places = Placement::new(graph);
    places.place_nodes();
    let mut steps: Vec<Vec<NodeId>> = vec![Vec::new(); graph.regions.len()];
    for id in graph.node_ids() {
        if let Some(region) = places.place[id.0 as usize]
            && !matches!(graph.node(id).op, Op::Param(..))
        {
            steps[region.0 as usize].push(id);
        }
    }
    if reads == ReadOrder::Rows {
        rows_first(graph, &places.place, &mut steps);
    }
    let body = build_block(graph, &steps, Graph::BODY);
    Schedule {
        body,
        uses: places.uses,
        place: places.place,
    }
}

fn build_block(graph: &Graph, steps: &[Vec<NodeId>], region: RegionId) -> Block {
    let step = |id: &NodeId| match graph.node(*id).op {
        Op::Loop(body) => Step::Loop {
            node: *id,
            body: build_block(graph, steps, body),
        },
        Op::If(then, otherwise) => Step::If {
            node: *id,
            then: build_block(graph, steps, then),
            otherwise: build_block(graph, steps, otherwise),
        },
        _ => Step::Eval(*id),
    };
    Block {
        steps: steps[region.0 as usize].iter().map(step).collect(),
    }
}

struct Placement<'g> {
    graph: &'g Graph,
    /// Nesting depth of each region, and of loops alone in `loops`.
    depth: Vec<u32>,
    loops: Vec<u32>,
    /// Region of an effect, by node.
    happens: Vec<Option<RegionId>>,
    /// Earliest possible region of each node. A loop or branch stays in the region that contains it.
    early: Vec<RegionId>,
    place: Vec<Option<RegionId>>,
    uses: Vec<u32>,
}

impl<'g> Placement<'g> {
    fn new(graph: &'g Graph) -> Self {
        let mut depth = vec![0; graph.regions.len()];
        let mut loops = vec![0; graph.regions.len()];
        for (k, region) in graph.regions.iter().enumerate().skip(1) {
            let parent = region.parent.unwrap_or(Graph::BODY).0 as usize;
            depth[k] = depth[parent] + 1;
            loops[k] = loops[parent] + u32::from(!region.params.is_empty());
        }
        let nodes = graph.nodes.len();
        let mut happens = vec![None; nodes];
        for (k, region) in graph.regions.iter().enumerate() {
            for id in &region.effects {
                happens[id.0 as usize] = Some(RegionId(k as u32));
            }
        }
        Placement {
            graph,
            depth,
            loops,
            happens,
            early: vec![Graph::BODY; nodes],
            place: vec![None; nodes],
            uses: vec![0; nodes],
        }
    }

    fn place_nodes(&mut self) {
        for id in self.graph.node_ids() {
            self.early[id.0 as usize] = self.earliest_region(id);
        }
        // Latest place: the common region of all uses. Users have larger ids, so one reverse sweep visits them first. A
        // region's results are used at its end, which is visited with the loop or branch.
        let mut late: Vec<Option<RegionId>> = vec![None; self.graph.nodes.len()];
        for output in self.graph.outputs() {
            late[output.0 as usize] = Some(Graph::BODY);
            self.uses[output.0 as usize] += 1;
        }
        for effect in &self.graph.regions[0].effects {
            late[effect.0 as usize] = Some(Graph::BODY);
        }
        for id in self.graph.node_ids().rev() {
            let Some(latest) = late[id.0 as usize] else { continue };
            let here = self.choose_region(id, latest);
            self.place[id.0 as usize] = Some(here);
            for arg in &self.graph.node(id).args {
                self.record_use(&mut late, *arg, here);
            }
            for region in self.graph.regions_of(id) {
                for result in self.graph.region(region).yielded_values() {
                    self.record_use(&mut late, result, region);
                }
                for effect in &self.graph.region(region).effects {
                    late[effect.0 as usize].get_or_insert(region);
                }
                for param in &self.graph.region(region).params {
                    late[param.0 as usize] = Some(region);
                }
            }
        }
    }

    fn record_use(&mut self, late: &mut [Option<RegionId>], id: NodeId, at: RegionId) {
        self.uses[id.0 as usize] += 1;
        let slot = &mut late[id.0 as usize];
        *slot = Some(match *slot {
            None => at,
            Some(other) => self.common_region(other, at),
        });
    }

    /// Earliest possible region of a node: that of the innermost parameter that it depends on.
    fn earliest_region(&self, id: NodeId) -> RegionId {
        let node = self.graph.node(id);
        if let Op::Param(region, _) = node.op {
            return region;
        }
        if let (true, Some(region)) = (node.op.is_effect(), self.happens[id.0 as usize]) {
            return region;
        }
        if let Some(first) = self.graph.regions_of(id).first() {
            return self.graph.region(*first).parent.unwrap_or(Graph::BODY);
        }
        let deepest = |a: RegionId, b: RegionId| {
            if self.depth[b.0 as usize] > self.depth[a.0 as usize] {
                b
            } else {
                a
            }
        };
        node.args
            .iter()
            .map(|arg| self.early[arg.0 as usize])
            .fold(Graph::BODY, deepest)
    }

    /// Returns the innermost region with the fewest enclosing loops, searching outwards from the latest to the earliest.
    fn choose_region(&self, id: NodeId, latest: RegionId) -> RegionId {
        let early = self.early[id.0 as usize];
        let node = self.graph.node(id);
        if !self.graph.regions_of(id).is_empty() || matches!(node.op, Op::Param(..)) || node.op.is_effect() {
            return early;
        }
        if matches!(node.op, Op::Result(_)) {
            return self.place_of_owner(node.args[0]);
        }
        // An array literal is an ordinary value. Written versions of an array stay where they were created, as do reads of
        // them.
        if (node.ty.is_array() && node.op != Op::MakeArray) || matches!(node.op, Op::ArrayGet) {
            // Not before its operands, which may come from an earlier branch.
            let home = self.common_region(self.graph.homes[id.0 as usize], latest);
            let deeper = self.depth[early.0 as usize] > self.depth[home.0 as usize];
            return if deeper { early } else { home };
        }
        let mut best = latest;
        let mut at = latest;
        while at != early {
            let Some(parent) = self.graph.region(at).parent else {
                break;
            };
            at = parent;
            if self.loops[at.0 as usize] < self.loops[best.0 as usize] {
                best = at;
            }
        }
        best
    }

    fn place_of_owner(&self, owner: NodeId) -> RegionId {
        self.early[owner.0 as usize]
    }

    fn common_region(&self, mut a: RegionId, mut b: RegionId) -> RegionId {
        while a != b {
            let deeper = if self.depth[a.0 as usize] >= self.depth[b.0 as usize] {
                &mut a
            } else {
                &mut b
            };
            *deeper = self.graph.region(*deeper).parent.unwrap_or(Graph::BODY);
        }
        a
    }
}
