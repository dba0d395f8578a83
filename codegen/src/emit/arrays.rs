//! Arrays of kept loops: values in the graph, variables changed in place in the text.
//!
//! All versions of an array that follow from one another by writes, iterations and branches share one variable (a
//! web). That is right as long as no version is read once the next has been written, which is checked while the text
//! is made; literals (`MakeArray`) belong to no web and are copied where a web begins.

use crate::ir::{Graph, NodeId, Op};
use std::collections::HashMap;

/// Webs of array versions.
pub struct Webs {
    parent: Vec<u32>,
    /// Per web in scope: its variable.
    names: HashMap<u32, String>,
    /// Per web in scope: the version that the variable holds.
    current: HashMap<u32, NodeId>,
}

impl Webs {
    /// Finds the webs of a graph.
    pub fn new(graph: &Graph) -> Webs {
        let mut webs = Webs {
            parent: (0..graph.nodes.len() as u32).collect(),
            names: HashMap::new(),
            current: HashMap::new(),
        };
        for id in graph.ids() {
            let node = graph.node(id);
            match &node.op {
                Op::ArraySet => webs.union(graph, id, node.args[0]),
                Op::Loop(body) => {
                    let region = graph.region(*body);
                    for (k, init) in node.args[2..].iter().enumerate() {
                        webs.union(graph, region.params[k + 1], *init);
                        webs.union(graph, region.params[k + 1], region.results[k]);
                    }
                }
                Op::Result(k) if node.ty.is_array() => {
                    for region in graph.regions_of(node.args[0]) {
                        webs.union(graph, id, graph.region(region).results[*k as usize]);
                    }
                }
                _ => {}
            }
        }
        webs
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
    pub fn variable(&self, id: NodeId) -> Option<&str> {
        self.names.get(&self.root(id)).map(String::as_str)
    }

    /// Brings a web into scope under a name, holding `version`.
    pub fn declare(&mut self, id: NodeId, name: String, version: NodeId) {
        let web = self.root(id);
        self.names.insert(web, name);
        self.current.insert(web, version);
    }

    /// Whether the web's variable holds just this version.
    pub fn holds(&self, id: NodeId) -> bool {
        self.current.get(&self.root(id)) == Some(&id)
    }

    /// The variable holds this version from now on.
    pub fn advance(&mut self, id: NodeId) {
        let web = self.root(id);
        self.current.insert(web, id);
    }

    /// What every variable holds and which are in scope, to return to with [`Webs::restore`].
    pub fn snapshot(&self) -> (HashMap<u32, String>, HashMap<u32, NodeId>) {
        (self.names.clone(), self.current.clone())
    }

    /// Leaves a scope: variables made in it are gone.
    pub fn leave(&mut self, (names, _): &(HashMap<u32, String>, HashMap<u32, NodeId>)) {
        self.names.clone_from(names);
        self.current.retain(|web, _| names.contains_key(web));
    }

    /// Returns to a state, as the other side of a branch does.
    pub fn restore(&mut self, (names, current): &(HashMap<u32, String>, HashMap<u32, NodeId>)) {
        self.names.clone_from(names);
        self.current.clone_from(current);
    }
}
