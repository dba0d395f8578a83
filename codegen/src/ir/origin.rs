//! Where a node comes from: what emitted names and comments are made of.

/// A loop counter's value at the time a node was made.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Counter {
    /// The counter's name in the source.
    pub name: String,
    /// Its value.
    pub value: i64,
}

/// The `let` that a node was made for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Name of the variable; for a part of a structure `variable_field`. Empty if there is none.
    pub name: String,
    /// Index into `Graph::files`.
    pub file: u32,
    /// Line, from 1.
    pub line: u32,
    /// Counters of the unrolled loops around, outermost first.
    pub counters: Vec<Counter>,
}

impl Origin {
    /// The origin of a node that two places share: what both agree on.
    pub fn merge(&mut self, other: &Origin) {
        if self.name.is_empty() {
            *self = other.clone();
        } else if self.name == other.name {
            self.counters.retain(|c| other.counters.contains(c));
        }
    }
}
