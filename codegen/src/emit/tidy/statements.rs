//! Shorter forms of statements.

use super::simplify::not;
use crate::emit::ast::{Block, Expr, Op, StmtKind};
use straightline_evaluator::ir::{self, BinaryOp, Scalar};

/// Shortens every statement, including those of inner blocks.
pub fn shorten_statements(block: &mut Block<'_>) {
    for stmt in block {
        stmt.blocks_mut().into_iter().for_each(shorten_statements);
        match &mut stmt.kind {
            StmtKind::Assign(place, op @ None, value) => {
                one_component(place, value);
                compound_assignment(place, op, value);
            }
            StmtKind::If {
                condition,
                then,
                otherwise,
            } if then.is_empty() => {
                // `if c {} else { a }` becomes `if !c { a }`.
                let taken = std::mem::replace(condition, Expr::constant(ir::Type::BOOL, [0; 4]));
                *condition = not(taken);
                std::mem::swap(then, otherwise);
            }
            _ => {}
        }
    }
}

/// `v = vec2(a, v.y)` becomes `v.x = a`.
fn one_component(place: &mut Expr, value: &mut Expr) {
    if place.as_var().is_none() || place.ty.is_array() || value.op != Op::Construct {
        return;
    }
    let mut first = 0;
    let mut changed = Vec::new();
    for (k, part) in value.args.iter().enumerate() {
        let lanes = part.ty.component_count();
        let kept = matches!(&part.op, Op::Swizzle(from) if from.iter().copied().eq(first..first + lanes))
            && part.args[0] == *place;
        if !kept {
            changed.push((k, first, lanes));
        }
        first += lanes;
    }
    if first == place.ty.component_count()
        && let [(k, component, 1)] = changed[..]
    {
        let part = value.args.swap_remove(k);
        *place = Expr::new(Op::Swizzle(vec![component]), vec![place.clone()], part.ty);
        *value = part;
    }
}

/// `x = x + a` becomes `x += a`.
fn compound_assignment(place: &Expr, assigned: &mut Option<BinaryOp>, value: &mut Expr) {
    let Op::Ir(ir::Op::Binary(op)) = value.op else { return };
    let compounds = match op {
        BinaryOp::Add | BinaryOp::Mul | BinaryOp::Sub | BinaryOp::Div => true,
        BinaryOp::And | BinaryOp::Or | BinaryOp::Xor => !matches!(value.ty.scalar_kind(), Some(Scalar::Bool)),
        _ => false,
    };
    if compounds && value.args[0] == *place {
        *assigned = Some(op);
        *value = value.args.swap_remove(1);
    } else if compounds && op.is_commutative() && value.args[1] == *place {
        *assigned = Some(op);
        *value = value.args.swap_remove(0);
    }
}
