//! Replacement of each `usize` by an `i32` or a `u32`.

use super::analysis::{Analysis, is_wide, power_of_two};
use super::extent::{Extent, WORD};
use crate::ir::{BinaryOp, Builder, Graph, NodeId, Op, RegionId, Replace, Scalar, Type, UnaryOp, usize_value};
use std::collections::HashMap;

/// Rebuilds the graph without `usize`.
pub struct Lower<'a> {
    of: &'a Analysis<'a>,
    graph: &'a Graph,
    caps: &'a HashMap<NodeId, i128>,
    /// Kind of the elements of all arrays.
    arrays: Scalar,
    /// Kind of a region's result, by its position.
    results: HashMap<(RegionId, usize), Scalar>,
    /// Operations whose result would differ in the shader.
    refused: Vec<NodeId>,
    /// Operations whose result would differ because their operands are already lost.
    following: Vec<NodeId>,
}

/// Replacements of the nodes so far.
type New<'n> = &'n [Option<NodeId>];

impl<'a> Lower<'a> {
    pub fn new(of: &'a Analysis<'a>, caps: &'a HashMap<NodeId, i128>) -> Lower<'a> {
        let graph = of.graph;
        let arrays = graph
            .node_ids()
            .filter(|id| graph.ty(*id).is_array() && is_wide(graph, *id));
        let arrays = match arrays.into_iter().all(|id| of.usize_extent(id).is_signed()) {
            true => Scalar::I32,
            false => Scalar::U32,
        };
        let mut lower = Lower {
            of,
            graph,
            caps,
            arrays,
            results: HashMap::new(),
            refused: Vec::new(),
            following: Vec::new(),
        };
        for id in graph.node_ids() {
            match &graph.node(id).op {
                Op::Loop(body) => {
                    let params = graph.region(*body).params.iter().skip(1).enumerate();
                    for (k, param) in params.filter(|(_, param)| is_wide(graph, **param)) {
                        let kind = lower.own_kind(*param);
                        lower.results.insert((*body, k), kind);
                    }
                }
                Op::If(then, otherwise) => {
                    let pairs = graph
                        .region(*then)
                        .results
                        .iter()
                        .zip(&graph.region(*otherwise).results);
                    for (k, (a, b)) in pairs.enumerate().filter(|(_, (a, _))| is_wide(graph, **a)) {
                        let kind = match graph.ty(*a).is_array() {
                            true => arrays,
                            false => kind_of(of.usize_extent(*a).join(of.usize_extent(*b))),
                        };
                        lower.results.insert((*then, k), kind);
                        lower.results.insert((*otherwise, k), kind);
                    }
                }
                _ => {}
            }
        }
        lower
    }

    /// Operations whose result would differ in the shader. Those that only follow from others are left out.
    pub fn into_refused(self) -> Vec<NodeId> {
        match self.refused.is_empty() {
            true => self.following,
            false => self.refused,
        }
    }

    /// Kind that a node's own extent requires.
    fn own_kind(&self, id: NodeId) -> Scalar {
        match self.graph.ty(id).is_array() {
            true => self.arrays,
            false => kind_of(self.of.usize_extent(id)),
        }
    }

    /// Kind that represents a `usize`.
    fn usize_kind(&self, id: NodeId) -> Scalar {
        let node = self.graph.node(id);
        match node.op {
            Op::Param(region, 0) => self.counted_in(region),
            Op::Result(k) => {
                let region = self.graph.regions_of(node.args[0]).first().copied();
                let kind = region.and_then(|region| self.results.get(&(region, k as usize)));
                kind.copied().unwrap_or(Scalar::U32)
            }
            _ => self.own_kind(id),
        }
    }

    /// Kind of a loop's counter.
    fn counted_in(&self, region: RegionId) -> Scalar {
        match self.of.region_owner(region) {
            Some(owner) if (0..2).all(|k| self.of.arg_extent(owner, k).is_natural()) => Scalar::I32,
            _ => Scalar::U32,
        }
    }

    /// Replacement of a node, converted to a kind.
    fn as_kind(&self, b: &mut Builder<'_>, old: NodeId, kind: Scalar, new: New<'_>) -> NodeId {
        if let Op::Const(bits) = &self.graph.node(old).op {
            return b.constant(Type::scalar(kind), [usize_value(bits) as u32, 0, 0, 0]);
        }
        let id = new[old.0 as usize].expect("arguments are built before their users");
        convert_node(b, id, kind)
    }

    /// Builds an operation on arguments of one kind.
    fn lower_operation(&self, b: &mut Builder<'_>, old: NodeId, kind: Scalar, ty: Type, new: New<'_>) -> NodeId {
        let node = self.graph.node(old);
        let args: Vec<NodeId> = node.args.iter().map(|arg| self.as_kind(b, *arg, kind, new)).collect();
        b.add(node.op.clone(), args, ty)
    }

    /// Kind in which numbers have their native order.
    fn ordered_kind(&self, args: &[NodeId]) -> Scalar {
        match args.iter().all(|arg| self.of.usize_extent(*arg).is_natural()) {
            true => Scalar::I32,
            false => Scalar::U32,
        }
    }

    /// Returns whether the shader's operation has the native result.
    fn is_same(&self, id: NodeId) -> bool {
        let node = self.graph.node(id);
        let of = |k: usize| self.of.usize_extent(node.args[k]);
        match &node.op {
            Op::Binary(BinaryOp::Div) => of(0).divided(of(1)).is_some(),
            Op::Binary(BinaryOp::Rem | BinaryOp::And) if self.of.float_by(id).is_some() => true,
            Op::Binary(BinaryOp::Rem) => of(0).rest(of(1)).is_some(),
            Op::Binary(BinaryOp::Shl) => power_of_two(of(1)).is_some(),
            Op::Binary(BinaryOp::Shr) => power_of_two(of(1)).is_some_and(|by| of(0).divided(by).is_some()),
            Op::Binary(BinaryOp::Min | BinaryOp::Max) => of(0).is_ordered_with(of(1)),
            Op::Binary(op) if op.is_comparison() => of(0).is_ordered_with(of(1)),
            Op::Clamp => of(0).is_ordered_with(of(1)) && of(0).larger(of(1)).is_ordered_with(of(2)),
            Op::Loop(_) => of(0).is_ordered_with(of(1)),
            Op::Convert if node.ty == Type::F32 => of(0).is_exact() || self.source_of_float(id).is_some(),
            Op::Convert if !is_wide(self.graph, id) => of(0).has_bits() || self.of.float_of(node.args[0]).is_some(),
            Op::Bitcast => of(0) != Extent::Lost,
            Op::Unary(UnaryOp::BitNot) => true,
            Op::Unary(_) => self.of.usize_extent(id) != Extent::Lost,
            _ => true,
        }
    }

    /// Float from which the `usize` argument of a conversion to float was itself converted.
    fn source_of_float(&self, id: NodeId) -> Option<NodeId> {
        let inner = self.graph.node(self.graph.node(id).args[0]);
        let float = *inner.args.first()?;
        (inner.op == Op::Convert && self.graph.ty(float) == Type::F32).then_some(float)
    }

    /// Builds the conversion of a number to a `usize`.
    fn widen_node(&self, b: &mut Builder<'_>, old: NodeId, new: New<'_>) -> NodeId {
        let from = self.graph.node(old).args[0];
        let id = new[from.0 as usize].expect("arguments are built before their users");
        let mut id = match b.graph().ty(id) {
            Type::F32 => convert_node(b, id, Scalar::U32),
            _ => id,
        };
        if let (Extent::Known { cap: Some(cap), .. }, Some(_)) = (self.of.usize_extent(old), self.caps.get(&old)) {
            let unsigned = convert_node(b, id, Scalar::U32);
            let cap = b.constant(Type::U32, [cap as u32, 0, 0, 0]);
            id = b.add(Op::Binary(BinaryOp::Min), [unsigned, cap], Type::U32);
        }
        convert_node(b, id, self.usize_kind(old))
    }

    /// Builds the conversion of a `usize` to a float.
    fn to_float(&self, b: &mut Builder<'_>, old: NodeId, new: New<'_>) -> NodeId {
        let whole = self.graph.node(old).args[0];
        let kind = self.ordered_kind(&[whole]);
        let (Some(float), false) = (self.source_of_float(old), self.of.usize_extent(whole).is_exact()) else {
            let whole = self.as_kind(b, whole, kind, new);
            return convert_node(b, whole, Scalar::F32);
        };
        // A float of at least 2^32 is a whole number already.
        let x = new[float.0 as usize].expect("arguments are built before their users");
        let [word, most] = [b.f32(WORD as f32), b.f32(u64::MAX as f32)];
        let large = b.add(Op::Binary(BinaryOp::Ge), [x, word], Type::BOOL);
        let bounded = b.add(Op::Binary(BinaryOp::Min), [x, most], Type::F32);
        let whole = convert_node(b, x, Scalar::U32);
        let small = convert_node(b, whole, Scalar::F32);
        b.add(Op::Select, [large, bounded, small], Type::F32)
    }
}

impl Replace for Lower<'_> {
    fn add_prologue(&mut self, _: &mut Builder<'_>) {}

    fn replace_node(&mut self, b: &mut Builder<'_>, old: NodeId, new: New<'_>) -> Option<NodeId> {
        let node = self.graph.node(old);
        let wide = is_wide(self.graph, old);
        if !wide && !node.args.iter().any(|arg| is_wide(self.graph, *arg)) {
            return None;
        }
        if !self.is_same(old) {
            let lost = |arg: &NodeId| is_wide(self.graph, *arg) && self.of.usize_extent(*arg) == Extent::Lost;
            match node.args.iter().any(lost) {
                true => self.following.push(old),
                false => self.refused.push(old),
            }
        }
        let own = match wide {
            true => self.usize_kind(old),
            false => Scalar::I32,
        };
        let ty = node.ty.with_scalar(own);
        Some(match &node.op {
            Op::Const(bits) => b.constant(ty, [usize_value(bits) as u32, 0, 0, 0]),
            Op::Undef => b.intern(Op::Undef, Vec::new(), ty),
            Op::Convert if wide => self.widen_node(b, old, new),
            Op::Convert if node.ty == Type::F32 => self.to_float(b, old, new),
            Op::Convert if self.of.float_of(node.args[0]).is_some() => {
                let float = self.of.float_of(node.args[0])?;
                let [_, low] = split_words(b, new[float.0 as usize]?);
                convert_node(b, low, node.ty.scalar_kind()?)
            }
            Op::Binary(op @ (BinaryOp::Rem | BinaryOp::And)) if self.of.float_by(old).is_some() => {
                let (float, by) = self.of.float_by(old)?;
                let [high, low] = split_words(b, new[float.0 as usize]?);
                let found = match op {
                    BinaryOp::And => binary_with(b, BinaryOp::And, low, by),
                    _ => {
                        // (high * 2^32 + low) % n, computed within 32 bits.
                        let high = binary_with(b, BinaryOp::Rem, high, by);
                        let high = binary_with(b, BinaryOp::Mul, high, (WORD as u64 % u64::from(by)) as u32);
                        let low = binary_with(b, BinaryOp::Rem, low, by);
                        let sum = b.add(Op::Binary(BinaryOp::Add), [high, low], Type::U32);
                        match sum == low {
                            true => low,
                            false => binary_with(b, BinaryOp::Rem, sum, by),
                        }
                    }
                };
                convert_node(b, found, own)
            }
            Op::Convert | Op::Bitcast => {
                let kind = node.ty.scalar_kind().unwrap_or(Scalar::I32);
                self.as_kind(b, node.args[0], kind, new)
            }
            Op::Binary(op) if op.is_comparison() => {
                let by_bits = matches!(op, BinaryOp::Eq | BinaryOp::Ne);
                let kind = match by_bits && node.args.iter().all(|arg| self.of.usize_extent(*arg).is_signed()) {
                    true => Scalar::I32,
                    false => self.ordered_kind(&node.args),
                };
                self.lower_operation(b, old, kind, node.ty, new)
            }
            Op::Clamp | Op::Binary(BinaryOp::Div | BinaryOp::Rem | BinaryOp::Shr | BinaryOp::Min | BinaryOp::Max) => {
                let kind = self.ordered_kind(&node.args);
                let found = self.lower_operation(b, old, kind, Type::scalar(kind), new);
                convert_node(b, found, own)
            }
            Op::Binary(_) | Op::Unary(_) => self.lower_operation(b, old, own, ty, new),
            Op::Select => {
                let condition = new[node.args[0].0 as usize]?;
                let [yes, no] = [1, 2].map(|k| self.as_kind(b, node.args[k], own, new));
                b.add(Op::Select, [condition, yes, no], ty)
            }
            Op::MakeArray => self.lower_operation(b, old, self.arrays, ty, new),
            Op::ArrayGet => {
                let args = [new[node.args[0].0 as usize]?, new[node.args[1].0 as usize]?];
                let element = b.add(Op::ArrayGet, args, Type::scalar(self.arrays));
                convert_node(b, element, own)
            }
            Op::ArraySet => {
                let element = self.as_kind(b, node.args[2], self.arrays, new);
                let args = [new[node.args[0].0 as usize]?, new[node.args[1].0 as usize]?, element];
                b.add(Op::ArraySet, args, ty)
            }
            Op::Tally(_) | Op::QuadSwap(_) => self.lower_operation(b, old, own, ty, new),
            _ => return None,
        })
    }

    fn replace_type(&self, old: NodeId, ty: Type) -> Type {
        match ty.scalar_kind() {
            Some(Scalar::Usize) => ty.with_scalar(self.usize_kind(old)),
            _ => ty,
        }
    }

    fn replace_bound(&mut self, b: &mut Builder<'_>, region: RegionId, old: NodeId, new: New<'_>) -> Option<NodeId> {
        is_wide(self.graph, old).then(|| self.as_kind(b, old, self.counted_in(region), new))
    }

    fn replace_passed(
        &mut self,
        b: &mut Builder<'_>,
        region: RegionId,
        k: usize,
        old: NodeId,
        new: New<'_>,
    ) -> Option<NodeId> {
        if !is_wide(self.graph, old) || self.graph.ty(old).is_array() {
            return None;
        }
        let kind = *self.results.get(&(region, k))?;
        Some(self.as_kind(b, old, kind, new))
    }
}

/// Upper and lower 32 bits of a float as a 64-bit integer, each a `u32`. All steps are exact: the float is scaled by powers
/// of two, and only its upper bits are subtracted from it.
fn split_words(b: &mut Builder<'_>, x: NodeId) -> [NodeId; 2] {
    let op = |op: BinaryOp| Op::Binary(op);
    let [word, inverse, end] = [b.f32(WORD as f32), b.f32(1.0 / WORD as f32), b.f32(u64::MAX as f32)];
    let scaled = b.add(op(BinaryOp::Mul), [x, inverse], Type::F32);
    let high = convert_node(b, scaled, Scalar::U32);
    let whole = b.add(Op::Unary(UnaryOp::Trunc), [scaled], Type::F32);
    let upper = b.add(op(BinaryOp::Mul), [whole, word], Type::F32);
    let rest = b.add(op(BinaryOp::Sub), [x, upper], Type::F32);
    let low = convert_node(b, rest, Scalar::U32);
    let beyond = b.add(op(BinaryOp::Ge), [x, end], Type::BOOL);
    let most = b.constant(Type::U32, [u32::MAX, 0, 0, 0]);
    [high, b.add(Op::Select, [beyond, most, low], Type::U32)]
}

/// Builds `x op n` for a `u32`.
fn binary_with(b: &mut Builder<'_>, op: BinaryOp, x: NodeId, n: u32) -> NodeId {
    let n = b.constant(Type::U32, [n, 0, 0, 0]);
    b.add(Op::Binary(op), [x, n], Type::U32)
}

/// Kind that holds the bits of a `usize`: `i32` if they fit.
fn kind_of(extent: Extent) -> Scalar {
    match extent.is_signed() {
        true => Scalar::I32,
        false => Scalar::U32,
    }
}

fn convert_node(b: &mut Builder<'_>, id: NodeId, kind: Scalar) -> NodeId {
    match b.graph().ty(id).scalar_kind() == Some(kind) {
        true => id,
        false => b.add(Op::Convert, [id], Type::scalar(kind)),
    }
}
