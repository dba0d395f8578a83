//! Expressions and statements.

use super::types::{Kind, Ty};
use super::{Around, Checker};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::breaks;
use crate::front::tree::{Block, Expr, ExprKind, ForLoop, Statement, Type};
use crate::ir::UnaryOp;

/// Parts of a type after which it is not looked at further.
const LARGEST: usize = 4096;

impl<'l> Checker<'l> {
    /// Looks at an expression where a type is wanted.
    pub fn against(&mut self, expr: &'l Expr, wanted: &Ty) {
        let found = self.expr(expr, Some(wanted));
        self.coerce(wanted, &found, expr.span);
    }

    /// Makes `found` do where `wanted` is needed, or says that it does not. A mutable reference does for a shared one.
    pub fn coerce(&mut self, wanted: &Ty, found: &Ty, span: Span) {
        let (wanted, mut found) = (self.table.shallow(wanted), self.table.shallow(found));
        if let (Ty::Ref(mutable, inner), Ty::Ref(given, target)) = (&wanted, &found) {
            if *mutable && !*given {
                return self.mismatch(&wanted, &found, span);
            }
            let mut target = self.table.shallow(target);
            // `&&T` does for `&T`.
            while let (Ty::Ref(_, next), false) =
                (&target, matches!(self.table.shallow(inner), Ty::Ref(..) | Ty::Var(_)))
            {
                target = self.table.shallow(next);
            }
            found = Ty::Ref(*mutable, Box::new(target));
        }
        if !self.table.unify(&wanted, &found) {
            self.mismatch(&wanted, &found, span);
        }
    }

    /// `mismatched types`, with what to write where that is plain.
    pub fn mismatch(&mut self, wanted: &Ty, found: &Ty, span: Span) {
        let (wanted, found) = (self.table.deep(wanted), self.table.deep(found));
        let shown = |checker: &Self, ty: &Ty| match checker.table.kind(ty) {
            Some(Kind::Integer) => "an integer".to_owned(),
            Some(Kind::Float) => "a float".to_owned(),
            _ => format!("`{ty}`"),
        };
        let (w, f) = (shown(self, &wanted), shown(self, &found));
        let mut error = Diagnostic::at(
            Code::MismatchedTypes,
            span,
            format!("mismatched types: expected {w}, found {f}"),
        )
        .label(format!("expected {w}"));
        if let Some(help) = self.conversion(&wanted, &found) {
            error = error.help(help);
        }
        self.errors.push(error);
    }

    /// Help that converts one type to another.
    fn conversion(&self, wanted: &Ty, found: &Ty) -> Option<String> {
        let number = |ty: &Ty| matches!(ty, Ty::Float | Ty::Int(_));
        Some(match (wanted, found) {
            (Ty::Ref(false, inner), other) if **inner == *other => "write `&` before it".to_owned(),
            (Ty::Ref(true, inner), other) if **inner == *other => "write `&mut` before the variable".to_owned(),
            (other, Ty::Ref(_, inner)) if **inner == *other => "read what it refers to: `*`".to_owned(),
            (Ty::Float, other) if self.table.kind(other) == Some(Kind::Integer) => {
                "write a float: `1.0`, or convert with `as f32`".to_owned()
            }
            (wanted, found) if number(wanted) && (number(found) || *found == Ty::Bool) => {
                format!("convert it with `as {wanted}`")
            }
            (Ty::Vector(kind, lanes), Ty::Vector(other, same)) if lanes == same && kind != other => {
                format!("convert it with `.as_{}()`", wanted.to_string().to_lowercase())
            }
            (Ty::Vector(_, more), Ty::Vector(_, fewer)) if more == &(fewer + 1) => {
                "add what is missing with `.extend(...)`".to_owned()
            }
            (Ty::Vector(_, fewer), Ty::Vector(_, more)) if more > fewer => {
                "leave out what is too much with `.truncate()` or `.xy()`".to_owned()
            }
            (Ty::Vector(..), found) if number(found) || self.table.kind(found).is_some() => {
                format!("write `{wanted}::splat(...)`")
            }
            (Ty::Bool, found) if number(found) => "compare it: `!= 0`".to_owned(),
            (wanted, Ty::Tuple(parts)) if parts.is_empty() && *wanted != Ty::UNIT => {
                "does a semicolon end its last line?".to_owned()
            }
            (wanted, Ty::Quad(lane)) if *wanted == **lane => {
                "for a value in each lane take `pixel: Quad<IVec2>` and give a `Quad<Vec4>`".to_owned()
            }
            _ => return None,
        })
    }

