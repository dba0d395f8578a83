//! Terms of sums, and the parts that each is made of.

use crate::ir::{BinaryOp, Graph, NodeId, Op, RegionId, Type, UnaryOp};
use rustc_hash::FxHashMap;

/// A factor with its exponent.
pub type Factor = (Place, i8);

/// Maximum number of factors of a product that is followed.
const MAX_FACTORS: usize = 2;

/// Maximum number of iterations back that a carried value is followed.
const MAX_AGE: u8 = 2;

/// A component of a value, in an iteration of the loop around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// The value.
    pub node: NodeId,
    /// The component, or [`Place::ALL`] for a vector whose components are all computed in the same way.
    pub lane: u8,
    /// Loop, and number of iterations back; 0 outside loops.
    pub age: (RegionId, u8),
}

impl Place {
    /// Every component of a vector.
    pub const ALL: u8 = u8::MAX;
}

/// A product of values, and of a constant if `node` is `None`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Term {
    /// The value that is followed further; `None` is 1.
    pub place: Option<Place>,
    /// Factors, in order.
    pub factors: Vec<Factor>,
}

impl Term {
    /// Term that consists of one value.
    pub fn from_place(place: Place) -> Term {
        Term {
            place: Some(place),
            factors: Vec::new(),
        }
    }

    /// Most recently created value in the term; `None` for a constant.
    pub fn newest_node(&self) -> Option<NodeId> {
        let factors = self.factors.iter().map(|(factor, _)| factor.node);
        self.place.map(|place| place.node).into_iter().chain(factors).max()
    }

    fn at(&self, place: Place) -> Term {
        Term {
            place: Some(place),
            factors: self.factors.clone(),
        }
    }

    /// The term at another place, multiplied by a power of a value; `None` if there are too many factors.
    fn times(&self, place: Place, by: Place, power: i8) -> Option<Term> {
        let mut factors = self.factors.clone();
        match factors.iter_mut().find(|(factor, _)| *factor == by) {
            Some((_, known)) => *known += power,
            None => factors.push((by, power)),
        }
        factors.retain(|(_, power)| *power != 0);
        factors.sort_unstable();
        let many = factors
            .iter()
            .map(|(_, power)| usize::from(power.unsigned_abs()))
            .sum::<usize>();
        (many <= MAX_FACTORS).then_some(Term {
            place: Some(place),
            factors,
        })
    }
}

/// A part of a term, with its factor and the effect of the operation that uses it.
pub struct WeightedTerm {
    pub term: Term,
    pub times: f64,
    pub by: Rounding,
}

/// Effect of an operation on its parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// No rounding.
    Itself,
    /// Rounding of a product or a quotient.
    Product,
    /// Rounding of a sum.
    Sum,
}

/// A value with alternatives, one of which is followed: a selection by its condition, a carried value by its region and the
/// iterations back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Choice {
    Condition(NodeId),
    Carried(RegionId, u8),
    Left(RegionId),
}

/// Parts of a term.
pub enum Definition {
    /// No known parts.
    Leaf,
    /// Components are computed differently and must be examined one by one.
    ByLane,
    /// A sum of parts.
    Sum(Vec<WeightedTerm>),
    /// Two alternatives, selected by a choice.
    Either(Choice, [WeightedTerm; 2]),
}

/// Loops that values depend on, owners of regions, and the values that each value may be made of.
pub struct Dependence {
    /// By node, a set of the values that it may be made of, as bits. Values with disjoint sets share no term.
    reach: Vec<[u64; 4]>,
    /// By node, the innermost loop or branch region whose parameters it depends on.
    innermost: Vec<RegionId>,
    has_loops: bool,
    parents: Vec<RegionId>,
    owners: FxHashMap<RegionId, NodeId>,
}

