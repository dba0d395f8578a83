//! Arrays: reads and writes of elements, and the variables that hold array versions.

use super::{Lowering, facts};
use crate::emit::ast::{Expr, Op, StmtKind, VarId};
use straightline_evaluator::ir::{self, NodeId, Type};

impl Lowering<'_> {
    pub(super) fn array_get(&mut self, id: NodeId) {
        let graph = &self.compiled.graph;
        let (array, index) = (graph.node(id).args[0], graph.node(id).args[1]);
        if graph.node(array).op == ir::Op::MakeArray && facts::is_table(graph, &graph.node(array).args) {
            self.emit_table(array);
        }
        let base = self.node_expr(array);
        let read = self.array_element(array, base, index);
        self.emit_let(id, read);
    }

    /// Emits an array of constants as a table of the module.
    fn emit_table(&mut self, array: NodeId) {
        if self.exprs[array.0 as usize].is_none() {
            let literal = self.node_expr(array);
            let var = self.new_variable(array);
            self.module.tables.push((var, literal));
            self.exprs[array.0 as usize] = Some(self.module.read_variable(var));
        }
    }

    /// Stores the elements of an array in a variable, because only variables can be indexed. Constants become a table; a
    /// version that is only copied is written directly at the copy.
    pub(super) fn make_array(&mut self, id: NodeId) {
        let graph = &self.compiled.graph;
        if self.indexed[id.0 as usize] && !facts::is_table(graph, &graph.node(id).args) {
            let literal = self.node_expr(id);
            let var = self.new_variable(id);
            self.emit_statement(id, StmtKind::Var(var, Some(literal)));
            self.exprs[id.0 as usize] = Some(self.module.read_variable(var));
        }
    }

    /// Returns an element of an array of the same type as `array`.
    fn array_element(&mut self, array: NodeId, base: Expr, index: NodeId) -> Expr {
        let graph = &self.compiled.graph;
        let ty = graph.ty(array);
        let inside = match ty {
            Type::Array { len, .. } => facts::is_inside(graph, index, len),
            _ => true,
        };
        let index = self.node_expr(index);
        Expr::new(Op::Index { inside }, vec![base, index], ty.element_type())
    }

    pub(super) fn array_set(&mut self, id: NodeId) {
        let args = &self.compiled.graph.node(id).args;
        let var = self.enter_web(id, args[0]);
        let place = self.array_element(id, self.module.read_variable(var), args[1]);
        let value = self.node_expr(args[2]);
        self.emit_statement(id, StmtKind::Assign(place, None, value));
    }

    /// Makes the variable of a version hold `begin`; returns the variable.
    pub(super) fn enter_web(&mut self, version: NodeId, begin: NodeId) -> VarId {
        let value = self.node_expr(begin);
        match self.coalescing.version_variable(version) {
            None => {
                let var = self.new_variable(version);
                self.emit_statement(version, StmtKind::Var(var, Some(value)));
                self.coalescing.declare_version(version, var);
                var
            }
            Some(var) => {
                let place = self.module.read_variable(var);
                if value != place {
                    self.emit_statement(version, StmtKind::Assign(place, None, value));
                }
                var
            }
        }
    }

    /// Returns the variable that holds a version of an array.
    pub(super) fn version_expr(&self, id: NodeId) -> Expr {
        self.module
            .read_variable(self.coalescing.version_variable(id).unwrap_or(VarId::PIXEL))
    }
}
