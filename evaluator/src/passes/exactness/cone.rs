//! Search for cancelling terms of one sum, difference or comparison.

use super::interned::{Part, Parts, TermId, Terms};
use super::terms::{Choice, Dependence, Place, Rounding, Term, WeightedTerm};
use crate::ir::{BinaryOp, NodeId, Op};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;
use std::ops::Range;

/// Maximum number of terms examined for one sum, nearest first.
const MAX_TERMS: usize = 256;

/// Maximum number of terms of a short side, which is examined first.
const FEW_TERMS: usize = 32;

/// Maximum number of alternatives followed at once, and of their combinations for one sum.
const MAX_CHOICES: usize = 4;
const MAX_COMBINATIONS: u32 = 32;

/// A term cancels if at most this share of it remains. Filter weights leave more; the constants of a split by 257 or more,
/// or of a rounding, leave less.
const LEFT: f64 = 1.0 / 256.0;

/// Constants from which a sum loses digits on purpose: those that round to multiples of less than 1/4096.
const LARGE: f64 = 1024.0;

/// Maximum number of sides of a sum: two, or the components of a dot product.
const SIDES: usize = 4;

/// Result of the search in a graph.
#[derive(Default)]
pub struct ExactSearch {
    /// Operations that a cancelling term passes through.
    pub marks: FxHashSet<NodeId>,
    /// Sums and differences that would be 0 without rounding: the rounding errors of others.
    pub errors: FxHashSet<NodeId>,
}

/// Adds the operations that a cancelling term passes through, if the cancellation in a node is intended:
///
/// - `(a + b) - a`, which subtracts a term that was added before;
/// - a sum that would be 0 without rounding: the rounding error of another;
/// - a large constant that rounds a value.
///
/// In other sums, such as `(a + b) - (a - b)`, reordering changes only a rounding.
pub fn find_cancelling(terms: &mut Terms<'_>, id: NodeId, found: &mut ExactSearch) {
    terms.limit();
    let (graph, dependence) = (terms.graph, terms.dependence);
    let node = graph.node(id);
    let sign = match &node.op {
        Op::Binary(BinaryOp::Add) => 1.0,
        Op::Binary(BinaryOp::Sub) => -1.0,
        Op::Binary(op) if op.is_comparison() => -1.0,
        Op::Dot => 1.0,
        _ => return,
    };
    let of = graph.ty(node.args[0]);
    if !of.is_float() || of.is_array() {
        return;
    }
    let mut search = |lane: u8, found: &mut ExactSearch| {
        let side = |k: usize, times: f64| WeightedTerm {
            term: dependence.component_term(node.args[k], lane),
            times,
            by: Rounding::Itself,
        };
        let sides = match node.op {
            Op::Dot => {
                let lanes = 0..of.component_count();
                lanes.map(|lane| dependence.dot_part(graph, id, lane)).collect()
            }
            _ => vec![vec![side(0, 1.0)], vec![side(1, sign)]],
        };
        if !may_share_terms(dependence, &sides) {
            return Outcome::Nothing;
        }
        let interned = |side: Vec<WeightedTerm>| side.into_iter().map(|part| terms.intern(part)).collect();
        let sides: Vec<Vec<Part>> = sides.into_iter().map(interned).collect();
        let mut search = Search {
            terms: &mut *terms,
            sides,
            choices: Vec::new(),
            left: MAX_COMBINATIONS,
            found,
            outcome: Outcome::Nothing,
            is_error: false,
        };
        if search.may_share() {
            search.run();
        }
        let (outcome, is_error) = (search.outcome, search.is_error);
        if is_error && node.op.is_rounding() {
            found.errors.insert(id);
        }
        outcome
    };
    let whole = match of.is_scalar() || node.op == Op::Dot {
        true => search(0, found),
        false => search(Place::ALL, found),
    };
    let cancels = match whole {
        Outcome::ByLane => {
            (0..of.component_count()).fold(false, |some, lane| some | (search(lane, found) == Outcome::Cancels))
        }
        outcome => outcome == Outcome::Cancels,
    };
    if cancels && node.op.is_rounding() {
        found.marks.insert(id);
    }
}