impl Dependence {
    pub fn from_graph(graph: &Graph) -> Dependence {
        let depths: Vec<u32> = {
            let mut depths: Vec<u32> = vec![0; graph.regions.len()];
            for (k, region) in graph.regions.iter().enumerate() {
                depths[k] = region.parent.map_or(0, |parent| depths[parent.0 as usize] + 1);
            }
            depths
        };
        let parents: Vec<RegionId> = graph.regions.iter().map(|r| r.parent.unwrap_or(Graph::BODY)).collect();
        let mut innermost = vec![Graph::BODY; graph.nodes.len()];
        let mut owners = FxHashMap::default();
        for id in graph.node_ids() {
            for region in graph.regions_of(id) {
                owners.insert(region, id);
            }
            let deeper = |a: RegionId, b: RegionId| match depths[b.0 as usize] > depths[a.0 as usize] {
                true => b,
                false => a,
            };
            innermost[id.0 as usize] = match graph.node(id).op {
                Op::Param(region, _) => region,
                Op::Loop(region) | Op::If(region, _) => parents[region.0 as usize],
                _ => {
                    let args = graph.node(id).args.iter().map(|arg| innermost[arg.0 as usize]);
                    args.fold(Graph::BODY, deeper)
                }
            };
        }
        let mut dependence = Dependence {
            reach: vec![[0; 4]; graph.nodes.len()],
            innermost,
            has_loops: graph.regions.iter().any(|region| !region.params.is_empty()),
            parents,
            owners,
        };
        // A second sweep covers values that loops carry, a third one nested loops.
        for _ in 0..if dependence.has_loops { 3 } else { 1 } {
            graph.node_ids().for_each(|id| dependence.record_node(graph, id));
        }
        dependence
    }

    fn record_node(&mut self, graph: &Graph, id: NodeId) {
        let node = graph.node(id);
        let mut reach = [0; 4];
        let mut bit = |n: u32| reach[(n / 64 % 4) as usize] |= 1 << (n % 64);
        match node.op {
            // All constants are one term.
            Op::Const(_) => bit(0),
            _ => bit(1 + id.0.wrapping_mul(0x9e37_79b9) % 255),
        }
        let args = match node.op {
            Op::Param(..) | Op::Result(_) => self.incoming_values(graph, id),
            _ if node.ty.is_float() => node.args.clone(),
            _ => Vec::new(),
        };
        for arg in args.into_iter().filter(|arg| graph.ty(*arg).is_float()) {
            let of = self.reach[arg.0 as usize];
            (0..4).for_each(|k| reach[k] |= of[k]);
        }
        self.reach[id.0 as usize] = reach;
    }

    /// Returns whether values may come from a later place, through a loop.
    pub fn has_loops(&self) -> bool {
        self.has_loops
    }

    /// Set of the values that a value may be made of, as bits.
    pub fn reach_bits(&self, id: NodeId) -> [u64; 4] {
        self.reach[id.0 as usize]
    }

    /// Returns whether a value may differ between iterations of a loop.
    fn varies_in(&self, id: NodeId, region: RegionId) -> bool {
        let mut at = self.innermost[id.0 as usize];
        while at != Graph::BODY {
            if at == region {
                return true;
            }
            at = self.parents[at.0 as usize];
        }
        false
    }

    /// Values that a parameter or a result may take.
    pub fn incoming_values(&self, graph: &Graph, id: NodeId) -> Vec<NodeId> {
        let node = graph.node(id);
        match node.op {
            Op::Param(region, k) if k > 0 => {
                let results = &graph.region(region).results;
                let before = self
                    .owners
                    .get(&region)
                    .and_then(|owner| graph.node(*owner).args.get(k as usize + 1));
                results.get(k as usize - 1).into_iter().chain(before).copied().collect()
            }
            Op::Result(k) => {
                let owner = node.args[0];
                let results = graph.regions_of(owner).into_iter();
                let results = results.filter_map(|region| graph.region(region).results.get(k as usize).copied());
                let before = match graph.node(owner).op {
                    Op::Loop(_) => graph.node(owner).args.get(k as usize + 2).copied(),
                    _ => None,
                };
                results.chain(before).collect()
            }
            _ => Vec::new(),
        }
    }

    fn component_place(&self, node: NodeId, lane: u8, age: (RegionId, u8)) -> Place {
        let age = match age.1 > 0 && self.varies_in(node, age.0) {
            true => age,
            false => (Graph::BODY, 0),
        };
        Place { node, lane, age }
    }

    /// Term of a component of a value.
    pub fn component_term(&self, node: NodeId, lane: u8) -> Term {
        Term::from_place(self.component_place(node, lane, (Graph::BODY, 0)))
    }

