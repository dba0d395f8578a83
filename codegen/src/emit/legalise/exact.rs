//! Exact operations: `precise` if the language has it, else a function that is opaque to compilers.

use crate::emit::ast::{Expr, Function, Module, Op, Stmt, StmtKind, Ty};
use straightline_evaluator::ir::{self, BinaryOp, Scalar};

/// Name of the function that keeps a value as written; for vectors, the type is appended.
pub const AS_WRITTEN: &str = "as_written";

/// Declares the variables of exact values as `precise`.
pub fn mark_precise(module: &mut Module<'_>) {
    let mut body = std::mem::take(&mut module.body);
    body.iter_mut().for_each(|stmt| mark_statement(module, stmt));
    module.body = body;
}

fn mark_statement(module: &mut Module<'_>, stmt: &mut Stmt<'_>) {
    let variable = match &stmt.kind {
        StmtKind::Let(var, value) | StmtKind::Var(var, Some(value)) if is_exact(value) => Some(*var),
        StmtKind::Assign(place, _, value) if is_exact(value) => place.as_var(),
        _ => None,
    };
    if let Some(var) = variable {
        module.variables[var.0 as usize].precise = true;
    }
    for expr in stmt.own_mut() {
        expr.rewrite_in_place(&mut |mut expr| match expr.op {
            Op::Exact { .. } => expr.args.swap_remove(0),
            _ => expr,
        });
    }
    for block in stmt.blocks_mut() {
        block.iter_mut().for_each(|stmt| mark_statement(module, stmt));
    }
}

fn is_exact(expr: &Expr) -> bool {
    matches!(expr.op, Op::Exact { .. })
}

/// Wraps exact values in calls of a function: those that further arithmetic uses, or all of them with `all`.
pub fn insert_barriers(module: &mut Module<'_>, all: bool) {
    module.rewrite(&mut |module, mut expr| match expr.op {
        Op::Exact { goes_on } if all || goes_on => {
            expr.op = barrier_function(module, expr.ty);
            expr
        }
        Op::Exact { .. } => expr.args.swap_remove(0),
        _ => expr,
    });
}

/// Returns a function that replaces the bits of one NaN by those of another. A compiler cannot know that no number has
/// these bits. So it must compute the argument as written, and cannot optimise across the call.
fn barrier_function(module: &mut Module<'_>, ty: Ty) -> Op {
    const LARGEST: u32 = 0xffff_fffe;
    let name = match ty.is_scalar() && !ty.half {
        true => AS_WRITTEN.to_owned(),
        false => format!("{AS_WRITTEN}_{}", ty.short_name().replace(['<', '>'], "_")),
    };
    module.add_function(&name.clone(), ty, |module| {
        let x = module.new_variable("x", ty);
        let words = ty.to_full_precision().with_kind(Scalar::U32);
        let largest = Expr::new(Op::Hex(LARGEST), Vec::new(), words);
        let full = |expr: Expr| {
            if ty.half {
                expr.convert_to(ty.to_full_precision())
            } else {
                expr
            }
        };
        let bits = full(module.read_variable(x)).bits_as(words);
        let same = Expr::new(Op::Ir(ir::Op::Binary(BinaryOp::Min)), vec![bits, largest], words);
        let same = same.bits_as(ty.to_full_precision());
        let same = if ty.half { same.convert_to(ty) } else { same };
        Function {
            comment: "The same number, by its bits: what it is computed of stays in the order in which it is written."
                .to_owned(),
            name,
            params: vec![x],
            result: ty,
            body: vec![StmtKind::Return(Some(same)).into()],
        }
    })
}
