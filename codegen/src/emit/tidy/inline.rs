//! A value that is used once is written where it is used, while the line stays short.

use super::columns::Columns;
use super::dead;
use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, VarId};
use crate::emit::text::WIDEST;
use crate::ir::{Graph, Memory};
use rustc_hash::{FxHashMap, FxHashSet};

/// Operators and calls that a line may have, lest it be hard to read; shader compilers also recurse over them.
const MOST: usize = 16;

/// Inlines values that are used once.
pub fn inline(module: &mut Module<'_>, graph: &Graph) {
    let uses = dead::uses(module);
    let mut body = std::mem::take(&mut module.body);
    let inliner = Inliner {
        uses,
        columns: Columns { module, graph },
    };
    inliner.block(&mut body, 1);
    module.body = body;
}

struct Inliner<'m> {
    uses: Vec<u32>,
    columns: Columns<'m>,
}

impl Inliner<'_> {
    fn block(&self, block: &mut Block<'_>, depth: usize) {
        let mut out: Vec<Option<Stmt<'_>>> = Vec::with_capacity(block.len());
        // Where each candidate stands, and when each mutable variable was last assigned.
        let mut defined: FxHashMap<VarId, usize> = FxHashMap::default();
        let mut assigned: FxHashMap<VarId, usize> = FxHashMap::default();
        for mut stmt in block.drain(..) {
            self.absorb(&mut stmt, &mut out, &defined, &assigned, depth);
            for inner in stmt.blocks_mut() {
                self.block(inner, depth + 1);
            }
            let at = out.len();
            let mut written = FxHashSet::default();
            assignments(&stmt, &mut written);
            assigned.extend(written.into_iter().map(|var| (var, at)));
            if let StmtKind::Let(var, _) = stmt.kind
                && self.uses[var.0 as usize] == 1
            {
                defined.insert(var, at);
            }
            out.push(Some(stmt));
        }
        block.extend(out.into_iter().flatten());
    }

    /// Writes values of earlier statements into a statement, short ones first.
    fn absorb<'g>(
        &self,
        stmt: &mut Stmt<'g>,
        out: &mut [Option<Stmt<'g>>],
        defined: &FxHashMap<VarId, usize>,
        assigned: &FxHashMap<VarId, usize>,
        depth: usize,
    ) {
        // The end of a loop is computed again for each iteration: what it reads must not change, and be quick to tell.
        let is_loop = matches!(stmt.kind, StmtKind::For { .. });
        let mut written = FxHashSet::default();
        assignments(stmt, &mut written);
        let suits = |value: &Expr| {
            !is_loop
                || (operations(value) <= 2 && !reads_memory(value) && !value.mentions(|var| written.contains(&var)))
        };
        loop {
            let mut candidates = Vec::new();
            for expr in stmt.own() {
                expr.visit(&mut |expr| {
                    if let Op::Var(var) = expr.op
                        && let Some(at) = defined.get(&var)
                        && let Some(Stmt {
                            kind: StmtKind::Let(_, value),
                            ..
                        }) = &out[*at]
                        && !changed_since(value, *at, assigned)
                        && suits(value)
                    {
                        candidates.push((self.columns.of(value), var, *at));
                    }
                });
            }
            candidates.sort_unstable();
            let (wide, many) = self.columns.of_stmt(stmt);
            let fits = candidates.into_iter().find(|(columns, var, at)| {
                let name = self.columns.module.variables[var.0 as usize].name.len();
                let Some(Stmt {
                    kind: StmtKind::Let(_, value),
                    ..
                }) = &out[*at]
                else {
                    return false;
                };
                4 * depth + wide + columns - name <= WIDEST && many + operations(value) <= MOST
            });
            let Some((_, var, at)) = fits else { return };
            let Some(Stmt {
                kind: StmtKind::Let(_, value),
                origin,
            }) = out[at].take()
            else {
                return;
            };
            if stmt.origin.is_none() && !matches!(stmt.kind, StmtKind::For { .. } | StmtKind::If { .. }) {
                stmt.origin = origin;
            }
            let mut value = Some(value);
            for own in stmt.own_mut() {
                let taken = own.clone();
                *own = taken.rewrite(&mut |expr| match expr.op {
                    Op::Var(found) if found == var => value.take().unwrap_or(expr),
                    _ => expr,
                });
            }
        }
    }
}

/// Operators and calls.
pub fn operations(expr: &Expr) -> usize {
    let mut count = 0;
    expr.visit(&mut |expr| {
        let free = matches!(
            expr.op,
            Op::Var(_) | Op::Ir(crate::ir::Op::Const(_) | crate::ir::Op::Uniform(_)) | Op::Swizzle(_)
        );
        count += usize::from(!free);
    });
    count
}

/// Whether an expression reads what a workgroup shares.
fn reads_shared(expr: &Expr) -> bool {
    let mut reads = false;
    expr.visit(&mut |expr| reads |= matches!(expr.op, Op::Ir(crate::ir::Op::SharedLoad(_))));
    reads
}

/// Whether an expression reads an array or what the host binds.
fn reads_memory(expr: &Expr) -> bool {
    let mut reads = false;
    expr.visit(&mut |expr| {
        reads |= match &expr.op {
            Op::Index { .. } => true,
            Op::Ir(op) => op.is_read() || op.only_looks(),
            _ => false,
        };
    });
    reads
}

/// Whether a variable that a value reads was assigned after a statement.
fn changed_since(value: &Expr, at: usize, assigned: &FxHashMap<VarId, usize>) -> bool {
    let changed = |var: VarId| assigned.get(&var).is_some_and(|when| *when > at);
    value.mentions(changed) || (reads_shared(value) && changed(VarId::MEMORY))
}

/// Variables that a statement assigns to.
fn assignments(stmt: &Stmt<'_>, out: &mut FxHashSet<VarId>) {
    if let StmtKind::Assign(place, ..) = &stmt.kind {
        place.visit(&mut |expr| {
            if let Op::Var(var) = expr.op {
                out.insert(var);
            }
        });
    }
    if let StmtKind::Effect(effect) = &stmt.kind {
        out.extend(effect.before);
    }
    if matches!(&stmt.kind, StmtKind::Effect(effect) if matches!(effect.memory, Memory::Shared(_)))
        || matches!(stmt.kind, StmtKind::Barrier { .. })
    {
        out.insert(VarId::MEMORY);
    }
    for block in stmt.blocks() {
        block.iter().for_each(|stmt| assignments(stmt, out));
    }
}
