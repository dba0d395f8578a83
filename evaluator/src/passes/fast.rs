//! Algebra that may change a rounding, as [`Math::Fast`](crate::policy::Math::Fast) requests.
//!
//! Each rewrite states what it may change. None of them turns a finite value infinite within the bounds that [`is_held`]
//! sets for constants, drops a test of the kernel, or assumes that there are no NaNs.
//!
//! File tests: `evaluator/tests/filetests/passes/fast`.

use super::fold::Exact;
use crate::ir::{
    BinaryOp, Bits, Builder, Graph, NodeId, Op, Rebuild, Replace, Scalar, Type, UnaryOp, rebuild_replacing,
};
use std::collections::HashMap;

/// Rebuilds the kernel with fewer or cheaper operations on floats, each result off by some roundings. Exact operations
/// ([`Op::Exact`]) remain unchanged.
///
/// - A division by a constant becomes a multiplication by its reciprocal, and so do several divisions by one value (1
///   rounding).
/// - `exp` becomes `exp2`, with log2 e folded into constants (2 roundings of the exponent).
/// - A constant factor is folded into the constants of a sum, a product or a quotient (1 rounding a term; in a sum that
///   cancels, of its largest term). Most GPUs multiply and add in one instruction.
/// - `x + 0` becomes `x` (a zero may change its sign).
pub fn apply_fast_math(graph: &Graph) -> Graph {
    let mut rewriting = FastMath::from_graph(graph);
    let pass = Rebuild {
        rules: &Exact,
        share_loads: false,
    };
    rebuild_replacing(graph, &pass, &mut rewriting)
}

/// A constant factor, a number for each component.
type Factor = [f32; 4];

const LOG2_E: Factor = [std::f32::consts::LOG2_E; 4];

struct FastMath<'g> {
    old: &'g Graph,
    /// By node, the number of uses.
    uses: Vec<u32>,
    /// By node, whether it must be rounded as written.
    exact: Vec<bool>,
    /// By divisor, the number of quotients; a vector divided by a scalar counts once for each component.
    quotients: HashMap<NodeId, u32>,
}