    /// A block; its last expression is wanted to be of a type.
    pub fn block(&mut self, block: &'l Block, wanted: Option<&Ty>) -> Ty {
        let mark = self.locals.len();
        let mut leaves = false;
        for statement in &block.statements {
            leaves |= self.statement(statement) == Ty::Never;
        }
        let found = match &block.value {
            Some(value) => self.expr(value, wanted),
            None if leaves => Ty::Never,
            None => Ty::UNIT,
        };
        self.locals.truncate(mark);
        found
    }

    fn statement(&mut self, statement: &'l Statement) -> Ty {
        match statement {
            Statement::Let(pattern, ty, init, span) => {
                let stated = ty.as_ref().map(|ty| self.stated(ty, *span));
                let found = match (init, stated) {
                    (Some(init), Some(stated)) => {
                        self.against(init, &stated);
                        stated
                    }
                    (Some(init), None) => self.expr(init, None),
                    (None, stated) => stated.unwrap_or_else(|| self.table.fresh(Kind::Any)),
                };
                let leaves = self.table.shallow(&found) == Ty::Never;
                self.bind_whole(pattern, &found, init.is_none());
                if init.is_some() && !leaves {
                    self.irrefutable(pattern, &found, *span);
                }
                if leaves { Ty::Never } else { Ty::UNIT }
            }
            Statement::Expr(expr) => {
                let found = self.expr(expr, None);
                self.table.shallow(&found)
            }
            Statement::Const(constant) => {
                let ty = self.stated(&constant.ty, constant.value.span);
                self.against(&constant.value, &ty);
                self.declare(&constant.name, ty, false, false, constant.value.span);
                Ty::UNIT
            }
        }
    }

