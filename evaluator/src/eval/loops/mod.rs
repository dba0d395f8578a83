//! Loops: which are unrolled, which are left in the shader, and why.

mod budget;
mod causes;
mod demand;
mod for_loops;
mod kept;
mod partial;
mod points;
mod while_loops;

use crate::diagnostic::{Diagnostic, Span};
use crate::ir::{Counter, Graph, NodeId};
use budget::LoopTracker;
use demand::StructuredLoops;
use rustc_hash::FxHashSet;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

pub use budget::{BUDGET_HELP, LoopReport, name_largest_loops};
pub use demand::UnrollReason;
pub use for_loops::LoopBody;
pub use points::RestartPoints;

/// Loops unrolled regardless of the policy, because a constant is needed that they assign.
pub type ForcedUnrolls = HashMap<Span, UnrollReason>;

/// The loops of a kernel, and where evaluation is among them.
#[derive(Default)]
pub struct LoopState {
    tracker: LoopTracker,
    structured: StructuredLoops,
    forced: ForcedUnrolls,
    /// Statements that may leave an unrollable loop in the shader.
    statements: FxHashSet<Span>,
    /// Number of times evaluation has returned to a loop.
    restarts: usize,
    /// `true` if every loop that can be unrolled is unrolled.
    unrolls_all: bool,
    /// Counters of the enclosing unrolled loops, outermost first.
    counters: Arc<[Counter]>,
    /// Number of enclosing loops left in the shader.
    depth: u32,
}

/// Loops at a point that evaluation may return to.
#[derive(Clone)]
pub struct LoopMark {
    tracker: LoopTracker,
    counters: Arc<[Counter]>,
    depth: u32,
    /// Number of loops left in the shader.
    kept: usize,
}

impl LoopState {
    /// Loops of a kernel in which only `statements` may leave an unrollable loop in the shader.
    pub fn new(statements: FxHashSet<Span>, forced: ForcedUnrolls) -> LoopState {
        LoopState {
            statements,
            forced,
            ..LoopState::default()
        }
    }

    /// Loops that another evaluation of the kernel has to unroll.
    pub fn into_forced(self) -> ForcedUnrolls {
        self.forced
    }

    /// Counters of the enclosing unrolled loops, outermost first.
    pub fn counters(&self) -> &Arc<[Counter]> {
        &self.counters
    }

    /// Returns whether the code being evaluated belongs to a loop left in the shader.
    pub fn is_inside_kept(&self) -> bool {
        self.depth > 0
    }

    /// Loops that could be unrolled and that `nodes` depend on.
    pub fn loops_feeding(&self, graph: &Graph, nodes: &[NodeId]) -> BTreeSet<Span> {
        self.structured.loops_feeding(graph, nodes)
    }

    /// All loops in source order.
    pub fn sorted_reports(&self) -> Vec<LoopReport> {
        self.tracker.sorted_reports()
    }

    /// Takes the errors to report if there are no others.
    pub fn take_deferred(&mut self) -> Vec<Diagnostic> {
        self.tracker.take_deferred()
    }

    /// Adds the contribution of each of the five largest loops to an error.
    pub fn name_largest(&self, error: Diagnostic) -> Diagnostic {
        self.tracker.name_largest(error)
    }

    /// Captures the loops at this point.
    pub fn mark(&self) -> LoopMark {
        LoopMark {
            tracker: self.tracker.clone(),
            counters: Arc::clone(&self.counters),
            depth: self.depth,
            kept: self.structured.len(),
        }
    }

    /// Restores an earlier state. What was learnt about loops that cannot stay in the shader is kept.
    pub fn return_to(&mut self, mark: LoopMark) {
        self.tracker.return_to(mark.tracker);
        self.structured.truncate(mark.kept);
        self.counters = mark.counters;
        self.depth = mark.depth;
    }
}
