//! Lowering of structured loops and branches.

use super::Lowering;
use crate::emit::ast::{Expr, Stmt, StmtKind, VarId};
use straightline_evaluator::ir::{self, Bits, Graph, NodeId, Region};
use straightline_evaluator::passes::Block;

/// Bits of the trip count of a loop without an exclusive end.
const ENDLESS: Bits = [Graph::ENDLESS as u32, 0, 0, 0];

impl<'g> Lowering<'g> {
    pub(super) fn lower_loop(&mut self, node: NodeId, body: &'g Block) {
        let graph = &self.compiled.graph;
        let args = &graph.node(node).args;
        let region = graph.region(graph.regions_of(node)[0]);
        for (param, init) in region.params[1..].iter().zip(&args[2..]) {
            if graph.ty(*param).is_array() {
                self.enter_web(*param, *init);
            } else {
                let value = self.looked_at(*init).then(|| self.node_expr(*init));
                let var = self.new_variable(*param);
                self.emit_statement(*param, StmtKind::Var(var, value));
                self.exprs[param.0 as usize] = Some(self.module.read_variable(var));
            }
        }
        let counter = self.new_variable(region.params[0]);
        let (start, end) = (self.node_expr(args[0]), self.node_expr(args[1]));
        self.exprs[region.params[0].0 as usize] = Some(self.module.read_variable(counter));
        let scope = self.coalescing.current_scope();
        let body = self.nested(|lowering| {
            lowering.steps(body);
            lowering.next_iteration(&region.params[1..], region);
        });
        let counted = self.compiled.schedule.uses[region.params[0].0 as usize] > 0
            || region.stop.is_none()
            || graph.constant_bits(args[1]) != Some(ENDLESS);
        let kind = match counted {
            true => StmtKind::For {
                counter,
                start,
                end,
                body,
            },
            false => StmtKind::Loop(body),
        };
        let source = self.place_of(node);
        self.block.push(Stmt { kind, source });
        self.coalescing.restore_scope(&scope);
        self.bind_results(node, &region.params[1..]);
    }

    /// Returns whether a value is defined: an undefined one need not be assigned.
    fn looked_at(&self, id: NodeId) -> bool {
        self.compiled.graph.node(id).op != ir::Op::Undef
    }

    /// Assigns the next iteration's values, and exits the loop after the last iteration. Values that read a variable which
    /// an earlier assignment overwrites are computed first.
    fn next_iteration(&mut self, params: &[NodeId], region: &Region) {
        let graph = &self.compiled.graph;
        let mut moves: Vec<(NodeId, VarId, Expr)> = Vec::new();
        for (param, result) in params.iter().zip(&region.results) {
            let value = self.node_expr(*result);
            let var = match graph.ty(*param).is_array() {
                true => self.coalescing.version_variable(*param),
                false => self.exprs[param.0 as usize].as_ref().and_then(Expr::as_var),
            };
            let var = var.unwrap_or(VarId::PIXEL);
            if value.as_var() != Some(var) && self.looked_at(*result) {
                moves.push((*param, var, value));
            }
        }
        let mut stop = region.stop.map(|stop| (stop, self.node_expr(stop)));
        let all: Vec<VarId> = moves.iter().map(|(_, var, _)| *var).collect();
        if let Some((id, condition)) = &mut stop
            && condition.mentions(|var| all.contains(&var))
        {
            let ends = self.module.new_variable("ends", condition.ty);
            let value = std::mem::replace(condition, Expr::var(ends, condition.ty));
            self.emit_statement(*id, StmtKind::Let(ends, value));
        }
        for k in 0..moves.len() {
            let changed: Vec<VarId> = moves[..k].iter().map(|(_, var, _)| *var).collect();
            let (param, var, value) = &moves[k];
            if value.mentions(|var| changed.contains(&var)) {
                let (param, ty) = (*param, value.ty);
                let name = format!("next_{}", self.module.variables[var.0 as usize].name);
                let next = self.module.new_variable(name, ty);
                let value = std::mem::replace(&mut moves[k].2, Expr::var(next, ty));
                self.emit_statement(param, StmtKind::Let(next, value));
            }
        }
        for (param, var, value) in moves {
            let place = self.module.read_variable(var);
            self.emit_statement(param, StmtKind::Assign(place, None, value));
        }
        if let Some((id, condition)) = stop {
            let leave = StmtKind::If {
                condition,
                then: vec![StmtKind::Break.into()],
                otherwise: Vec::new(),
            };
            self.emit_statement(id, leave);
        }
    }

