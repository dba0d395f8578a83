//! Interference of array versions that are live at the same time, computed from the end of the schedule to its beginning.
//!
//! A version is written when it is created, carried into a loop, or yielded by a branch. All other versions live after that
//! write must be in other variables, unless only elements of them are read that the new version shares.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use straightline_evaluator::ir::{Graph, NodeId, Op, RegionId, Type};
use straightline_evaluator::passes::{Block, Schedule, Step};

/// Pairs of versions of which one is live where the other is written; symmetric.
pub type Interference = HashMap<NodeId, HashSet<NodeId>>;

/// Versions that are live after a place.
type Needed = BTreeMap<NodeId, Elements>;

/// Elements of an array that are read.
#[derive(Clone, Debug, PartialEq)]
enum Elements {
    /// All, or some that are not known.
    All,
    /// Elements with these indices.
    Only(BTreeSet<u32>),
}

impl Elements {
    fn add(&mut self, other: Elements) {
        match (&mut *self, other) {
            (Elements::Only(known), Elements::Only(other)) => known.extend(other),
            _ => *self = Elements::All,
        }
    }
}

/// Number of writes between two versions after which they are assumed to share no element.
const FAR: usize = 64;

/// Finds the interference of the arrays of a scheduled graph.
pub fn find_interference(graph: &Graph, schedule: &Schedule) -> Interference {
    let mut walk = Walk {
        graph,
        found: Interference::new(),
        results: results_by_owner(graph),
    };
    walk.walk_block(&schedule.body, &mut Needed::new());
    walk.found
}

/// Returns the version that a node stands for. Literals are not versions: they are copied where they are used. The result
/// of a loop stands for the version that the loop carried.
pub fn array_version(graph: &Graph, id: NodeId) -> Option<NodeId> {
    let node = graph.node(id);
    match node.op {
        _ if !node.ty.is_array() => None,
        Op::MakeArray | Op::Undef => None,
        Op::Result(k) => match graph.node(node.args[0]).op {
            Op::Loop(body) => Some(graph.region(body).params[k as usize + 1]),
            _ => Some(id),
        },
        _ => Some(id),
    }
}

/// Returns the result nodes of loops and branches, by their owners, with their numbers.
fn results_by_owner(graph: &Graph) -> HashMap<NodeId, Vec<(NodeId, usize)>> {
    let mut results: HashMap<NodeId, Vec<(NodeId, usize)>> = HashMap::new();
    for id in graph.node_ids() {
        if let Op::Result(k) = graph.node(id).op {
            results
                .entry(graph.node(id).args[0])
                .or_default()
                .push((id, k as usize));
        }
    }
    results
}

struct Walk<'g> {
    graph: &'g Graph,
    found: Interference,
    results: HashMap<NodeId, Vec<(NodeId, usize)>>,
}

