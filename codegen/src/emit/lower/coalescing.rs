//! Arrays of structured loops: values in the graph, variables changed in place in the text.
//!
//! Versions of an array that follow from one another by writes, iterations and branches share one variable (a web). Webs of
//! versions that are live at the same time interfere and stay apart, and the later web begins with a copy. Literals
//! (`MakeArray`) belong to no web; they are copied at the beginning of a web.

use super::interference::{Interference, array_version, find_interference};
use crate::emit::ast::VarId;
use std::collections::HashMap;
use straightline_evaluator::ir::{Graph, NodeId, Op};
use straightline_evaluator::passes::Schedule;

/// Assigns array versions to webs, and webs to variables in scope.
pub struct ArrayCoalescing {
    parent: Vec<u32>,
    /// Variables in scope, by web.
    vars: Scope,
}

/// The variables in scope, by web.
pub type Scope = HashMap<u32, VarId>;

impl ArrayCoalescing {
    /// Computes the webs of a scheduled graph.
    pub fn new(graph: &Graph, schedule: &Schedule) -> ArrayCoalescing {
        let mut webs = Webs {
            graph,
            parent: (0..graph.nodes.len() as u32).collect(),
            apart: find_interference(graph, schedule),
        };
        let arrays = || graph.node_ids().filter(|id| schedule.has_node(*id));
        for id in arrays() {
            let node = graph.node(id);
            match &node.op {
                Op::ArraySet => webs.unite(id, node.args[0]),
                // The result of a loop is the variable that the loop carried.
                Op::Result(_) if node.ty.is_array() => {
                    let carried = array_version(graph, id).unwrap_or(id);
                    webs.parent[id.0 as usize] = webs.web_root(carried);
                }
                _ => {}
            }
        }
        for id in arrays() {
            let node = graph.node(id);
            match &node.op {
                Op::Loop(body) => {
                    let region = graph.region(*body);
                    for (k, init) in node.args[2..].iter().enumerate() {
                        webs.unite(region.params[k + 1], *init);
                        webs.unite(region.params[k + 1], region.results[k]);
                    }
                }
                Op::Result(k) if matches!(graph.node(node.args[0]).op, Op::If(..)) => {
                    for region in graph.regions_of(node.args[0]) {
                        webs.unite(id, graph.region(region).results[*k as usize]);
                    }
                }
                _ => {}
            }
        }
        ArrayCoalescing {
            parent: webs.parent,
            vars: Scope::new(),
        }
    }

    /// Returns the variable of a version, if its web is in scope.
    pub fn version_variable(&self, id: NodeId) -> Option<VarId> {
        self.vars.get(&find_root(&self.parent, id)).copied()
    }

    /// Brings the web of a version into scope as a variable.
    pub fn declare_version(&mut self, id: NodeId, var: VarId) {
        self.vars.insert(find_root(&self.parent, id), var);
    }

    /// Returns the variables in scope, for [`ArrayCoalescing::restore_scope`].
    pub fn current_scope(&self) -> Scope {
        self.vars.clone()
    }

    /// Leaves a scope, dropping its variables.
    pub fn restore_scope(&mut self, outer: &Scope) {
        self.vars.clone_from(outer);
    }
}

fn find_root(parent: &[u32], id: NodeId) -> u32 {
    let mut at = id.0;
    while parent[at as usize] != at {
        at = parent[at as usize];
    }
    at
}

struct Webs<'g> {
    graph: &'g Graph,
    parent: Vec<u32>,
    /// Versions that must not join a web, by the web's root.
    apart: Interference,
}

impl Webs<'_> {
    fn web_root(&self, id: NodeId) -> u32 {
        find_root(&self.parent, id)
    }

    /// Unites the webs of two versions, unless they are live at the same time.
    fn unite(&mut self, a: NodeId, b: NodeId) {
        let (Some(a), Some(b)) = (array_version(self.graph, a), array_version(self.graph, b)) else {
            return;
        };
        let (a, b) = (self.web_root(a), self.web_root(b));
        if a == b {
            return;
        }
        let parent = &self.parent;
        let of = |web: u32| self.apart.get(&NodeId(web)).into_iter().flatten();
        if of(a).any(|other| find_root(parent, *other) == b) || of(b).any(|other| find_root(parent, *other) == a) {
            return;
        }
        let (kept, joined) = (a.min(b), a.max(b));
        self.parent[joined as usize] = kept;
        if let Some(others) = self.apart.remove(&NodeId(joined)) {
            self.apart.entry(NodeId(kept)).or_default().extend(others);
        }
    }
}
