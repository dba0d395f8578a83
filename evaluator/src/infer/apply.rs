//! Writes into the tree what inference found: types of literals, and which functions methods stand for.

use super::{Known, KnownItems};
use crate::diagnostic::Span;
use crate::front::Library;
use crate::front::tree::{Block, Expr, ExprKind, Pattern, Statement, Type, generic_arguments};
use std::sync::Arc;

/// Gives each literal the type that was found for it, and each method of a number the function that it stands for.
pub fn apply_inferred(library: &mut Library, items: &KnownItems) {
    let nothing = Known::default();
    let of = |name: &str| items.get(name).unwrap_or(&nothing);
    for (name, function) in &mut library.functions {
        let known = of(name);
        for param in &mut function.params {
            apply_to_type(&mut param.ty, known);
        }
        apply_to_type(&mut function.result, known);
        apply_to_block(&mut function.body, known);
    }
    for (name, constant) in &mut library.consts {
        let known = of(name);
        apply_to_type(&mut constant.ty, known);
        apply_to_expr(&mut constant.value, known);
    }
    let known = of("");
    let of_structures = library.structs.values_mut().flat_map(|s| &mut s.fields);
    let variants = library.enums.values_mut().flat_map(|e| &mut e.variants);
    let of_variants = variants.flat_map(|variant| &mut variant.fields);
    of_structures
        .chain(of_variants)
        .for_each(|(_, t, _)| apply_to_type(t, known));
    for field in library.options.values_mut().flatten() {
        apply_to_type(&mut field.ty, known);
        apply_to_expr(&mut field.default, known);
        field.range.iter_mut().for_each(|range| apply_to_expr(range, known));
    }
}

fn apply_to_block(b: &mut Block, known: &Known) {
    for statement in &mut b.statements {
        match statement {
            Statement::Let(p, stated, init, _) => {
                apply_to_pattern(p, known);
                stated.iter_mut().for_each(|t| apply_to_type(t, known));
                init.iter_mut().for_each(|e| apply_to_expr(e, known));
            }
            Statement::Expr(e) => apply_to_expr(e, known),
            Statement::Const(constant) => {
                apply_to_type(&mut constant.ty, known);
                apply_to_expr(&mut constant.value, known);
            }
        }
    }
    b.value.iter_mut().for_each(|e| apply_to_expr(e, known));
}

