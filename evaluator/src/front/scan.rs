//! Effects of a piece of the tree: variables that it may change, and loops that it may leave.

use super::tree::{Block, Expr, ExprKind, Pattern, Statement, Type, split_qualified};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// Effects of a loop's body on its surroundings.
#[derive(Debug, Default)]
pub struct Effects {
    /// Variables around it that it assigns to or borrows mutably.
    pub assigned: BTreeSet<String>,
    /// Every name that it mentions.
    pub mentioned: BTreeSet<String>,
    /// `true` if it may leave the loop other than by its end: `break`, `continue`, `return`.
    pub leaves: bool,
}

/// Scans a loop's body. `mutating` names the methods that take `&mut self`: a receiver counts as borrowed by a method of such a name,
/// whatever its type.
pub fn scan_effects(body: &Block, mutating: &FxHashSet<String>) -> Effects {
    let mut effects = Effects::default();
    let mut around = Around {
        mutating: Some(mutating),
        ..Around::default()
    };
    scan_block(body, &mut effects, &mut around);
    collect_mentioned(body, &mut effects.mentioned);
    effects
}

/// Returns whether a loop's body has a `break` of its own loop, whose label is `label`.
pub fn has_break(body: &Block, label: Option<&str>) -> bool {
    fn in_block(body: &Block, label: Option<&str>, innermost: bool) -> bool {
        let of = |e: &Expr| in_expr(e, label, innermost);
        body.statements.iter().any(|statement| match statement {
            Statement::Let(_, _, init, _) => init.as_ref().is_some_and(of),
            Statement::Expr(e) => of(e),
            Statement::Const(_) => false,
        }) || body.value.as_deref().is_some_and(of)
    }
    fn in_expr(e: &Expr, label: Option<&str>, innermost: bool) -> bool {
        let inner = match &e.kind {
            ExprKind::Break(None) => innermost,
            ExprKind::Break(of) => of.as_deref() == label,
            ExprKind::For(f) => in_block(&f.body, label, false),
            ExprKind::While(_, body, ..) => in_block(body, label, false),
            ExprKind::If(_, then, ..) => in_block(then, label, innermost),
            ExprKind::Block(block) | ExprKind::Labelled(_, block) => in_block(block, label, innermost),
            _ => false,
        };
        inner || child_exprs(e).into_iter().any(|child| in_expr(child, label, innermost))
    }
    in_block(body, label, true)
}

/// Labels and variables in scope at a place.
#[derive(Default)]
struct Around<'b> {
    /// Labels of loops.
    loops: Vec<Option<&'b str>>,
    /// Variables of the body's own.
    own: Vec<&'b str>,
    /// Methods that take `&mut self`.
    mutating: Option<&'b FxHashSet<String>>,
}

impl Around<'_> {
    /// Notes that the variable that `place` is a part of may be written.
    fn note_write(&self, place: &Expr, out: &mut Effects) {
        if let Some(name) = root_variable(place).filter(|name| !self.own.contains(&name.as_str())) {
            out.assigned.insert(name);
        }
    }

    fn mutates(&self, method: &str) -> bool {
        // Inference may have found the function that a method stands for.
        let method = method.rsplit("::").next().unwrap_or(method);
        method == "iter_mut" || self.mutating.is_some_and(|names| names.contains(method))
    }
}

fn scan_block<'b>(b: &'b Block, out: &mut Effects, around: &mut Around<'b>) {
    let mark = around.own.len();
    for statement in &b.statements {
        match statement {
            Statement::Let(pattern, _, init, _) => {
                init.iter().for_each(|e| scan_expr(e, out, around));
                collect_bindings(pattern, &mut around.own);
            }
            Statement::Expr(e) => scan_expr(e, out, around),
            Statement::Const(_) => {}
        }
    }
    b.value.iter().for_each(|e| scan_expr(e, out, around));
    around.own.truncate(mark);
}

/// The names that a pattern binds.
fn collect_bindings<'b>(pattern: &'b Pattern, out: &mut Vec<&'b str>) {
    match pattern {
        Pattern::Name(name, ..) => out.push(name),
        Pattern::Tuple(all, _) | Pattern::Array(all, _) | Pattern::Or(all) => {
            all.iter().for_each(|p| collect_bindings(p, out))
        }
        Pattern::Struct(_, fields, _) => fields.iter().for_each(|(_, p)| collect_bindings(p, out)),
        Pattern::Ref(inner, _) => collect_bindings(inner, out),
        Pattern::At(name, _, inner, _) => {
            out.push(name);
            collect_bindings(inner, out);
        }
        Pattern::Wild | Pattern::Rest | Pattern::Value(_) | Pattern::Range(..) => {}
    }
}

