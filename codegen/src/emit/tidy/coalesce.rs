//! Merges variables whose value is copied back. `var b = a; if c { b = f(a); } a = b;` becomes `if c { a = f(a); }`, also
//! if both sides assign `b`. `let b = f(a); g(b); a = b;` becomes `a = f(a); g(a);`. `let a = f(); var b = a; if c { b =
//! g(b); }` becomes `var a = f(); if c { a = g(a); }`.

use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, VarId, Variable};
use std::collections::BTreeSet;

/// Merges such variables, innermost blocks first.
pub fn coalesce_variables(module: &mut Module<'_>) {
    merge_block(&mut module.body, &module.variables);
}

fn merge_block(block: &mut Block<'_>, variables: &[Variable]) {
    for stmt in &mut *block {
        stmt.blocks_mut()
            .into_iter()
            .for_each(|inner| merge_block(inner, variables));
    }
    // Variables whose whole value is assigned to another one: few in a long block.
    let passed_on: BTreeSet<VarId> = block
        .iter()
        .filter_map(|stmt| match &stmt.kind {
            StmtKind::Assign(_, None, value) => value.as_var(),
            _ => None,
        })
        .collect();
    let mut k = 0;
    while k < block.len() {
        if let StmtKind::Var(copy, _) = block[k].kind
            && passed_on.contains(&copy)
            && let Some((original, last)) = given_back(block, k, copy)
        {
            block[k + 1..last]
                .iter_mut()
                .for_each(|stmt| read_first(stmt, copy, original));
        }
        if let Some((copy, original, last)) = copied_back(block, k) {
            block.remove(last);
            block.remove(k);
            block[k..]
                .iter_mut()
                .for_each(|stmt| rename_variable(stmt, copy, original));
            continue;
        }
        if let Some((copy, original, declared)) = goes_on(block, k, variables) {
            let kind = std::mem::replace(&mut block[declared].kind, StmtKind::Break);
            block[declared].kind = match kind {
                StmtKind::Let(var, value) => StmtKind::Var(var, Some(value)),
                kind => kind,
            };
            block.remove(k);
            block[k..]
                .iter_mut()
                .for_each(|stmt| rename_variable(stmt, copy, original));
            continue;
        }
        let made = match block[k].kind {
            StmtKind::Let(var, _) | StmtKind::Var(var, _) => passed_on.contains(&var),
            _ => false,
        };
        if made && let Some((copy, original, last)) = moved_on(block, k) {
            block.remove(last);
            let declaration = block.remove(k);
            block[k..]
                .iter_mut()
                .for_each(|stmt| rename_variable(stmt, copy, original));
            if let StmtKind::Let(_, value) | StmtKind::Var(_, Some(value)) = declaration.kind {
                let place = Expr::var(original, value.ty);
                let kind = StmtKind::Assign(place, None, value);
                block.insert(k, Stmt { kind, ..declaration });
                k += 1;
            }
            continue;
        }
        k += 1;
    }
}

