//! Inlines a value that is used once at its use, while the line stays short.

use super::columns::Columns;
use super::{dead, simplify_expr};
use crate::emit::ast::{Block, Expr, Module, Op, Stmt, StmtKind, VarId};
use crate::emit::liveness::register_count;
use crate::emit::text::WIDEST;
use rustc_hash::{FxHashMap, FxHashSet};
use straightline_evaluator::ir::{Graph, Memory};

/// Maximum number of operators and calls in a line, for readability and because shader compilers recurse over them.
const MOST: usize = 16;

/// Kinds of values that are not inlined.
#[derive(Clone, Copy)]
pub struct Stays {
    /// Reads of textures and buffers, if their order is not the source's.
    pub reads: bool,
    /// Values whose later computation would increase the number of live scalars.
    pub crowding: bool,
}

/// Inlines values that are used once, except those that stay; returns whether there were any.
pub fn inline_values(module: &mut Module<'_>, graph: &Graph, stays: Stays) -> bool {
    let uses = dead::count_reads(module);
    let mut body = std::mem::take(&mut module.body);
    let mut inliner = Inliner {
        left: uses.clone(),
        uses,
        stays,
        columns: Columns { module, graph },
    };
    let inlined = inliner.inline_block(&mut body, 1);
    module.body = body;
    inlined
}

struct Inliner<'m> {
    uses: Vec<u32>,
    /// Number of reads of each variable in the statements not yet visited.
    left: Vec<u32>,
    stays: Stays,
    columns: Columns<'m>,
}

/// A value that may be inlined.
#[derive(Clone, Copy)]
struct Candidate {
    /// Index of the statement that computes the value.
    at: usize,
    /// Width in columns.
    columns: usize,
    /// Number of operators and calls.
    operations: usize,
}

/// Facts about the visited statements of a block.
#[derive(Default)]
struct Seen {
    /// Values that may be inlined.
    defined: FxHashMap<VarId, Candidate>,
    /// Index of the statement that last assigned each mutable variable.
    assigned: FxHashMap<VarId, usize>,
    /// Index of the statement that last read each variable of the block, including its declaration.
    read: FxHashMap<VarId, usize>,
}