fn apply_to_expr(e: &mut Expr, known: &Known) {
    let go = |e: &mut Expr| apply_to_expr(e, known);
    match &mut e.kind {
        ExprKind::Int(_, ty) => *ty = ty.or_else(|| known.literals.get(&e.span).copied()),
        ExprKind::Path(path) => {
            // A constant or a function of a type; one name is a variable.
            if let (Some(key), true) = (known.methods.get(&e.span), path.len() > 1) {
                *path = vec![key.clone()];
            }
        }
        ExprKind::Float(..)
        | ExprKind::Bool(_)
        | ExprKind::Str(_)
        | ExprKind::Break(_)
        | ExprKind::Continue(_)
        | ExprKind::Unreachable => {}
        ExprKind::Unary(_, a)
        | ExprKind::Ref(_, a)
        | ExprKind::Deref(a)
        | ExprKind::Field(a, _)
        | ExprKind::Assert { condition: a, .. }
        | ExprKind::Try(a) => {
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
        ExprKind::Slice(base, bounds) => {
            go(base);
            [&mut bounds.start, &mut bounds.end]
                .into_iter()
                .flatten()
                .for_each(|end| go(end));
        }
        ExprKind::Call(path, constants, args) => {
            constants.iter_mut().chain(args).for_each(go);
            if let Some(function) = known.methods.get(&e.span) {
                *path = vec![function.clone()];
            }
            if let Some((_, types)) = known.instances.get(&e.span) {
                *constants = fill_arguments(std::mem::take(constants), types, e.span);
            }
        }
        ExprKind::Method(receiver, name, constants, args) => {
            constants.iter_mut().for_each(|e| apply_to_expr(e, known));
            if let Some(function) = known.methods.get(&e.span) {
                name.clone_from(function);
            }
            go(receiver);
            args.iter_mut().for_each(go);
            // Only a call has a place for types.
            if let Some((key, types)) = known.instances.get(&e.span) {
                let constants = fill_arguments(std::mem::take(constants), types, e.span);
                let mut receiver = (**receiver).clone();
                // A function with a `&mut` receiver borrows it, as a method does.
                if changes_array(key) {
                    receiver = Expr {
                        span: receiver.span,
                        kind: ExprKind::Ref(true, Box::new(receiver)),
                    };
                }
                let all = std::iter::once(receiver).chain(args.drain(..)).collect();
                e.kind = ExprKind::Call(vec![key.clone()], constants, all);
            }
        }
        ExprKind::Invoke(callee, args) => {
            go(callee);
            args.iter_mut().for_each(go);
        }
        ExprKind::Tuple(parts) | ExprKind::Array(parts) => parts.iter_mut().for_each(go),
        ExprKind::Struct(_, fields, rest) => {
            fields.iter_mut().for_each(|(_, e)| go(e));
            rest.iter_mut().for_each(|e| go(e));
        }
        ExprKind::Cast(a, t) => {
            go(a);
            apply_to_type(t, known);
        }
        ExprKind::Return(value) => value.iter_mut().for_each(|e| go(e)),
        ExprKind::If(condition, then, otherwise, _) => {
            go(condition);
            otherwise.iter_mut().for_each(|e| go(e));
            apply_to_block(then, known);
        }
        ExprKind::Match(subject, arms, _) => {
            go(subject);
            for arm in arms {
                apply_to_pattern(&mut arm.pattern, known);
                arm.guard.iter_mut().for_each(|e| apply_to_expr(e, known));
                apply_to_expr(&mut arm.body, known);
            }
        }
        ExprKind::Closure(closure) => {
            let closure = Arc::make_mut(closure);
            for (p, stated) in &mut closure.params {
                apply_to_pattern(p, known);
                stated.iter_mut().for_each(|t| apply_to_type(t, known));
            }
            closure.result.iter_mut().for_each(|t| apply_to_type(t, known));
            apply_to_expr(&mut closure.body, known);
        }
        ExprKind::Block(b) | ExprKind::Labelled(_, b) => apply_to_block(b, known),
        ExprKind::For(f) => {
            apply_to_pattern(&mut f.pattern, known);
            apply_to_expr(&mut f.over, known);
            apply_to_block(&mut f.body, known);
        }
        ExprKind::While(condition, body, ..) => {
            go(condition);
            apply_to_block(body, known);
        }
    }
}

/// Generic arguments with the types that were found: those that are stated, then the others. What is not known is `()`.
fn fill_arguments(stated: Vec<Expr>, types: &[Option<Type>], span: Span) -> Vec<Expr> {
    let owner = generic_arguments(&stated).1.and_then(|_| stated.last().cloned());
    let count = stated.len() - usize::from(owner.is_some());
    let mut stated = stated.into_iter().take(count);
    let each = types.iter().map(|ty| {
        let given = stated.next();
        let kind = match (ty, given) {
            (Some(Type::Name(name, args)), _) if args.is_empty() => ExprKind::Path(vec![name.clone()]),
            (Some(ty), _) => {
                let kind = ExprKind::Path(Vec::new());
                ExprKind::Cast(Box::new(Expr { kind, span }), ty.clone())
            }
            (None, Some(given)) => return given,
            (None, None) => ExprKind::Tuple(Vec::new()),
        };
        Expr { kind, span }
    });
    each.chain(owner).collect()
}

fn apply_to_pattern(p: &mut Pattern, known: &Known) {
    match p {
        Pattern::Name(..) | Pattern::Wild | Pattern::Rest => {}
        Pattern::Tuple(parts, _) | Pattern::Array(parts, _) | Pattern::Or(parts) => {
            parts.iter_mut().for_each(|part| apply_to_pattern(part, known));
        }
        Pattern::Struct(_, fields, _) => fields.iter_mut().for_each(|(_, part)| apply_to_pattern(part, known)),
        Pattern::Ref(inner, _) | Pattern::At(_, _, inner, _) => apply_to_pattern(inner, known),
        Pattern::Value(e) => apply_to_expr(e, known),
        Pattern::Range(low, high, _) => [low, high]
            .into_iter()
            .flatten()
            .for_each(|end| apply_to_expr(end, known)),
    }
}

fn apply_to_type(t: &mut Type, known: &Known) {
    match t {
        Type::Name(_, args) | Type::Tuple(args) => args.iter_mut().for_each(|t| apply_to_type(t, known)),
        Type::Ref(_, inner) => apply_to_type(inner, known),
        Type::Const(value) => apply_to_expr(value, known),
        Type::Fn(params, result) => {
            params.iter_mut().for_each(|t| apply_to_type(t, known));
            apply_to_type(result, known);
        }
        Type::Array(element, len) => {
            apply_to_type(element, known);
            len.iter_mut().for_each(|e| apply_to_expr(e, known));
        }
    }
}

/// Returns whether a method of arrays in the library changes its receiver.
fn changes_array(key: &str) -> bool {
    key.strip_prefix("Array::")
        .is_some_and(|name| crate::front::CHANGING.contains(&name))
}