    /// Parts that a term is made of.
    pub fn term_definition(&self, graph: &Graph, term: &Term) -> Definition {
        let Some(place) = term.place else {
            return Definition::Leaf;
        };
        let node = graph.node(place.node);
        if !node.ty.is_float() || node.ty.is_array() {
            return Definition::Leaf;
        }
        let (lane, age) = (place.lane, place.age);
        // A scalar has one component.
        let lane_of = |id: NodeId| match graph.ty(id).is_scalar() {
            true => 0,
            false => lane,
        };
        let arg = |k: usize| self.component_place(node.args[k], lane_of(node.args[k]), age);
        let part = |term: Term, times: f64, by: Rounding| WeightedTerm { term, times, by };
        let same = |place: Place, times: f64, by: Rounding| part(term.at(place), times, by);
        let constant = |id: NodeId| self.known_factor(graph, id, lane_of(id));
        match &node.op {
            Op::Const(_) => match constant(place.node) {
                ConstantFact::Number(value) => {
                    let one = Term {
                        place: None,
                        factors: term.factors.clone(),
                    };
                    Definition::Sum(vec![part(one, value, Rounding::Itself)])
                }
                ConstantFact::ByLane => Definition::ByLane,
                ConstantFact::Nothing => Definition::Leaf,
            },
            Op::Exact | Op::Tally(_) => Definition::Sum(vec![same(arg(0), 1.0, Rounding::Itself)]),
            Op::Unary(UnaryOp::Neg) => Definition::Sum(vec![same(arg(0), -1.0, Rounding::Itself)]),
            Op::Unary(UnaryOp::Sqrt) => {
                // The root times itself.
                let by_itself = term
                    .factors
                    .iter()
                    .any(|(factor, power)| *factor == place && *power > 0);
                match by_itself.then(|| term.times(arg(0), place, -1)).flatten() {
                    Some(square) => Definition::Sum(vec![part(square, 1.0, Rounding::Product)]),
                    None => Definition::Leaf,
                }
            }
            Op::Binary(BinaryOp::Add) => {
                Definition::Sum(vec![same(arg(0), 1.0, Rounding::Sum), same(arg(1), 1.0, Rounding::Sum)])
            }
            Op::Binary(BinaryOp::Sub) => Definition::Sum(vec![
                same(arg(0), 1.0, Rounding::Sum),
                same(arg(1), -1.0, Rounding::Sum),
            ]),
            Op::Binary(BinaryOp::Mul) => match (constant(node.args[0]), constant(node.args[1])) {
                (ConstantFact::ByLane, _) | (_, ConstantFact::ByLane) => Definition::ByLane,
                (_, ConstantFact::Number(by)) => Definition::Sum(vec![same(arg(0), by, scaling_effect(by))]),
                (ConstantFact::Number(by), _) => Definition::Sum(vec![same(arg(1), by, scaling_effect(by))]),
                _ => Definition::Sum(self.expand_product(term, arg(0), arg(1))),
            },
            Op::Binary(BinaryOp::Div) => match constant(node.args[1]) {
                ConstantFact::ByLane => Definition::ByLane,
                ConstantFact::Number(0.0) => Definition::Leaf,
                ConstantFact::Number(by) => Definition::Sum(vec![same(arg(0), 1.0 / by, scaling_effect(by))]),
                ConstantFact::Nothing => match term.times(arg(0), arg(1), -1) {
                    Some(quotient) => Definition::Sum(vec![part(quotient, 1.0, Rounding::Product)]),
                    None => Definition::Leaf,
                },
            },
            Op::Dot => {
                let lanes = 0..graph.ty(node.args[0]).component_count();
                Definition::Sum(lanes.flat_map(|lane| self.product_of(graph, term, lane)).collect())
            }
            Op::Splat => Definition::Sum(vec![same(
                self.component_place(node.args[0], 0, age),
                1.0,
                Rounding::Itself,
            )]),
            Op::Compose if lane == Place::ALL => Definition::ByLane,
            Op::Compose => Definition::Sum(vec![same(
                self.component_place(node.args[lane as usize], 0, age),
                1.0,
                Rounding::Itself,
            )]),
            Op::Extract(k) => Definition::Sum(vec![same(
                self.component_place(node.args[0], *k, age),
                1.0,
                Rounding::Itself,
            )]),
            Op::Select => {
                let choice = Choice::Condition(node.args[0]);
                Definition::Either(
                    choice,
                    [same(arg(1), 1.0, Rounding::Itself), same(arg(2), 1.0, Rounding::Itself)],
                )
            }
            Op::Result(k) => {
                let owner = graph.node(node.args[0]);
                let result = |region: &RegionId| graph.region(*region).results.get(*k as usize).copied();
                match &owner.op {
                    Op::If(then, otherwise) => match (result(then), result(otherwise)) {
                        (Some(yes), Some(no)) => {
                            let sides = [yes, no]
                                .map(|side| same(self.component_place(side, lane, age), 1.0, Rounding::Itself));
                            Definition::Either(Choice::Condition(owner.args[0]), sides)
                        }
                        _ => Definition::Leaf,
                    },
                    Op::Loop(body) => match (result(body), owner.args.get(*k as usize + 2)) {
                        (Some(last), Some(before)) if age.1 == 0 => {
                            let sides = [last, *before]
                                .map(|side| same(self.component_place(side, lane, age), 1.0, Rounding::Itself));
                            Definition::Either(Choice::Left(*body), sides)
                        }
                        _ => Definition::Leaf,
                    },
                    _ => Definition::Leaf,
                }
            }
            Op::Param(region, k) if *k > 0 => {
                let back = match age {
                    (_, 0) => 1,
                    (of, back) if of == *region && back < MAX_AGE => back + 1,
                    _ => return Definition::Leaf,
                };
                let last = graph.region(*region).results.get(*k as usize - 1);
                let owner = self.owners.get(region).map(|owner| graph.node(*owner));
                match (last, owner.and_then(|owner| owner.args.get(*k as usize + 1))) {
                    (Some(last), Some(before)) => {
                        let last = same(
                            self.component_place(*last, lane, (*region, back)),
                            1.0,
                            Rounding::Itself,
                        );
                        let before = same(
                            self.component_place(*before, lane, (Graph::BODY, 0)),
                            1.0,
                            Rounding::Itself,
                        );
                        Definition::Either(Choice::Carried(*region, back), [last, before])
                    }
                    _ => Definition::Leaf,
                }
            }
            _ => Definition::Leaf,
        }
    }