/// Finds in statement `k` a variable that is initialised with a named value which is not read after the variable changes.
/// Returns the variable, the value, and the statement that made the value.
fn goes_on(block: &[Stmt<'_>], k: usize, variables: &[Variable]) -> Option<(VarId, VarId, usize)> {
    let StmtKind::Var(copy, Some(value)) = &block[k].kind else {
        return None;
    };
    let (copy, original) = (*copy, value.as_var()?);
    let [name, known] = [copy, original].map(|var| &variables[var.0 as usize].name);
    if name != known {
        return None;
    }
    let makes = |stmt: &Stmt<'_>| matches!(stmt.kind, StmtKind::Let(var, _) | StmtKind::Var(var, _) if var == original);
    let declared = block[..k].iter().position(makes)?;
    let mut changed = false;
    let kept = block[k + 1..]
        .iter()
        .all(|stmt| keeps_original(stmt, copy, original, &mut changed));
    kept.then_some((copy, original, declared))
}

/// Finds in statement `k` a value that a later statement of the block assigns to a variable whose old value is not read in
/// between. Returns the value's name, the variable and the later statement.
fn moved_on(block: &[Stmt<'_>], k: usize) -> Option<(VarId, VarId, usize)> {
    let (StmtKind::Let(copy, _) | StmtKind::Var(copy, _)) = block[k].kind else {
        return None;
    };
    let (original, last) = given_back(block, k, copy)?;
    let declares = |stmt: &Stmt<'_>| matches!(stmt.kind, StmtKind::Var(var, _) if var == original);
    let unread = block[k + 1..last]
        .iter()
        .all(|stmt| !stmt.mentions(original) && !declares(stmt) && !may_leave(stmt));
    let behind = &block[last + 1..];
    let unused = behind.iter().all(|stmt| !stmt.mentions(copy));
    let same = behind.iter().all(|stmt| !stmt.assigns(original) && !stmt.assigns(copy));
    (unread && (unused || same)).then_some((copy, original, last))
}

/// Returns whether a statement may exit its block.
fn may_leave(stmt: &Stmt<'_>) -> bool {
    match &stmt.kind {
        StmtKind::Break | StmtKind::Return(_) => true,
        _ => stmt.blocks().into_iter().any(|inner| inner.iter().any(may_leave)),
    }
}

/// Finds in statement `k` a copy of a variable that a later statement copies back, while only the copy changes in between.
/// Returns the copy, the original and the later statement.
fn copied_back(block: &[Stmt<'_>], k: usize) -> Option<(VarId, VarId, usize)> {
    let StmtKind::Var(copy, value) = &block[k].kind else {
        return None;
    };
    let copy = *copy;
    let (original, last) = given_back(block, k, copy)?;
    let declared = |stmt: &Stmt<'_>| matches!(stmt.kind, StmtKind::Var(var, _) if var == original);
    if value.as_ref().is_some_and(|value| value.as_var() != Some(original)) || block[k..last].iter().any(declared) {
        return None;
    }
    let mut changed = false;
    let kept = block[k + 1..last]
        .iter()
        .all(|stmt| keeps_original(stmt, copy, original, &mut changed));
    // From there on both are equal, unless one of them changes.
    let rest = &block[last + 1..];
    let unused = rest.iter().all(|stmt| !stmt.mentions(copy));
    let same = rest.iter().all(|stmt| !stmt.assigns(copy) && !stmt.assigns(original));
    (kept && (unused || same)).then_some((copy, original, last))
}

/// Returns the variable to which the copy of statement `k` is assigned, and the assigning statement.
fn given_back(block: &[Stmt<'_>], k: usize, copy: VarId) -> Option<(VarId, usize)> {
    let back = |stmt: &Stmt<'_>| match &stmt.kind {
        StmtKind::Assign(place, None, value) if value.as_var() == Some(copy) => place.as_var(),
        _ => None,
    };
    let rest = block.iter().enumerate().skip(k + 1);
    rest.filter_map(|(at, stmt)| Some((back(stmt)?, at))).next()
}

/// Moves reads of the original before changes of the copy, on every side of a branch: `b = x; c = a;` becomes `c = a; b =
/// x;`.
fn read_first(stmt: &mut Stmt<'_>, copy: VarId, original: VarId) {
    let StmtKind::If { then, otherwise, .. } = &mut stmt.kind else {
        return;
    };
    for side in [then, otherwise] {
        for k in 1..side.len() {
            let (before, behind) = side.split_at_mut(k);
            let (StmtKind::Assign(changed, None, value), StmtKind::Assign(place, None, read)) =
                (&before[k - 1].kind, &behind[0].kind)
            else {
                continue;
            };
            let reads = read.mentions(|var| var == original) && !read.mentions(|var| var == copy);
            let apart = place
                .as_var()
                .is_some_and(|var| var != copy && !value.mentions(|other| other == var));
            if changed.as_var() == Some(copy) && reads && apart {
                side.swap(k - 1, k);
            }
        }
        side.iter_mut().for_each(|inner| read_first(inner, copy, original));
    }
}

/// Returns whether a statement does not change the original, and does not read it after the copy has `changed`.
fn keeps_original(stmt: &Stmt<'_>, copy: VarId, original: VarId, changed: &mut bool) -> bool {
    let reads = |expr: &Expr| expr.mentions(|var| var == original);
    match &stmt.kind {
        StmtKind::Assign(place, _, value) => {
            let target = place.root_variable();
            let index = place.args.iter().skip(1).any(reads);
            if target == Some(original) || ((reads(value) || index) && *changed) {
                return false;
            }
            *changed |= target == Some(copy);
            true
        }
        StmtKind::If {
            condition,
            then,
            otherwise,
        } => {
            if reads(condition) && *changed {
                return false;
            }
            let (mut first, mut second) = (*changed, *changed);
            let sides = then.iter().all(|stmt| keeps_original(stmt, copy, original, &mut first))
                && otherwise
                    .iter()
                    .all(|stmt| keeps_original(stmt, copy, original, &mut second));
            *changed |= first | second;
            sides
        }
        StmtKind::Effect(effect) if effect.before.is_some_and(|var| var == copy || var == original) => false,
        // An exit from the loop skips the copy back.
        StmtKind::Break | StmtKind::Return(_) => false,
        // An iteration sees the changes of earlier ones.
        StmtKind::For { .. } | StmtKind::Loop(_) => {
            let (copied, read) = (stmt.mentions(copy), stmt.mentions(original));
            let first = *changed;
            *changed |= copied;
            !read || !(copied || first || stmt.assigns(original))
        }
        _ => !(*changed && stmt.own_exprs().any(reads)),
    }
}

fn rename_variable(stmt: &mut Stmt<'_>, from: VarId, to: VarId) {
    stmt.rewrite(&mut |expr| match expr.op {
        Op::Var(var) if var == from => Expr::var(to, expr.ty),
        _ => expr,
    });
    rename_before(stmt, from, to);
}

/// Renames the variable that receives the old value of an effect, too.
fn rename_before(stmt: &mut Stmt<'_>, from: VarId, to: VarId) {
    if let StmtKind::Effect(effect) = &mut stmt.kind
        && effect.before == Some(from)
    {
        effect.before = Some(to);
    }
    for inner in stmt.blocks_mut() {
        inner.iter_mut().for_each(|stmt| rename_before(stmt, from, to));
    }
}