    /// Binds the results of a loop to the variables that it carried.
    fn bind_results(&mut self, owner: NodeId, variables: &[NodeId]) {
        for (id, k) in self.results_of(owner) {
            if !self.compiled.graph.ty(id).is_array() {
                self.exprs[id.0 as usize] = self.exprs[variables[k].0 as usize].clone();
            }
        }
    }

    /// Returns the result nodes of a loop or branch, with their numbers.
    fn results_of(&self, owner: NodeId) -> Vec<(NodeId, usize)> {
        let graph = &self.compiled.graph;
        let all = graph.node_ids().skip(owner.0 as usize);
        all.filter_map(|id| match graph.node(id).op {
            ir::Op::Result(k) if graph.node(id).args[0] == owner => Some((id, k as usize)),
            _ => None,
        })
        .collect()
    }

    pub(super) fn lower_branch(&mut self, node: NodeId, then: &'g Block, otherwise: &'g Block) {
        let graph = &self.compiled.graph;
        let regions: Vec<_> = graph.regions_of(node).into_iter().map(|r| graph.region(r)).collect();
        let results = self.results_of(node);
        // An empty side yields values computed before the branch, so the variable is initialised with them. Except if the
        // other side yields a value that a loop carries, as before an exit: the two may then share a variable.
        let idle = otherwise.steps.is_empty();
        let carried = |id: NodeId| matches!(graph.node(id).op, ir::Op::Param(..));
        let begins = |k: usize| idle && !carried(regions[0].results[k]);
        let mut changes_array = false;
        let mut assigns = !idle;
        for (id, k) in &results {
            let kept = regions[1].results[*k];
            if graph.ty(*id).is_array() {
                changes_array |= self.prepare_array(*id, kept);
                continue;
            }
            assigns |= !begins(*k);
            let begin = (begins(*k) && self.looked_at(kept)).then(|| self.node_expr(kept));
            let var = self.new_variable(*id);
            self.emit_statement(*id, StmtKind::Var(var, begin));
            self.exprs[id.0 as usize] = Some(self.module.read_variable(var));
        }
        let condition = self.node_expr(graph.node(node).args[0]);
        let scope = self.coalescing.current_scope();
        let then = self.nested(|lowering| lowering.lower_side(then, &results, &regions[0].results, &|_| false));
        self.coalescing.restore_scope(&scope);
        let otherwise = self.nested(|lowering| {
            if assigns || changes_array {
                lowering.lower_side(otherwise, &results, &regions[1].results, &begins);
            } else {
                for (id, k) in results.iter().filter(|(id, _)| graph.ty(*id).is_array()) {
                    lowering.enter_web(*id, regions[1].results[*k]);
                }
            }
        });
        let kind = StmtKind::If {
            condition,
            then,
            otherwise,
        };
        let source = self.place_of(node);
        self.block.push(Stmt { kind, source });
        self.coalescing.restore_scope(&scope);
    }

    /// Declares the variable of an array that a branch selects before the branch. Returns whether the side that yields
    /// `kept` must write it, because the variable holds another value.
    fn prepare_array(&mut self, id: NodeId, kept: NodeId) -> bool {
        if self.coalescing.version_variable(id).is_none() {
            let var = self.new_variable(id);
            self.emit_statement(id, StmtKind::Var(var, None));
            // Both sides write the variable before it is read.
            self.coalescing.declare_version(id, var);
        }
        self.coalescing.version_variable(kept) != self.coalescing.version_variable(id)
    }

    /// Lowers one side of a branch: its steps, then the assignments to the branch's variables, except to those that already
    /// hold the value.
    fn lower_side(
        &mut self,
        block: &'g Block,
        results: &[(NodeId, usize)],
        values: &[NodeId],
        holds: &dyn Fn(usize) -> bool,
    ) {
        self.steps(block);
        for (id, k) in results {
            if self.compiled.graph.ty(*id).is_array() {
                self.enter_web(*id, values[*k]);
            } else if !holds(*k) && self.looked_at(values[*k]) {
                let (place, value) = (self.node_expr(*id), self.node_expr(values[*k]));
                self.emit_statement(*id, StmtKind::Assign(place, None, value));
            }
        }
    }
}
