//! Half precision: every float of the kernel is an `f16`; inputs and outputs shared with other hardware stay in full
//! precision.

use crate::emit::ast::{Expr, Module, Op, Stmt, StmtKind, Ty};
use straightline_evaluator::ir;

/// The largest finite number of half precision.
const LARGEST: f32 = 65504.0;

/// Rewrites a kernel to half precision; the output colours stay in full precision.
pub fn legalise_half(module: &mut Module<'_>) {
    for variable in &mut module.variables {
        variable.ty = to_half_type(variable.ty);
    }
    module.rewrite(&mut |_, expr| half_rule(expr));
    module.body.iter_mut().for_each(widen_stored);
    for stmt in &mut module.body {
        if let StmtKind::Output(values) = &mut stmt.kind {
            for value in values {
                *value = value.clone().into_full();
            }
        }
    }
}

/// Converts values that are stored in buffers and pictures back to full precision.
fn widen_stored(stmt: &mut Stmt<'_>) {
    match &mut stmt.kind {
        StmtKind::Effect(effect) => {
            for arg in &mut effect.args {
                *arg = arg.clone().into_full();
            }
        }
        StmtKind::Store(_, _, value) => *value = value.clone().into_full(),
        _ => {}
    }
    stmt.blocks_mut().into_iter().flatten().for_each(widen_stored);
}

fn to_half_type(ty: Ty) -> Ty {
    Ty {
        half: ty.is_float(),
        ..ty
    }
}

fn half_rule(mut expr: Expr) -> Expr {
    use ir::Op::{
        Bitcast, BufferLoad, Compare, Derivative, Gather, GatherCompare, Load, Override, QuadSwap, Sample, SharedLoad,
        Uniform, Varying,
    };
    match &expr.op {
        // Bits are those of an `f32` in every precision.
        Op::Ir(
            Load { .. }
            | Sample { .. }
            | Gather { .. }
            | Compare { .. }
            | GatherCompare { .. }
            | BufferLoad { .. }
            | SharedLoad(_)
            | QuadSwap(_)
            | Derivative(_)
            | Uniform(_)
            | Override(_)
            | Varying(_)
            | Bitcast,
        ) => {
            expr.args = expr.args.into_iter().map(Expr::into_full).collect();
            expr.into_half()
        }
        // Conversions between half precision and integers go through `f32`, which holds every `f16` and every integer that
        // an `f16` holds. Driver-specific behaviour is then the same as in full precision.
        Op::Convert { fits } => {
            let fits = *fits;
            expr.args = expr.args.into_iter().map(Expr::into_full).collect();
            let clamps = !fits && expr.args[0].ty.is_integer() && expr.ty.is_float();
            if clamps {
                let ty = expr.ty;
                let [low, high] = [-LARGEST, LARGEST].map(|x| Expr::splat(ty, x.to_bits()));
                expr = Expr::new(Op::Ir(ir::Op::Clamp), vec![expr, low, high], ty);
            }
            expr.into_half()
        }
        // Converts only the components in use, not the whole texel.
        Op::Swizzle(_) if matches!(expr.args[0].op, Op::Convert { .. }) && expr.args[0].ty.half => {
            let converted = expr.args.pop().expect("a vector");
            expr.args = converted.args;
            expr.into_half()
        }
        _ => {
            expr.ty = to_half_type(expr.ty);
            expr
        }
    }
}
