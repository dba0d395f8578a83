//! Variables that expressions and statements read and write.

use super::ast::{Expr, Op, Stmt, StmtKind, VarId};

impl Expr {
    /// Returns the variable, if the expression is one.
    pub fn as_var(&self) -> Option<VarId> {
        match self.op {
            Op::Var(var) => Some(var),
            _ => None,
        }
    }

    /// Returns the variable that a place is a part of.
    pub fn root_variable(&self) -> Option<VarId> {
        match self.op {
            Op::Index { .. } | Op::Swizzle(_) => self.args[0].root_variable(),
            _ => self.as_var(),
        }
    }

    /// Returns whether the expression mentions a variable for which `of` holds.
    pub fn mentions(&self, of: impl Fn(VarId) -> bool) -> bool {
        let mut found = false;
        self.visit(&mut |expr| found |= expr.as_var().is_some_and(&of));
        found
    }
}

impl Stmt<'_> {
    /// Returns whether the statement or its blocks mention a variable.
    pub fn mentions(&self, var: VarId) -> bool {
        let mut found = false;
        self.visit(&mut |expr| found |= expr.as_var() == Some(var));
        found || self.sets_old_value(var)
    }

    /// Returns whether an effect in the statement or its blocks puts the old value into a variable.
    fn sets_old_value(&self, var: VarId) -> bool {
        matches!(&self.kind, StmtKind::Effect(effect) if effect.before == Some(var))
            || self.blocks().into_iter().flatten().any(|stmt| stmt.sets_old_value(var))
    }

    /// Returns whether the statement or one of its blocks assigns to a variable or a part of it.
    pub fn assigns(&self, var: VarId) -> bool {
        matches!(&self.kind, StmtKind::Assign(place, ..) if place.root_variable() == Some(var))
            || self.sets_old_value(var)
            || self.blocks().into_iter().flatten().any(|stmt| stmt.assigns(var))
    }
}