    /// The type of an expression. `wanted` is a hint: literals under an `as` take it, as in rustc.
    pub fn expr(&mut self, expr: &'l Expr, wanted: Option<&Ty>) -> Ty {
        let span = expr.span;
        match &expr.kind {
            ExprKind::Int(value, suffix) => {
                let ty = match suffix {
                    Some(suffix) => Ty::Int(*suffix),
                    None => self.table.fresh(Kind::Integer),
                };
                self.integers.push((span, ty.clone(), *value));
                ty
            }
            ExprKind::Float(_, true) => Ty::Float,
            ExprKind::Float(_, false) => {
                let ty = self.table.fresh(Kind::Float);
                self.floats.push((span, ty.clone()));
                ty
            }
            ExprKind::Bool(_) => Ty::Bool,
            ExprKind::Str(_) => Ty::Str.shared(),
            ExprKind::Path(_) | ExprKind::Field(..) | ExprKind::Index(..) | ExprKind::Deref(_) => self.place(expr).0,
            ExprKind::Unary(op, operand) => self.unary(*op, operand, wanted, span),
            ExprKind::Ref(true, operand) => {
                let (ty, access) = self.place(operand);
                self.writable(access, operand, false);
                Ty::Ref(true, Box::new(ty))
            }
            ExprKind::Ref(false, operand) => {
                let inner = match wanted.map(|ty| self.table.shallow(ty)) {
                    Some(Ty::Ref(_, inner)) => Some(*inner),
                    _ => None,
                };
                self.expr(operand, inner.as_ref()).shared()
            }
            ExprKind::Binary(op, left, right) => {
                let (l, r) = (self.expr(left, None), self.expr(right, None));
                let found = self.operator(*op, &l, &r, expr);
                if let (Some(a), Some(b)) = (super::operators::literal(left), super::operators::literal(right)) {
                    self.computed.push((span, *op, [a, b], found.clone()));
                }
                found
            }
            ExprKind::Lazy(_, left, right) => {
                self.against(left, &Ty::Bool);
                self.against(right, &Ty::Bool);
                Ty::Bool
            }
            ExprKind::Assign(target, op, value) => self.assign(target, *op, value, expr),
            ExprKind::Call(path, constants, args) => self.call(path, constants, args, span),
            ExprKind::Invoke(callee, args) => self.invoked(callee, args, span),
            ExprKind::Method(receiver, name, constants, args) => self.method(receiver, name, constants, args, span),
            ExprKind::If(condition, then, otherwise, _) => {
                self.against(condition, &Ty::Bool);
                let left = self.block(then, wanted);
                match otherwise {
                    Some(otherwise) => {
                        let at = then.value.as_ref().map_or(span, |value| value.span);
                        let left = self.as_object(left, wanted, at);
                        let right = self.expr(otherwise, wanted);
                        let right = self.as_object(right, wanted, otherwise.span);
                        self.joined(left, right, otherwise.span)
                    }
                    None => {
                        let at = then.value.as_ref().map_or(span, |value| value.span);
                        self.coerce(&Ty::UNIT, &left, at);
                        Ty::UNIT
                    }
                }
            }
            ExprKind::Match(subject, arms, _) => {
                let subject = self.expr(subject, None);
                let mut all = Ty::Never;
                for arm in arms {
                    let mark = self.locals.len();
                    self.bind_whole(&arm.pattern, &subject, false);
                    if let Some(guard) = &arm.guard {
                        self.against(guard, &Ty::Bool);
                    }
                    let found = self.expr(&arm.body, wanted);
                    let found = self.as_object(found, wanted, arm.body.span);
                    self.locals.truncate(mark);
                    all = self.joined(all, found, arm.body.span);
                }
                self.exhaustive(&subject, arms, span);
                all
            }
            ExprKind::Block(block) => self.block(block, wanted),
            ExprKind::Labelled(label, block) => {
                let label = Some(label.as_str());
                self.loops.push(Around { label, block: true });
                let found = self.block(block, wanted);
                self.loops.pop();
                // A `break` out of the block continues after it.
                match self.table.shallow(&found) {
                    Ty::Never if breaks(block, label) => Ty::UNIT,
                    _ => found,
                }
            }
            ExprKind::Tuple(parts) => {
                let hints = match wanted.map(|ty| self.table.shallow(ty)) {
                    Some(Ty::Tuple(types)) if types.len() == parts.len() => types,
                    _ => Vec::new(),
                };
                let types = parts.iter().enumerate().map(|(k, part)| match hints.get(k) {
                    // A reference that is wanted may be made of another one.
                    Some(hint) if matches!(self.table.shallow(hint), Ty::Ref(..)) => {
                        self.against(part, hint);
                        hint.clone()
                    }
                    hint => self.expr(part, hint),
                });
                let types = types.collect();
                self.bounded(Ty::Tuple(types))
            }
            ExprKind::Array(parts) => {
                let element = match wanted.map(|ty| self.table.shallow(ty)) {
                    Some(Ty::Array(element)) => *element,
                    _ => self.table.fresh(Kind::Any),
                };
                parts.iter().for_each(|part| self.against(part, &element));
                self.bounded(Ty::Array(Box::new(element)))
            }
            ExprKind::Repeat(value, len) => {
                let hint = match wanted.map(|ty| self.table.shallow(ty)) {
                    Some(Ty::Array(element)) => Some(*element),
                    _ => None,
                };
                let element = self.expr(value, hint.as_ref());
                self.against(len, &Ty::USIZE);
                Ty::Array(Box::new(element))
            }
            ExprKind::Struct(path, fields, rest) => self.structure(path, fields, rest.as_deref()),
            ExprKind::Cast(value, ty) => self.cast(value, ty, span),
            ExprKind::Range(start, end, _) => {
                let ty = self.expr(start, None);
                let other = self.expr(end, None);
                self.coerce(&ty, &other, end.span);
                Ty::Range(Box::new(ty))
            }
            ExprKind::For(f) => self.for_(f),
            ExprKind::While(condition, body, label, _) => {
                self.loops.push(Around {
                    label: label.as_deref(),
                    block: false,
                });
                self.against(condition, &Ty::Bool);
                let found = self.block(body, None);
                self.loops.pop();
                let at = body.value.as_ref().map_or(span, |value| value.span);
                self.coerce(&Ty::UNIT, &found, at);
                // A `while true` without a `break` of its own only ends by a `return` or by a `break` of a loop around it.
                if matches!(condition.kind, ExprKind::Bool(true)) && !breaks(body, label.as_deref()) {
                    Ty::Never
                } else {
                    Ty::UNIT
                }
            }
            ExprKind::Try(value) => self.tried(value, span),
            ExprKind::Return(value) => {
                let wanted = self.result.clone();
                match value {
                    Some(value) => self.against(value, &wanted),
                    None => self.coerce(&wanted, &Ty::UNIT, span),
                }
                Ty::Never
            }
            ExprKind::Break(label) => self.leaves_loop("break", label.as_deref(), span),
            ExprKind::Continue(label) => self.leaves_loop("continue", label.as_deref(), span),
            ExprKind::Closure(closure) => self.closure(closure, wanted, span),
            ExprKind::Assert(condition, _) => {
                self.against(condition, &Ty::Bool);
                Ty::UNIT
            }
        }
    }