fn scan_expr<'b>(e: &'b Expr, out: &mut Effects, around: &mut Around<'b>) {
    match &e.kind {
        ExprKind::Assign(place, _, value) => {
            around.note_write(place, out);
            scan_expr(place, out, around);
            scan_expr(value, out, around);
        }
        ExprKind::Ref(true, place) => {
            around.note_write(place, out);
            scan_expr(place, out, around);
        }
        ExprKind::Method(receiver, name, _, args) => {
            if around.mutates(name) {
                around.note_write(receiver, out);
            }
            scan_expr(receiver, out, around);
            args.iter().for_each(|e| scan_expr(e, out, around));
        }
        ExprKind::Try(value) => {
            out.leaves = true;
            scan_expr(value, out, around);
        }
        ExprKind::Return(value) => {
            out.leaves = true;
            value.iter().for_each(|e| scan_expr(e, out, around));
        }
        ExprKind::Break(None) | ExprKind::Continue(None) => out.leaves |= around.loops.is_empty(),
        ExprKind::Break(label) | ExprKind::Continue(label) => out.leaves |= !around.loops.contains(&label.as_deref()),
        ExprKind::For(f) => {
            scan_expr(&f.over, out, around);
            let mark = around.own.len();
            collect_bindings(&f.pattern, &mut around.own);
            around.loops.push(f.label.as_deref());
            scan_block(&f.body, out, around);
            around.loops.pop();
            around.own.truncate(mark);
        }
        ExprKind::While(condition, body, label, _) => {
            scan_expr(condition, out, around);
            around.loops.push(label.as_deref());
            scan_block(body, out, around);
            around.loops.pop();
        }
        ExprKind::If(condition, then, otherwise, _) => {
            scan_expr(condition, out, around);
            scan_block(then, out, around);
            otherwise.iter().for_each(|e| scan_expr(e, out, around));
        }
        ExprKind::Closure(closure) => {
            // A `return` in it leaves the closure alone.
            let leaves = out.leaves;
            let mark = around.own.len();
            closure
                .params
                .iter()
                .for_each(|(pattern, _)| collect_bindings(pattern, &mut around.own));
            scan_expr(&closure.body, out, around);
            around.own.truncate(mark);
            out.leaves = leaves;
        }
        ExprKind::Block(b) => scan_block(b, out, around),
        ExprKind::Labelled(label, b) => {
            around.loops.push(Some(label));
            scan_block(b, out, around);
            around.loops.pop();
        }
        ExprKind::Match(subject, arms, _) => {
            scan_expr(subject, out, around);
            for arm in arms {
                let mark = around.own.len();
                collect_bindings(&arm.pattern, &mut around.own);
                arm.guard.iter().for_each(|e| scan_expr(e, out, around));
                scan_expr(&arm.body, out, around);
                around.own.truncate(mark);
            }
        }
        _ => child_exprs(e)
            .into_iter()
            .for_each(|child| scan_expr(child, out, around)),
    }
}

/// The variable that a place is a part of.
pub fn root_variable(place: &Expr) -> Option<String> {
    match &place.kind {
        ExprKind::Path(path) if path.len() == 1 => Some(path[0].clone()),
        ExprKind::Field(base, _)
        | ExprKind::Index(base, _)
        | ExprKind::Slice(base, _)
        | ExprKind::Deref(base)
        | ExprKind::Ref(_, base) => root_variable(base),
        // A method may give a reference to a part of its receiver.
        ExprKind::Method(receiver, ..) => root_variable(receiver),
        _ => None,
    }
}