/// Outcome of a search.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Nothing,
    /// A term cancels.
    Cancels,
    /// Components must be examined one by one.
    ByLane,
}

/// Returns whether two sides may have a term in common.
fn may_share_terms(dependence: &Dependence, sides: &[Vec<WeightedTerm>]) -> bool {
    let reach = |side: &Vec<WeightedTerm>| {
        let all = side.iter().filter_map(|part| part.term.place);
        all.map(|place| dependence.reach_bits(place.node)).fold([0; 4], union)
    };
    let reaches: Vec<[u64; 4]> = sides.iter().map(reach).collect();
    let pairs = (0..reaches.len()).flat_map(|k| (0..k).map(move |l| (k, l)));
    pairs.into_iter().any(|(k, l)| intersect(reaches[k], reaches[l]))
}

fn union(a: [u64; 4], b: [u64; 4]) -> [u64; 4] {
    std::array::from_fn(|k| a[k] | b[k])
}

fn intersect(a: [u64; 4], b: [u64; 4]) -> bool {
    (0..4).any(|k| a[k] & b[k] != 0)
}

struct Search<'s, 'g> {
    terms: &'s mut Terms<'g>,
    sides: Vec<Vec<Part>>,
    /// Alternatives followed: the first, the second, or neither.
    choices: Vec<(Choice, usize)>,
    /// Number of combinations that may still be examined.
    left: u32,
    found: &'s mut ExactSearch,
    outcome: Outcome,
    /// `true` if nothing remains of the sum without rounding.
    is_error: bool,
}

/// Edge from a term to one of its parts: the part, its factor, and the operation.
type Edge = (usize, f64, Rounding);

/// Paths to a term: total factor by side, whether a rounding lies on them, and by side whether a sum does.
#[derive(Clone, Copy, Default)]
struct Share {
    times: [f64; SIDES],
    rounded: bool,
    summed: [bool; SIDES],
}

impl Share {
    fn sum(&self) -> f64 {
        self.times.iter().sum()
    }

    fn largest_times(&self) -> f64 {
        self.times.iter().fold(0.0, |most, x| most.max(x.abs()))
    }

    fn is_cancelled(&self) -> bool {
        self.sum().abs() <= self.largest_times() * LEFT
    }

    fn sides(&self) -> impl Iterator<Item = usize> {
        let times = self.times;
        (0..SIDES).filter(move |side| times[*side] != 0.0)
    }

    /// Adds the paths that reach another term through an edge.
    fn add(&mut self, from: Share, times: f64, by: Rounding) {
        for side in from.sides() {
            self.times[side] += from.times[side] * times;
            self.summed[side] |= from.summed[side] || by == Rounding::Sum;
        }
        self.rounded |= from.rounded || by != Rounding::Itself;
    }
}

/// Terms that a sum is made of, with their edges.
#[derive(Default)]
struct Cone {
    terms: Vec<TermId>,
    index: FxHashMap<TermId, usize>,
    /// Edges to the parts of terms, those of one term after the other.
    edges: Vec<Edge>,
    /// By term, the range of its edges.
    spans: Vec<Range<usize>>,
    /// `true` if the limit was reached and terms are missing.
    is_cut: bool,
}

impl Cone {
    fn add(&mut self, term: TermId) -> (usize, bool) {
        if let Some(known) = self.index.get(&term) {
            return (*known, false);
        }
        let k = self.terms.len();
        self.index.insert(term, k);
        self.terms.push(term);
        self.spans.push(0..0);
        (k, true)
    }

    /// Edges from a term to its parts.
    fn edges_of(&self, term: usize) -> &[Edge] {
        &self.edges[self.spans[term].clone()]
    }

    /// Terms by those that use them, of the terms that `passes` lets through.
    fn users(&self, passes: &[bool]) -> Vec<Vec<usize>> {
        let mut users = vec![Vec::new(); self.terms.len()];
        for k in (0..self.terms.len()).filter(|k| passes[*k]) {
            for (to, ..) in self.edges_of(k) {
                users[*to].push(k);
            }
        }
        users
    }

