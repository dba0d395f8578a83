//! Attempts: the state of an evaluation, to return to.

use super::Evaluator;
use super::control::ControlMark;
use super::loops::LoopMark;
use super::scope::Scope;
use super::value::Value;
use crate::diagnostic::Diagnostic;
use crate::ir::{Mark, NodeId};
use std::collections::{BTreeMap, HashMap};

/// State to restore after an attempt.
#[derive(Clone)]
pub struct Checkpoint {
    scope: Scope,
    /// Loops at this point.
    pub loops: LoopMark,
    control: ControlMark,
    /// Number of errors recorded at this point.
    pub error_count: usize,
    /// Site of the last read.
    last_site: u32,
    made: Mark,
}

impl Evaluator<'_> {
    /// Captures the current state.
    pub fn take_checkpoint(&self) -> Checkpoint {
        Checkpoint {
            scope: self.scope.clone(),
            loops: self.loops.mark(),
            control: self.control.mark(),
            error_count: self.report.error_count(),
            last_site: self.last_site,
            made: self.builder.mark(),
        }
    }

    /// Restores a state and removes all nodes added since. Returns the first error recorded since.
    pub fn return_to(&mut self, before: Checkpoint) -> Option<Diagnostic> {
        self.scope = before.scope;
        self.loops.return_to(before.loops);
        self.control.return_to(before.control);
        self.builder.return_to(&before.made);
        let is_kept = |id: &NodeId| (id.0 as usize) < before.made.nodes;
        self.consts.retain(|_, (made, _)| *made <= before.made.nodes);
        self.facts.counters.retain(|id, _| is_kept(id));
        self.facts.wrapping.retain(is_kept);
        self.report.drop_errors(before.error_count)
    }

    /// Restores a state completely, including the numbering of reads.
    pub fn rewind_to(&mut self, before: Checkpoint) {
        self.last_site = before.last_site;
        self.return_to(before);
    }

    /// Restores a state, but keeps values built only from constants and earlier nodes.
    pub fn return_with(&mut self, mut before: Checkpoint, values: Vec<Value>) -> Vec<Value> {
        if !values.iter().all(Value::is_plain) {
            // The captures of a closure cannot be rebuilt.
            before.made = self.builder.mark().with_effects_of(&before.made);
            self.return_to(before);
            return values;
        }
        let first = before.made.nodes;
        let mut leaves = Vec::new();
        values.iter().for_each(|value| value.flatten(&mut leaves));
        let mut pending = leaves.clone();
        let mut lost = BTreeMap::new();
        while let Some(id) = pending.pop() {
            let node = self.builder.graph().node(id);
            if id.0 as usize >= first && !lost.contains_key(&id) {
                pending.extend(&node.args);
                lost.insert(id, node.clone());
            }
        }
        self.return_to(before);
        let mut made: HashMap<NodeId, NodeId> = HashMap::new();
        // Arguments precede their users.
        for (id, node) in lost {
            let args: Vec<NodeId> = node.args.iter().map(|arg| *made.get(arg).unwrap_or(arg)).collect();
            made.insert(id, self.builder.add(node.op, args, node.ty));
        }
        let mut leaves = leaves.into_iter().map(|id| *made.get(&id).unwrap_or(&id));
        values.iter().map(|value| value.unflatten(&mut leaves)).collect()
    }
}
