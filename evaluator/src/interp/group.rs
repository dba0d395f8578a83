//! Workgroups: each invocation in its turn, up to the barrier that all of them come to.

use super::{Interpreter, Scratch};
use crate::ir::{NodeId, Op, Real};
use crate::passes::{Block, Step};

impl<R: Real> Interpreter<'_, R> {
    /// Runs the workgroup whose first pixel is given.
    pub(super) fn run_workgroup(&self, origin: [u32; 2], s: &mut Scratch) {
        s.memory.begin_workgroup(origin);
        for thread in &mut s.threads {
            thread.non_finite_origin = None;
        }
        self.run_together(&self.schedule.body, origin, s);
        s.non_finite_origin = s.threads.iter_mut().find_map(|thread| thread.non_finite_origin.take());
    }

    /// Runs a block that all invocations come to.
    fn run_together(&self, block: &Block, origin: [u32; 2], s: &mut Scratch) {
        let mut from = 0;
        for (k, step) in block.steps.iter().enumerate() {
            if !self.has_barrier(step) {
                continue;
            }
            self.one_by_one(&block.steps[from..k], origin, s);
            from = k + 1;
            match step {
                Step::Eval(_) => s.memory.barrier(),
                Step::Loop { node, body } => self.loop_together(*node, body, origin, s),
                Step::If { node, then, otherwise } => {
                    let holds =
                        self.uniform_decision(s, |interpreter, thread| interpreter.condition_holds(*node, thread));
                    self.run_together(if holds { then } else { otherwise }, origin, s);
                    for thread in &mut s.threads {
                        self.leave_branch(*node, holds, thread);
                    }
                }
            }
        }
        self.one_by_one(&block.steps[from..], origin, s);
    }

    fn loop_together(&self, node: NodeId, body: &Block, origin: [u32; 2], s: &mut Scratch) {
        let region = self.graph.region(self.graph.regions_of(node)[0]);
        let mut carried: Vec<_> = s.threads.iter().map(|thread| self.entry_values(node, thread)).collect();
        for counter in self.uniform_decision(s, |interpreter, thread| interpreter.counter_range(node, thread)) {
            for (thread, carried) in s.threads.iter_mut().zip(&mut carried) {
                self.begin_iteration(region, counter, std::mem::take(carried), thread);
            }
            self.run_together(body, origin, s);
            let mut stops = Vec::new();
            for (thread, carried) in s.threads.iter_mut().zip(&mut carried) {
                let stop;
                (*carried, stop) = self.end_iteration(region, thread);
                stops.push(stop);
            }
            if stops.iter().any(|stop| *stop != stops[0]) {
                s.memory.note_divergence();
            }
            if stops[0] {
                break;
            }
        }
        for (thread, carried) in s.threads.iter_mut().zip(carried) {
            thread.arrays[node.0 as usize] = carried.concat();
        }
    }

    /// Evaluates a decision for the first invocation, and checks that all others agree.
    fn uniform_decision<T: PartialEq>(&self, s: &mut Scratch, says: impl Fn(&Self, &Scratch) -> T) -> T {
        let first = says(self, &s.threads[0]);
        if s.threads.iter().any(|thread| says(self, thread) != first) {
            s.memory.note_divergence();
        }
        first
    }

    /// Runs steps for each invocation in its turn.
    fn one_by_one(&self, steps: &[Step], origin: [u32; 2], s: &mut Scratch) {
        if steps.is_empty() {
            return;
        }
        for (number, thread) in (0..).zip(&mut s.threads) {
            s.memory.thread = number;
            std::mem::swap(&mut s.memory, &mut thread.memory);
            let pixel = [0, 1].map(|k| origin[k] + thread.local[k]);
            self.run_steps(steps, pixel, thread);
            std::mem::swap(&mut s.memory, &mut thread.memory);
        }
    }

    /// Returns whether a step contains a barrier.
    fn has_barrier(&self, step: &Step) -> bool {
        let any = |block: &Block| block.steps.iter().any(|step| self.has_barrier(step));
        match step {
            Step::Eval(id) => matches!(self.graph.node(*id).op, Op::Barrier { .. }),
            Step::Loop { body, .. } => any(body),
            Step::If { then, otherwise, .. } => any(then) || any(otherwise),
        }
    }
}
