//! Steps in their order: loops and branches.

use super::{Interpreter, MOST_ITERATIONS, Scratch, load_cells, store_cells};
use crate::ir::arith::Cells;
use crate::ir::{NodeId, Real, Region, Type};
use crate::passes::{Block, Schedule, Step};

impl<R: Real> Interpreter<'_, R> {
    pub(super) fn run_block(&self, block: &Block, pixel: [u32; 2], s: &mut Scratch) {
        self.run_steps(&block.steps, pixel, s);
    }

    pub(super) fn run_steps(&self, steps: &[Step], pixel: [u32; 2], s: &mut Scratch) {
        for step in steps {
            match step {
                Step::Eval(id) => self.eval(*id, pixel, s),
                Step::Loop { node, body } => self.run_loop(*node, body, pixel, s),
                Step::If { node, then, otherwise } => {
                    let holds = self.condition_holds(*node, s);
                    self.run_block(if holds { then } else { otherwise }, pixel, s);
                    self.leave_branch(*node, holds, s);
                }
            }
        }
    }

    /// Returns whether the condition of a branch holds.
    pub(super) fn condition_holds(&self, node: NodeId, s: &Scratch) -> bool {
        s.values[self.graph.node(node).args[0].0 as usize][0] != 0
    }

    /// Gives a branch what the side gave that was run.
    pub(super) fn leave_branch(&self, node: NodeId, holds: bool, s: &mut Scratch) {
        let region = self.graph.regions_of(node)[usize::from(!holds)];
        let results = &self.graph.region(region).results;
        s.arrays[node.0 as usize] = results.iter().flat_map(|r| load_cells(self.graph, s, *r)).collect();
    }

    /// The first counter of a loop and its end.
    pub(super) fn counter_range(&self, node: NodeId, s: &Scratch) -> std::ops::Range<i64> {
        let args = &self.graph.node(node).args;
        let signed = self.graph.ty(args[0]) == Type::I32;
        let [start, end] = [args[0], args[1]].map(|id| {
            let bits = s.values[id.0 as usize][0] as u32;
            if signed {
                i64::from(bits as i32)
            } else {
                i64::from(bits)
            }
        });
        start..end
    }

    /// Returns the values that a loop carries into its first iteration.
    pub(super) fn entry_values(&self, node: NodeId, s: &Scratch) -> Vec<Vec<Cells>> {
        let args = &self.graph.node(node).args;
        args[2..].iter().map(|a| load_cells(self.graph, s, *a)).collect()
    }

    /// Gives the parameters of a loop's body their values.
    pub(super) fn begin_iteration(&self, region: &Region, counter: i64, carried: Vec<Vec<Cells>>, s: &mut Scratch) {
        s.values[region.params[0].0 as usize] = [u64::from(counter as u32), 0, 0, 0];
        s.loops.push((region.params[0], counter));
        for (param, value) in region.params[1..].iter().zip(carried) {
            store_cells(self.graph, s, *param, value);
        }
    }

    /// Returns the values that a loop carries into its next iteration, and whether this iteration was the last one.
    pub(super) fn end_iteration(&self, region: &Region, s: &mut Scratch) -> (Vec<Vec<Cells>>, bool) {
        s.loops.pop();
        let stops = region.stop.is_some_and(|stop| s.values[stop.0 as usize][0] != 0);
        s.iterations += 1;
        let ended = s.iterations > MOST_ITERATIONS;
        (self.exit_values(region, s), stops || ended)
    }

    fn run_loop(&self, node: NodeId, body: &Block, pixel: [u32; 2], s: &mut Scratch) {
        let region = self.graph.region(self.graph.regions_of(node)[0]);
        let mut carried = self.entry_values(node, s);
        for counter in self.counter_range(node, s) {
            self.begin_iteration(region, counter, carried, s);
            self.run_block(body, pixel, s);
            let stops;
            (carried, stops) = self.end_iteration(region, s);
            if stops {
                break;
            }
        }
        s.arrays[node.0 as usize] = carried.concat();
    }

    /// Returns whether a value's only user is `user`, which is evaluated once each time that the value is.
    pub(super) fn is_last_use(&self, id: NodeId, user: NodeId) -> bool {
        let Schedule { uses, place, .. } = self.schedule;
        uses[id.0 as usize] == 1 && place[id.0 as usize] == place[user.0 as usize]
    }

    /// Returns the values that leave a loop's body. An array that is made in each iteration, and leaves once, is moved.
    fn exit_values(&self, region: &Region, s: &mut Scratch) -> Vec<Vec<Cells>> {
        let here = self.schedule.place[region.params[0].0 as usize];
        let mut values = Vec::new();
        for result in &region.results {
            let slot = result.0 as usize;
            let moves = self.graph.ty(*result).is_array()
                && self.schedule.place[slot] == here
                && here.is_some()
                && region.results.iter().filter(|r| *r == result).count() == 1;
            values.push(match moves {
                true => std::mem::take(&mut s.arrays[slot]),
                false => load_cells(self.graph, s, *result),
            });
        }
        values
    }
}