    /// Product of one component in a dot product.
    pub fn dot_part(&self, graph: &Graph, dot: NodeId, lane: u8) -> Vec<WeightedTerm> {
        self.product_of(graph, &self.component_term(dot, 0), lane)
    }

    fn product_of(&self, graph: &Graph, term: &Term, lane: u8) -> Vec<WeightedTerm> {
        let Some(place) = term.place else { return Vec::new() };
        let args = &graph.node(place.node).args;
        let [left, right] = [0, 1].map(|k| self.component_place(args[k], lane, place.age));
        let scaled = |place: Place, times: f64| {
            vec![WeightedTerm {
                term: term.at(place),
                times,
                by: Rounding::Sum,
            }]
        };
        match [0, 1].map(|k| self.known_factor(graph, args[k], lane)) {
            [_, ConstantFact::Number(by)] => scaled(left, by),
            [ConstantFact::Number(by), _] => scaled(right, by),
            _ => self.expand_product(term, left, right),
        }
    }

    /// Expands a product to each of its two values times the other.
    fn expand_product(&self, term: &Term, x: Place, y: Place) -> Vec<WeightedTerm> {
        let both = [term.times(x, y, 1), term.times(y, x, 1).filter(|_| x != y)];
        let part = |term| WeightedTerm {
            term,
            times: 1.0,
            by: Rounding::Product,
        };
        both.into_iter().flatten().map(part).collect()
    }

    fn known_factor(&self, graph: &Graph, id: NodeId, lane: u8) -> ConstantFact {
        let ty = graph.ty(id);
        let Some(bits) = graph.constant_bits(id) else {
            return match (&graph.node(id).op, lane) {
                // A vector of equal components.
                (Op::Splat, _) => self.known_factor(graph, graph.node(id).args[0], 0),
                _ => ConstantFact::Nothing,
            };
        };
        let lanes = &bits[..usize::from(ty.component_count())];
        let bits = match lane {
            Place::ALL if lanes.iter().any(|bits| *bits != lanes[0]) => return ConstantFact::ByLane,
            Place::ALL => lanes[0],
            lane => lanes[usize::from(lane)],
        };
        let value = f32::from_bits(bits);
        match value.is_finite() && ty != Type::Results {
            true => ConstantFact::Number(value.into()),
            false => ConstantFact::Nothing,
        }
    }
}

/// Constant facts about a component.
enum ConstantFact {
    Number(f64),
    /// Components differ.
    ByLane,
    Nothing,
}

/// Effect of multiplying by a number: a power of two rounds nothing.
fn scaling_effect(x: f64) -> Rounding {
    match x != 0.0 && x.to_bits() << 12 == 0 {
        true => Rounding::Itself,
        false => Rounding::Product,
    }
}