    /// A type that is not too large to be looked at; the evaluator refuses values of so many parts.
    fn bounded(&mut self, ty: Ty) -> Ty {
        if self.table.size(&ty, LARGEST) > LARGEST {
            Ty::Unknown
        } else {
            ty
        }
    }

    /// The type of an arm where `&dyn Trait` is wanted: each arm may refer to another type.
    fn as_object(&mut self, found: Ty, wanted: Option<&Ty>, span: Span) -> Ty {
        let Some(wanted) = wanted.map(|ty| self.table.shallow(ty)) else {
            return found;
        };
        let is_object = |ty: &Ty| matches!(ty, Ty::Param(name) if name.starts_with("dyn "));
        match &wanted {
            Ty::Ref(_, inner) if is_object(&self.table.shallow(inner)) && self.table.shallow(&found) != Ty::Never => {
                self.coerce(&wanted, &found, span);
                wanted
            }
            _ => found,
        }
    }

    /// The type of what is one of two values.
    fn joined(&mut self, left: Ty, right: Ty, span: Span) -> Ty {
        match (self.table.shallow(&left), self.table.shallow(&right)) {
            (Ty::Never, _) => right,
            (_, Ty::Never) => left,
            // A mutable reference on one side is a shared one if the other side is.
            (Ty::Ref(true, a), Ty::Ref(false, b)) => {
                self.coerce(&b, &a, span);
                right
            }
            _ => {
                self.coerce(&left, &right, span);
                left
            }
        }
    }

    fn unary(&mut self, op: UnaryOp, operand: &'l Expr, wanted: Option<&Ty>, span: Span) -> Ty {
        let found = self.expr(operand, wanted);
        let (bare, _) = self.peeled(&found);
        if let Some(result) = self.unary_of(op, &bare) {
            return result;
        }
        let fits = match (op, &bare) {
            (UnaryOp::Neg, Ty::Bool | Ty::Array(_) | Ty::Tuple(_) | Ty::Struct(..) | Ty::Enum(..)) => false,
            (UnaryOp::Neg, Ty::Vector(kind, _)) => *kind != crate::ir::Scalar::U32,
            (UnaryOp::Not, Ty::Float | Ty::Array(_) | Ty::Tuple(_) | Ty::Struct(..) | Ty::Enum(..) | Ty::Matrix(_)) => {
                false
            }
            (UnaryOp::Not, Ty::Vector(kind, _)) => *kind != crate::ir::Scalar::F32,
            (UnaryOp::Not, other) => self.table.kind(other) != Some(Kind::Float),
            _ => true,
        };
        if !fits {
            let sign = if op == UnaryOp::Neg { "-" } else { "!" };
            self.errors.push(
                Diagnostic::at(
                    Code::OperatorTypes,
                    span,
                    format!("cannot apply unary operator `{sign}` to type `{bare}`"),
                )
                .label("not for this type"),
            );
            return Ty::Unknown;
        }
        if op == UnaryOp::Neg {
            self.negated.push((span, bare.clone(), operand.span));
        }
        bare
    }

