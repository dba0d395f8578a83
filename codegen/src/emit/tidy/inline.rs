//! A value that is used once is written where it is used, while the line stays short.

use super::columns::Columns;
use super::{dead, simplify};
use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, VarId};
use crate::emit::text::WIDEST;
use rustc_hash::{FxHashMap, FxHashSet};
use straightline_evaluator::ir::{Graph, Memory};
use straightline_evaluator::policy::ReadOrder;

/// Operators and calls that a line may have, lest it be hard to read; shader compilers also recurse over them.
const MOST: usize = 16;

/// Inlines values that are used once, but for reads whose order is not the source's; gives whether there were some.
pub fn inline(module: &mut Module<'_>, graph: &Graph, reads: ReadOrder) -> bool {
    let uses = dead::uses(module);
    let mut body = std::mem::take(&mut module.body);
    let mut inliner = Inliner {
        uses,
        keeps_reads: reads == ReadOrder::Rows,
        columns: Columns { module, graph },
    };
    let inlined = inliner.block(&mut body, 1);
    module.body = body;
    inlined
}

struct Inliner<'m> {
    uses: Vec<u32>,
    keeps_reads: bool,
    columns: Columns<'m>,
}

/// A value that may be written where it is used.
#[derive(Clone, Copy)]
struct Candidate {
    /// Which statement makes it.
    at: usize,
    /// How wide it is.
    columns: usize,
    /// Operators and calls in it.
    operations: usize,
}

impl Inliner<'_> {
    fn block(&mut self, block: &mut Block<'_>, depth: usize) -> bool {
        let mut inlined = false;
        let mut out: Vec<Option<Stmt<'_>>> = Vec::with_capacity(block.len());
        // The candidates, and when each mutable variable was last assigned.
        let mut defined: FxHashMap<VarId, Candidate> = FxHashMap::default();
        let mut assigned: FxHashMap<VarId, usize> = FxHashMap::default();
        for mut stmt in block.drain(..) {
            self.absorb(&mut stmt, &mut out, &defined, &assigned, depth);
            for inner in stmt.blocks_mut() {
                inlined |= self.block(inner, depth + 1);
            }
            let at = out.len();
            assignments(&stmt, &mut |var| _ = assigned.insert(var, at));
            if let StmtKind::Let(var, value) = &stmt.kind
                && !(self.keeps_reads && reads_memory(value))
                && !matches!(value.op, Op::Exact { .. })
            {
                let candidate = Candidate {
                    at,
                    columns: self.columns.of(value),
                    operations: value.operations(),
                };
                defined.insert(*var, candidate);
            }
            out.push(Some(stmt));
        }
        inlined |= out.iter().any(Option::is_none);
        block.extend(out.into_iter().flatten());
        inlined
    }

    /// Writes values of earlier statements into a statement, short ones first.
    fn absorb<'g>(
        &mut self,
        stmt: &mut Stmt<'g>,
        out: &mut [Option<Stmt<'g>>],
        defined: &FxHashMap<VarId, Candidate>,
        assigned: &FxHashMap<VarId, usize>,
        depth: usize,
    ) {
        // The end of a loop is computed again for each iteration: what it reads must not change, and be quick to tell.
        let mut written = FxHashSet::default();
        let is_loop = matches!(stmt.kind, StmtKind::For { .. });
        if is_loop {
            assignments(stmt, &mut |var| _ = written.insert(var));
        }
        let suits = |value: &Expr, operations: usize| {
            !is_loop || (operations <= 2 && !reads_memory(value) && !value.mentions(|var| written.contains(&var)))
        };
        // Each turn takes one of them.
        for _ in 0..=out.len() {
            let mut candidates = Vec::new();
            for expr in stmt.own() {
                expr.visit(&mut |expr| {
                    if let Op::Var(var) = expr.op
                        && self.uses[var.0 as usize] == 1
                        && let Some(candidate) = defined.get(&var)
                        && let Some(Stmt {
                            kind: StmtKind::Let(_, value),
                            ..
                        }) = &out[candidate.at]
                        && !changed_since(value, candidate.at, assigned)
                        && suits(value, candidate.operations)
                    {
                        candidates.push((candidate.columns, var, *candidate));
                    }
                });
            }
            if candidates.is_empty() {
                return;
            }
            candidates.sort_unstable_by_key(|(columns, var, _)| (*columns, *var));
            let (wide, many) = self.columns.of_stmt(stmt);
            let fits = candidates.into_iter().find(|(columns, var, candidate)| {
                let name = self.columns.module.variables[var.0 as usize].name.len();
                4 * depth + wide + columns - name <= WIDEST && many + candidate.operations <= MOST
            });
            let Some((_, var, Candidate { at, .. })) = fits else {
                return;
            };
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
            let mut reads = FxHashMap::default();
            read(stmt.own().chain([&value]), 1, &mut reads);
            let mut value = Some(value);
            for own in stmt.own_mut() {
                // What has become shorter has room for more.
                own.rewrite_in_place(&mut |expr| match expr.op {
                    Op::Var(found) if found == var => value.take().unwrap_or(expr),
                    _ => simplify(expr),
                });
            }
            read(stmt.own(), -1, &mut reads);
            for (read, lost) in reads {
                let uses = &mut self.uses[read.0 as usize];
                *uses = uses.saturating_add_signed(-lost);
            }
        }
    }
}

/// Adds `weight` for each time that expressions read a variable.
fn read<'e>(exprs: impl Iterator<Item = &'e Expr>, weight: i32, reads: &mut FxHashMap<VarId, i32>) {
    for expr in exprs {
        expr.visit(&mut |expr| {
            if let Op::Var(var) = expr.op {
                *reads.entry(var).or_default() += weight;
            }
        });
    }
}

/// Whether an expression reads what a workgroup shares.
fn reads_shared(expr: &Expr) -> bool {
    let mut reads = false;
    expr.visit(&mut |expr| reads |= matches!(expr.op, Op::Ir(straightline_evaluator::ir::Op::SharedLoad(_))));
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

/// Shows every variable that a statement assigns to.
fn assignments(stmt: &Stmt<'_>, see: &mut dyn FnMut(VarId)) {
    if let StmtKind::Assign(place, ..) = &stmt.kind {
        place.visit(&mut |expr| {
            if let Op::Var(var) = expr.op {
                see(var);
            }
        });
    }
    if let StmtKind::Effect(effect) = &stmt.kind
        && let Some(before) = effect.before
    {
        see(before);
    }
    if matches!(&stmt.kind, StmtKind::Effect(effect) if matches!(effect.memory, Memory::Shared(_)))
        || matches!(stmt.kind, StmtKind::Barrier { .. })
    {
        see(VarId::MEMORY);
    }
    for block in stmt.blocks() {
        block.iter().for_each(|stmt| assignments(stmt, see));
    }
}
