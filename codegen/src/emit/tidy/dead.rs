//! Removes statements without effect, and statements whose value is unused.

use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, VarId};
use straightline_evaluator::limits;

/// Counts the reads of each variable.
pub fn count_reads(module: &Module<'_>) -> Vec<u32> {
    let mut uses = vec![0; module.variables.len()];
    for stmt in &module.body {
        count_stmt_reads(stmt, &mut uses);
    }
    for (_, value) in &module.tables {
        value.visit(&mut |expr| {
            if let Op::Var(var) = expr.op {
                uses[var.0 as usize] += 1;
            }
        });
    }
    uses
}

/// Returns the expressions that a statement reads itself; a write to a variable is not a read.
pub fn read_by<'s>(stmt: &'s Stmt<'_>) -> impl Iterator<Item = &'s Expr> {
    let written = matches!(&stmt.kind, StmtKind::Assign(place, None, _) if matches!(place.op, Op::Var(_)));
    stmt.own_exprs().skip(usize::from(written))
}

fn count_stmt_reads(stmt: &Stmt<'_>, uses: &mut [u32]) {
    for expr in read_by(stmt) {
        expr.visit(&mut |expr| {
            if let Op::Var(var) = expr.op {
                uses[var.0 as usize] += 1;
            }
        });
    }
    for block in stmt.blocks() {
        block.iter().for_each(|stmt| count_stmt_reads(stmt, uses));
    }
}

/// Removes variables that are never read with their assignments, branches without statements, and unused tables.
pub fn remove_dead(module: &mut Module<'_>) {
    // Each iteration but the last removes a statement, and the first may remove only tables.
    for _ in 0..=crate::emit::ast::count_statements(&module.body) + 1 {
        limits::count_work(u64::from(crate::emit::ast::count_statements(&module.body)));
        if limits::exceeded_limit(0).is_some() {
            // The remaining statements are dead but correct; the caller reports the exceeded limit.
            return;
        }
        let uses = count_reads(module);
        let is_used = |var: VarId| uses[var.0 as usize] > 0;
        let mut removed = false;
        sweep_block(&mut module.body, &is_used, &mut removed);
        module.tables.retain(|(var, _)| is_used(*var));
        if !removed {
            return;
        }
    }
}

fn sweep_block(block: &mut Block<'_>, is_used: &dyn Fn(VarId) -> bool, removed: &mut bool) {
    let before = block.len();
    let mut needed = Vec::new();
    for stmt in block.iter() {
        variables_of_effects(stmt, &mut needed);
    }
    for stmt in block.iter_mut() {
        for inner in stmt.blocks_mut() {
            sweep_block(inner, is_used, removed);
        }
    }
    block.retain(|stmt| match &stmt.kind {
        StmtKind::Let(var, _) | StmtKind::Var(var, _) => is_used(*var) || needed.contains(var),
        StmtKind::Assign(place, None, value) => match place.op {
            Op::Var(var) => is_used(var) && place != value,
            _ => true,
        },
        StmtKind::If { then, otherwise, .. } => !then.is_empty() || !otherwise.is_empty(),
        _ => true,
    });
    for stmt in block.iter_mut() {
        // Effects are kept.
        if let StmtKind::Effect(effect) = &mut stmt.kind {
            effect.before = effect.before.filter(|var| is_used(*var) || effect.needs_variable());
        }
    }
    *removed |= block.len() < before;
}

/// Collects the variables that some language needs to express the effects of a statement.
fn variables_of_effects(stmt: &Stmt<'_>, out: &mut Vec<VarId>) {
    if let StmtKind::Effect(effect) = &stmt.kind
        && effect.needs_variable()
    {
        out.extend(effect.before);
    }
    for block in stmt.blocks() {
        block.iter().for_each(|stmt| variables_of_effects(stmt, out));
    }
}
