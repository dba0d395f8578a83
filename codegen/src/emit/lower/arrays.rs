//! Arrays: elements read and written, and the variables that hold their versions.

use super::{Lowering, Stale, facts};
use crate::emit::ast::{Expr, Op, StmtKind, VarId};
use straightline_evaluator::ir::{self, NodeId, Type};

impl Lowering<'_> {
    pub(super) fn array_get(&mut self, id: NodeId) {
        let graph = &self.compiled.graph;
        let (array, index) = (graph.node(id).args[0], graph.node(id).args[1]);
        let mut base = self.expr(array);
        if graph.node(array).op == ir::Op::MakeArray && self.exprs[array.0 as usize].is_none() {
            let var = self.variable(array);
            let literal = std::mem::replace(&mut base, self.module.read(var));
            if facts::is_table(graph, &graph.node(array).args) {
                self.module.tables.push((var, literal));
                self.exprs[array.0 as usize] = Some(base.clone());
            } else {
                // It is made again in every scope that indexes it.
                self.statement(id, StmtKind::Var(var, Some(literal)));
            }
        }
        let read = self.indexed(array, base, index);
        self.declare(id, read);
    }

    /// An element of an array of the same type as `array`.
    fn indexed(&mut self, array: NodeId, base: Expr, index: NodeId) -> Expr {
        let graph = &self.compiled.graph;
        let ty = graph.ty(array);
        let inside = match ty {
            Type::Array { len, .. } => facts::is_inside(graph, index, len),
            _ => true,
        };
        let index = self.expr(index);
        Expr::new(Op::Index { inside }, vec![base, index], ty.element())
    }

    pub(super) fn array_set(&mut self, id: NodeId) {
        let args = &self.compiled.graph.node(id).args;
        let var = self.enter_web(id, args[0]);
        let place = self.indexed(id, self.module.read(var), args[1]);
        let value = self.expr(args[2]);
        self.statement(id, StmtKind::Assign(place, None, value));
    }

    /// Makes the web's variable hold `begin`, and takes it to be `version`.
    pub(super) fn enter_web(&mut self, version: NodeId, begin: NodeId) -> VarId {
        let value = self.expr(begin);
        let var = match self.coalescing.variable(version) {
            None => {
                let var = self.variable(version);
                self.statement(version, StmtKind::Var(var, Some(value)));
                self.coalescing.declare(version, var, begin);
                var
            }
            Some(var) => {
                let place = self.module.read(var);
                if value != place {
                    self.statement(version, StmtKind::Assign(place, None, value));
                }
                var
            }
        };
        self.coalescing.advance(version);
        var
    }

    /// The variable that holds just this version of an array.
    pub(super) fn version(&mut self, id: NodeId) -> Expr {
        let var = self.coalescing.holder(id).or_else(|| {
            let since = self.coalescing.replacement(id).map_or(Stale::Unknown, Stale::Since);
            self.stale.get_or_insert(since);
            self.coalescing.variable(id)
        });
        self.module.read(var.unwrap_or(VarId::PIXEL))
    }
}
