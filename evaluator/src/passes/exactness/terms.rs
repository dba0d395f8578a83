//! Terms of sums, and how each is made of others.

use crate::ir::{BinaryOp, Graph, NodeId, Op, RegionId, Type, UnaryOp};
use rustc_hash::FxHashMap;

/// A factor with its power.
pub type Factor = (Place, i8);

/// Factors that a product is followed through.
const MAX_FACTORS: usize = 2;

/// Iterations back that a carried value is followed.
const MAX_AGE: u8 = 2;

/// A component of a value, in an iteration of the loop around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// The value.
    pub node: NodeId,
    /// The component, or [`Place::ALL`] for a vector whose components are all computed alike.
    pub lane: u8,
    /// Iterations back, and of which loop; 0 outside of loops.
    pub age: (RegionId, u8),
}

impl Place {
    /// Every component of a vector.
    pub const ALL: u8 = u8::MAX;
}

/// A product of values and, where `node` is `None`, of a constant.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Term {
    /// The value that is followed further; `None` is 1.
    pub place: Option<Place>,
    /// By which it is multiplied, in order.
    pub factors: Vec<Factor>,
}

impl Term {
    /// A value.
    pub fn of(place: Place) -> Term {
        Term {
            place: Some(place),
            factors: Vec::new(),
        }
    }

    /// The value in it that was made last; `None` of a constant.
    pub fn newest(&self) -> Option<NodeId> {
        let factors = self.factors.iter().map(|(factor, _)| factor.node);
        self.place.map(|place| place.node).into_iter().chain(factors).max()
    }

    fn at(&self, place: Place) -> Term {
        Term {
            place: Some(place),
            factors: self.factors.clone(),
        }
    }

    /// The term at another place, multiplied by a power of a value; `None` if that has too many factors.
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

/// A part of a term: how often it is taken, and what the operation does that takes it.
pub struct Part {
    pub term: Term,
    pub times: f64,
    pub by: By,
}

/// Effect of an operation on the parts of its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// Rounds nothing.
    Itself,
    /// Rounds a product or a quotient.
    Product,
    /// Rounds a sum.
    Sum,
}

/// A value that has alternatives, of which one is followed: a selection by its condition, what a loop carries by its region and the
/// iterations back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Choice {
    Condition(NodeId),
    Carried(RegionId, u8),
    Left(RegionId),
}

/// Terms that a term is made of.
pub enum Made {
    /// Nothing else is known of it.
    Leaf,
    /// Components are computed differently: each must be looked at by itself.
    ByLane,
    /// A sum of others.
    Sum(Vec<Part>),
    /// Two alternatives, of which a choice takes one.
    Either(Choice, [Part; 2]),
}

/// Loops that values depend on, the nodes of loops and branches, and what values may be made of.
pub struct Dependence {
    /// By node, a set of the values that it may be made of, as bits: two values whose sets have none in common share no term.
    reach: Vec<[u64; 4]>,
    /// By node, the innermost loop's or branch's region whose parameters it depends on.
    innermost: Vec<RegionId>,
    has_loops: bool,
    parents: Vec<RegionId>,
    owners: FxHashMap<RegionId, NodeId>,
}

