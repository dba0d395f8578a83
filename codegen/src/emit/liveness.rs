//! Register pressure: live scalars at each statement of a tree.
//!
//! GPU compilers split vectors into scalars, and so does this analysis. A component that only renames another (`vec2(left,
//! pixel.y)`, `a.yx`) shares its register. Constants and uniforms take none. Booleans are bits of masks.

use super::ast::{Expr, Module, Op, Stmt, StmtKind, VarId};
use std::collections::HashSet;
use straightline_evaluator::ir::{self, Origin, Scalar};

/// Returns the maximum number of live scalars of a kernel, and the first place where it occurs.
pub fn most_alive<'g>(module: &Module<'g>) -> (u32, Option<&'g Origin>) {
    let mut walk = Walk::new(module);
    walk.walk_block(&module.body);
    walk.most
}

/// Returns the number of registers for a variable of a type; an array takes one for each number.
pub fn register_count(ty: ir::Type) -> u32 {
    match ty {
        ir::Type::Array { components, len, .. } => u32::from(components).saturating_mul(len),
        _ if ty.scalar_kind() == Some(Scalar::Bool) => 0,
        _ => u32::from(ty.component_count()),
    }
}

/// A component of a variable: an index into the scalars of all variables.
type Slot = u32;

struct Walk<'g> {
    /// First slot and number of slots of each variable.
    slots: Vec<(Slot, u32)>,
    /// Register width of each slot, and its liveness at the current statement.
    width: Vec<u32>,
    alive: Vec<bool>,
    /// Slot that each slot renames.
    renames: Vec<Option<Renamed>>,
    /// Registers of all live slots.
    sum: u32,
    /// Maximum number of registers, and its place. Statements are visited from last to first.
    most: (u32, Option<&'g Origin>),
}

/// A component that needs no operation.
#[derive(Clone, Copy)]
enum Renamed {
    Constant,
    As(Slot),
}