    /// Orders terms before their parts.
    fn dependency_order(&self, roots: impl Iterator<Item = usize>) -> Vec<usize> {
        let mut order = Vec::with_capacity(self.terms.len());
        let mut seen = vec![false; self.terms.len()];
        for root in roots {
            let mut stack = vec![(root, 0)];
            if std::mem::replace(&mut seen[root], true) {
                continue;
            }
            while let Some((at, next)) = stack.pop() {
                match self.edges_of(at).get(next) {
                    None => order.push(at),
                    Some((to, ..)) => {
                        stack.push((at, next + 1));
                        if !std::mem::replace(&mut seen[*to], true) {
                            stack.push((*to, 0));
                        }
                    }
                }
            }
        }
        order.reverse();
        order
    }
}

impl Search<'_, '_> {
    /// Returns whether the shorter side may share a term with the other. Nodes created after the other side cannot be terms
    /// of it, unless a loop carries them there. Most terms of a long sum are such nodes and need no second look.
    fn may_share(&mut self) -> bool {
        let [left, right] = &self.sides[..] else { return true };
        if self.terms.dependence.has_loops() {
            return true;
        }
        let newest = |side: &[Part]| {
            side.iter()
                .filter_map(|part| self.terms.term(part.term).newest_node())
                .max()
        };
        let (newest_left, newest_right) = (newest(left), newest(right));
        let (short, bound) = match newest_left > newest_right {
            true => (left, newest_right),
            false => (right, newest_left),
        };
        let mut seen: FxHashSet<TermId> = short.iter().map(|part| part.term).collect();
        let mut pending: Vec<TermId> = seen.iter().copied().collect();
        while let Some(term) = pending.pop() {
            if self.terms.term(term).newest_node() <= bound || seen.len() > FEW_TERMS {
                return true;
            }
            let parts = match self.terms.parts(term) {
                Parts::Leaf => continue,
                Parts::ByLane => return true,
                Parts::Sum(parts) => &parts[..],
                Parts::Either(_, parts) => parts,
            };
            pending.extend(parts.iter().map(|part| part.term).filter(|term| seen.insert(*term)));
        }
        false
    }

    fn run(&mut self) {
        if self.left == 0 || self.outcome == Outcome::ByLane {
            return;
        }
        self.left -= 1;
        let (cone, roots, pending) = self.build_cone();
        if self.outcome == Outcome::ByLane {
            return;
        }
        self.find_cancelled(&cone, &roots);
        let Some(choice) = pending.filter(|_| self.choices.len() < MAX_CHOICES) else {
            return;
        };
        for side in 0..3 {
            self.choices.push((choice, side));
            match side {
                // The value as a leaf: examined above, unless another choice follows.
                2 if self.choices.len() == MAX_CHOICES => {}
                _ => self.run(),
            }
            self.choices.pop();
        }
    }

    /// Builds the cone under the choices made. Returns it with the first terms of each side and a choice that is still
    /// open.
    fn build_cone(&mut self) -> (Cone, Vec<Vec<Edge>>, Option<Choice>) {
        let mut cone = Cone::default();
        let mut queue = VecDeque::new();
        let mut roots = Vec::new();
        for side in &self.sides {
            let mut parts = Vec::new();
            for part in side {
                let (k, is_new) = cone.add(part.term);
                parts.push((k, part.times, part.by));
                if is_new {
                    queue.push_back(k);
                }
            }
            roots.push(parts);
        }
        let mut pending = None;
        while let Some(k) = queue.pop_front() {
            if cone.terms.len() >= MAX_TERMS {
                cone.is_cut = true;
                break;
            }
            let parts = match self.terms.parts(cone.terms[k]) {
                Parts::Leaf => continue,
                Parts::ByLane => {
                    self.outcome = Outcome::ByLane;
                    break;
                }
                Parts::Sum(parts) => &parts[..],
                Parts::Either(choice, sides) => match self.choices.iter().find(|(known, _)| known == choice) {
                    Some((_, side @ (0 | 1))) => &sides[*side..=*side],
                    Some(_) => continue,
                    None => {
                        pending.get_or_insert(*choice);
                        continue;
                    }
                },
            };
            let first = cone.edges.len();
            for part in parts {
                let (to, is_new) = cone.add(part.term);
                cone.edges.push((to, part.times, part.by));
                if is_new {
                    queue.push_back(to);
                }
            }
            cone.spans[k] = first..cone.edges.len();
        }
        (cone, roots, pending)
    }

