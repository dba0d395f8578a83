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
