//! No second variable for what is copied back: `var b = a; if c { b = f(a); } a = b;` is `if c { a = f(a); }`, and so where
//! both sides of the branch give `b` its value.

use crate::emit::ast::{Block, Expr, Op, Stmt, StmtKind, VarId};

/// Merges such variables, innermost blocks first.
pub fn coalesce(block: &mut Block<'_>) {
    for stmt in &mut *block {
        stmt.blocks_mut().into_iter().for_each(coalesce);
    }
    let mut k = 0;
    while k < block.len() {
        match copied_back(block, k) {
            Some((copy, original, last)) => {
                block.remove(last);
                block.remove(k);
                block[k..].iter_mut().for_each(|stmt| rename(stmt, copy, original));
            }
            None => k += 1,
        }
    }
}

/// If statement `k` copies a variable which a later one copies back, and none but the copy is changed between: the copy, the
/// original and the later statement.
fn copied_back(block: &[Stmt<'_>], k: usize) -> Option<(VarId, VarId, usize)> {
    let StmtKind::Var(copy, value) = &block[k].kind else {
        return None;
    };
    let copy = *copy;
    let back = |stmt: &Stmt<'_>| match &stmt.kind {
        StmtKind::Assign(place, None, value) if value.as_var() == Some(copy) => place.as_var(),
        _ => None,
    };
    let (at, original) = block[k + 1..]
        .iter()
        .enumerate()
        .find_map(|(at, stmt)| Some((at, back(stmt)?)))?;
    let last = k + 1 + at;
    let declared = |stmt: &Stmt<'_>| matches!(stmt.kind, StmtKind::Var(var, _) if var == original);
    if value.as_ref().is_some_and(|value| value.as_var() != Some(original)) || block[k..last].iter().any(declared) {
        return None;
    }
    let mut changed = false;
    let kept = block[k + 1..last]
        .iter()
        .all(|stmt| keeps(stmt, copy, original, &mut changed));
    // From there on both are the same, unless one of them changes.
    let rest = &block[last + 1..];
    let unused = rest.iter().all(|stmt| !stmt.mentions(copy));
    let same = rest.iter().all(|stmt| !stmt.assigns(copy) && !stmt.assigns(original));
    (kept && (unused || same)).then_some((copy, original, last))
}

/// Whether a statement leaves the original as it is, and does not read it once the copy is `changed`.
fn keeps(stmt: &Stmt<'_>, copy: VarId, original: VarId, changed: &mut bool) -> bool {
    let reads = |expr: &Expr| expr.mentions(|var| var == original);
    match &stmt.kind {
        StmtKind::Assign(place, _, value) => {
            let target = place.root();
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
            let sides = then.iter().all(|stmt| keeps(stmt, copy, original, &mut first))
                && otherwise.iter().all(|stmt| keeps(stmt, copy, original, &mut second));
            *changed |= first | second;
            sides
        }
        StmtKind::Effect(effect) if effect.before.is_some_and(|var| var == copy || var == original) => false,
        // Who leaves the loop here does not come to where it is copied back.
        StmtKind::Break | StmtKind::Return(_) => false,
        // Iterations see what those before have changed.
        StmtKind::For { .. } | StmtKind::Loop(_) => {
            let (copied, read) = (stmt.mentions(copy), stmt.mentions(original));
            let first = *changed;
            *changed |= copied;
            !read || !(copied || first || stmt.assigns(original))
        }
        _ => !(*changed && stmt.own().into_iter().any(reads)),
    }
}

fn rename(stmt: &mut Stmt<'_>, from: VarId, to: VarId) {
    stmt.rewrite(&mut |expr| match expr.op {
        Op::Var(var) if var == from => Expr::var(to, expr.ty),
        _ => expr,
    });
}