impl Dependence {
    pub fn of(graph: &Graph) -> Dependence {
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
        for id in graph.ids() {
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
        // Again for what loops carry back, and once more for a loop in a loop.
        for _ in 0..if dependence.has_loops { 3 } else { 1 } {
            graph.ids().for_each(|id| dependence.gather(graph, id));
        }
        dependence
    }

    fn gather(&mut self, graph: &Graph, id: NodeId) {
        let node = graph.node(id);
        let mut reach = [0; 4];
        let mut bit = |n: u32| reach[(n / 64 % 4) as usize] |= 1 << (n % 64);
        match node.op {
            // All constants are one term.
            Op::Const(_) => bit(0),
            _ => bit(1 + id.0.wrapping_mul(0x9e37_79b9) % 255),
        }
        let args = match node.op {
            Op::Param(..) | Op::Result(_) => self.sources(graph, id),
            _ if node.ty.is_float() => node.args.clone(),
            _ => Vec::new(),
        };
        for arg in args.into_iter().filter(|arg| graph.ty(*arg).is_float()) {
            let of = self.reach[arg.0 as usize];
            (0..4).for_each(|k| reach[k] |= of[k]);
        }
        self.reach[id.0 as usize] = reach;
    }

    /// True if values may come from a later place, by way of a loop.
    pub fn has_loops(&self) -> bool {
        self.has_loops
    }

    /// A set of the values that a value may be made of, as bits.
    pub fn reach(&self, id: NodeId) -> [u64; 4] {
        self.reach[id.0 as usize]
    }

    /// Tells if a value may differ from iteration to iteration of a loop.
    fn varies(&self, id: NodeId, region: RegionId) -> bool {
        let mut at = self.innermost[id.0 as usize];
        while at != Graph::BODY {
            if at == region {
                return true;
            }
            at = self.parents[at.0 as usize];
        }
        false
    }

    /// The values that may come to be that of a parameter or a result.
    pub fn sources(&self, graph: &Graph, id: NodeId) -> Vec<NodeId> {
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

    fn place(&self, node: NodeId, lane: u8, age: (RegionId, u8)) -> Place {
        let age = match age.1 > 0 && self.varies(node, age.0) {
            true => age,
            false => (Graph::BODY, 0),
        };
        Place { node, lane, age }
    }

    /// The term of a component of a value.
    pub fn term(&self, node: NodeId, lane: u8) -> Term {
        Term::of(self.place(node, lane, (Graph::BODY, 0)))
    }

    /// Terms that a term is made of.
    pub fn made(&self, graph: &Graph, term: &Term) -> Made {
        let Some(place) = term.place else { return Made::Leaf };
        let node = graph.node(place.node);
        if !node.ty.is_float() || node.ty.is_array() {
            return Made::Leaf;
        }
        let (lane, age) = (place.lane, place.age);
        // Of a scalar there is one component.
        let lane_of = |id: NodeId| match graph.ty(id).is_scalar() {
            true => 0,
            false => lane,
        };
        let arg = |k: usize| self.place(node.args[k], lane_of(node.args[k]), age);
        let part = |term: Term, times: f64, by: By| Part { term, times, by };
        let same = |place: Place, times: f64, by: By| part(term.at(place), times, by);
        let constant = |id: NodeId| self.constant(graph, id, lane_of(id));
        match &node.op {
            Op::Const(_) => match constant(place.node) {
                Known::Number(value) => {
                    let one = Term {
                        place: None,
                        factors: term.factors.clone(),
                    };
                    Made::Sum(vec![part(one, value, By::Itself)])
                }
                Known::ByLane => Made::ByLane,
                Known::Nothing => Made::Leaf,
            },
            Op::Exact | Op::Tally(_) => Made::Sum(vec![same(arg(0), 1.0, By::Itself)]),
            Op::Unary(UnaryOp::Neg) => Made::Sum(vec![same(arg(0), -1.0, By::Itself)]),
            Op::Unary(UnaryOp::Sqrt) => {
                // The root multiplied by itself.
                let by_itself = term
                    .factors
                    .iter()
                    .any(|(factor, power)| *factor == place && *power > 0);
                match by_itself.then(|| term.times(arg(0), place, -1)).flatten() {
                    Some(square) => Made::Sum(vec![part(square, 1.0, By::Product)]),
                    None => Made::Leaf,
                }
            }
            Op::Binary(BinaryOp::Add) => Made::Sum(vec![same(arg(0), 1.0, By::Sum), same(arg(1), 1.0, By::Sum)]),
            Op::Binary(BinaryOp::Sub) => Made::Sum(vec![same(arg(0), 1.0, By::Sum), same(arg(1), -1.0, By::Sum)]),
            Op::Binary(BinaryOp::Mul) => match (constant(node.args[0]), constant(node.args[1])) {
                (Known::ByLane, _) | (_, Known::ByLane) => Made::ByLane,
                (_, Known::Number(by)) => Made::Sum(vec![same(arg(0), by, scaling(by))]),
                (Known::Number(by), _) => Made::Sum(vec![same(arg(1), by, scaling(by))]),
                _ => Made::Sum(self.product(term, arg(0), arg(1))),
            },
            Op::Binary(BinaryOp::Div) => match constant(node.args[1]) {
                Known::ByLane => Made::ByLane,
                Known::Number(0.0) => Made::Leaf,
                Known::Number(by) => Made::Sum(vec![same(arg(0), 1.0 / by, scaling(by))]),
                Known::Nothing => match term.times(arg(0), arg(1), -1) {
                    Some(quotient) => Made::Sum(vec![part(quotient, 1.0, By::Product)]),
                    None => Made::Leaf,
                },
            },
            Op::Dot => {
                let lanes = 0..graph.ty(node.args[0]).components();
                Made::Sum(lanes.flat_map(|lane| self.product_of(graph, term, lane)).collect())
            }
            Op::Splat => Made::Sum(vec![same(self.place(node.args[0], 0, age), 1.0, By::Itself)]),
            Op::Compose if lane == Place::ALL => Made::ByLane,
            Op::Compose => Made::Sum(vec![same(
                self.place(node.args[lane as usize], 0, age),
                1.0,
                By::Itself,
            )]),
            Op::Extract(k) => Made::Sum(vec![same(self.place(node.args[0], *k, age), 1.0, By::Itself)]),
            Op::Select => {
                let choice = Choice::Condition(node.args[0]);
                Made::Either(choice, [same(arg(1), 1.0, By::Itself), same(arg(2), 1.0, By::Itself)])
            }
            Op::Result(k) => {
                let owner = graph.node(node.args[0]);
                let result = |region: &RegionId| graph.region(*region).results.get(*k as usize).copied();
                match &owner.op {
                    Op::If(then, otherwise) => match (result(then), result(otherwise)) {
                        (Some(yes), Some(no)) => {
                            let sides = [yes, no].map(|side| same(self.place(side, lane, age), 1.0, By::Itself));
                            Made::Either(Choice::Condition(owner.args[0]), sides)
                        }
                        _ => Made::Leaf,
                    },
                    Op::Loop(body) => match (result(body), owner.args.get(*k as usize + 2)) {
                        (Some(last), Some(before)) if age.1 == 0 => {
                            let sides = [last, *before].map(|side| same(self.place(side, lane, age), 1.0, By::Itself));
                            Made::Either(Choice::Left(*body), sides)
                        }
                        _ => Made::Leaf,
                    },
                    _ => Made::Leaf,
                }
            }
            Op::Param(region, k) if *k > 0 => {
                let back = match age {
                    (_, 0) => 1,
                    (of, back) if of == *region && back < MAX_AGE => back + 1,
                    _ => return Made::Leaf,
                };
                let last = graph.region(*region).results.get(*k as usize - 1);
                let owner = self.owners.get(region).map(|owner| graph.node(*owner));
                match (last, owner.and_then(|owner| owner.args.get(*k as usize + 1))) {
                    (Some(last), Some(before)) => {
                        let last = same(self.place(*last, lane, (*region, back)), 1.0, By::Itself);
                        let before = same(self.place(*before, lane, (Graph::BODY, 0)), 1.0, By::Itself);
                        Made::Either(Choice::Carried(*region, back), [last, before])
                    }
                    _ => Made::Leaf,
                }
            }
            _ => Made::Leaf,
        }
    }

    /// The product of one component of a dot product.
    pub fn dot_part(&self, graph: &Graph, dot: NodeId, lane: u8) -> Vec<Part> {
        self.product_of(graph, &self.term(dot, 0), lane)
    }

    fn product_of(&self, graph: &Graph, term: &Term, lane: u8) -> Vec<Part> {
        let Some(place) = term.place else { return Vec::new() };
        let args = &graph.node(place.node).args;
        let [left, right] = [0, 1].map(|k| self.place(args[k], lane, place.age));
        let scaled = |place: Place, times: f64| {
            vec![Part {
                term: term.at(place),
                times,
                by: By::Sum,
            }]
        };
        match [0, 1].map(|k| self.constant(graph, args[k], lane)) {
            [_, Known::Number(by)] => scaled(left, by),
            [Known::Number(by), _] => scaled(right, by),
            _ => self.product(term, left, right),
        }
    }

    /// A product of two values as each of them times the other.
    fn product(&self, term: &Term, x: Place, y: Place) -> Vec<Part> {
        let both = [term.times(x, y, 1), term.times(y, x, 1).filter(|_| x != y)];
        let part = |term| Part {
            term,
            times: 1.0,
            by: By::Product,
        };
        both.into_iter().flatten().map(part).collect()
    }

    fn constant(&self, graph: &Graph, id: NodeId, lane: u8) -> Known {
        let ty = graph.ty(id);
        let Some(bits) = graph.constant(id) else {
            return match (&graph.node(id).op, lane) {
                // A vector of one number.
                (Op::Splat, _) => self.constant(graph, graph.node(id).args[0], 0),
                _ => Known::Nothing,
            };
        };
        let lanes = &bits[..usize::from(ty.components())];
        let bits = match lane {
            Place::ALL if lanes.iter().any(|bits| *bits != lanes[0]) => return Known::ByLane,
            Place::ALL => lanes[0],
            lane => lanes[usize::from(lane)],
        };
        let value = f32::from_bits(bits);
        match value.is_finite() && ty != Type::Results {
            true => Known::Number(value.into()),
            false => Known::Nothing,
        }
    }
}

/// Facts about a component that are known without running anything.
enum Known {
    Number(f64),
    /// Components differ.
    ByLane,
    Nothing,
}

/// Effect of multiplying by a number: by a power of two it rounds nothing.
fn scaling(x: f64) -> By {
    match x != 0.0 && x.to_bits() << 12 == 0 {
        true => By::Itself,
        false => By::Product,
    }
}
