//! Builder for the statements of a function.

use crate::emit::ast::{Block, Expr, Module, Op, StmtKind, Ty, VarId};
use straightline_evaluator::ir::{self, BinaryOp, Scalar, Type, UnaryOp};

/// Body of a function under construction, for one float type.
pub struct Body<'m, 'g> {
    module: &'m mut Module<'g>,
    /// Float type of the function.
    pub ty: Ty,
    statements: Block<'g>,
}

impl<'m, 'g> Body<'m, 'g> {
    pub fn new(module: &'m mut Module<'g>, ty: Ty) -> Self {
        Body {
            module,
            ty,
            statements: Vec::new(),
        }
    }

    pub fn into_statements(self) -> Block<'g> {
        self.statements
    }

    /// Returns a number in every component.
    pub fn float_constant(&self, x: f32) -> Expr {
        Expr::splat(self.ty, x.to_bits())
    }

    /// Returns a bit pattern in every component.
    pub fn bits_constant(&self, bits: u32) -> Expr {
        Expr::new(Op::Hex(bits), Vec::new(), self.ty.with_kind(Scalar::U32))
    }

    /// Declares an immutable variable with this value; returns a read of it.
    pub fn emit_let(&mut self, name: &str, value: Expr) -> Expr {
        let var = self.module.new_variable(name, value.ty);
        self.statements.push(StmtKind::Let(var, value).into());
        self.module.read_variable(var)
    }

    /// Declares a mutable variable.
    pub fn emit_var(&mut self, name: &str, value: Expr) -> VarId {
        let var = self.module.new_variable(name, value.ty);
        self.statements.push(StmtKind::Var(var, Some(value)).into());
        var
    }

    /// Returns the value of a variable.
    pub fn read_variable(&self, var: VarId) -> Expr {
        self.module.read_variable(var)
    }

    /// Assigns a value to a variable.
    pub fn emit_assign(&mut self, var: VarId, value: Expr) {
        let place = self.module.read_variable(var);
        self.statements.push(StmtKind::Assign(place, None, value).into());
    }

    /// Emits a loop of `times` iterations, with the body that `turn` emits.
    pub fn emit_loop(&mut self, times: Expr, turn: impl FnOnce(&mut Self)) {
        let counter = self.module.new_variable("turn", Type::I32);
        let outer = std::mem::take(&mut self.statements);
        turn(self);
        let body = std::mem::replace(&mut self.statements, outer);
        self.statements.push(
            StmtKind::For {
                counter,
                start: Expr::splat(Type::I32, 0),
                end: times,
                body,
            }
            .into(),
        );
    }

    /// Returns the bits of a float.
    pub fn to_bits(&self, x: &Expr) -> Expr {
        x.clone().bits_as(self.ty.with_kind(Scalar::U32))
    }

    /// Returns the bits of a float without its sign.
    pub fn size_bits(&self, x: &Expr) -> Expr {
        self.to_bits(x).binary(BinaryOp::And, self.bits_constant(0x7fff_ffff))
    }

    /// Tests whether a float is a NaN, by its bits, because a compiler may assume that there are no NaNs.
    pub fn is_nan(&self, x: &Expr) -> Expr {
        self.size_bits(x).binary(BinaryOp::Gt, self.bits_constant(0x7f80_0000))
    }

    /// Tests whether a float's sign bit is set.
    pub fn has_sign(&self, x: &Expr) -> Expr {
        self.to_bits(x).binary(BinaryOp::Ge, self.bits_constant(0x8000_0000))
    }

    /// Returns a positive float with the sign bit of `of`.
    pub fn with_sign_of(&self, size: Expr, of: &Expr) -> Expr {
        let sign = self.to_bits(of).binary(BinaryOp::And, self.bits_constant(0x8000_0000));
        self.to_bits(&size).binary(BinaryOp::Or, sign).bits_as(self.ty)
    }
}

/// An operation on one float.
pub fn unary(op: UnaryOp, x: &Expr) -> Expr {
    Expr::new(Op::Ir(ir::Op::Unary(op)), vec![x.clone()], x.ty)
}

/// An operation on two values.
pub fn binary(x: &Expr, op: BinaryOp, y: &Expr) -> Expr {
    x.clone().binary(op, y.clone())
}

/// Both of two conditions.
pub fn and(x: Expr, y: Expr) -> Expr {
    x.binary(BinaryOp::And, y)
}

/// The disjunction of two conditions.
pub fn or(x: Expr, y: Expr) -> Expr {
    x.binary(BinaryOp::Or, y)
}

/// The opposite of a condition.
pub fn not(x: Expr) -> Expr {
    let ty = x.ty;
    Expr::new(Op::Ir(ir::Op::Unary(UnaryOp::Not)), vec![x], ty)
}
