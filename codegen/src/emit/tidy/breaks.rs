//! Moves exits into the branches that decide them: `if c { a } else { b } if c { break; }` becomes `if c { a; break; } b`.

use super::simplify::not;
use crate::emit::ast::{Block, Expr, Op, Stmt, StmtKind, VarId};
use straightline_evaluator::ir::{self, BinaryOp, Type, UnaryOp};

/// Moves every `break` at the end of a loop's body into the preceding branch that decides it.
pub fn sink_breaks(block: &mut Block<'_>) {
    for stmt in &mut *block {
        stmt.blocks_mut().into_iter().for_each(sink_breaks);
        if let StmtKind::For { body, .. } | StmtKind::Loop(body) = &mut stmt.kind {
            sink_break(body);
        }
    }
    let mut declared = Vec::new();
    for stmt in block {
        match &mut stmt.kind {
            StmtKind::Var(var, Some(value)) if value.as_constant().is_some() => declared.push((*var, value.clone())),
            StmtKind::For { body, .. } | StmtKind::Loop(body) => {
                for (var, value) in &declared {
                    if keeps_value(body, *var, value) {
                        drop_assignments(body, *var, value);
                    }
                }
            }
            _ => {}
        }
        declared.retain(|(var, _)| !stmt.assigns(*var));
    }
}

/// Value of a loop's exit condition at the end of one side of a branch.
enum Known {
    /// The constant value.
    Is(bool),
    /// The simplified condition; `true` if a branch at the end of the side simplifies it further.
    Left(Expr, bool),
}

impl Known {
    /// Returns whether the condition is decided, here or in a branch at the end.
    fn is_decided(&self) -> bool {
        match self {
            Known::Is(_) => true,
            Known::Left(_, within) => *within,
        }
    }
}

/// Merges a `break` at the end of a block with the preceding branch, as deeply as that decides it.
fn sink_break(block: &mut Block<'_>) {
    branch_last(block);
    let [.., branch, leave] = block.as_slice() else { return };
    let StmtKind::If {
        condition,
        then,
        otherwise,
    } = &branch.kind
    else {
        return;
    };
    let Some(leaves) = exit_condition(leave) else { return };
    let known = [(true, then), (false, otherwise)].map(|(holds, side)| evaluate_exit(leaves, condition, holds, side));
    let [first, second] = known;
    if !first.is_decided() && !second.is_decided() {
        return;
    }
    let Some(leave) = block.pop() else { return };
    let Some(Stmt {
        kind: StmtKind::If {
            mut condition,
            mut then,
            mut otherwise,
        },
        source,
    }) = block.pop()
    else {
        return;
    };
    let (leaves_first, leaves_second) = (matches!(first, Known::Is(true)), matches!(second, Known::Is(true)));
    for (side, known) in [(&mut then, first), (&mut otherwise, second)] {
        match known {
            Known::Is(true) => side.push(StmtKind::Break.into()),
            Known::Is(false) => {}
            Known::Left(condition, _) => {
                let kind = StmtKind::If {
                    condition,
                    then: vec![StmtKind::Break.into()],
                    otherwise: Vec::new(),
                };
                side.push(Stmt { kind, ..leave });
                sink_break(side);
            }
        }
    }
    // After a side that ends in a `break`, the other side's statements need no block.
    let mut rest = Vec::new();
    if leaves_first {
        rest = std::mem::take(&mut otherwise);
    } else if leaves_second {
        condition = not(condition);
        std::mem::swap(&mut then, &mut otherwise);
        rest = std::mem::take(&mut otherwise);
    }
    let kind = StmtKind::If {
        condition,
        then,
        otherwise,
    };
    block.push(Stmt { kind, source });
    block.extend(rest);
}

/// Returns the condition of a statement that only exits the loop.
fn exit_condition<'s>(stmt: &'s Stmt<'_>) -> Option<&'s Expr> {
    match &stmt.kind {
        StmtKind::If {
            condition,
            then,
            otherwise,
        } if otherwise.is_empty() && matches!(then.as_slice(), [only] if only.kind == StmtKind::Break) => {
            Some(condition)
        }
        _ => None,
    }
}

/// Evaluates the exit condition `leaves` at the end of a branch's side, which is taken if `condition` equals `holds`.
fn evaluate_exit(leaves: &Expr, condition: &Expr, holds: bool, side: &Block<'_>) -> Known {
    let unchanged = !condition.mentions(|var| side.iter().any(|stmt| stmt.assigns(var)));
    let left = leaves.clone().rewrite(&mut |expr| {
        let of_condition = (unchanged && expr == *condition).then_some(holds);
        let of_negation = (unchanged && not(expr.clone()) == *condition).then_some(!holds);
        let assigned = expr.as_var().and_then(|var| last_value(side, var));
        match of_condition.or(of_negation) {
            Some(value) => bool_constant(value),
            None => reduce_boolean(assigned.cloned().unwrap_or(expr)),
        }
    });
    if let Some(bits) = left.as_constant() {
        return Known::Is(bits[0] != 0);
    }
    let within = match side.last().map(|stmt| &stmt.kind) {
        Some(StmtKind::If {
            condition,
            then,
            otherwise,
        }) => {
            let side = |holds, side| evaluate_exit(&left, condition, holds, side).is_decided();
            side(true, then) || side(false, otherwise)
        }
        _ => false,
    };
    Known::Left(left, within)
}

