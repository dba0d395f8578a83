//! Ranges of runtime values.
//!
//! File tests: `evaluator/tests/filetests/passes/ranges`.

use crate::ir::{BinaryOp, Builder, Graph, Invocation, NodeId, Op, Real, Scalar, Type, UnaryOp, usize_value};

/// Maximum depth of arguments that a query follows. Nothing is known beyond it.
const DEPTH: u32 = 12;

/// Maximum width and height of a texture. A pixel lies at most a block's width farther out.
const LARGEST_FRAME: i64 = 1 << 15;

/// Maximum number of elements of a buffer.
const LONGEST_BUFFER: i64 = 1 << 28;

/// Farthest pixel of a block.
const FARTHEST_PIXEL: i64 = LARGEST_FRAME + 64;

/// Returns whether every component of a float is +0, positive or NaN: never negative and never -0.
pub fn is_nonnegative(g: &Graph, id: NodeId) -> bool {
    at_depth(g, id, DEPTH)
}

fn at_depth(g: &Graph, id: NodeId, depth: u32) -> bool {
    if depth == 0 {
        return false;
    }
    let node = g.node(id);
    let known = |k: usize| at_depth(g, node.args[k], depth - 1);
    match &node.op {
        Op::Const(bits) => bits[..node.ty.component_count() as usize].iter().all(|lane| {
            let x = f32::from_bits(*lane);
            x.is_nan() || x.is_sign_positive()
        }),
        Op::Unary(UnaryOp::Abs | UnaryOp::Exp | UnaryOp::Exp2 | UnaryOp::Saturate) => true,
        Op::Unary(UnaryOp::Sqrt | UnaryOp::InverseSqrt)
        | Op::Exact
        | Op::Half
        | Op::Tally(_)
        | Op::Splat
        | Op::Extract(_) => known(0),
        // A square is nonnegative; sums, products and quotients are if their operands are.
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

/// Smallest and largest value of a scalar integer, derived from constants, counters and floats.
pub fn integer_bounds(g: &Graph, id: NodeId) -> Option<(i64, i64)> {
    bounds_at(g, id, 0, DEPTH)
}

/// Like [`integer_bounds`], for one component of an integer vector.
pub fn component_bounds(g: &Graph, id: NodeId, component: u8) -> Option<(i64, i64)> {
    bounds_at(g, id, component, DEPTH)
}

/// Smallest and largest value of a float component, either of which may be infinite. A value with known bounds is a NaN
/// only if a NaN was clamped; hardware then decides which of the bounds replaces it.
pub fn float_bounds(g: &Graph, id: NodeId, component: u8) -> Option<(f32, f32)> {
    floats_at(g, id, component, DEPTH)
}

/// Every value of an integer type.
fn full_range(ty: Type) -> (i64, i64) {
    match ty.scalar_kind() {
        Some(Scalar::U32) => (0, i64::from(u32::MAX)),
        // The largest `i64` represents everything above it.
        Some(Scalar::Usize) => (0, i64::MAX),
        _ => (i64::from(i32::MIN), i64::from(i32::MAX)),
    }
}

fn bounds_at(g: &Graph, id: NodeId, component: u8, depth: u32) -> Option<(i64, i64)> {
    if depth == 0 {
        return None;
    }
    let node = g.node(id);
    if !node.ty.is_integer() {
        return None;
    }
    let of = |k: usize| bounds_at(g, node.args[k], component, depth - 1);
    let (smallest, largest) = full_range(node.ty);
    let (unsigned, wide) = (smallest == 0, node.ty == Type::USIZE);
    // Values outside the type's range wrap.
    let fits = |(low, high): (i64, i64)| {
        (low >= smallest && high <= largest && !(wide && high == largest)).then_some((low, high))
    };
    let known = |id: NodeId| {
        let bits = g.constant_bits(id)?;
        if wide {
            return i64::try_from(usize_value(&bits)).ok();
        }
        let bits = bits[component as usize];
        Some(if unsigned {
            i64::from(bits)
        } else {
            i64::from(bits as i32)
        })
    };
    let corners = |f: fn(i64, i64) -> i64| {
        let ((a, b), (c, d)) = (of(0)?, of(1)?);
        let all = [f(a, c), f(a, d), f(b, c), f(b, d)];
        fits((*all.iter().min()?, *all.iter().max()?))
    };
    let found = match &node.op {
        Op::Const(_) => known(id).map(|n| (n, n)),
        // A pixel of a block may lie past the frame, but never before it.
        Op::Pixel => Some((0, FARTHEST_PIXEL)),
        Op::FrameSize | Op::TextureSize(_) | Op::TextureLayers(_) | Op::TextureLevels(_) => Some((1, LARGEST_FRAME)),
        Op::BufferLen(_) => Some((1, LONGEST_BUFFER)),
        Op::Lane => Some((0, 1)),
        Op::GroupOrigin => Some((0, FARTHEST_PIXEL)),
        Op::Thread => match g.invocation {
            Invocation::Group(size) => Some((0, i64::from(size[component as usize]) - 1)),
            _ => None,
        },
        Op::Param(region, 0) => {
            let owner = g.node_ids().find(|id| g.node(*id).op == Op::Loop(*region))?;
            let bound = |k: usize| bounds_at(g, g.node(owner).args[k], 0, depth - 1);
            match (bound(0)?, bound(1)?) {
                ((low, _), (_, i64::MAX)) => Some((low, i64::MAX)),
                ((low, _), (_, end)) => Some((low, (end - 1).max(low))),
            }
        }
        Op::Splat => bounds_at(g, node.args[0], 0, depth - 1),
        Op::Compose => bounds_at(g, node.args[component as usize], 0, depth - 1),
        Op::Extract(k) => bounds_at(g, node.args[0], *k, depth - 1),
        Op::Tally(_) => of(0),
        Op::Unary(UnaryOp::CountOneBits | UnaryOp::LeadingZeros | UnaryOp::TrailingZeros) => Some((0, 64)),
        Op::Binary(BinaryOp::Add) => corners(i64::saturating_add),
        Op::Binary(BinaryOp::Sub) => corners(i64::saturating_sub),
        Op::Binary(BinaryOp::Mul) => corners(i64::saturating_mul),
        Op::Binary(BinaryOp::Div) => {
            let divisor = known(node.args[1]).filter(|d| *d > 0)?;
            of(0).map(|(low, high)| (low / divisor, high / divisor))
        }
        Op::Binary(BinaryOp::Rem) => {
            let divisor = known(node.args[1]).filter(|d| *d > 0)?;
            let low = of(0).map_or(1 - divisor, |(low, _)| low.clamp(1 - divisor, 0));
            Some((if unsigned { 0 } else { low }, divisor - 1))
        }
        Op::Binary(BinaryOp::And) => {
            let mask = node.args.iter().filter_map(|arg| known(*arg)).find(|mask| *mask >= 0)?;
            Some((0, mask))
        }
        Op::Binary(BinaryOp::Shr) => {
            let count = g.constant_bits(node.args[1])?[component as usize] % if wide { 64 } else { 32 };
            let (low, high) = of(0).unwrap_or((smallest, largest));
            Some((low >> count, high >> count))
        }
        Op::Binary(op @ (BinaryOp::Min | BinaryOp::Max)) => match (of(0), of(1), op) {
            (Some((a, b)), Some((c, d)), BinaryOp::Min) => Some((a.min(c), b.min(d))),
            (Some((a, b)), Some((c, d)), _) => Some((a.max(c), b.max(d))),
            (Some((_, high)), None, BinaryOp::Min) | (None, Some((_, high)), BinaryOp::Min) => Some((smallest, high)),
            (Some((low, _)), None, _) | (None, Some((low, _)), _) => Some((low, largest)),
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
        // An index out of range refers to the last element.
        Op::ArrayGet if g.node(node.args[0]).op == Op::MakeArray => {
            let elements = g.node(node.args[0]).args.iter();
            let all: Vec<(i64, i64)> = elements
                .map(|id| bounds_at(g, *id, component, depth - 1))
                .collect::<Option<_>>()?;
            let low = all.iter().map(|(low, _)| *low).min()?;
            let high = all.iter().map(|(_, high)| *high).max()?;
            Some((low, high))
        }
        Op::Convert if g.ty(node.args[0]).is_float() => {
            let (low, high) = floats_at(g, node.args[0], component, depth - 1)?;
            let whole = |x: f32| (x as i64).clamp(smallest, largest);
            // A NaN becomes 0.
            Some((whole(low).min(0), whole(high).max(0)))
        }
        Op::Convert if g.ty(node.args[0]).scalar_kind() == Some(Scalar::Bool) => Some((0, 1)),
        Op::Convert => fits(of(0)?),
        _ => None,
    };
    found.or(unsigned.then_some((smallest, largest)))
}

fn floats_at(g: &Graph, id: NodeId, component: u8, depth: u32) -> Option<(f32, f32)> {
    if depth == 0 {
        return None;
    }
    let node = g.node(id);
    if !node.ty.is_float() {
        return None;
    }
    let of = |k: usize| floats_at(g, node.args[k], component, depth - 1);
    let finite = |(low, high): (f32, f32)| (low.is_finite() && high.is_finite()).then_some((low, high));
    // Rounding is monotonic, so values between the corners round to values between them.
    let corners = |f: fn(f32, f32) -> f32| {
        let ((a, b), (c, d)) = (finite(of(0)?)?, finite(of(1)?)?);
        let all = [f(a, c), f(a, d), f(b, c), f(b, d)];
        let low = all.iter().copied().reduce(f32::min)?;
        let high = all.iter().copied().reduce(f32::max)?;
        finite((low, high))
    };
    let monotonic = |f: fn(f32) -> f32| of(0).map(|(low, high)| (f(low), f(high)));
    match &node.op {
        Op::Const(bits) => {
            let x = f32::from_bits(bits[component as usize]);
            (!x.is_nan()).then_some((x, x))
        }
        Op::Convert => {
            let from = g.ty(node.args[0]);
            let (low, high) = match from.scalar_kind()? {
                Scalar::F32 => return of(0),
                Scalar::Bool => (0, 1),
                _ => bounds_at(g, node.args[0], component, depth - 1).unwrap_or(full_range(from)),
            };
            if high == i64::MAX {
                return Some((low as f32, u64::MAX as f32));
            }
            Some((low as f32, high as f32))
        }
        Op::Splat => floats_at(g, node.args[0], 0, depth - 1),
        Op::Compose => floats_at(g, node.args[component as usize], 0, depth - 1),
        Op::Extract(k) => floats_at(g, node.args[0], *k, depth - 1),
        Op::Exact | Op::Tally(_) => of(0),
        Op::Half => monotonic(f32::to_half),
        Op::Unary(UnaryOp::Neg) => of(0).map(|(low, high)| (-high, -low)),
        Op::Unary(UnaryOp::Abs) => of(0).map(|(low, high)| (0.0, low.abs().max(high.abs()))),
        Op::Unary(UnaryOp::Floor) => monotonic(f32::floor),
        Op::Unary(UnaryOp::Ceil) => monotonic(f32::ceil),
        Op::Unary(UnaryOp::Round) => monotonic(f32::round_ties_even),
        Op::Unary(UnaryOp::Trunc) => monotonic(f32::trunc),
        Op::Unary(UnaryOp::Fract) => of(0).and_then(finite).map(|_| (0.0, 1.0)),
        Op::Unary(UnaryOp::Saturate) => Some((0.0, 1.0)),
        Op::Unary(UnaryOp::Sqrt) => of(0).filter(|(low, _)| *low >= 0.0).map(|(_, high)| (0.0, high.sqrt())),
        Op::Binary(BinaryOp::Add) => corners(|a, b| a + b),
        Op::Binary(BinaryOp::Sub) => corners(|a, b| a - b),
        Op::Binary(BinaryOp::Mul) => corners(|a, b| a * b),
        Op::Binary(BinaryOp::Div) => {
            let (low, high) = of(1)?;
            // A divisor near 0 may overflow.
            (low > 0.0 || high < 0.0).then(|| corners(|a, b| a / b))?
        }
        Op::Binary(BinaryOp::Min) => match (of(0), of(1)) {
            (Some((a, b)), Some((c, d))) => Some((a.min(c), b.min(d))),
            (Some((_, high)), None) | (None, Some((_, high))) => Some((f32::NEG_INFINITY, high)),
            _ => None,
        },
        Op::Binary(BinaryOp::Max) => match (of(0), of(1)) {
            (Some((a, b)), Some((c, d))) => Some((a.max(c), b.max(d))),
            (Some((low, _)), None) | (None, Some((low, _))) => Some((low, f32::INFINITY)),
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
        _ => None,
    }
}

/// Folds a clamp of an integer that is already inside.
pub fn fold_inner_clamp(g: &Graph, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    if *op != Op::Clamp || !ty.is_integer() || ty.is_array() {
        return None;
    }
    let inside = |component: u8| {
        let bounds = |k: usize| component_bounds(g, args[k], component);
        let ((low, high), (_, least), (most, _)) = (bounds(0)?, bounds(1)?, bounds(2)?);
        Some(low >= least && high <= most)
    };
    let all = (0..ty.component_count()).all(|component| inside(component) == Some(true));
    all.then_some(args[0])
}

/// Folds comparisons, minima and maxima of integers whose ranges decide them.
pub fn fold_comparison(b: &mut Builder<'_>, op: &Op, args: &[NodeId]) -> Option<NodeId> {
    let (Op::Binary(op), g) = (op, b.graph()) else {
        return None;
    };
    let (x, y) = (args[0], args[1]);
    let ty = g.ty(x);
    if !ty.is_integer() || ty.is_array() {
        return None;
    }
    if let Some(ordered) = sum_of(g, x, y) {
        // A sum that does not wrap is not less than a part of it.
        match (op, ordered) {
            (BinaryOp::Lt, true) | (BinaryOp::Gt, false) => return Some(b.bool(false)),
            (BinaryOp::Ge, true) | (BinaryOp::Le, false) => return Some(b.bool(true)),
            _ => {}
        }
    }
    let range = |id, component| component_bounds(g, id, component).unwrap_or(full_range(ty));
    // Compares the largest value of the first with the smallest of the second by `less`, in every component.
    let all = |less: fn(i64, i64) -> bool, first, second| {
        (0..ty.component_count()).all(|component| less(range(first, component).1, range(second, component).0))
    };
    let below = |first, second| all(|a, b| a < b, first, second);
    let not_above = |first, second| all(|a, b| a <= b, first, second);
    let (yes, no) = match op {
        BinaryOp::Min if not_above(x, y) => return Some(x),
        BinaryOp::Min if not_above(y, x) => return Some(y),
        BinaryOp::Max if not_above(x, y) => return Some(y),
        BinaryOp::Max if not_above(y, x) => return Some(x),
        _ if !ty.is_scalar() => return None,
        BinaryOp::Lt => (below(x, y), not_above(y, x)),
        BinaryOp::Le => (not_above(x, y), below(y, x)),
        BinaryOp::Gt => (below(y, x), not_above(x, y)),
        BinaryOp::Ge => (not_above(y, x), below(x, y)),
        BinaryOp::Eq => (false, below(x, y) || below(y, x)),
        BinaryOp::Ne => (below(x, y) || below(y, x), false),
        _ => return None,
    };
    (yes || no).then(|| b.bool(yes))
}

/// Compares two `usize` if one is a sum that includes the other and does not overflow: `true` if the first is the sum,
/// `false` if the second is.
fn sum_of(g: &Graph, x: NodeId, y: NodeId) -> Option<bool> {
    let is_sum = |sum: NodeId, part: NodeId| {
        let node = g.node(sum);
        let fits = || integer_bounds(g, sum).is_some_and(|(_, high)| high < i64::MAX);
        node.ty == Type::USIZE && node.op == Op::Binary(BinaryOp::Add) && node.args.contains(&part) && fits()
    };
    match (is_sum(x, y), is_sum(y, x)) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// Folds the clamp of a neighbour's coordinate to the frame. The pixel itself is inside, so a step to the right can only
/// leave the frame on the right.
pub fn fold_frame_clamp(b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
    let g = b.graph();
    if *op != Op::Clamp || !is_zero(g, args[1]) || !is_last(g, args[2]) {
        return None;
    }
    let node = g.node(args[0]);
    match node.op {
        // A pixel of such an invocation may lie outside.
        _ if matches!(
            g.invocation,
            Invocation::MayBeOutside | Invocation::Lane | Invocation::Group(_)
        ) =>
        {
            None
        }
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
                Some(b.add(Op::Binary(BinaryOp::Min), [args[0], args[2]], ty))
            } else if step.iter().all(|s| *s <= 0) {
                Some(b.add(Op::Binary(BinaryOp::Max), [args[0], args[1]], ty))
            } else {
                None
            }
        }
        // A clamped coordinate keeps its direction: a step right or down was limited to the last pixel, a step back to 0.
        Op::Binary(side @ (BinaryOp::Min | BinaryOp::Max)) => {
            let [moved, bound] = [node.args[0], node.args[1]];
            let inner = [moved, args[1], args[2]];
            let again = match side {
                BinaryOp::Min => bound == args[2],
                _ => bound == args[1],
            };
            let brought = again.then(|| fold_frame_clamp(b, op, &inner, ty)).flatten();
            (brought == Some(args[0])).then_some(args[0])
        }
        _ => None,
    }
}

/// Steps beyond this might wrap; a pixel's coordinate is less than 2^16.
const MAX_STEP: i32 = 1 << 30;

fn is_zero(g: &Graph, id: NodeId) -> bool {
    g.constant_bits(id) == Some([0; 4])
}

/// Returns whether a node is the frame's size minus one.
fn is_last(g: &Graph, id: NodeId) -> bool {
    let node = g.node(id);
    node.op == Op::Binary(BinaryOp::Sub)
        && g.node(node.args[0]).op == Op::FrameSize
        && g.constant_bits(node.args[1]).is_some_and(|c| c[0] == 1 && c[1] == 1)
}