impl<'g> Walk<'g> {
    fn new(module: &Module<'g>) -> Walk<'g> {
        let mut walk = Walk {
            slots: Vec::with_capacity(module.variables.len()),
            width: Vec::new(),
            alive: Vec::new(),
            renames: Vec::new(),
            sum: 0,
            most: (0, None),
        };
        for variable in &module.variables {
            let ty = variable.ty.shape;
            let scalars = if ty.is_array() {
                1
            } else {
                u32::from(ty.component_count())
            };
            walk.slots.push((walk.width.len() as Slot, scalars));
            let each = if ty.is_array() {
                register_count(ty)
            } else {
                register_count(ty) / scalars.max(1)
            };
            walk.width.extend((0..scalars).map(|_| each));
        }
        // A table is in memory, not in registers.
        for (var, _) in &module.tables {
            let (first, count) = walk.slots[var.0 as usize];
            (first..first + count).for_each(|slot| walk.width[slot as usize] = 0);
        }
        walk.alive = vec![false; walk.width.len()];
        walk.renames = vec![None; walk.width.len()];
        let mut changes = vec![false; module.variables.len()];
        find_changes(&module.body, &mut changes);
        walk.find_renames(&module.body, &changes);
        walk
    }

    fn find_renames(&mut self, block: &[Stmt<'_>], changes: &[bool]) {
        for stmt in block {
            if let StmtKind::Let(var, value) = &stmt.kind
                && !value.ty.is_array()
            {
                let (first, count) = self.slots[var.0 as usize];
                for k in 0..count {
                    self.renames[(first + k) as usize] = self.renamed_component(value, k, changes);
                }
            }
            let blocks = stmt.blocks().into_iter();
            blocks.for_each(|inner| self.find_renames(inner, changes));
        }
    }

    /// Returns the component that component `k` of an expression renames, if it needs no operation.
    fn renamed_component(&self, value: &Expr, k: u32, changes: &[bool]) -> Option<Renamed> {
        match &value.op {
            Op::Ir(ir::Op::Const(_) | ir::Op::Uniform(_) | ir::Op::Override(_)) => Some(Renamed::Constant),
            Op::Var(var) if !value.ty.is_array() && !changes[var.0 as usize] => {
                let slot = self.slots[var.0 as usize].0 + k;
                Some(self.renames[slot as usize].unwrap_or(Renamed::As(slot)))
            }
            Op::Swizzle(of) => self.renamed_component(&value.args[0], u32::from(of[k as usize]), changes),
            Op::Construct if value.args.len() == 1 => self.renamed_component(&value.args[0], 0, changes),
            Op::Construct => {
                let mut before = 0;
                let part = value.args.iter().find(|part| {
                    before += u32::from(part.ty.component_count());
                    k < before
                })?;
                self.renamed_component(part, k + u32::from(part.ty.component_count()) - before, changes)
            }
            _ => None,
        }
    }

    /// Visits statements from last to first, updating the live slots.
    fn walk_block(&mut self, block: &[Stmt<'g>]) {
        for stmt in block.iter().rev() {
            self.walk_statement(stmt);
        }
    }

    fn walk_statement(&mut self, stmt: &Stmt<'g>) {
        self.record_pressure(self.sum, stmt.source.origin);
        match &stmt.kind {
            StmtKind::Let(var, value) => {
                // A value that is never read still needs a register when it is written.
                self.record_pressure(self.registers_after_write(*var), stmt.source.origin);
                self.kill(*var);
                if self.is_computed(*var) {
                    self.read_expr(value);
                }
            }
            StmtKind::Var(var, value) => {
                self.kill(*var);
                value.iter().for_each(|value| self.read_expr(value));
            }
            StmtKind::Assign(place, op, value) => {
                match (&place.op, op) {
                    (Op::Var(var), None) => self.kill(*var),
                    _ => self.read_expr(place),
                }
                self.read_expr(value);
            }
            StmtKind::If {
                condition,
                then,
                otherwise,
            } => {
                let behind = (self.alive.clone(), self.sum);
                self.walk_block(otherwise);
                let other = std::mem::replace(&mut self.alive, behind.0);
                self.sum = behind.1;
                self.walk_block(then);
                let of_other = (0..other.len()).filter(|slot| other[*slot]);
                of_other.for_each(|slot| self.wake(slot));
                self.read_expr(condition);
            }
            StmtKind::For { body, .. } | StmtKind::Loop(body) => {
                // Values that the next iteration may read are live throughout the loop.
                let outside = mentioned_of_outside(stmt);
                outside.iter().for_each(|var| self.wake_all(*var));
                self.walk_block(body);
                outside.iter().for_each(|var| self.wake_all(*var));
                if let StmtKind::For { counter, .. } = &stmt.kind {
                    self.kill(*counter);
                }
                stmt.own_exprs().for_each(|value| self.read_expr(value));
            }
            StmtKind::Effect(effect) => {
                effect.before.iter().for_each(|var| self.kill(*var));
                stmt.own_exprs().for_each(|value| self.read_expr(value));
            }
            _ => stmt.own_exprs().for_each(|value| self.read_expr(value)),
        }
        self.record_pressure(self.sum, stmt.source.origin);
    }

    fn record_pressure(&mut self, alive: u32, origin: Option<&'g Origin>) {
        if alive > self.most.0 || (alive == self.most.0 && origin.is_some()) {
            self.most = (alive, origin);
        }
    }

    /// Returns whether some component of a variable needs an operation.
    fn is_computed(&self, var: VarId) -> bool {
        let (first, count) = self.slots[var.0 as usize];
        (first..first + count).any(|slot| self.renames[slot as usize].is_none())
    }

    /// Returns the number of registers in use once a variable is written, including its components that are never read.
    fn registers_after_write(&self, var: VarId) -> u32 {
        let (first, count) = self.slots[var.0 as usize];
        let is_new = |slot: &Slot| !self.alive[*slot as usize] && self.renames[*slot as usize].is_none();
        self.sum
            + (first..first + count)
                .filter(is_new)
                .map(|slot| self.width[slot as usize])
                .sum::<u32>()
    }

    fn kill(&mut self, var: VarId) {
        let (first, count) = self.slots[var.0 as usize];
        for slot in first..first + count {
            if std::mem::take(&mut self.alive[slot as usize]) {
                self.sum -= self.width[slot as usize];
            }
        }
    }

    fn wake(&mut self, slot: usize) {
        if !std::mem::replace(&mut self.alive[slot], true) {
            self.sum += self.width[slot];
        }
    }

    fn wake_all(&mut self, var: VarId) {
        let (first, count) = self.slots[var.0 as usize];
        (first..first + count).for_each(|slot| self.wake_renamed(slot));
    }

    fn wake_renamed(&mut self, slot: Slot) {
        match self.renames[slot as usize] {
            Some(Renamed::Constant) => {}
            Some(Renamed::As(of)) => self.wake(of as usize),
            None => self.wake(slot as usize),
        }
    }

    /// Marks the variables of an expression as live before it.
    fn read_expr(&mut self, value: &Expr) {
        match &value.op {
            Op::Var(var) => self.wake_all(*var),
            Op::Swizzle(of) if matches!(value.args[0].op, Op::Var(_)) => {
                if let Op::Var(var) = value.args[0].op {
                    let first = self.slots[var.0 as usize].0;
                    of.iter().for_each(|k| self.wake_renamed(first + u32::from(*k)));
                }
            }
            _ => value.args.iter().for_each(|arg| self.read_expr(arg)),
        }
    }
}

/// Records the variables that are assigned after their declaration.
fn find_changes(block: &[Stmt<'_>], changes: &mut [bool]) {
    for stmt in block {
        match &stmt.kind {
            StmtKind::Var(var, _) | StmtKind::For { counter: var, .. } => changes[var.0 as usize] = true,
            StmtKind::Effect(effect) => effect.before.iter().for_each(|var| changes[var.0 as usize] = true),
            _ => {}
        }
        stmt.blocks().into_iter().for_each(|inner| find_changes(inner, changes));
    }
}

/// Returns the variables of a loop's body that are declared outside of it.
fn mentioned_of_outside(stmt: &Stmt<'_>) -> Vec<VarId> {
    let mut declared = HashSet::new();
    collect_declared(stmt, &mut declared);
    let mut found = Vec::new();
    stmt.visit(&mut |expr| {
        if let Op::Var(var) = expr.op
            && declared.insert(var)
        {
            found.push(var);
        }
    });
    found
}

fn collect_declared(stmt: &Stmt<'_>, out: &mut HashSet<VarId>) {
    match &stmt.kind {
        StmtKind::Let(var, _) | StmtKind::Var(var, _) => _ = out.insert(*var),
        StmtKind::For { counter, .. } => _ = out.insert(*counter),
        _ => {}
    }
    for block in stmt.blocks() {
        block.iter().for_each(|stmt| collect_declared(stmt, out));
    }
}
