//! Origins of nodes, from which names and comments of the emitted text are made.

use std::sync::Arc;

/// A loop counter's value at the time a node was made.
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
    /// The parameter that the value was passed as.
    Parameter,
    /// The function that gave it.
    Function,
}

/// The variable that a node was made for, or else what it was passed as, or what gave it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Name of the variable; for a part of a structure `variable_field`. Empty if there is none.
    pub name: Arc<str>,
    /// Source of the name.
    pub naming: Naming,
    /// Index into `Graph::files`.
    pub file: u32,
    /// Line, from 1.
    pub line: u32,
    /// Counters of the unrolled loops around, outermost first.
    pub counters: Arc<[Counter]>,
}

impl Origin {
    /// The line of what is nowhere in the source.
    pub const NOWHERE: u32 = 0;

    /// The origin of a node that two places share: the better name, and of one name what both agree on.
    pub fn merge(&mut self, other: &Origin) {
        if self.name.is_empty() || other.naming < self.naming {
            *self = other.clone();
        } else if self.name == other.name && self.counters != other.counters {
            let both = self.counters.iter().filter(|c| other.counters.contains(c));
            self.counters = both.cloned().collect();
        }
    }
}
