//! Which variables expressions and statements read and write.

use super::ast::{Expr, Op, Stmt, StmtKind, VarId};

impl Expr {
    /// The variable that this is.
    pub fn as_var(&self) -> Option<VarId> {
        match self.op {
            Op::Var(var) => Some(var),
            _ => None,
        }
    }

    /// The variable that a place is a part of.
    pub fn root(&self) -> Option<VarId> {
        match self.op {
            Op::Index { .. } | Op::Swizzle(_) => self.args[0].root(),
            _ => self.as_var(),
        }
    }

    /// Whether a variable that `of` holds for stands in it.
    pub fn mentions(&self, of: impl Fn(VarId) -> bool) -> bool {
        let mut found = false;
        self.visit(&mut |expr| found |= expr.as_var().is_some_and(&of));
        found
    }
}

impl Stmt<'_> {
    /// Whether a variable stands in it or in its blocks.
    pub fn mentions(&self, var: VarId) -> bool {
        let mut found = false;
        self.visit(&mut |expr| found |= expr.as_var() == Some(var));
        found || self.gives(var)
    }

    /// Whether what is there before an effect in it, or in its blocks, goes to a variable.
    fn gives(&self, var: VarId) -> bool {
        matches!(&self.kind, StmtKind::Effect(effect) if effect.before == Some(var))
            || self.blocks().into_iter().flatten().any(|stmt| stmt.gives(var))
    }

    /// Whether it, or a statement of its blocks, assigns to a variable or a part of it.
    pub fn assigns(&self, var: VarId) -> bool {
        matches!(&self.kind, StmtKind::Assign(place, ..) if place.root() == Some(var))
            || self.gives(var)
            || self.blocks().into_iter().flatten().any(|stmt| stmt.assigns(var))
    }
}