/// Returns the value that a block leaves in a variable, if the same expression has that value after the block.
fn last_value<'b>(block: &'b Block<'_>, var: VarId) -> Option<&'b Expr> {
    let at = block.iter().rposition(|stmt| stmt.assigns(var))?;
    match &block[at].kind {
        StmtKind::Assign(place, None, value) if place.as_var() == Some(var) => {
            let changed = value.mentions(|read| block[at..].iter().any(|stmt| stmt.assigns(read)));
            (!changed).then_some(value)
        }
        _ => None,
    }
}

/// Moves assignments after a branch that do not depend on it to before it, so that the branch immediately precedes the
/// `break` that it decides on.
fn branch_last(block: &mut Block<'_>) {
    let Some(end) = block
        .len()
        .checked_sub(1)
        .filter(|_| block.last().is_some_and(|stmt| exit_condition(stmt).is_some()))
    else {
        return;
    };
    let Some(mut at) = block[..end]
        .iter()
        .rposition(|stmt| matches!(stmt.kind, StmtKind::If { .. }))
    else {
        return;
    };
    for k in at + 1..end {
        let (before, behind) = block.split_at_mut(k);
        let (branch, stmt) = (&mut before[at], &mut behind[0]);
        let StmtKind::Assign(place, None, value) = &stmt.kind else {
            return;
        };
        let Some(var) = place.as_var() else { return };
        let depends = value.mentions(|read| branch.assigns(read)) || branch.mentions(var);
        if !depends {
            block[at..=k].rotate_right(1);
            at += 1;
            continue;
        }
        return;
    }
}

fn bool_constant(holds: bool) -> Expr {
    Expr::constant(Type::BOOL, [u32::from(holds), 0, 0, 0])
}

/// Simplifies a boolean operation with a constant argument.
fn reduce_boolean(expr: Expr) -> Expr {
    let known = |k: usize| expr.args.get(k).and_then(Expr::as_constant).map(|bits| bits[0] != 0);
    let keep = match (&expr.op, known(0), known(1)) {
        (Op::Ir(ir::Op::Unary(UnaryOp::Not)), Some(value), _) => return bool_constant(!value),
        (Op::Ir(ir::Op::Binary(BinaryOp::Or)), Some(true), _)
        | (Op::Ir(ir::Op::Binary(BinaryOp::Or)), _, Some(true)) => {
            return bool_constant(true);
        }
        (Op::Ir(ir::Op::Binary(BinaryOp::And)), Some(false), _)
        | (Op::Ir(ir::Op::Binary(BinaryOp::And)), _, Some(false)) => return bool_constant(false),
        (Op::Ir(ir::Op::Binary(BinaryOp::Or | BinaryOp::And)), Some(_), _) => 1,
        (Op::Ir(ir::Op::Binary(BinaryOp::Or | BinaryOp::And)), _, Some(_)) => 0,
        _ => return expr,
    };
    let mut args = expr.args;
    args.swap_remove(keep)
}

/// Returns whether a variable that begins as `value` still holds it wherever a loop's body assigns that value again: each
/// assignment of another value exits the loop.
fn keeps_value(body: &Block<'_>, var: VarId, value: &Expr) -> bool {
    let leaves = matches!(body.last().map(|stmt| &stmt.kind), Some(StmtKind::Break));
    body.iter().all(|stmt| match &stmt.kind {
        StmtKind::Assign(place, op, to) if place.root_variable() == Some(var) => {
            leaves || (op.is_none() && place.as_var() == Some(var) && to == value)
        }
        StmtKind::For { .. } | StmtKind::Loop(_) => !stmt.assigns(var),
        _ => stmt.blocks().into_iter().all(|inner| keeps_value(inner, var, value)),
    })
}

/// Removes the assignments of a value that the variable already has.
fn drop_assignments(block: &mut Block<'_>, var: VarId, value: &Expr) {
    if matches!(block.last().map(|stmt| &stmt.kind), Some(StmtKind::Break)) {
        // The value assigned before a `break` is read after the loop.
        let others = |stmt: &Stmt<'_>| matches!(&stmt.kind, StmtKind::Assign(place, _, to) if place.root_variable() == Some(var) && to != value);
        if block.iter().any(others) {
            return;
        }
    }
    block.retain(
        |stmt| !matches!(&stmt.kind, StmtKind::Assign(place, None, to) if place.as_var() == Some(var) && to == value),
    );
    for stmt in block {
        stmt.blocks_mut()
            .into_iter()
            .for_each(|inner| drop_assignments(inner, var, value));
    }
}