    fn cast(&mut self, value: &'l Expr, ty: &'l Type, span: Span) -> Ty {
        let target = self.stated(ty, span);
        if matches!(target, Ty::Fn(..)) {
            self.against(value, &target);
            return target;
        }
        let found = self.expr(value, Some(&target));
        self.observed.push(found.clone());
        // A literal under a cast is of that type, if it can be.
        if self.is_literal(value) {
            let kind = self.table.kind(&found);
            if kind == Some(Kind::Integer) && matches!(target, Ty::Int(_))
                || kind == Some(Kind::Float) && target == Ty::Float
            {
                self.table.unify(&found, &target);
            }
        }
        match self.table.shallow(&found) {
            Ty::Bool if target == Ty::Float => {
                self.errors.push(
                    Diagnostic::at(Code::Cast, span, "casting `bool` as `f32` is invalid")
                        .label("not a number")
                        .help("cast through an integer: `as u32 as f32`"),
                );
            }
            found @ (Ty::Vector(..)
            | Ty::Matrix(_)
            | Ty::Array(_)
            | Ty::Tuple(_)
            | Ty::Struct(..)
            | Ty::Enum(..)
            | Ty::Ref(..)) => {
                let help = match found {
                    Ty::Vector(..) => "vectors convert with `.as_vec2()`, `.as_ivec3()`, ...",
                    Ty::Ref(..) => "read what it refers to: `*`",
                    _ => "convert its parts",
                };
                self.errors.push(
                    Diagnostic::at(Code::Cast, span, format!("non-primitive cast: `{found}` as `{target}`"))
                        .label("not one number")
                        .help(help),
                );
            }
            _ => {}
        }
        target
    }

    /// Returns whether an expression is a literal, with signs before it or in parentheses, which takes its type from the cast around it.
    fn is_literal(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::Int(_, None) | ExprKind::Float(_, false) => true,
            ExprKind::Unary(_, operand) => self.is_literal(operand),
            ExprKind::Block(block) => block.value.as_ref().is_some_and(|value| self.is_literal(value)),
            _ => false,
        }
    }

    /// `break` or `continue`, of a loop that is around it.
    fn leaves_loop(&mut self, word: &str, label: Option<&str>, span: Span) -> Ty {
        let target = match label {
            None => self.loops.last(),
            Some(_) => self.loops.iter().rev().find(|around| around.label == label),
        };
        let in_block = target.is_some_and(|around| around.block);
        let error = match label {
            None if in_block => Diagnostic::at(
                Code::Leaving,
                span,
                format!("`{word}` without a label in a block with a label"),
            )
            .label("of the loop, or of the block?")
            .help("write the label of what it is to leave"),
            Some(label) if in_block && word == "continue" => Diagnostic::at(
                Code::Leaving,
                span,
                format!("`continue` of the block `'{label}`, which is no loop"),
            )
            .label("a block has no next iteration")
            .help(format!("write `break '{label}`")),
            None if self.loops.is_empty() => Diagnostic::at(Code::Leaving, span, format!("`{word}` outside of a loop"))
                .label("no loop is around it")
                .help("`return` leaves a function"),
            Some(label) if target.is_none() => {
                let labels = self.loops.iter().filter_map(|around| around.label);
                let known: Vec<String> = labels.map(|label| format!("'{label}")).collect();
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                let help = crate::suggest::suggest(&format!("'{label}"), &known, "labels around it are");
                Diagnostic::at(Code::UnknownLabel, span, format!("cannot find the label `'{label}`"))
                    .label("not found")
                    .help(help)
            }
            _ => return Ty::Never,
        };
        self.errors.push(error);
        Ty::Never
    }

    fn for_(&mut self, f: &'l ForLoop) -> Ty {
        let over = self.expr(&f.over, None);
        self.solve();
        let item = match self.table.shallow(&over) {
            Ty::Range(t) | Ty::Iter(t) | Ty::Array(t) => *t,
            Ty::Ref(mutable, inner) => match self.table.shallow(&inner) {
                Ty::Array(t) => Ty::Ref(mutable, t),
                Ty::Range(t) | Ty::Iter(t) => *t,
                _ => Ty::Unknown,
            },
            _ => Ty::Unknown,
        };
        let mark = self.locals.len();
        self.bind_whole(&f.pattern, &item, false);
        self.irrefutable(&f.pattern, &item, f.over.span);
        self.loops.push(Around {
            label: f.label.as_deref(),
            block: false,
        });
        let found = self.block(&f.body, None);
        self.loops.pop();
        let at = f.body.value.as_ref().map_or(f.over.span, |value| value.span);
        self.coerce(&Ty::UNIT, &found, at);
        self.locals.truncate(mark);
        Ty::UNIT
    }
}
