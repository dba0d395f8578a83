//! Arrays of structured loops: values in the graph, variables changed in place in the text.
//!
//! All versions of an array that follow from one another by writes, iterations and branches share one variable (a web).
//! That is right as long as no version is read once the next has been written. Where one is, lowering begins again with
//! the web cut before the version that came too early: that version then begins a variable of its own with a copy. Literals (`MakeArray`) belong to no web and are copied where one begins.
//! Where cuts do not help, every version is a variable of its own, which is always right: see [`ArrayCoalescing::apart`].

use crate::emit::ast::VarId;
use std::collections::{HashMap, HashSet};
use straightline_evaluator::ir::{Graph, NodeId, Op};

/// ArrayCoalescing of array versions.
pub struct ArrayCoalescing {
    parent: Vec<u32>,
    /// Per web in scope: its variable.
    vars: HashMap<u32, VarId>,
    /// Per web in scope: the version that the variable holds.
    current: HashMap<u32, NodeId>,
    /// By version: the one that took its place in the variable.
    replaced: HashMap<NodeId, NodeId>,
}

/// What was in scope and what variables held.
pub type Snapshot = (HashMap<u32, VarId>, HashMap<u32, NodeId>);

impl ArrayCoalescing {
    /// Finds the coalescing of a graph. Versions in `cut` do not share the variable of what they were made from.
    pub fn new(graph: &Graph, cut: &HashSet<NodeId>) -> ArrayCoalescing {
        let mut coalescing = ArrayCoalescing::single(graph);
        for id in graph.ids() {
            let node = graph.node(id);
            if node.op == Op::ArraySet && !cut.contains(&id) {
                coalescing.union(graph, id, node.args[0]);
            }
        }
        for id in graph.ids() {
            let node = graph.node(id);
            match &node.op {
                Op::Loop(body) => {
                    let region = graph.region(*body);
                    for (k, init) in node.args[2..].iter().enumerate() {
                        let param = region.params[k + 1];
                        if !cut.contains(&param) {
                            coalescing.union(graph, param, *init);
                        }
                        coalescing.join(graph, param, region.results[k], cut);
                    }
                }
                Op::Result(k) if node.ty.is_array() => match graph.node(node.args[0]).op {
                    // The variable that was carried.
                    Op::Loop(body) => coalescing.union(graph, id, graph.region(body).params[*k as usize + 1]),
                    _ if cut.contains(&id) => {}
                    _ => {
                        for region in graph.regions_of(node.args[0]) {
                            coalescing.join(graph, id, graph.region(region).results[*k as usize], cut);
                        }
                    }
                },
                _ => {}
            }
        }
        coalescing
    }

    /// ArrayCoalescing of one version each; only what a loop carries is, after the loop, where it was carried. No version is ever
    /// read once another has taken its place, so that text can be written for every graph.
    pub fn apart(graph: &Graph) -> ArrayCoalescing {
        let mut coalescing = ArrayCoalescing::single(graph);
        for id in graph.ids() {
            let node = graph.node(id);
            if let Op::Result(k) = node.op
                && let Op::Loop(body) = graph.node(node.args[0]).op
            {
                coalescing.union(graph, id, graph.region(body).params[k as usize + 1]);
            }
        }
        coalescing
    }

    fn single(graph: &Graph) -> ArrayCoalescing {
        ArrayCoalescing {
            parent: (0..graph.nodes.len() as u32).collect(),
            vars: HashMap::new(),
            current: HashMap::new(),
            replaced: HashMap::new(),
        }
    }

    /// Unites a version with what leaves a region for it, unless that would undo a cut.
    fn join(&mut self, graph: &Graph, id: NodeId, result: NodeId, cut: &HashSet<NodeId>) {
        let web = self.root(result);
        if !cut.iter().any(|version| self.root(*version) == web) {
            self.union(graph, id, result);
        }
    }

    fn union(&mut self, graph: &Graph, a: NodeId, b: NodeId) {
        let literal = |id: NodeId| graph.node(id).op == Op::MakeArray;
        if graph.ty(a).is_array() && !literal(a) && !literal(b) {
            let (a, b) = (self.root(a), self.root(b));
            self.parent[a.max(b) as usize] = a.min(b);
        }
    }

    fn root(&self, id: NodeId) -> u32 {
        let mut at = id.0;
        while self.parent[at as usize] != at {
            at = self.parent[at as usize];
        }
        at
    }

    /// The variable of a version's web, if the web is in scope.
    pub fn variable(&self, id: NodeId) -> Option<VarId> {
        self.vars.get(&self.root(id)).copied()
    }

    /// Brings a web into scope as a variable, holding `version`.
    pub fn declare(&mut self, id: NodeId, var: VarId, version: NodeId) {
        let web = self.root(id);
        self.vars.insert(web, var);
        self.current.insert(web, version);
    }

    /// The variable that holds just this version, if one does.
    pub fn holder(&self, id: NodeId) -> Option<VarId> {
        let web = self.root(id);
        self.vars
            .get(&web)
            .filter(|_| self.current.get(&web) == Some(&id))
            .copied()
    }

    /// The variable of `id`'s web holds this version from now on.
    pub fn advance(&mut self, id: NodeId) {
        let web = self.root(id);
        if let Some(before) = self.current.insert(web, id)
            && before != id
        {
            self.replaced.insert(before, id);
        }
    }

    /// The version to cut the web before, so that `id` can still be read: the one that took its place.
    pub fn replacement(&self, id: NodeId) -> Option<NodeId> {
        self.replaced.get(&id).copied()
    }

    /// What every variable holds and which are in scope, to return to with [`ArrayCoalescing::restore`].
    pub fn snapshot(&self) -> Snapshot {
        (self.vars.clone(), self.current.clone())
    }

    /// Leaves a scope: variables made in it are gone.
    pub fn leave(&mut self, (vars, _): &Snapshot) {
        self.vars.clone_from(vars);
        self.current.retain(|web, _| vars.contains_key(web));
    }

    /// Of what was in scope before a loop's body, a version that its variable no longer holds at the end: the next
    /// iteration would find another.
    pub fn lost(&self, (vars, current): &Snapshot) -> Option<NodeId> {
        let mut lost: Vec<NodeId> = vars
            .keys()
            .filter(|web| self.current.get(web) != current.get(web))
            .filter_map(|web| current.get(web).copied())
            .collect();
        lost.sort_unstable();
        lost.first().copied()
    }

    /// Joins this state, that of the second side of a branch, with that of the first: where a variable may hold two
    /// versions, it is not known to hold any.
    pub fn join_sides(&mut self, (_, first): &Snapshot) {
        self.current.retain(|web, version| first.get(web) == Some(version));
    }

    /// Returns to a state, as the other side of a branch does.
    pub fn restore(&mut self, (vars, current): &Snapshot) {
        self.vars.clone_from(vars);
        self.current.clone_from(current);
    }
}