/// Direct parts of an expression, blocks left out.
pub fn child_exprs(e: &Expr) -> Vec<&Expr> {
    match &e.kind {
        ExprKind::Unary(_, a)
        | ExprKind::Field(a, _)
        | ExprKind::Cast(a, _)
        | ExprKind::Assert { condition: a, .. }
        | ExprKind::Try(a)
        | ExprKind::Ref(_, a)
        | ExprKind::Deref(a) => vec![a],
        ExprKind::Binary(_, a, b)
        | ExprKind::Lazy(_, a, b)
        | ExprKind::Index(a, b)
        | ExprKind::Repeat(a, b)
        | ExprKind::Range(a, b, _)
        | ExprKind::Assign(a, _, b) => vec![a, b],
        ExprKind::Slice(base, bounds) => std::iter::once(&**base).chain(bounds.ends()).collect(),
        ExprKind::Call(_, constants, args) => constants.iter().chain(args).collect(),
        ExprKind::Tuple(args) | ExprKind::Array(args) => args.iter().collect(),
        ExprKind::Method(first, _, constants, args) => std::iter::once(&**first).chain(constants).chain(args).collect(),
        ExprKind::Invoke(first, args) => std::iter::once(&**first).chain(args).collect(),
        ExprKind::Struct(_, fields, rest) => fields.iter().map(|(_, e)| e).chain(rest.as_deref()).collect(),
        ExprKind::Return(value) => value.iter().map(|e| &**e).collect(),
        ExprKind::If(condition, _, otherwise, _) => std::iter::once(&**condition).chain(otherwise.as_deref()).collect(),
        ExprKind::Match(subject, arms, _) => std::iter::once(&**subject)
            .chain(arms.iter().flat_map(|a| a.guard.iter().chain([&a.body])))
            .collect(),
        ExprKind::For(f) => vec![&f.over],
        ExprKind::While(condition, ..) => vec![condition],
        ExprKind::Closure(closure) => vec![&closure.body],
        _ => Vec::new(),
    }
}

/// Every name that a piece of the tree mentions: variables, functions, constants, types.
pub fn collect_mentioned(b: &Block, out: &mut BTreeSet<String>) {
    for statement in &b.statements {
        match statement {
            Statement::Let(_, _, init, _) => init.iter().for_each(|e| mentioned_in(e, out)),
            Statement::Expr(e) => mentioned_in(e, out),
            Statement::Const(c) => mentioned_in(&c.value, out),
        }
    }
    b.value.iter().for_each(|e| mentioned_in(e, out));
}

/// Every name that an expression mentions.
pub fn mentioned_in(e: &Expr, out: &mut BTreeSet<String>) {
    match &e.kind {
        ExprKind::Path(path) | ExprKind::Call(path, ..) => {
            out.extend(path.iter().cloned());
            // Type parameters: `<T as Trait>::name`, `T::Space`.
            let of = path.first().and_then(|first| match split_qualified(first) {
                Some((ty, ..)) => Some(ty),
                None => first.split_once("::").map(|(ty, _)| ty),
            });
            out.extend(of.map(str::to_owned));
        }
        ExprKind::Cast(_, ty) => in_type(ty, out),
        ExprKind::Method(_, name, ..) => {
            out.insert(name.clone());
        }
        ExprKind::Struct(path, ..) => out.extend(path.iter().cloned()),
        ExprKind::If(_, then, ..) => collect_mentioned(then, out),
        ExprKind::For(f) => {
            in_pattern(&f.pattern, out);
            collect_mentioned(&f.body, out);
        }
        ExprKind::While(_, body, ..) | ExprKind::Block(body) | ExprKind::Labelled(_, body) => {
            collect_mentioned(body, out)
        }
        ExprKind::Match(_, arms, _) => arms.iter().for_each(|arm| in_pattern(&arm.pattern, out)),
        _ => {}
    }
    child_exprs(e).into_iter().for_each(|child| mentioned_in(child, out));
}

/// Names in a type, which may be parameters.
fn in_type(ty: &Type, out: &mut BTreeSet<String>) {
    match ty {
        Type::Name(name, args) => {
            out.insert(name.clone());
            args.iter().for_each(|arg| in_type(arg, out));
        }
        Type::Tuple(parts) => parts.iter().for_each(|part| in_type(part, out)),
        Type::Ref(_, inner) => in_type(inner, out),
        Type::Array(element, len) => {
            in_type(element, out);
            len.iter().for_each(|len| mentioned_in(len, out));
        }
        Type::Const(value) => mentioned_in(value, out),
        Type::Fn(..) => {}
    }
}

fn in_pattern(pattern: &Pattern, out: &mut BTreeSet<String>) {
    match pattern {
        Pattern::Value(e) => mentioned_in(e, out),
        Pattern::Or(all) | Pattern::Tuple(all, _) | Pattern::Array(all, _) => {
            all.iter().for_each(|p| in_pattern(p, out))
        }
        Pattern::Struct(path, fields, _) => {
            out.extend(path.iter().cloned());
            fields.iter().for_each(|(_, p)| in_pattern(p, out));
        }
        Pattern::Ref(inner, _) | Pattern::At(_, _, inner, _) => in_pattern(inner, out),
        Pattern::Range(low, high, _) => [low, high].into_iter().flatten().for_each(|end| mentioned_in(end, out)),
        Pattern::Name(..) | Pattern::Wild | Pattern::Rest => {}
    }
}
