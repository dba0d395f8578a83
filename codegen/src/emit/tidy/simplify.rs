//! Shorter forms of expressions.

use crate::emit::ast::{Expr, Op};
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// Simplifies an expression whose arguments have been simplified.
pub fn simplify_expr(expr: Expr) -> Expr {
    match &expr.op {
        Op::Swizzle(_) => simplify_swizzle(expr),
        Op::Construct => simplify_construct(expr),
        Op::Convert { .. } => simplify_convert(expr),
        Op::Ir(ir::Op::Binary(op)) => {
            let op = *op;
            merge_comparisons(op, flip_negative_term(op, scalar_operands(op, expr)))
        }
        _ => expr,
    }
}

/// Returns `!condition`: `a` for `!a`, and `a != b` for `a == b`.
pub fn not(mut condition: Expr) -> Expr {
    let opposite = |op| match op {
        BinaryOp::Eq => Some(BinaryOp::Ne),
        BinaryOp::Ne => Some(BinaryOp::Eq),
        _ => None,
    };
    match condition.op {
        Op::Ir(ir::Op::Unary(UnaryOp::Not)) => return condition.args.swap_remove(0),
        Op::Ir(ir::Op::Binary(op)) => {
            // For a NaN, the opposite of other comparisons does not hold.
            if let Some(opposite) = opposite(op) {
                condition.op = Op::Ir(ir::Op::Binary(opposite));
                return condition;
            }
        }
        _ => {}
    }
    let ty = condition.ty;
    Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Not)), vec![condition], ty)
}

/// `v.zyx.y` becomes `v.y`; `v.xyz` of a vector of three becomes `v`; `vec2(a, b).y` becomes `b`.
fn simplify_swizzle(mut expr: Expr) -> Expr {
    let Op::Swizzle(components) = &expr.op else { return expr };
    let base = &mut expr.args[0];
    match &mut base.op {
        Op::Swizzle(inner) => {
            let components = components.iter().map(|k| inner[*k as usize]).collect();
            let base = base.args.swap_remove(0);
            simplify_swizzle(Expr::new(Op::Swizzle(components), vec![base], expr.ty))
        }
        Op::Construct
            if components.len() == 1
                && base.args.len() == base.ty.component_count() as usize
                && base.args[components[0] as usize].ty == expr.ty =>
        {
            base.args.swap_remove(components[0] as usize)
        }
        _ => {
            let whole = components.iter().copied().eq(0..base.ty.component_count());
            if whole { expr.args.swap_remove(0) } else { expr }
        }
    }
}

/// `vec3(v.x, v.y, a)` becomes `vec3(v.xy, a)`.
fn simplify_construct(expr: Expr) -> Expr {
    if expr.ty.is_array() || expr.args.len() < 2 {
        return expr;
    }
    let mut parts: Vec<Expr> = Vec::new();
    for part in expr.args {
        if let Some(last) = parts.last_mut()
            && let (Op::Swizzle(before), Op::Swizzle(after)) = (&mut last.op, &part.op)
            && last.args == part.args
        {
            before.extend(after);
            let lanes = before.len() as u8;
            if let Some(kind) = last.ty.scalar_kind() {
                last.ty.shape = Type::value(kind, lanes);
            }
            continue;
        }
        parts.push(part);
    }
    let parts: Vec<Expr> = parts.into_iter().map(simplify_swizzle).collect();
    match &parts[..] {
        [one] if one.ty == expr.ty => one.clone(),
        _ => Expr::new(Op::Construct, parts, expr.ty),
    }
}

/// `f32(u32(i))` becomes `f32(i)` if `i` is not negative; likewise `i32(u32(i))` becomes `i`.
fn simplify_convert(mut expr: Expr) -> Expr {
    let Op::Convert { fits: outer } = expr.op else {
        return expr;
    };
    let inner = &mut expr.args[0];
    if let Op::Convert { fits: true } = inner.op
        && inner.ty.is_integer()
        && inner.args[0].ty.is_integer()
    {
        let source = inner.args.swap_remove(0);
        if source.ty == expr.ty {
            return source;
        }
        return Expr::new(Op::Convert { fits: outer }, vec![source], expr.ty);
    }
    expr
}

/// A vector with equal components becomes a scalar if the other operand is a vector.
fn scalar_operands(op: BinaryOp, mut expr: Expr) -> Expr {
    if !matches!(op, BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div) || expr.ty.is_scalar() {
        return expr;
    }
    for k in [1, 0] {
        if !expr.args[1 - k].ty.is_scalar()
            && let Some(scalar) = splatted_scalar(&expr.args[k])
        {
            expr.args[k] = scalar;
        }
    }
    expr
}

/// Returns the scalar that all components of a vector equal.
fn splatted_scalar(expr: &Expr) -> Option<Expr> {
    let kind = expr.ty.scalar_kind()?;
    let lanes = expr.ty.component_count() as usize;
    let ty = crate::emit::ast::Ty {
        shape: Type::scalar(kind),
        ..expr.ty
    };
    match &expr.op {
        Op::Construct if expr.args.len() == 1 && expr.args[0].ty.is_scalar() => Some(expr.args[0].clone()),
        Op::Ir(ir::Op::Const(bits)) if bits[..lanes].iter().all(|b| *b == bits[0]) => Some(Expr::splat(ty, bits[0])),
        _ => None,
    }
}