impl Walk<'_> {
    fn walk_block(&mut self, block: &Block, needed: &mut Needed) {
        for step in block.steps.iter().rev() {
            match step {
                Step::Eval(id) => {
                    let node = self.graph.node(*id);
                    if node.op == Op::ArraySet {
                        self.write_version(*id, needed);
                    }
                    match node.op {
                        Op::Result(_) => {}
                        Op::ArrayGet => {
                            let read = element_index(self.graph, *id);
                            let read = read.map_or(Elements::All, |index| Elements::Only(BTreeSet::from([index])));
                            self.read_elements(node.args[0], read, needed);
                        }
                        _ => node.args.iter().for_each(|arg| self.read_version(*arg, needed)),
                    }
                }
                Step::Loop { node, body } => self.walk_loop(*node, body, needed),
                Step::If { node, then, otherwise } => self.walk_branch(*node, then, otherwise, needed),
            }
        }
    }

    fn walk_loop(&mut self, node: NodeId, body: &Block, needed: &mut Needed) {
        let inside = self.graph.regions_of(node)[0];
        let region = self.graph.region(inside);
        // Values from outside that the next iteration reads are live at the end of each iteration.
        let mut outside = BTreeSet::new();
        self.collect_read(inside, body, &mut outside);
        let outside: Needed = outside.into_iter().map(|version| (version, Elements::All)).collect();
        needed.extend(outside.clone());
        let carried = |k: usize| region.params[k + 1];
        (0..region.results.len()).for_each(|k| self.write_version(carried(k), needed));
        region.yielded_values().for_each(|id| self.read_version(id, needed));
        self.walk_block(body, needed);
        needed.extend(outside);
        for (k, init) in self.graph.node(node).args[2..].iter().enumerate().rev() {
            self.write_version(carried(k), needed);
            self.read_version(*init, needed);
        }
    }

    fn walk_branch(&mut self, node: NodeId, then: &Block, otherwise: &Block, needed: &mut Needed) {
        let behind = std::mem::take(needed);
        let left = self.results.get(&node).cloned().unwrap_or_default();
        for (region, block) in self.graph.regions_of(node).into_iter().zip([then, otherwise]) {
            let mut side = behind.clone();
            // Assignments run in sequence: the assignment of one result must not overwrite the source of the next.
            for (result, k) in left.iter().rev() {
                self.write_version(*result, &mut side);
                self.read_version(self.graph.region(region).results[*k], &mut side);
            }
            self.walk_block(block, &mut side);
            for (version, elements) in side {
                add_needed(needed, version, elements);
            }
        }
    }

    /// Records a write to a version: all other live versions interfere with it.
    fn write_version(&mut self, id: NodeId, needed: &mut Needed) {
        let Some(version) = array_version(self.graph, id) else {
            return;
        };
        needed.remove(&version);
        for (other, elements) in needed.iter() {
            if self.shares(version, *other, elements) {
                continue;
            }
            self.found.entry(version).or_default().insert(*other);
            self.found.entry(*other).or_default().insert(version);
        }
    }

    fn read_version(&self, id: NodeId, needed: &mut Needed) {
        self.read_elements(id, Elements::All, needed);
    }

    fn read_elements(&self, id: NodeId, elements: Elements, needed: &mut Needed) {
        if let Some(version) = array_version(self.graph, id) {
            add_needed(needed, version, elements);
        }
    }

    /// Returns whether a version was made from another one by writes to elements other than `elements`.
    fn shares(&self, version: NodeId, other: NodeId, elements: &Elements) -> bool {
        let Elements::Only(elements) = elements else {
            return false;
        };
        let mut at = version;
        for _ in 0..FAR {
            let node = self.graph.node(at);
            let written = element_index(self.graph, at).filter(|_| node.op == Op::ArraySet);
            if written.is_none_or(|written| elements.contains(&written)) {
                return false;
            }
            match array_version(self.graph, node.args[0]) {
                Some(base) if base == other => return true,
                Some(base) => at = base,
                None => return false,
            }
        }
        false
    }

    /// Collects the versions that a loop's body reads and does not create.
    fn collect_read(&self, region: RegionId, body: &Block, read: &mut BTreeSet<NodeId>) {
        let mut made: BTreeSet<NodeId> = self.graph.region(region).params.iter().copied().collect();
        self.collect_versions(body, read, &mut made);
        self.graph
            .region(region)
            .yielded_values()
            .for_each(|id| read.extend(array_version(self.graph, id)));
        read.retain(|version| !made.contains(version));
    }

    fn collect_versions(&self, block: &Block, read: &mut BTreeSet<NodeId>, made: &mut BTreeSet<NodeId>) {
        for step in &block.steps {
            let (node, blocks): (_, &[&Block]) = match step {
                Step::Eval(id) => (*id, &[]),
                Step::Loop { node, body } => (*node, &[body]),
                Step::If { node, then, otherwise } => (*node, &[then, otherwise]),
            };
            self.graph
                .node(node)
                .args
                .iter()
                .for_each(|arg| read.extend(array_version(self.graph, *arg)));
            made.extend(array_version(self.graph, node));
            let results = self.results.get(&node).into_iter().flatten();
            made.extend(results.filter_map(|(id, _)| array_version(self.graph, *id)));
            for region in self.graph.regions_of(node) {
                made.extend(&self.graph.region(region).params);
                self.graph
                    .region(region)
                    .yielded_values()
                    .for_each(|id| read.extend(array_version(self.graph, id)));
            }
            blocks.iter().for_each(|block| self.collect_versions(block, read, made));
        }
    }
}

fn add_needed(needed: &mut Needed, version: NodeId, elements: Elements) {
    match needed.get_mut(&version) {
        Some(known) => known.add(elements),
        None => _ = needed.insert(version, elements),
    }
}

/// Returns the index of the element that an operation reads or writes, if it is a constant inside the array.
fn element_index(graph: &Graph, id: NodeId) -> Option<u32> {
    let args = &graph.node(id).args;
    let [index, ..] = graph.constant_bits(*args.get(1)?)?;
    matches!(graph.ty(args[0]), Type::Array { len, .. } if index < len).then_some(index)
}
