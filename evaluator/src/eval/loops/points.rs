//! Restart points: going back to a loop left in the shader, to unroll it.
//!
//! A demand for a constant propagates outwards to the block with the statement that contains the loops in question. That
//! block restores its state before the statement and continues with the loops unrolled. A loop that was unrolled because of
//! a constant is never left in the shader again, so evaluation goes back at most once for each.
//!
//! A kernel with many demands would be re-evaluated from its first loops on for each of them. After `AT_ONCE` restarts, a
//! block is therefore evaluated to its end, so that all its demands are met at once.

use crate::diagnostic::Span;
use crate::eval::Evaluator;
use crate::eval::checkpoint::Checkpoint;
use crate::eval::value::{ConstantDemand, Eval, Exit};
use crate::front::scan_effects;
use crate::front::tree::{Block, Statement};
use std::collections::BTreeSet;

/// Number of restarts that happen as soon as a constant is needed.
const AT_ONCE: usize = 4;

/// Restart points of a block, and demands deferred to the end of the block.
#[derive(Default)]
pub struct RestartPoints {
    points: Vec<RestartPoint>,
    deferred: Vec<ConstantDemand>,
}

/// A statement that evaluation may go back to.
struct RestartPoint {
    /// Position of the statement in its block; for the block's value, the number of statements.
    statement: usize,
    /// State before it.
    before: Checkpoint,
}

impl Evaluator<'_> {
    /// Adds a restart point if the statement may leave a loop in the shader.
    pub fn add_restart_point(&mut self, points: &mut RestartPoints, statement: usize, span: Span) {
        let points = &mut points.points;
        if points
            .last()
            .is_some_and(|last| !self.loops.structured.has_unrollable_since(last.before.loops.kept))
        {
            points.pop();
        }
        if self.loops.statements.contains(&span) && !self.loops.unrolls_all {
            let before = self.take_checkpoint();
            points.push(RestartPoint { statement, before });
        }
    }

    /// Defers the demands of a statement to the end of the block, so that those of later statements are found too.
    ///
    /// # Errors
    ///
    /// The demands themselves, if evaluation goes back for them at once.
    pub fn defer_demands(
        &mut self,
        needs: Vec<ConstantDemand>,
        statement: &Statement,
        points: &mut RestartPoints,
    ) -> Eval<()> {
        if self.loops.restarts < AT_ONCE {
            return Err(Exit::Demand(needs));
        }
        points.deferred.extend(needs);
        let alone = Block {
            statements: vec![statement.clone()],
            value: None,
            exact: false,
        };
        // Values that the statement would have replaced must not cause further demands.
        for name in scan_effects(&alone, &self.library.mutating).assigned {
            if let Some(slot) = self.scope.find_slot(&name) {
                let value = self.scope.name_and_value(slot).1.clone();
                let blank = self.undef_like(&value);
                self.scope.set_value(slot, blank);
            }
        }
        Ok(())
    }

    /// Returns the outcome of a block, together with its deferred demands.
    pub fn with_deferred(&self, outcome: Eval, points: &mut RestartPoints) -> Eval {
        let mut needs = std::mem::take(&mut points.deferred);
        match outcome {
            Err(Exit::Demand(last)) => {
                needs.extend(last);
                Err(Exit::Demand(needs))
            }
            _ if !needs.is_empty() && !self.report.is_exhausted() => Err(Exit::Demand(needs)),
            outcome => outcome,
        }
    }

    /// Goes back to the last statement before all demanded loops that were first left in the shader after the first of
    /// `points`. These loops are unrolled from there on. Returns the position of the statement.
    ///
    /// # Errors
    ///
    /// The demands, if there is no such loop.
    pub fn go_back(&mut self, needs: Vec<ConstantDemand>, points: &mut RestartPoints) -> Eval<usize> {
        let points = &mut points.points;
        let begin = points.first().map_or(usize::MAX, |point| point.before.loops.kept);
        let first = |span: &Span| {
            self.loops
                .structured
                .first_position(*span)
                .filter(|first| *first >= begin)
        };
        let here: BTreeSet<Span> = needs.iter().flat_map(|need| &need.loops).copied().collect();
        let here: BTreeSet<Span> = here.into_iter().filter(|span| first(span).is_some()).collect();
        let Some(earliest) = here.iter().filter_map(first).min() else {
            return Err(Exit::Demand(needs));
        };
        points.truncate(points.partition_point(|point| point.before.loops.kept <= earliest));
        let Some(point) = points.pop() else {
            return Err(Exit::Demand(needs));
        };
        self.rewind_to(point.before);
        for need in needs {
            let loops = need.loops.intersection(&here);
            self.unroll_for(loops.copied().collect(), need.error);
        }
        self.loops.restarts += 1;
        Ok(point.statement)
    }

    /// Runs `evaluate`, and restarts it from the beginning for each demand that no nested block met.
    pub fn meeting_demands<T>(&mut self, mut evaluate: impl FnMut(&mut Self) -> Eval<T>) -> Eval<T> {
        loop {
            let before = self.take_checkpoint();
            match evaluate(self) {
                Err(Exit::Demand(needs)) => {
                    self.rewind_to(before);
                    for need in needs {
                        self.unroll_for(need.loops, need.error);
                    }
                    self.loops.restarts += 1;
                }
                outcome => return outcome,
            }
        }
    }
}
