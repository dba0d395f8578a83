//! What is known of a value without knowing it.

use crate::ir::{BinaryOp, Builder, Graph, NodeId, Op, Type, UnaryOp};

/// How far back a question is followed; beyond it nothing is known.
const DEPTH: u32 = 12;

/// Whether every lane of a float is +0, positive or NaN: never negative and never -0.
pub fn nonnegative(g: &Graph, id: NodeId) -> bool {
    at_depth(g, id, DEPTH)
}

fn at_depth(g: &Graph, id: NodeId, depth: u32) -> bool {
    if depth == 0 {
        return false;
    }
    let node = g.node(id);
    let known = |k: usize| at_depth(g, node.args[k], depth - 1);
    match &node.op {
        Op::Const(bits) => bits[..node.ty.lanes() as usize].iter().all(|lane| {
            let x = f32::from_bits(*lane);
            x.is_nan() || x.is_sign_positive()
        }),
        Op::Unary(UnaryOp::Abs | UnaryOp::Exp | UnaryOp::Exp2) => true,
        Op::Unary(UnaryOp::Sqrt | UnaryOp::InverseSqrt) | Op::Tally(_) | Op::Splat | Op::Extract(_) => known(0),
        // A sum of such values is one; so is their product, their quotient, and the square of anything.
        Op::Binary(BinaryOp::Mul) if node.args[0] == node.args[1] => true,
        Op::Binary(BinaryOp::Add | BinaryOp::Mul | BinaryOp::Div | BinaryOp::Min | BinaryOp::Max) => {
            known(0) && known(1)
        }
        Op::Dot => node.args[0] == node.args[1],
        Op::Select => known(1) && known(2),
        Op::Compose => (0..node.args.len()).all(known),
        _ => false,
    }
}

/// The smallest and the largest value that an integer can have, as far as constants and loop counters tell.
pub fn bounds(g: &Graph, id: NodeId) -> Option<(i64, i64)> {
    bounds_at(g, id, DEPTH)
}

