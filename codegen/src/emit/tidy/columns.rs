//! Approximate printed width of statements. Printers wrap lines that exceed the limit.

use crate::emit::ast::{Expr, Module, Op, Stmt, StmtKind, Ty};
use crate::emit::legalise::AS_WRITTEN;
use crate::emit::literals::number_columns;
use straightline_evaluator::ir::{self, BinaryOp, Graph};

/// Names, which widths depend on.
pub struct Columns<'m> {
    pub module: &'m Module<'m>,
    pub graph: &'m Graph,
}

impl Columns<'_> {
    /// Returns the width of a statement's own line, without its indentation, and the number of its operators and calls.
    pub fn of_stmt(&self, stmt: &Stmt<'_>) -> (usize, usize) {
        let around = match &stmt.kind {
            StmtKind::Let(var, _) | StmtKind::Var(var, _) => self.module.variables[var.0 as usize].name.len() + 8,
            StmtKind::Assign(..) => 4,
            StmtKind::Store(..) => 30,
            StmtKind::Effect(effect) => 20 + self.graph.memory(effect.memory).1.len(),
            StmtKind::Output(_) | StmtKind::Return(_) => 30,
            StmtKind::For { .. } => 40,
            StmtKind::If { .. } | StmtKind::Loop(_) | StmtKind::Break => 5,
            StmtKind::Comment(_) | StmtKind::Barrier { .. } => 0,
        };
        (
            around + stmt.own_exprs().map(|expr| self.expr_columns(expr)).sum::<usize>(),
            stmt.own_exprs().map(Expr::operation_count).sum(),
        )
    }

    /// Returns the width of an expression, in columns.
    pub fn expr_columns(&self, expr: &Expr) -> usize {
        let args: usize = expr.args.iter().map(|arg| self.expr_columns(arg)).sum();
        let commas = 2 * expr.args.len().saturating_sub(1);
        let call = |name: usize| name + 2 + args + commas;
        match &expr.op {
            Op::Var(var) => self.module.variables[var.0 as usize].name.len(),
            Op::Swizzle(components) => args + 1 + components.len(),
            Op::Index { .. } => args + 2,
            Op::Construct | Op::Convert { .. } => call(expr.ty.short_name().len()),
            Op::Division(..) => args + 3 + parenthesis_columns(expr),
            Op::Guarded(..) => call(10),
            Op::Builtin(_) => 20,
            Op::Any | Op::All => call(3),
            Op::Exact { .. } => call(AS_WRITTEN.len()),
            Op::Choose => call(6),
            Op::Hex(_) => 11,
            Op::Call(name) => call(name.len()),
            Op::Function(name) => call(name.len()),
            Op::Ir(op) => match op {
                ir::Op::Const(bits) => self.constant_columns(expr.ty, bits),
                // The frame's size follows the kernel's uniforms.
                ir::Op::Uniform(k) => {
                    11 + self
                        .graph
                        .uniforms
                        .get(*k as usize)
                        .map_or(10, |uniform| uniform.name.len())
                }
                ir::Op::Override(k) => 6 + self.graph.overrides[*k as usize].name.len(),
                ir::Op::Varying(k) => self.graph.varyings[*k as usize].name.len(),
                ir::Op::Unary(ir::UnaryOp::Neg | ir::UnaryOp::Not | ir::UnaryOp::BitNot) => {
                    args + 1 + parenthesis_columns(expr)
                }
                ir::Op::Binary(BinaryOp::Min | BinaryOp::Max | BinaryOp::Pow) => call(3),
                ir::Op::Binary(BinaryOp::Atan2) => call(5),
                ir::Op::Binary(_) => args + 3 + parenthesis_columns(expr),
                ir::Op::Unary(op) => call(format!("{op:?}").len()),
                ir::Op::Bitcast => call(8 + expr.ty.short_name().len() + 2),
                ir::Op::Load { texture, .. } => call(16 + self.texture_columns(*texture)),
                ir::Op::Sample { texture, sampler, .. } => {
                    call(28 + self.texture_columns(*texture) + self.sampler_columns(*sampler))
                }
                ir::Op::Gather { texture, sampler, .. } => {
                    call(20 + self.texture_columns(*texture) + self.sampler_columns(*sampler))
                }
                ir::Op::Compare { texture, sampler, .. } | ir::Op::GatherCompare { texture, sampler, .. } => {
                    call(29 + self.texture_columns(*texture) + self.sampler_columns(*sampler))
                }
                ir::Op::TextureSize(texture) => 26 + self.texture_columns(*texture),
                ir::Op::TextureLevels(texture) | ir::Op::TextureLayers(texture) => 23 + self.texture_columns(*texture),
                ir::Op::BufferLoad { buffer, field, .. } => {
                    let buffer = &self.graph.buffers[*buffer as usize];
                    let field = match &buffer.element {
                        ir::Element::Value(_) => 0,
                        ir::Element::Struct(of) => of.fields.get(*field as usize).map_or(0, |f| f.name.len() + 1),
                    };
                    args + 2 * expr.args.len() + buffer.name.len() + field
                }
                ir::Op::SharedLoad(shared) => args + 2 + self.graph.shared[*shared as usize].name.len(),
                ir::Op::BufferLen(buffer) => 18 + self.graph.buffers[*buffer as usize].name.len(),
                ir::Op::QuadSwap(_) | ir::Op::Derivative(_) => call(12),
                _ => call(6),
            },
        }
    }

    fn constant_columns(&self, ty: Ty, bits: &ir::Bits) -> usize {
        let lanes = &bits[..ty.component_count() as usize];
        let number = |bits: &u32| number_columns(ty, *bits);
        match lanes {
            [one] => number(one),
            [first, rest @ ..] if rest.iter().all(|bits| bits == first) => 7 + number(first),
            _ => 5 + lanes.iter().map(|bits| number(bits) + 2).sum::<usize>(),
        }
    }

    fn texture_columns(&self, index: u32) -> usize {
        self.graph.textures[index as usize].name.len()
    }

    fn sampler_columns(&self, index: u32) -> usize {
        self.graph.samplers[index as usize].name.len()
    }
}

/// Returns the width of possible parentheses around operands that are operators themselves.
fn parenthesis_columns(expr: &Expr) -> usize {
    let operator = |arg: &&Expr| match (&arg.op, &expr.op) {
        (Op::Ir(ir::Op::Binary(inner)), Op::Ir(ir::Op::Binary(outer))) => !matches!(
            (inner, outer),
            (BinaryOp::Mul, BinaryOp::Add | BinaryOp::Sub) | (BinaryOp::Add, BinaryOp::Add)
        ),
        (Op::Ir(ir::Op::Binary(_)) | Op::Division(..), _) => true,
        _ => false,
    };
    2 * expr.args.iter().filter(operator).count()
}
