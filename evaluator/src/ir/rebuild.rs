//! Rebuilding of a graph without unused nodes: the frame of every pass.
//!
//! File tests: `evaluator/tests/filetests/passes/rebuild`.

use super::{Builder, Event, Graph, NodeId, Op, Region, RegionId, Rules, Type};
use std::sync::Arc;

/// Options for rebuilding a graph.
pub struct Rebuild<'a> {
    /// Simplifications to apply.
    pub rules: &'a dyn Rules,
    /// `true` if reads of the same texel are merged.
    pub share_loads: bool,
}

/// Replacements for nodes while a graph is rebuilt, and nodes placed before all of them.
pub trait Replace {
    /// Adds the nodes that come first.
    fn add_prologue(&mut self, builder: &mut Builder<'_>);

    /// Returns the replacement of a node of the old graph; `None` to copy the node. `new` contains the replacements of
    /// earlier nodes.
    fn replace_node(&mut self, builder: &mut Builder<'_>, old: NodeId, new: &[Option<NodeId>]) -> Option<NodeId>;

    /// Type of a parameter or result whose old type was `ty`.
    fn replace_type(&self, _old: NodeId, ty: Type) -> Type {
        ty
    }

    /// Replacement of the start or end of the loop of `region`, in the type of its counter; `None` for the general
    /// replacement.
    fn replace_bound(
        &mut self,
        _builder: &mut Builder<'_>,
        _region: RegionId,
        _old: NodeId,
        _new: &[Option<NodeId>],
    ) -> Option<NodeId> {
        None
    }

    /// Replacement of result `k` of `region`, or of the initial carried value of its loop, in the type of the result;
    /// `None` for the general replacement.
    fn replace_passed(
        &mut self,
        _builder: &mut Builder<'_>,
        _region: RegionId,
        _k: usize,
        _old: NodeId,
        _new: &[Option<NodeId>],
    ) -> Option<NodeId> {
        None
    }
}

/// Copies every node unchanged.
struct CopyAll;

impl Replace for CopyAll {
    fn add_prologue(&mut self, _: &mut Builder<'_>) {}

    fn replace_node(&mut self, _: &mut Builder<'_>, _: NodeId, _: &[Option<NodeId>]) -> Option<NodeId> {
        None
    }
}

/// Rebuilds a kernel with its effects. Drops unused nodes, unused carried values and unused components of texels, and
/// applies the pass's rules.
pub fn rebuild_graph(old: &Graph, pass: &Rebuild<'_>) -> Graph {
    rebuild_replacing(old, pass, &mut CopyAll)
}

/// Like [`rebuild_graph`], with some nodes replaced.
pub fn rebuild_replacing(old: &Graph, pass: &Rebuild<'_>, replace: &mut dyn Replace) -> Graph {
    let live = Liveness::from_graph(old);
    let mut builder = Builder::new(pass.rules);
    builder.reserve(old.nodes.len());
    copy_tables(old, builder.graph_mut());
    for (texture, components) in builder.graph_mut().textures.iter_mut().zip(components_read(old, &live)) {
        texture.components = components.min(texture.components);
    }
    replace.add_prologue(&mut builder);
    builder.place_nodes(|| None);
    let mut walk = Rebuilder {
        old,
        live,
        builder,
        new_ids: vec![None; old.nodes.len()],
        new_regions: vec![None; old.regions.len()],
        args: Vec::new(),
    };
    walk.new_regions[0] = Some(Graph::BODY);
    let mut events = old.events.iter().peekable();
    for id in old.node_ids() {
        while let Some((_, event)) = events.next_if(|(at, _)| *at <= id.0) {
            walk.event(*event, replace);
        }
        walk.node(id, pass.share_loads, replace);
        walk.builder.place_nodes(|| old.place(id).cloned());
    }
    for (_, event) in events {
        if *event != Event::Close(Graph::BODY) {
            walk.event(*event, replace);
        }
    }
    let outputs = old.outputs().iter().map(|id| walk.new_id(*id)).collect();
    walk.builder.finish(outputs)
}

/// Copies everything from the old graph except its nodes and regions.
pub fn copy_tables(old: &Graph, new: &mut Graph) {
    new.textures.clone_from(&old.textures);
    new.buffers.clone_from(&old.buffers);
    new.images.clone_from(&old.images);
    new.shared.clone_from(&old.shared);
    new.samplers.clone_from(&old.samplers);
    new.uniforms.clone_from(&old.uniforms);
    new.overrides.clone_from(&old.overrides);
    new.tallies.clone_from(&old.tallies);
    new.files.clone_from(&old.files);
    new.purposes = Arc::clone(&old.purposes);
    new.varyings.clone_from(&old.varyings);
    new.targets.clone_from(&old.targets);
    new.invocation = old.invocation;
}

struct Rebuilder<'g, 'r> {
    old: &'g Graph,
    live: Liveness,
    builder: Builder<'r>,
    new_ids: Vec<Option<NodeId>>,
    new_regions: Vec<Option<RegionId>>,
    /// Buffer for a node's arguments, reused.
    args: Vec<NodeId>,
}

impl Rebuilder<'_, '_> {
    fn new_id(&self, old: NodeId) -> NodeId {
        self.new_ids[old.0 as usize].expect("arguments are built before their users")
    }

    fn event(&mut self, event: Event, replace: &dyn Replace) {
        match event {
            Event::Open(region) if self.live.regions[region.0 as usize] => self.open(region, replace),
            // Results of a region may be newer than its end: they are set when the loop or branch is built.
            Event::Close(region) if self.live.regions[region.0 as usize] => self.builder.close_region(Vec::new()),
            _ => {}
        }
    }

    fn open(&mut self, region: RegionId, replace: &dyn Replace) {
        let params = self.live.keep_used(region, &self.old.region(region).params, true);
        let types: Vec<_> = params
            .iter()
            .map(|p| replace.replace_type(*p, self.old.ty(*p)))
            .collect();
        let new = self.builder.open_region(&types);
        self.new_regions[region.0 as usize] = Some(new);
        let made = self.builder.graph().region(new).params.clone();
        for (old, new) in params.iter().zip(made) {
            self.take_over(*old, new);
        }
    }

    /// Positions of the used results of a region. The first `before` of the `count` values are no results.
    fn used_positions(&self, region: RegionId, count: usize, before: usize) -> Vec<usize> {
        let used = &self.live.results[region.0 as usize];
        (0..count - before).filter(|k| used[*k]).collect()
    }

    /// Sets the results of the regions of a loop or branch.
    fn set_results(&mut self, owner: NodeId, replace: &mut dyn Replace) {
        for region in self.old.regions_of(owner) {
            let results: Vec<NodeId> = self
                .used_positions(region, self.old.region(region).results.len(), 0)
                .into_iter()
                .map(|k| {
                    let old = self.old.region(region).results[k];
                    let passed = replace.replace_passed(&mut self.builder, region, k, old, &self.new_ids);
                    passed.unwrap_or_else(|| self.new_id(old))
                })
                .collect();
            let stop = self.old.region(region).stop.map(|stop| self.new_id(stop));
            if let Some(new) = self.new_regions[region.0 as usize] {
                self.builder.graph_mut().regions[new.0 as usize].results = results;
                stop.iter().for_each(|stop| self.builder.set_stop(new, *stop));
            }
        }
    }

    fn node(&mut self, id: NodeId, share_loads: bool, replace: &mut dyn Replace) {
        if !self.live.nodes[id.0 as usize] || self.new_ids[id.0 as usize].is_some() {
            return;
        }
        if let Some(new) = replace.replace_node(&mut self.builder, id, &self.new_ids) {
            return self.take_over(id, new);
        }
        self.set_results(id, replace);
        let node = self.old.node(id);
        let region =
            |r: &RegionId| self.new_regions[r.0 as usize].expect("regions are opened before their owner is built");
        let mut carried = Vec::new();
        let (op, args): (Op, &[NodeId]) = match &node.op {
            Op::Loop(body) => {
                for old in &node.args[..2] {
                    let bound = replace.replace_bound(&mut self.builder, *body, *old, &self.new_ids);
                    carried.push(bound.unwrap_or_else(|| self.new_id(*old)));
                }
                for k in self.used_positions(*body, node.args.len(), 2) {
                    let old = node.args[k + 2];
                    let passed = replace.replace_passed(&mut self.builder, *body, k, old, &self.new_ids);
                    carried.push(passed.unwrap_or_else(|| self.new_id(old)));
                }
                (Op::Loop(region(body)), &[])
            }
            Op::If(then, otherwise) => (Op::If(region(then), region(otherwise)), &node.args),
            Op::Result(k) => {
                let owner = self.old.node(node.args[0]);
                let (Op::Loop(owner) | Op::If(owner, _)) = owner.op else {
                    unreachable!("verified: a result is of a loop or branch")
                };
                let gone = self.live.results[owner.0 as usize][..*k as usize]
                    .iter()
                    .filter(|live| !**live)
                    .count();
                (Op::Result(k - gone as u32), &node.args)
            }
            read if share_loads && read.is_read() => (read.clone().without_site(), &node.args),
            other => (other.clone(), &node.args),
        };
        let mut new_args = std::mem::take(&mut self.args);
        new_args.clear();
        new_args.extend(args.iter().map(|a| self.new_id(*a)));
        new_args.extend(carried);
        let args = new_args.as_slice();
        let ty = match (&op, op.texture()) {
            (Op::Load { .. } | Op::Sample { .. }, Some(texture)) => {
                self.builder.graph().textures[texture as usize].texel_type()
            }
            (Op::Result(_), _) => replace.replace_type(id, node.ty),
            _ => node.ty,
        };
        let new = match op {
            effect if effect.is_effect() => {
                // An effect whose condition is never true is dropped; its value is 0.
                let never = args
                    .first()
                    .and_then(|id| self.builder.graph().constant_bits(*id))
                    .is_some_and(|bits| bits[0] == 0);
                match (never, ty) {
                    (false, _) => self.builder.add_effect(effect, args.to_vec(), ty),
                    (true, Type::Results) => return,
                    (true, _) => self.builder.constant(ty, [0; 4]),
                }
            }
            Op::Const(_) => self.builder.intern(op, args, ty),
            // The texel has become a scalar.
            Op::Extract(0) if self.builder.graph().ty(args[0]) == ty => args[0],
            _ => self.builder.add(op, args, ty),
        };
        self.args = new_args;
        self.take_over(id, new);
    }

    fn take_over(&mut self, old: NodeId, new: NodeId) {
        self.new_ids[old.0 as usize] = Some(new);
        if let Some(origin) = self.old.origin(old) {
            self.builder.set_origin(new, origin);
        }
    }
}

/// For each texture, the number of components up to the last one used of any texel.
fn components_read(graph: &Graph, live: &Liveness) -> Vec<u8> {
    let texel_of = |id: NodeId| match graph.node(id).op {
        Op::Load { texture, .. } | Op::Sample { texture, .. } => Some(texture as usize),
        _ => None,
    };
    let mut most = vec![1; graph.textures.len()];
    let mut use_of = |id: NodeId, components: u8| {
        if let Some(texture) = texel_of(id) {
            most[texture] = components.max(most[texture]);
        }
    };
    const ALL: u8 = 4;
    for id in graph.node_ids().filter(|id| live.nodes[id.0 as usize]) {
        let node = graph.node(id);
        match node.op {
            Op::Extract(lane) => use_of(node.args[0], lane + 1),
            _ => node.args.iter().for_each(|arg| use_of(*arg, ALL)),
        }
    }
    graph.outputs().iter().for_each(|id| use_of(*id, ALL));
    for region in &graph.regions {
        region.yielded_values().for_each(|id| use_of(id, ALL));
    }
    for id in graph.node_ids().filter(|id| live.nodes[id.0 as usize]) {
        if let Op::Gather { texture, component, .. } = graph.node(id).op {
            most[texture as usize] = most[texture as usize].max(component + 1);
        }
    }
    most
}

/// Nodes and regions that the output depends on.
struct Liveness {
    nodes: Vec<bool>,
    regions: Vec<bool>,
    /// By region, whether each of its results is used outside; the same for both sides of a branch.
    results: Vec<Vec<bool>>,
}

impl Liveness {
    fn from_graph(graph: &Graph) -> Liveness {
        let mut live = Liveness {
            nodes: vec![false; graph.nodes.len()],
            regions: vec![false; graph.regions.len()],
            results: graph.regions.iter().map(|r| vec![false; r.results.len()]).collect(),
        };
        live.regions[0] = true;
        let happens = |region: &Region| -> Vec<NodeId> {
            let all = region.effects.iter().copied();
            all.filter(|id| !graph.node(*id).op.is_removable_effect()).collect()
        };
        let mut pending = [graph.outputs(), &happens(&graph.regions[0])].concat();
        while let Some(id) = pending.pop() {
            if std::mem::replace(&mut live.nodes[id.0 as usize], true) {
                continue;
            }
            let node = graph.node(id);
            match node.op {
                Op::Loop(region) => {
                    live.regions[region.0 as usize] = true;
                    pending.extend(&node.args[..2]);
                    pending.extend(graph.region(region).stop);
                    pending.extend(happens(graph.region(region)));
                }
                Op::If(then, otherwise) => {
                    live.regions[then.0 as usize] = true;
                    live.regions[otherwise.0 as usize] = true;
                    pending.push(node.args[0]);
                    pending.extend(happens(graph.region(then)));
                    pending.extend(happens(graph.region(otherwise)));
                }
                Op::Result(k) => {
                    pending.push(node.args[0]);
                    live.mark_result(graph, node.args[0], k as usize, &mut pending);
                }
                Op::Param(region, k) if k > 0 => {
                    let owner = graph.node_ids().find(|id| graph.node(*id).op == Op::Loop(region));
                    live.mark_result(
                        graph,
                        owner.expect("a region with parameters is a loop's"),
                        k as usize - 1,
                        &mut pending,
                    );
                }
                _ => pending.extend(&node.args),
            }
        }
        live
    }

    /// Marks result `k` of `owner` as used, together with the value that computes it and, in a loop, its initial value.
    fn mark_result(&mut self, graph: &Graph, owner: NodeId, k: usize, pending: &mut Vec<NodeId>) {
        for region in graph.regions_of(owner) {
            if !std::mem::replace(&mut self.results[region.0 as usize][k], true) {
                let entry = graph.region(region);
                pending.push(entry.results[k]);
                pending.extend(entry.params.get(k + 1));
                if matches!(graph.node(owner).op, Op::Loop(_)) {
                    pending.push(graph.node(owner).args[k + 2]);
                }
            }
        }
    }

    /// Keeps those of the values whose region results are used. With `counter`, the first value corresponds to no result
    /// and is kept.
    fn keep_used(&self, region: RegionId, values: &[NodeId], counter: bool) -> Vec<NodeId> {
        let skip = usize::from(counter && !values.is_empty());
        let used = self.results[region.0 as usize].iter();
        let rest = values[skip..]
            .iter()
            .zip(used)
            .filter(|(_, used)| **used)
            .map(|(v, _)| *v);
        values[..skip].iter().copied().chain(rest).collect()
    }
}