fn bounds_at(g: &Graph, id: NodeId, depth: u32) -> Option<(i64, i64)> {
    if depth == 0 {
        return None;
    }
    let node = g.node(id);
    let of = |k: usize| bounds_at(g, node.args[k], depth - 1);
    let fits = |(low, high): (i64, i64)| {
        // What leaves the range wraps.
        let range = if node.ty == Type::U32 {
            0..=i64::from(u32::MAX)
        } else {
            i64::from(i32::MIN)..=i64::from(i32::MAX)
        };
        (range.contains(&low) && range.contains(&high)).then_some((low, high))
    };
    let corners = |f: fn(i64, i64) -> i64| {
        let ((a, b), (c, d)) = (of(0)?, of(1)?);
        let all = [f(a, c), f(a, d), f(b, c), f(b, d)];
        fits((*all.iter().min()?, *all.iter().max()?))
    };
    match &node.op {
        Op::Const(bits) if node.ty == Type::I32 => Some((i64::from(bits[0] as i32), i64::from(bits[0] as i32))),
        Op::Const(bits) if node.ty == Type::U32 => Some((i64::from(bits[0]), i64::from(bits[0]))),
        Op::Param(region, 0) => {
            let owner = g.ids().find(|id| g.node(*id).op == Op::Loop(*region))?;
            let bound = |k: usize| bounds_at(g, g.node(owner).args[k], depth - 1);
            let ((low, _), (_, end)) = (bound(0)?, bound(1)?);
            Some((low, (end - 1).max(low)))
        }
        Op::Binary(BinaryOp::Add) => corners(|a, b| a + b),
        Op::Binary(BinaryOp::Sub) => corners(|a, b| a - b),
        Op::Binary(BinaryOp::Mul) => corners(|a, b| a.saturating_mul(b)),
        Op::Binary(BinaryOp::Div) => {
            let divisor = g
                .constant(node.args[1])
                .map(|bits| i64::from(bits[0] as i32))
                .filter(|d| *d > 0)?;
            of(0).map(|(low, high)| (low / divisor, high / divisor))
        }
        Op::Binary(BinaryOp::Rem) => {
            let divisor = g
                .constant(node.args[1])
                .map(|bits| i64::from(bits[0] as i32))
                .filter(|d| *d > 0)?;
            let low = of(0).map_or(1 - divisor, |(low, _)| low.clamp(1 - divisor, 0));
            Some((if node.ty == Type::U32 { 0 } else { low }, divisor - 1))
        }
        Op::Binary(op @ (BinaryOp::Min | BinaryOp::Max)) => match (of(0), of(1), op) {
            (Some((a, b)), Some((c, d)), BinaryOp::Min) => Some((a.min(c), b.min(d))),
            (Some((a, b)), Some((c, d)), _) => Some((a.max(c), b.max(d))),
            (Some((_, high)), None, BinaryOp::Min) | (None, Some((_, high)), BinaryOp::Min) => {
                Some((i64::from(i32::MIN), high))
            }
            _ => None,
        },
        Op::Clamp => {
            let ((low, _), (_, high)) = (of(1)?, of(2)?);
            Some((low, high.max(low)))
        }
        Op::Select => {
            let ((a, b), (c, d)) = (of(1)?, of(2)?);
            Some((a.min(c), b.max(d)))
        }
        // Of a wrong index, the last element.
        Op::ArrayGet if g.node(node.args[0]).op == Op::MakeArray => {
            let elements = g.node(node.args[0]).args.iter().map(|id| bounds_at(g, *id, depth - 1));
            let all: Vec<(i64, i64)> = elements.collect::<Option<_>>()?;
            let low = all.iter().map(|(low, _)| *low).min()?;
            let high = all.iter().map(|(_, high)| *high).max()?;
            Some((low, high))
        }
        Op::Convert if node.ty.is_scalar() => fits(of(0)?),
        _ => None,
    }
}

/// Clamping of a neighbour's coordinate to the frame: the pixel itself is inside, so a step to the right can only
/// leave on the right.
pub fn clamp(b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    let g = b.graph();
    if *op != Op::Clamp || !is_zero(g, args[1]) || !is_last(g, args[2]) {
        return None;
    }
    let node = g.node(args[0]);
    match node.op {
        Op::Pixel => Some(args[0]),
        Op::Binary(BinaryOp::Add) => {
            let (x, y) = (node.args[0], node.args[1]);
            let step = match (&g.node(x).op, &g.node(y).op) {
                (Op::Pixel, Op::Const(step)) | (Op::Const(step), Op::Pixel) => [step[0] as i32, step[1] as i32],
                _ => return None,
            };
            let bounds = |s: &i32| (-MAX_STEP..=MAX_STEP).contains(s);
            if !step.iter().all(bounds) {
                None
            } else if step.iter().all(|s| *s >= 0) {
                Some(b.add(Op::Binary(BinaryOp::Min), vec![args[0], args[2]], ty))
            } else if step.iter().all(|s| *s <= 0) {
                Some(b.add(Op::Binary(BinaryOp::Max), vec![args[0], args[1]], ty))
            } else {
                None
            }
        }
        _ => None,
    }
}

/// A pixel's coordinate is less than 2^20, so steps of this size cannot wrap.
const MAX_STEP: i32 = 1 << 30;

fn is_zero(g: &Graph, id: NodeId) -> bool {
    g.constant(id) == Some([0; 4])
}

/// The frame's size less one.
fn is_last(g: &Graph, id: NodeId) -> bool {
    let node = g.node(id);
    node.op == Op::Binary(BinaryOp::Sub)
        && g.node(node.args[0]).op == Op::FrameSize
        && g.constant(node.args[1]).is_some_and(|c| c[0] == 1 && c[1] == 1)
}
