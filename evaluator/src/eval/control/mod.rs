//! Conditions under which code is reached: branches, and early exits from blocks, loops and functions.

mod blocks;
mod branches;
mod departures;
mod states;

use super::Evaluator;
use super::value::Eval;
use crate::ir::NodeId;

pub use departures::{EarlyExit, Side, Tail};

/// Conditions of the code being evaluated.
#[derive(Default)]
pub struct ControlState {
    /// Early exits from the enclosing blocks, first to last.
    early_exits: Vec<EarlyExit>,
    /// Conditions under which the current place is reached, each with its required value: those of the selected sides
    /// of branches, and those of exits taken before the enclosing branches and loops.
    path_conditions: Vec<(NodeId, bool)>,
    /// `true` inside a phase of a workgroup.
    pub in_phase: bool,
    /// Runtime conditions of the enclosing branches, with the number of calls around each.
    branch_conditions: Vec<(usize, NodeId)>,
}

/// Early exits at a point that evaluation may return to.
#[derive(Clone)]
pub struct ControlMark(Vec<EarlyExit>);

impl ControlState {
    /// Number of early exits so far. Those from this position on are later ones.
    pub fn exit_count(&self) -> usize {
        self.early_exits.len()
    }

    /// Conditions of the early exits since a position.
    pub fn exits_since(&self, since: usize) -> Vec<NodeId> {
        self.early_exits[since..].iter().map(|exit| exit.condition).collect()
    }

    /// Adds an early exit after all others.
    pub fn push_exit(&mut self, exit: EarlyExit) {
        self.early_exits.push(exit);
    }

    /// Takes the last early exit.
    pub fn pop_exit(&mut self) -> Option<EarlyExit> {
        self.early_exits.pop()
    }

    /// Captures the early exits.
    pub fn mark(&self) -> ControlMark {
        ControlMark(self.early_exits.clone())
    }

    /// Restores the early exits.
    pub fn return_to(&mut self, mark: ControlMark) {
        self.early_exits = mark.0;
    }
}

impl Evaluator<'_> {
    /// Evaluates code whose effects happen only if each of `conditions` has the stated value and no early exit was taken.
    pub fn eval_under<T>(&mut self, conditions: &[(NodeId, bool)], evaluate: impl FnOnce(&mut Self) -> T) -> T {
        let mark = self.control.path_conditions.len();
        self.control.path_conditions.extend(conditions);
        let outcome = evaluate(self);
        self.control.path_conditions.truncate(mark);
        outcome
    }

    /// Evaluates a called function without pending exits, under the condition that none of the current ones was taken.
    pub fn eval_without_exits<T>(&mut self, evaluate: impl FnOnce(&mut Self) -> T) -> T {
        let pending = self.take_exits();
        let outcome = self.eval_under(&none_taken(&pending), evaluate);
        self.control.early_exits = pending;
        outcome
    }

    /// Evaluates a branch or loop, under the condition that none of the pending exits was taken. Its own exits follow them.
    pub fn eval_nested<T>(&mut self, evaluate: impl FnOnce(&mut Self) -> Eval<T>) -> Eval<T> {
        let before = self.scope.clone();
        let pending = self.take_exits();
        let outcome = self.eval_under(&none_taken(&pending), evaluate);
        if matches!(&outcome, Err(exit) if exit.is_failure()) {
            // Values created inside must not be used outside.
            self.scope = before;
            self.control.early_exits.clear();
        }
        self.control.early_exits.splice(0..0, pending);
        outcome
    }

    /// Condition under which the code being evaluated is reached, as far as regions do not imply it.
    pub fn reach_condition(&mut self) -> NodeId {
        let mut conditions = self.control.path_conditions.clone();
        conditions.extend(none_taken(&self.control.early_exits));
        let mut all = self.builder.bool(true);
        for (condition, holds) in conditions {
            let holds = if holds { condition } else { self.not(condition) };
            all = self.and(all, holds);
        }
        all
    }

    /// Returns the runtime conditions that control evaluation inside the outermost call of a function.
    pub fn decides_within(&self, function: &str) -> Vec<NodeId> {
        let around = self.report.calls_around(function);
        let inside = self
            .control
            .branch_conditions
            .iter()
            .filter(|(calls, _)| *calls > around);
        inside.map(|(_, condition)| *condition).collect()
    }

    /// Takes all early exits.
    pub fn take_exits(&mut self) -> Vec<EarlyExit> {
        std::mem::take(&mut self.control.early_exits)
    }
}

/// The conditions that none of some exits was taken.
fn none_taken(exits: &[EarlyExit]) -> Vec<(NodeId, bool)> {
    exits.iter().map(|exit| (exit.condition, false)).collect()
}
