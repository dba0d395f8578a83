//! Origins of nodes, from which names and comments in the emitted text are derived.

use std::sync::Arc;

/// Value of a loop counter when a node was created.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Counter {
    /// The counter's name in the source.
    pub name: Arc<str>,
    /// Value of the counter.
    pub value: i64,
}

/// Source of a name, the best first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Naming {
    /// A variable.
    #[default]
    Let,
    /// The parameter that received the value.
    Parameter,
    /// The function that returned the value.
    Function,
}

/// Source-level identity of a node: the variable it was created for, or else the parameter that received it, or the
/// function that returned it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Name of the variable; `variable_field` for a part of a structure. Empty if there is none.
    pub name: Arc<str>,
    /// Source of the name.
    pub naming: Naming,
    /// Index into `Graph::files`.
    pub file: u32,
    /// Line, from 1.
    pub line: u32,
    /// Counters of the enclosing unrolled loops, outermost first.
    pub counters: Arc<[Counter]>,
}

impl Origin {
    /// Line of nodes that have no place in the source.
    pub const NOWHERE: u32 = 0;

    /// Merges the origins of a node that two places share: keeps the better name, and for equal names the common counters.
    pub fn merge(&mut self, other: &Origin) {
        if self.name.is_empty() || other.naming < self.naming {
            *self = other.clone();
        } else if self.name == other.name && self.counters != other.counters {
            let both = self.counters.iter().filter(|c| other.counters.contains(c));
            self.counters = both.cloned().collect();
        }
    }
}