impl<'g> FastMath<'g> {
    fn from_graph(old: &'g Graph) -> FastMath<'g> {
        let mut uses = vec![0; old.nodes.len()];
        let mut exact = vec![false; old.nodes.len()];
        for id in old.node_ids().filter(|id| old.node(*id).op == Op::Exact) {
            exact[old.node(id).args[0].0 as usize] = true;
        }
        let mut quotients = HashMap::new();
        for id in old.node_ids() {
            let node = old.node(id);
            node.args.iter().for_each(|arg| uses[arg.0 as usize] += 1);
            if let Some((divisor, count)) = common_divisor(old, id).filter(|_| !exact[id.0 as usize]) {
                *quotients.entry(divisor).or_default() += count;
            }
        }
        let leaving = old.regions.iter().flat_map(|region| region.yielded_values());
        for id in old.outputs().iter().copied().chain(leaving) {
            uses[id.0 as usize] += 1;
        }
        FastMath {
            old,
            uses,
            exact,
            quotients,
        }
    }

    fn constant_factor(&self, id: NodeId) -> Option<Factor> {
        let bits: Bits = self.old.constant_bits(id)?;
        (self.old.ty(id).scalar_kind() == Some(Scalar::F32)).then(|| bits.map(f32::from_bits))
    }

    /// Splits a product or a quotient into its other side and its constant factor.
    fn split_factor(&self, id: NodeId) -> Option<(NodeId, Factor)> {
        let node = self.old.node(id);
        let lanes = usize::from(node.ty.component_count());
        let inverse = |divisor: Factor| {
            let inverse = divisor.map(|x| 1.0 / x);
            is_held(&inverse[..lanes]).then_some(inverse)
        };
        match (&node.op, &node.args[..]) {
            (Op::Binary(BinaryOp::Mul), [x, k]) if self.constant_factor(*k).is_some() => {
                Some((*x, self.constant_factor(*k)?))
            }
            (Op::Binary(BinaryOp::Mul), [k, x]) if self.constant_factor(*k).is_some() => {
                Some((*x, self.constant_factor(*k)?))
            }
            (Op::Binary(BinaryOp::Div), [x, k]) => Some((*x, inverse(self.constant_factor(*k)?)?)),
            _ => None,
        }
    }

    /// Returns whether a constant factor costs nothing here: it is folded into a constant, or into a sum with a constant.
    fn absorbs_factor(&self, id: NodeId) -> bool {
        let node = self.old.node(id);
        if self.constant_factor(id).is_some() {
            return true;
        }
        if self.exact[id.0 as usize] || self.uses[id.0 as usize] > 1 || node.ty.scalar_kind() != Some(Scalar::F32) {
            return false;
        }
        match (&node.op, &node.args[..]) {
            (Op::Unary(UnaryOp::Neg) | Op::Splat, [x]) => self.absorbs_factor(*x),
            (Op::Binary(BinaryOp::Add | BinaryOp::Sub), [x, y]) => {
                let is_known = self.constant_factor(*x).is_some() || self.constant_factor(*y).is_some();
                is_known || (self.absorbs_factor(*x) && self.absorbs_factor(*y))
            }
            _ => self.split_factor(id).is_some(),
        }
    }

    /// Builds a value of the old graph times a constant.
    fn build_scaled(&self, b: &mut Builder<'_>, id: NodeId, by: Factor, new: &[Option<NodeId>]) -> NodeId {
        let node = self.old.node(id);
        let lanes = usize::from(node.ty.component_count());
        let times = |other: Factor| {
            let product: Factor = std::array::from_fn(|k| by[k] * other[k]);
            is_held(&product[..lanes]).then_some(product)
        };
        if let Some(product) = self.constant_factor(id).and_then(times) {
            return build_constant(b, node.ty, product);
        }
        if self.absorbs_factor(id) {
            match (&node.op, &node.args[..]) {
                (Op::Unary(UnaryOp::Neg), [x]) => return self.build_scaled(b, *x, by.map(|k| -k), new),
                (Op::Splat, [x]) if by[..lanes].iter().all(|k| k.to_bits() == by[0].to_bits()) => {
                    let scaled = self.build_scaled(b, *x, [by[0]; 4], new);
                    return b.add(Op::Splat, [scaled], node.ty);
                }
                (Op::Binary(op @ (BinaryOp::Add | BinaryOp::Sub)), [x, y]) => {
                    let sides = [*x, *y].map(|side| self.build_scaled(b, side, by, new));
                    return b.add(Op::Binary(*op), sides, node.ty);
                }
                _ => {}
            }
            if let Some((x, product)) = self.split_factor(id).and_then(|(x, k)| Some((x, times(k)?))) {
                return self.build_scaled(b, x, product, new);
            }
        }
        let same = new[id.0 as usize].expect("arguments are built before their users");
        let factor = build_constant(b, node.ty, by);
        b.add(Op::Binary(BinaryOp::Mul), [same, factor], node.ty)
    }

    /// Builds a quotient whose divisor is shared, as a product with the reciprocal.
    fn shared_quotient(&self, b: &mut Builder<'_>, id: NodeId, new: &[Option<NodeId>]) -> Option<NodeId> {
        let (divisor, _) = common_divisor(self.old, id)?;
        if self.quotients.get(&divisor).is_none_or(|count| *count < 2) {
            return None;
        }
        let node = self.old.node(id);
        let dividend = new[node.args[0].0 as usize]?;
        let below = new[divisor.0 as usize]?;
        let of = self.old.ty(divisor);
        let one = build_constant(b, of, [1.0; 4]);
        let reciprocal = b.add(Op::Binary(BinaryOp::Div), [one, below], of);
        let factor = match of == node.ty {
            true => reciprocal,
            false => b.add(Op::Splat, [reciprocal], node.ty),
        };
        Some(b.add(Op::Binary(BinaryOp::Mul), [dividend, factor], node.ty))
    }
}

impl Replace for FastMath<'_> {
    fn add_prologue(&mut self, _: &mut Builder<'_>) {}

    fn replace_node(&mut self, b: &mut Builder<'_>, id: NodeId, new: &[Option<NodeId>]) -> Option<NodeId> {
        let node = self.old.node(id);
        if node.ty.scalar_kind() != Some(Scalar::F32) || node.ty.is_array() || self.exact[id.0 as usize] {
            return None;
        }
        let is_zero = |id: NodeId| {
            self.constant_factor(id)
                .is_some_and(|k| k[..component_count(node.ty)].iter().all(|k| *k == 0.0))
        };
        match (&node.op, &node.args[..]) {
            (Op::Unary(UnaryOp::Exp), [x]) => {
                let exponent = self.build_scaled(b, *x, LOG2_E, new);
                Some(b.add(Op::Unary(UnaryOp::Exp2), [exponent], node.ty))
            }
            (Op::Binary(BinaryOp::Add), [zero, x] | [x, zero]) if is_zero(*zero) => new[x.0 as usize],
            (Op::Binary(BinaryOp::Mul | BinaryOp::Div), _) => match self.split_factor(id) {
                Some((x, k)) if self.absorbs_factor(x) || node.op == Op::Binary(BinaryOp::Div) => {
                    Some(self.build_scaled(b, x, k, new))
                }
                Some(_) => None,
                None => self.shared_quotient(b, id, new),
            },
            _ => None,
        }
    }
}

fn component_count(ty: Type) -> usize {
    usize::from(ty.component_count())
}

/// Returns the divisor of a node, if it is a scalar and not constant, and the number of quotients.
fn common_divisor(g: &Graph, id: NodeId) -> Option<(NodeId, u32)> {
    let node = g.node(id);
    let ([_, below], true) = (&node.args[..], node.op == Op::Binary(BinaryOp::Div)) else {
        return None;
    };
    let is_float = node.ty.scalar_kind() == Some(Scalar::F32);
    let of = match &g.node(*below).op {
        Op::Splat => g.node(*below).args[0],
        _ if node.ty.is_scalar() => *below,
        _ => return None,
    };
    (is_float && g.constant_bits(of).is_none()).then_some((of, u32::from(node.ty.component_count())))
}

/// Returns whether constants are 0 or in the normal range of half precision. No product with one of them then underflows or
/// overflows that did not before.
fn is_held(factors: &[f32]) -> bool {
    let held = |k: f32| k == 0.0 || (6.2e-5..=65504.0).contains(&k.abs());
    factors.iter().all(|k| held(*k))
}

fn build_constant(b: &mut Builder<'_>, ty: Type, values: Factor) -> NodeId {
    let mut bits = [0; 4];
    for (bits, value) in bits.iter_mut().zip(values).take(component_count(ty)) {
        *bits = value.to_bits();
    }
    b.constant(ty, bits)
}
