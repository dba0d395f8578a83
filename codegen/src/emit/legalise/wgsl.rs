//! WGSL: shift counts, saturating conversions, non-finite constants, and tables with many reads.

use super::{below_32, by_component, guards::rewrite_unequal, is_non_finite, to_integer};
use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, Ty, VarId, Variable};
use std::collections::BTreeMap;
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// Variables of non-finite floats, by their bits: WGSL has no such literals.
type Specials = BTreeMap<u32, [VarId; 2]>;

/// Rewrites a module for WGSL.
pub fn apply_wgsl_rules(module: &mut Module<'_>) {
    for k in 0..module.functions.len() {
        let mut body = std::mem::take(&mut module.functions[k].body);
        let mut specials = Specials::new();
        for stmt in &mut body {
            stmt.rewrite(&mut |expr| finite_rule(module, &mut specials, expr));
        }
        module.functions[k].body = declare_specials(module, specials, body);
    }
    let mut specials = Specials::new();
    module.rewrite(&mut |module, expr| finite_rule(module, &mut specials, expr));
    let body = std::mem::take(&mut module.body);
    module.body = declare_specials(module, specials, body);
    copy_tables(module);
}

/// Copies tables with several reads to variables: naga copies a constant array for every read.
fn copy_tables(module: &mut Module<'_>) {
    let mut reads: BTreeMap<VarId, u32> = module.tables.iter().map(|(var, _)| (*var, 0)).collect();
    module.body.iter().for_each(|stmt| count_reads(stmt, 1, &mut reads));
    let copies: BTreeMap<VarId, VarId> = reads
        .into_iter()
        .filter(|(_, times)| *times > 1)
        .map(|(table, _)| {
            let Variable { name, ty, .. } = module.variables[table.0 as usize].clone();
            (table, module.new_variable(format!("{name}_values"), ty))
        })
        .collect();
    for stmt in &mut module.body {
        stmt.rewrite(&mut |expr| match expr.op {
            Op::Index { .. } => Expr {
                args: expr.args.into_iter().map(|arg| rename_copy(arg, &copies)).collect(),
                ..expr
            },
            _ => expr,
        });
    }
    let declarations = copies.iter().flat_map(|(table, copy)| {
        let comment = StmtKind::Comment("A variable, since a constant would be copied for each read.".to_owned());
        [comment, StmtKind::Var(*copy, Some(module.read_variable(*table)))]
    });
    let declarations: Block<'_> = declarations.map(Into::into).collect();
    module.body.splice(0..0, declarations);
}

/// Counts reads of tables at non-constant indices; a read in a loop counts several times.
fn count_reads(stmt: &Stmt<'_>, times: u32, reads: &mut BTreeMap<VarId, u32>) {
    for expr in stmt.own_exprs() {
        expr.visit(&mut |expr| {
            if let (Op::Index { .. }, [array, index]) = (&expr.op, &expr.args[..])
                && let Some(var) = array.as_var()
                && index.as_constant().is_none()
                && let Some(count) = reads.get_mut(&var)
            {
                *count += times;
            }
        });
    }
    let times = match stmt.kind {
        StmtKind::For { .. } | StmtKind::Loop(_) => 2,
        _ => times,
    };
    let inner = stmt.blocks().into_iter().flatten();
    inner.for_each(|stmt| count_reads(stmt, times, reads));
}

fn rename_copy(expr: Expr, copies: &BTreeMap<VarId, VarId>) -> Expr {
    match expr.as_var().and_then(|var| copies.get(&var)) {
        Some(copy) => Expr::var(*copy, expr.ty),
        None => expr,
    }
}

/// Rewrite rule of WGSL for infinities and NaN, which have no literals.
fn finite_rule(module: &mut Module<'_>, specials: &mut Specials, expr: Expr) -> Expr {
    if is_non_finite(&expr) {
        let half = expr.ty.half;
        return by_component(&expr, |bits| non_finite(module, specials, bits, half));
    }
    wgsl_rule(module, expr)
}

/// Prepends the variables that hold infinities and NaN to a block.
fn declare_specials<'g>(module: &mut Module<'g>, specials: Specials, mut block: Block<'g>) -> Block<'g> {
    let mut body: Block<'_> = Vec::new();
    for (bits, [value, variable]) in specials {
        let comment = "A variable, since no constant may be an infinity or a NaN.";
        let word = Expr::new(Op::Hex(bits), Vec::new(), Type::U32);
        let read = module.read_variable(variable).bits_as(Type::F32);
        let ty = module.variable_type(value);
        let read = if ty.half { read.convert_to(ty) } else { read };
        body.push(StmtKind::Comment(comment.to_owned()).into());
        body.push(StmtKind::Var(variable, Some(word)).into());
        body.push(StmtKind::Let(value, read).into());
    }
    body.append(&mut block);
    body
}

fn wgsl_rule(module: &mut Module<'_>, mut expr: Expr) -> Expr {
    match expr.op {
        // WGSL shifts by unsigned counts, and rejects a constant count of 32 or more.
        Op::Ir(ir::Op::Binary(BinaryOp::Shl | BinaryOp::Shr)) => {
            let count = expr.args.pop().expect("two arguments");
            let unsigned = count.ty.with_kind(Scalar::U32);
            let count = match (count.as_constant(), count.ty == unsigned) {
                (Some(bits), _) => Expr::constant(unsigned, *bits),
                (None, true) => count,
                (None, false) => count.convert_to(unsigned),
            };
            expr.args.push(below_32(count));
            expr
        }
        Op::Ir(ir::Op::Binary(BinaryOp::Ne)) => rewrite_unequal(expr),
        // WGSL's own conversion saturates at the nearest integer that is also an `f32`, which is not the largest integer,
        // and leaves NaN undefined.
        Op::Convert { fits: false } if expr.args[0].ty.is_float() && expr.ty.is_integer() => {
            let name = format!("to_{}", expr.ty.short_name());
            expr.op = to_integer(module, &name, expr.ty, false, wgsl_rule);
            expr
        }
        _ => expr,
    }
}

/// Returns an infinity or a NaN. WGSL rejects such constant expressions, but accepts the bits of a variable.
fn non_finite(module: &mut Module<'_>, specials: &mut Specials, bits: u32, half: bool) -> Expr {
    let ty = Ty { shape: Type::F32, half };
    if bits == f32::NEG_INFINITY.to_bits() {
        let infinity = non_finite(module, specials, f32::INFINITY.to_bits(), half);
        return Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Neg)), vec![infinity], ty);
    }
    let name = match f32::from_bits(bits).is_nan() {
        true => "nan",
        false => "infinity",
    };
    let [value, _] = *specials.entry(bits).or_insert_with(|| {
        [
            module.new_variable(name, ty),
            module.new_variable(format!("{name}_bits"), Type::U32),
        ]
    });
    module.read_variable(value)
}