    /// Finds the terms that cancel, and marks the operations that they pass through.
    fn find_cancelled(&mut self, cone: &Cone, roots: &[Vec<Edge>]) {
        let mut shares = vec![Share::default(); cone.terms.len()];
        let mut passes = vec![false; cone.terms.len()];
        for (side, parts) in roots.iter().enumerate() {
            let mut whole = Share::default();
            whole.times[side] = 1.0;
            for (k, times, by) in parts {
                shares[*k].add(whole, *times, *by);
            }
        }
        let mut cancelled = Vec::new();
        let mut is_error = !cone.is_cut;
        for k in cone.dependency_order(roots.iter().flatten().map(|(k, ..)| *k)) {
            let share = shares[k];
            // All constants are examined together.
            if share.is_cancelled() && !self.is_constant(cone.terms[k]) {
                // A value minus itself loses nothing, nor do the values that it is made of.
                if share.sides().count() > 1 && (share.rounded || self.is_contractible(cone.terms[k])) {
                    cancelled.push((k, order_matters(self.terms.term(cone.terms[k]), &share)));
                }
                continue;
            }
            is_error &= !cone.edges_of(k).is_empty();
            passes[k] = true;
            for (to, times, by) in cone.edges_of(k) {
                shares[*to].add(share, *times, *by);
            }
        }
        // The initial value that a loop carries is often 0.
        let before = |(choice, side): &(Choice, usize)| *side == 1 && !matches!(choice, Choice::Condition(_));
        is_error &= !cancelled.is_empty() && !self.choices.iter().any(before);
        self.is_error |= is_error;
        if cancelled.is_empty() {
            return;
        }
        let users = cone.users(&passes);
        let mut seen = FxHashSet::default();
        for (k, _) in cancelled.into_iter().filter(|(_, matters)| *matters || is_error) {
            self.outcome = Outcome::Cancels;
            self.mark_product(cone.terms[k]);
            let mut stack = vec![k];
            while let Some(at) = stack.pop() {
                for user in &users[at] {
                    if seen.insert(*user) {
                        stack.push(*user);
                        self.mark_term(cone.terms[*user]);
                    }
                }
            }
        }
    }

    fn mark_term(&mut self, term: TermId) {
        if let Some(place) = self.terms.term(term).place
            && self.terms.graph.node(place.node).op.is_rounding()
        {
            self.found.marks.insert(place.node);
        }
    }

    /// Marks a product that cancels itself, because a contraction would leave its rounding error.
    fn mark_product(&mut self, term: TermId) {
        if self.is_contractible(term) {
            self.mark_term(term);
        }
    }

    fn is_constant(&self, term: TermId) -> bool {
        let place = self.terms.term(term).place;
        place.is_some_and(|place| self.terms.graph.constant_bits(place.node).is_some())
    }

    /// Returns whether a term is a product that may be contracted with the sum that uses it.
    fn is_contractible(&self, term: TermId) -> bool {
        let graph = self.terms.graph;
        let is_product = |place: Place| matches!(graph.node(place.node).op, Op::Binary(BinaryOp::Mul) | Op::Dot);
        let term = self.terms.term(term);
        term.factors.is_empty() && term.place.is_some_and(is_product)
    }
}

/// Returns whether a result depends on the order in which a term cancels: one side is the term itself, or the term is a
/// large constant.
fn order_matters(term: &Term, share: &Share) -> bool {
    let is_itself = share.sides().any(|side| !share.summed[side]);
    match (term.place, &term.factors[..]) {
        (Some(_), _) | (None, []) if is_itself => true,
        (None, _) => share.largest_times() >= LARGE,
        _ => false,
    }
}