/// `x + -1` becomes `x - 1`, and `x - -1` becomes `x + 1`.
fn flip_negative_term(op: BinaryOp, mut expr: Expr) -> Expr {
    let other = match op {
        BinaryOp::Add => BinaryOp::Sub,
        BinaryOp::Sub => BinaryOp::Add,
        _ => return expr,
    };
    let right = &expr.args[1];
    let (Some(bits), Some(kind)) = (right.as_constant().copied(), right.ty.scalar_kind()) else {
        return expr;
    };
    let lanes = right.ty.component_count() as usize;
    let negative = |bits: u32| match kind {
        Scalar::F32 => f32::from_bits(bits) < 0.0,
        Scalar::I32 => (bits as i32) < 0 && bits as i32 != i32::MIN,
        _ => false,
    };
    let negated = |bits: u32| match kind {
        Scalar::F32 => (-f32::from_bits(bits)).to_bits(),
        _ => (bits as i32).wrapping_neg() as u32,
    };
    if bits[..lanes].iter().all(|bits| negative(*bits)) {
        let ty = right.ty;
        expr.args[1] = Expr::constant(ty, bits.map(negated));
        expr.op = Op::Ir(ir::Op::Binary(other));
    }
    expr
}

/// `(f(v.x) < a) & (f(v.y) < a)` becomes `all(f(v.xy) < vec2(a))`, and so does `max(v.x, v.y) < a` of integers.
fn merge_comparisons(op: BinaryOp, expr: Expr) -> Expr {
    match op {
        BinaryOp::And | BinaryOp::Or if expr.ty.shape == Type::BOOL => {
            let quantifier = if op == BinaryOp::And { Op::All } else { Op::Any };
            let [left, right] = [&expr.args[0], &expr.args[1]];
            let joined = match (left.op == quantifier, right.op == quantifier) {
                (true, true) => join_components(&left.args[0], &right.args[0]),
                (true, false) => join_components(&left.args[0], right),
                (false, true) => join_components(left, &right.args[0]),
                (false, false) => join_components(left, right),
            };
            match joined {
                Some(both) if is_comparison(&both) || !both.ty.is_scalar() => {
                    Expr::new(quantifier, vec![both], Type::BOOL)
                }
                _ => expr,
            }
        }
        BinaryOp::Lt | BinaryOp::Le | BinaryOp::Gt | BinaryOp::Ge if expr.args[0].ty.is_integer() => {
            let bound = &expr.args[1];
            let outermost = match op {
                BinaryOp::Lt | BinaryOp::Le => BinaryOp::Max,
                _ => BinaryOp::Min,
            };
            let mut parts = Vec::new();
            collect_operands(&expr.args[0], outermost, &mut parts);
            let Some(vector) = whole_vector(&parts) else {
                return expr;
            };
            let Some(bits) = bound.as_constant() else { return expr };
            let every = vector.binary(op, Expr::splat(bound.ty.shape_of(parts.len()), bits[0]));
            Expr::new(Op::All, vec![every], Type::BOOL)
        }
        _ => expr,
    }
}

fn is_comparison(expr: &Expr) -> bool {
    matches!(expr.op, Op::Ir(ir::Op::Binary(op)) if op.is_comparison())
}

/// Collects the operands of a chain of one operator.
fn collect_operands<'e>(expr: &'e Expr, op: BinaryOp, out: &mut Vec<&'e Expr>) {
    if expr.op == Op::Ir(ir::Op::Binary(op)) {
        expr.args.iter().for_each(|arg| collect_operands(arg, op, out));
    } else {
        out.push(expr);
    }
}

/// Returns the vector whose components these are, in order.
fn whole_vector(parts: &[&Expr]) -> Option<Expr> {
    let first = parts.first()?;
    let Op::Swizzle(_) = first.op else { return None };
    let base = &first.args[0];
    let component = |(k, part): (usize, &&Expr)| part.op == Op::Swizzle(vec![k as u8]) && part.args[0] == *base;
    let whole = parts.len() == base.ty.component_count() as usize && parts.iter().enumerate().all(component);
    (whole && parts.len() > 1).then(|| base.clone())
}

/// Joins two expressions that differ only in the components of one vector, into one with more components. Both must have
/// the same shape, except for the number of components.
fn join_components(left: &Expr, right: &Expr) -> Option<Expr> {
    let lanes = left.ty.component_count() + right.ty.component_count();
    if lanes > 4 || left.ty.is_array() {
        return None;
    }
    let shape = left.ty.shape_of(lanes as usize);
    match (&left.op, &right.op) {
        (Op::Swizzle(before), Op::Swizzle(after)) if left.args == right.args => {
            let components = before.iter().chain(after).copied().collect();
            Some(simplify_swizzle(Expr::new(
                Op::Swizzle(components),
                left.args.clone(),
                shape,
            )))
        }
        (Op::Ir(ir::Op::Const(a)), Op::Ir(ir::Op::Const(b))) => {
            let same = (0..left.ty.component_count() as usize).all(|k| a[k] == b[0])
                && (0..right.ty.component_count() as usize).all(|k| b[k] == b[0]);
            (same && left.ty.scalar_kind() == right.ty.scalar_kind()).then(|| Expr::splat(shape, b[0]))
        }
        (Op::Ir(a @ (ir::Op::Unary(_) | ir::Op::Binary(_) | ir::Op::Bitcast)), Op::Ir(b)) if a == b => {
            let pairs = left.args.iter().zip(&right.args);
            let args: Option<Vec<Expr>> = pairs.map(|(l, r)| join_components(l, r)).collect();
            Some(Expr::new(left.op.clone(), args?, shape))
        }
        _ => None,
    }
}