impl Inliner<'_> {
    fn inline_block(&mut self, block: &mut Block<'_>, depth: usize) -> bool {
        let mut inlined = false;
        let mut out: Vec<Option<Stmt<'_>>> = Vec::with_capacity(block.len());
        let mut seen = Seen::default();
        for mut stmt in block.drain(..) {
            let at = out.len();
            visit_reads(dead::read_by(&stmt), 1, &mut |var, times| {
                self.left[var.0 as usize] -= times as u32
            });
            self.absorb(&mut stmt, &mut out, &seen, depth);
            for inner in stmt.blocks_mut() {
                inlined |= self.inline_block(inner, depth + 1);
            }
            visit_assignments(&stmt, &mut |var| _ = seen.assigned.insert(var, at));
            stmt.visit(&mut |expr| {
                if let Op::Var(var) = expr.op
                    && let Some(last) = seen.read.get_mut(&var)
                {
                    *last = at;
                }
            });
            if let StmtKind::Let(var, _) | StmtKind::Var(var, _) = &stmt.kind {
                seen.read.insert(*var, at);
            }
            if let StmtKind::Let(var, value) = &stmt.kind
                && !(self.stays.reads && reads_memory(value))
                && !matches!(value.op, Op::Exact { .. })
            {
                let candidate = Candidate {
                    at,
                    columns: self.columns.expr_columns(value),
                    operations: value.operation_count(),
                };
                seen.defined.insert(*var, candidate);
            }
            out.push(Some(stmt));
        }
        inlined |= out.iter().any(Option::is_none);
        block.extend(out.into_iter().flatten());
        inlined
    }

    /// Returns whether computing a value in a later statement would keep more scalars alive: its operands then live until
    /// there, instead of the value.
    fn is_crowding(&self, value: &Expr, at: usize, stmt: &Stmt<'_>, out: &[Option<Stmt<'_>>], seen: &Seen) -> bool {
        let is_last = |at: usize| out[at + 1..].iter().all(Option::is_none);
        if is_last(at) {
            return false;
        }
        let mut longer: Vec<VarId> = Vec::new();
        value.visit(&mut |expr| {
            if let Op::Var(var) = expr.op
                && self.left[var.0 as usize] == 0
                && seen.read.get(&var).is_some_and(|last| !is_last(*last))
                && !longer.contains(&var)
                && !stmt.own_exprs().any(|own| own.mentions(|other| other == var))
            {
                longer.push(var);
            }
        });
        let more: u32 = longer
            .iter()
            .map(|var| register_count(self.columns.module.variable_type(*var).shape))
            .sum();
        more > register_count(value.ty.shape)
    }

    /// Inlines values of earlier statements into a statement, short ones first.
    fn absorb<'g>(&mut self, stmt: &mut Stmt<'g>, out: &mut [Option<Stmt<'g>>], seen: &Seen, depth: usize) {
        // The end of a loop is computed again for each iteration, so its operands must not change, and it must be cheap.
        let mut written = FxHashSet::default();
        let is_loop = matches!(stmt.kind, StmtKind::For { .. });
        if is_loop {
            visit_assignments(stmt, &mut |var| _ = written.insert(var));
        }
        let suits = |value: &Expr, operations: usize| {
            !is_loop || (operations <= 2 && !reads_memory(value) && !value.mentions(|var| written.contains(&var)))
        };
        // Each iteration inlines one value.
        for _ in 0..=out.len() {
            let mut candidates = Vec::new();
            for expr in stmt.own_exprs() {
                expr.visit(&mut |expr| {
                    if let Op::Var(var) = expr.op
                        && self.uses[var.0 as usize] == 1
                        && let Some(candidate) = seen.defined.get(&var)
                        && let Some(Stmt {
                            kind: StmtKind::Let(_, value),
                            ..
                        }) = &out[candidate.at]
                        && !changed_since(value, candidate.at, &seen.assigned)
                        && suits(value, candidate.operations)
                        && !(self.stays.crowding && self.is_crowding(value, candidate.at, stmt, out, seen))
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
                source,
            }) = out[at].take()
            else {
                return;
            };
            if stmt.source.origin.is_none() && !matches!(stmt.kind, StmtKind::For { .. } | StmtKind::If { .. }) {
                stmt.source.origin = source.origin;
            }
            let mut reads: FxHashMap<VarId, i32> = FxHashMap::default();
            let mut note = |var, times| *reads.entry(var).or_default() += times;
            visit_reads(stmt.own_exprs().chain([&value]), 1, &mut note);
            let mut value = Some(value);
            for own in stmt.own_mut() {
                // A shorter expression has room for more values.
                own.rewrite_in_place(&mut |expr| match expr.op {
                    Op::Var(found) if found == var => value.take().unwrap_or(expr),
                    _ => simplify_expr(expr),
                });
            }
            visit_reads(stmt.own_exprs(), -1, &mut note);
            for (read, lost) in reads {
                let uses = &mut self.uses[read.0 as usize];
                *uses = uses.saturating_add_signed(-lost);
            }
        }
    }
}

/// Visits each variable that expressions read, with `weight` each time.
fn visit_reads<'e>(exprs: impl Iterator<Item = &'e Expr>, weight: i32, see: &mut dyn FnMut(VarId, i32)) {
    for expr in exprs {
        expr.visit(&mut |expr| {
            if let Op::Var(var) = expr.op {
                see(var, weight);
            }
        });
    }
}

/// Returns whether an expression reads workgroup memory.
fn reads_shared(expr: &Expr) -> bool {
    let mut reads = false;
    expr.visit(&mut |expr| reads |= matches!(expr.op, Op::Ir(straightline_evaluator::ir::Op::SharedLoad(_))));
    reads
}

/// Returns whether an expression reads an array or a resource.
fn reads_memory(expr: &Expr) -> bool {
    let mut reads = false;
    expr.visit(&mut |expr| {
        reads |= match &expr.op {
            Op::Index { .. } => true,
            Op::Ir(op) => op.is_read() || op.is_removable_effect(),
            _ => false,
        };
    });
    reads
}

/// Returns whether a variable that a value reads was assigned after a statement.
fn changed_since(value: &Expr, at: usize, assigned: &FxHashMap<VarId, usize>) -> bool {
    let changed = |var: VarId| assigned.get(&var).is_some_and(|when| *when > at);
    value.mentions(changed) || (reads_shared(value) && changed(VarId::MEMORY))
}

/// Visits every variable that a statement assigns.
fn visit_assignments(stmt: &Stmt<'_>, see: &mut dyn FnMut(VarId)) {
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
        block.iter().for_each(|stmt| visit_assignments(stmt, see));
    }
}
