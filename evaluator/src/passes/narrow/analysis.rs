//! Extents of all runtime `usize` of a graph, including loops.

use super::Facts;
use super::extent::{Extent, WORD};
use crate::ir::{BinaryOp, Graph, NodeId, Op, RegionId, Scalar, Type, UnaryOp, usize_value};
use crate::passes::ranges;
use std::collections::HashMap;

/// Upper bound on the iterations of a loop in a shader.
const LONGEST_LOOP: i128 = 1 << 24;

/// Number of rounds after which a value that still grows in a loop is widened. After `GIVE_UP` rounds nothing is known of
/// it.
const WIDEN: u32 = 4;
const GIVE_UP: u32 = 40;

/// Extents of each `usize` of a graph.
pub struct Analysis<'g> {
    pub graph: &'g Graph,
    facts: &'g Facts,
    /// Capped conversions, with their caps.
    caps: &'g HashMap<NodeId, i128>,
    extents: Vec<Extent>,
    /// Loop or branch of each region.
    owners: HashMap<RegionId, NodeId>,
}

/// Returns whether a node is a `usize`, or an array of them.
pub fn is_wide(graph: &Graph, id: NodeId) -> bool {
    graph.ty(id).scalar_kind() == Some(Scalar::Usize)
}

impl<'g> Analysis<'g> {
    /// Computes the extents.
    pub fn from_graph(graph: &'g Graph, facts: &'g Facts, caps: &'g HashMap<NodeId, i128>) -> Analysis<'g> {
        let mut owners = HashMap::new();
        for id in graph.node_ids() {
            owners.extend(graph.regions_of(id).into_iter().map(|region| (region, id)));
        }
        let mut analysis = Analysis {
            graph,
            facts,
            caps,
            extents: vec![Extent::range(0, 0); graph.nodes.len()],
            owners,
        };
        let mut carried: HashMap<NodeId, Extent> = HashMap::new();
        for round in 0..=GIVE_UP {
            for id in graph.node_ids().filter(|id| is_wide(graph, *id)) {
                let found = analysis.compute_extent(id, &carried);
                analysis.extents[id.0 as usize] = found;
            }
            if !analysis.propagate_carried(&mut carried, round) {
                break;
            }
        }
        analysis
    }

    /// Propagates extents of carried values to the next iteration. Returns whether any of them grew.
    fn propagate_carried(&self, carried: &mut HashMap<NodeId, Extent>, round: u32) -> bool {
        let mut changed = false;
        for (k, node) in self.graph.nodes.iter().enumerate() {
            let Op::Loop(region) = node.op else { continue };
            let entry = self.graph.region(region);
            if !self.owners.contains_key(&region) || self.owners[&region].0 as usize != k {
                continue;
            }
            for (param, result) in entry.params.iter().skip(1).zip(&entry.results) {
                if !is_wide(self.graph, *param) {
                    continue;
                }
                let before = self.usize_extent(*param);
                let after = before.join(self.usize_extent(*result));
                if after != before {
                    changed = true;
                    let wider = match round {
                        GIVE_UP.. => Extent::Lost,
                        WIDEN.. => widen_extent(before, after),
                        _ => after,
                    };
                    carried.insert(*param, wider);
                }
            }
        }
        changed
    }

    /// Returns the extent of a `usize`.
    pub fn usize_extent(&self, id: NodeId) -> Extent {
        self.extents[id.0 as usize]
    }

    /// Returns the extent of an argument of a node.
    pub fn arg_extent(&self, id: NodeId, k: usize) -> Extent {
        self.usize_extent(self.graph.node(id).args[k])
    }

    /// Returns whether a difference wraps intentionally.
    fn is_wrapping(&self, id: NodeId) -> bool {
        self.facts.wrapping.contains(&id)
    }

    fn compute_extent(&self, id: NodeId, carried: &HashMap<NodeId, Extent>) -> Extent {
        let node = self.graph.node(id);
        let of = |k: usize| self.usize_extent(node.args[k]);
        let found = match &node.op {
            Op::Const(bits) => {
                let value = i128::from(usize_value(bits) as i64);
                Extent::range(value, value)
            }
            Op::Undef => Extent::range(0, 0),
            Op::Convert => self.converted_extent(id),
            Op::Unary(UnaryOp::BitNot) => of(0).inverted(),
            Op::Unary(UnaryOp::CountOneBits) if of(0).is_exact() => Extent::range(0, 32),
            Op::Binary(BinaryOp::Add) => of(0).plus(of(1)),
            Op::Binary(BinaryOp::Sub) => of(0).minus(of(1), self.is_wrapping(id)),
            Op::Binary(BinaryOp::Mul) => of(0).times(of(1)),
            Op::Binary(BinaryOp::Div) => of(0).divided(of(1)).unwrap_or(Extent::Lost),
            Op::Binary(BinaryOp::Rem | BinaryOp::And) if self.float_by(id).is_some() => match self.float_by(id) {
                Some((_, by)) if node.op == Op::Binary(BinaryOp::And) => Extent::range(0, by.into()),
                Some((_, by)) => Extent::range(0, i128::from(by) - 1),
                None => Extent::Lost,
            },
            Op::Binary(BinaryOp::Rem) => of(0).rest(of(1)).unwrap_or(Extent::Lost),
            Op::Binary(BinaryOp::And) => of(0).masked(of(1)),
            Op::Binary(BinaryOp::Or | BinaryOp::Xor) => of(0).mixed(of(1)),
            Op::Binary(BinaryOp::Shl) => power_of_two(of(1)).map_or(Extent::Lost, |by| of(0).times(by)),
            Op::Binary(BinaryOp::Shr) => power_of_two(of(1))
                .and_then(|by| of(0).divided(by))
                .unwrap_or(Extent::Lost),
            Op::Binary(BinaryOp::Min) => of(0).smaller(of(1)),
            Op::Binary(BinaryOp::Max) => of(0).larger(of(1)),
            Op::Clamp => of(0).larger(of(1)).smaller(of(2)),
            Op::Select => {
                let condition = node.args[0];
                let side = |k: usize, holds| self.extent_under(node.args[k], condition, holds);
                side(1, true).join(side(2, false))
            }
            Op::MakeArray => node
                .args
                .iter()
                .map(|id| self.usize_extent(*id))
                .reduce(Extent::join)
                .unwrap_or(Extent::Lost),
            Op::ArraySet => of(0).join(of(2)),
            Op::ArrayGet | Op::Tally(_) | Op::QuadSwap(_) => of(0),
            Op::Param(region, 0) => self.counter_extent(*region),
            Op::Param(region, k) => {
                let owner = self.owners.get(region).map(|owner| self.graph.node(*owner));
                let first = owner.and_then(|owner| owner.args.get(*k as usize + 1));
                let first = first.map_or(Extent::Lost, |first| self.usize_extent(*first));
                carried.get(&id).map_or(first, |carried| carried.join(first))
            }
            Op::Result(k) => {
                let (owner, k) = (self.graph.node(node.args[0]), *k as usize);
                let results = |region: &RegionId| self.usize_extent(self.graph.region(*region).results[k]);
                match &owner.op {
                    Op::Loop(region) => self.usize_extent(owner.args[k + 2]).join(results(region)),
                    Op::If(then, otherwise) => {
                        let side = |region: &RegionId, holds| {
                            self.extent_under(self.graph.region(*region).results[k], owner.args[0], holds)
                        };
                        side(then, true).join(side(otherwise, false))
                    }
                    _ => Extent::Lost,
                }
            }
            _ => Extent::Lost,
        };
        match self.facts.counters.get(&id) {
            Some((start, end)) => self.range_extent(*start, *end).unwrap_or(found),
            None => found,
        }
    }

    /// Float that an unbounded `usize` was converted from, unless a cap was requested.
    pub fn float_of(&self, id: NodeId) -> Option<NodeId> {
        let node = self.graph.node(id);
        let float = *node.args.first()?;
        let made = node.op == Op::Convert && self.graph.ty(float) == Type::F32 && !self.caps.contains_key(&id);
        (made && self.usize_extent(id).bounds().is_none()).then_some(float)
    }

    /// For the remainder or mask of an unbounded float by a constant: the float and the constant. A shader can compute
    /// these with all 64 bits.
    pub fn float_by(&self, id: NodeId) -> Option<(NodeId, u32)> {
        let node = self.graph.node(id);
        let by = self
            .graph
            .constant_bits(*node.args.get(1)?)
            .map(|bits| usize_value(&bits))?;
        let most = match node.op {
            Op::Binary(BinaryOp::Rem) if by > 0 => u64::from(u16::MAX),
            Op::Binary(BinaryOp::And) => u64::from(u32::MAX),
            _ => return None,
        };
        let float = self.float_of(node.args[0])?;
        (by <= most).then_some((float, by as u32))
    }

    /// Loop or branch of a region.
    pub fn region_owner(&self, region: RegionId) -> Option<NodeId> {
        self.owners.get(&region).copied()
    }

    /// Returns the extent of a value where its comparison with a constant holds, or where it does not.
    fn extent_under(&self, id: NodeId, condition: NodeId, holds: bool) -> Extent {
        let (whole, node) = (self.usize_extent(id), self.graph.node(condition));
        let (Op::Binary(op), Some((low, high)), [first, second]) = (&node.op, whole.bounds(), node.args.as_slice())
        else {
            return whole;
        };
        let (other, op) = match (*first == id, *second == id) {
            (true, false) => (*second, *op),
            (false, true) => (
                *first,
                match op {
                    BinaryOp::Lt => BinaryOp::Gt,
                    BinaryOp::Le => BinaryOp::Ge,
                    BinaryOp::Gt => BinaryOp::Lt,
                    BinaryOp::Ge => BinaryOp::Le,
                    op => *op,
                },
            ),
            _ => return whole,
        };
        if !is_wide(self.graph, other) || !whole.is_ordered_with(self.usize_extent(other)) {
            return whole;
        }
        let Some((least, most)) = self.usize_extent(other).bounds() else {
            return whole;
        };
        // Negative values, which are the largest, and others.
        let bounded = |low: i128, high: i128| match low <= high {
            true => Extent::range(low, high),
            false => whole,
        };
        match (op, holds) {
            (BinaryOp::Eq, true) | (BinaryOp::Ne, false) => self.usize_extent(other),
            (BinaryOp::Eq, false) | (BinaryOp::Ne, true) if least == most && least == low => bounded(low + 1, high),
            (BinaryOp::Eq, false) | (BinaryOp::Ne, true) if least == most && least == high => bounded(low, high - 1),
            (BinaryOp::Lt, true) | (BinaryOp::Ge, false) if least >= 0 => bounded(low.max(0), high.min(most - 1)),
            (BinaryOp::Le, true) | (BinaryOp::Gt, false) if least >= 0 => bounded(low.max(0), high.min(most)),
            _ => whole,
        }
    }

    /// Extent of a number converted to a `usize`.
    fn converted_extent(&self, id: NodeId) -> Extent {
        let from = self.graph.node(id).args[0];
        let cap = self.caps.get(&id).copied();
        let (low, high) = match self.graph.ty(from) {
            Type::F32 => match ranges::float_bounds(self.graph, from, 0) {
                Some((_, high)) if high < WORD as f32 => (0, i128::from(high.max(0.0) as u64)),
                _ => (0, i128::MAX),
            },
            Type::BOOL => (0, 1),
            ty => {
                let (low, high) = ranges::integer_bounds(self.graph, from).unwrap_or(match ty {
                    Type::U32 => (0, u32::MAX.into()),
                    _ => (i32::MIN.into(), i32::MAX.into()),
                });
                (low.into(), i128::from(high))
            }
        };
        match cap {
            Some(cap) if low < 0 || high > cap => Extent::capped(low.max(0), cap, Some(cap)),
            None if high == i128::MAX => Extent::capped(0, WORD - 1, Some(WORD - 1)),
            _ => Extent::range(low, high),
        }
    }

    /// Extent of a loop's counter.
    fn counter_extent(&self, region: RegionId) -> Extent {
        let Some(owner) = self.owners.get(&region) else {
            return Extent::Lost;
        };
        let (start, end) = (self.arg_extent(*owner, 0), self.arg_extent(*owner, 1));
        let (
            Extent::Known { low, high, .. },
            Extent::Known {
                low: from, high: to, ..
            },
        ) = (start, end)
        else {
            return Extent::Lost;
        };
        let farthest = high + LONGEST_LOOP;
        let last = if from < 0 { farthest } else { (to - 1).min(farthest) };
        Extent::range(low, last.max(low))
    }

    /// Returns the extent of the values between the ends of a range.
    fn range_extent(&self, start: NodeId, end: NodeId) -> Option<Extent> {
        let ((low, high), (from, to)) = (self.usize_extent(start).bounds()?, self.usize_extent(end).bounds()?);
        let last = if from < 0 { i32::MAX.into() } else { to };
        (low >= 0).then(|| Extent::range(low, last.max(high)))
    }
}

/// Extent of 2 to the power of a shift count, if a shader may shift by it.
pub fn power_of_two(count: Extent) -> Option<Extent> {
    let (low, high) = count.bounds()?;
    (low >= 0 && high < 32).then(|| Extent::range(1 << low, 1 << high))
}

/// Extent of a carried value that still grows after [`WIDEN`] rounds.
fn widen_extent(before: Extent, after: Extent) -> Extent {
    match (before, after) {
        (
            Extent::Known {
                low, counted: false, ..
            },
            Extent::Known {
                low: least,
                high,
                cap: None,
                ..
            },
        ) if least >= low && high <= super::extent::COUNTED => Extent::counted(low),
        (_, after) if after.has_bits() => Extent::Modular,
        _ => Extent::Lost,
    }
}
