//! Writes into the tree what inference found.

use crate::diagnostic::Span;
use crate::front::tree::{Block, Expr, ExprKind, IntType, Library, Pattern, Statement, Type};
use std::collections::HashMap;

/// Gives each literal the type that was found for it.
pub fn apply(library: &mut Library, literals: &HashMap<Span, IntType>) {
    for function in library.functions.values_mut() {
        for param in &mut function.params {
            ty(&mut param.ty, literals);
        }
        ty(&mut function.result, literals);
        block(&mut function.body, literals);
    }
    for constant in library.consts.values_mut() {
        ty(&mut constant.ty, literals);
        expr(&mut constant.value, literals);
    }
    for structure in library.structs.values_mut() {
        structure.fields.iter_mut().for_each(|(_, t, _)| ty(t, literals));
    }
    for field in library.options.values_mut().flatten() {
        ty(&mut field.ty, literals);
        expr(&mut field.default, literals);
        field.range.iter_mut().for_each(|range| expr(range, literals));
    }
}

fn block(b: &mut Block, literals: &HashMap<Span, IntType>) {
    for statement in &mut b.statements {
        match statement {
            Statement::Let(p, stated, init, _) => {
                pattern(p, literals);
                stated.iter_mut().for_each(|t| ty(t, literals));
                init.iter_mut().for_each(|e| expr(e, literals));
            }
            Statement::Expr(e) => expr(e, literals),
            Statement::Const(constant) => {
                ty(&mut constant.ty, literals);
                expr(&mut constant.value, literals);
            }
        }
    }
    b.value.iter_mut().for_each(|e| expr(e, literals));
}

fn expr(e: &mut Expr, literals: &HashMap<Span, IntType>) {
    let go = |e: &mut Expr| expr(e, literals);
    match &mut e.kind {
        ExprKind::Int(_, known) => *known = known.or_else(|| literals.get(&e.span).copied()),
        ExprKind::Float(..)
        | ExprKind::Bool(_)
        | ExprKind::Str(_)
        | ExprKind::Path(_)
        | ExprKind::Break(_)
        | ExprKind::Continue(_) => {}
        ExprKind::Unary(_, a)
        | ExprKind::Ref(_, a)
        | ExprKind::Deref(a)
        | ExprKind::Field(a, _)
        | ExprKind::Assert(a, _) => {
            go(a);
        }
        ExprKind::Binary(_, a, b)
        | ExprKind::Lazy(_, a, b)
        | ExprKind::Assign(a, _, b)
        | ExprKind::Index(a, b)
        | ExprKind::Repeat(a, b)
        | ExprKind::Range(a, b, _) => {
            go(a);
            go(b);
        }
        ExprKind::Call(_, constants, args) => constants.iter_mut().chain(args).for_each(go),
        ExprKind::Method(receiver, _, args) => {
            go(receiver);
            args.iter_mut().for_each(go);
        }
        ExprKind::Tuple(parts) | ExprKind::Array(parts) => parts.iter_mut().for_each(go),
        ExprKind::Struct(_, fields, rest) => {
            fields.iter_mut().for_each(|(_, e)| go(e));
            rest.iter_mut().for_each(|e| go(e));
        }
        ExprKind::Cast(a, t) => {
            go(a);
            ty(t, literals);
        }
        ExprKind::Return(value) => value.iter_mut().for_each(|e| go(e)),
        ExprKind::If(condition, then, otherwise, _) => {
            go(condition);
            otherwise.iter_mut().for_each(|e| go(e));
            block(then, literals);
        }
        ExprKind::Match(subject, arms, _) => {
            go(subject);
            for arm in arms {
                pattern(&mut arm.pattern, literals);
                arm.guard.iter_mut().for_each(|e| expr(e, literals));
                expr(&mut arm.body, literals);
            }
        }
        ExprKind::Block(b) => block(b, literals),
        ExprKind::For(f) => {
            pattern(&mut f.pattern, literals);
            expr(&mut f.over, literals);
            block(&mut f.body, literals);
        }
        ExprKind::While(condition, body, ..) => {
            go(condition);
            block(body, literals);
        }
    }
}

fn pattern(p: &mut Pattern, literals: &HashMap<Span, IntType>) {
    match p {
        Pattern::Name(..) | Pattern::Wild => {}
        Pattern::Tuple(parts, _) | Pattern::Array(parts, _) | Pattern::Or(parts) => {
            parts.iter_mut().for_each(|part| pattern(part, literals));
        }
        Pattern::Struct(_, fields, _) => fields.iter_mut().for_each(|(_, part)| pattern(part, literals)),
        Pattern::Ref(inner, _) | Pattern::At(_, _, inner, _) => pattern(inner, literals),
        Pattern::Value(e) => expr(e, literals),
        Pattern::Range(low, high, _) => [low, high].into_iter().flatten().for_each(|end| expr(end, literals)),
    }
}

fn ty(t: &mut Type, literals: &HashMap<Span, IntType>) {
    match t {
        Type::Name(_, args) | Type::Tuple(args) => args.iter_mut().for_each(|t| ty(t, literals)),
        Type::Ref(_, inner) => ty(inner, literals),
        Type::Array(element, len) => {
            ty(element, literals);
            len.iter_mut().for_each(|e| expr(e, literals));
        }
    }
}
