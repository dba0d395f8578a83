//! Terms by number, each defined once for all sums of a graph: long sums have most of their terms in common.

use super::terms::{Choice, Definition, Dependence, Rounding, Term, WeightedTerm};
use crate::ir::Graph;
use rustc_hash::FxHashMap;

/// Number of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TermId(u32);

/// A part of a term, with its factor and the effect of the operation that uses it.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    pub term: TermId,
    pub times: f64,
    pub by: Rounding,
}

/// Parts of a term, as [`Definition`] has them.
pub enum Parts {
    Leaf,
    ByLane,
    Sum(Vec<Part>),
    Either(Choice, [Part; 2]),
}

/// Most terms that are kept from one sum to the next, to bound memory.
const MOST: usize = 1 << 20;

/// The terms of a graph that were met.
pub struct Terms<'g> {
    pub graph: &'g Graph,
    pub dependence: &'g Dependence,
    all: Vec<Term>,
    numbers: FxHashMap<Term, TermId>,
    /// By term, its parts once they are known.
    parts: Vec<Option<Parts>>,
}

impl<'g> Terms<'g> {
    pub fn new(graph: &'g Graph, dependence: &'g Dependence) -> Self {
        Terms {
            graph,
            dependence,
            all: Vec::new(),
            numbers: FxHashMap::default(),
            parts: Vec::new(),
        }
    }

    /// Forgets all terms if they are many. Earlier numbers are invalid then.
    pub fn limit(&mut self) {
        if self.all.len() > MOST {
            *self = Terms::new(self.graph, self.dependence);
        }
    }

    /// The term of a number.
    pub fn term(&self, id: TermId) -> &Term {
        &self.all[id.0 as usize]
    }

    /// Part with the number of its term.
    pub fn intern(&mut self, part: WeightedTerm) -> Part {
        let WeightedTerm { term, times, by } = part;
        let term = match self.numbers.get(&term) {
            Some(known) => *known,
            None => {
                let id = TermId(u32::try_from(self.all.len()).expect("fewer terms than the limit of nodes"));
                self.numbers.insert(term.clone(), id);
                self.all.push(term);
                self.parts.push(None);
                id
            }
        };
        Part { term, times, by }
    }

    /// Parts that a term is made of.
    pub fn parts(&mut self, id: TermId) -> &Parts {
        let at = id.0 as usize;
        if self.parts[at].is_none() {
            let parts = match self.dependence.term_definition(self.graph, &self.all[at]) {
                Definition::Leaf => Parts::Leaf,
                Definition::ByLane => Parts::ByLane,
                Definition::Sum(parts) => Parts::Sum(parts.into_iter().map(|part| self.intern(part)).collect()),
                Definition::Either(choice, sides) => Parts::Either(choice, sides.map(|part| self.intern(part))),
            };
            self.parts[at] = Some(parts);
        }
        self.parts[at].as_ref().expect("just defined")
    }
}
