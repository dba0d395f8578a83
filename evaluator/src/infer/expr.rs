//! Expressions and statements.

use super::types::{Kind, Ty};
use super::{Around, Checker};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::has_break;
use crate::front::tree::{Block, Expr, ExprKind, ForLoop, Statement, Type};
use crate::ir::UnaryOp;

/// Parts of a type after which it is not looked at further.
const LARGEST: usize = 4096;

impl<'l> Checker<'l> {
    /// Looks at an expression where a type is wanted.
    pub fn check_expr(&mut self, expr: &'l Expr, wanted: &Ty) {
        let found = self.infer_expr(expr, Some(wanted));
        self.coerce(wanted, &found, expr.span);
    }

    /// Makes `found` do where `wanted` is needed, or says that it does not. A mutable reference does for a shared one.
    pub fn coerce(&mut self, wanted: &Ty, found: &Ty, span: Span) {
        let (wanted, mut found) = (self.table.resolve_shallow(wanted), self.table.resolve_shallow(found));
        if let (Ty::Ref(mutable, inner), Ty::Ref(given, target)) = (&wanted, &found) {
            if *mutable && !*given {
                return self.note_mismatch(&wanted, &found, span);
            }
            let mut target = self.table.resolve_shallow(target);
            // `&&T` does for `&T`.
            while let (Ty::Ref(_, next), false) = (
                &target,
                matches!(self.table.resolve_shallow(inner), Ty::Ref(..) | Ty::Var(_)),
            ) {
                target = self.table.resolve_shallow(next);
            }
            found = Ty::Ref(*mutable, Box::new(target));
        }
        if !self.table.unify(&wanted, &found) {
            self.note_mismatch(&wanted, &found, span);
        }
    }

    /// `mismatched types`, with what to write where that is plain.
    pub fn note_mismatch(&mut self, wanted: &Ty, found: &Ty, span: Span) {
        let (wanted, found) = (self.table.resolve_deep(wanted), self.table.resolve_deep(found));
        let shown = |checker: &Self, ty: &Ty| match checker.table.variable_kind(ty) {
            Some(Kind::Integer) => "an integer".to_owned(),
            Some(Kind::Float) => "a float".to_owned(),
            _ => format!("`{ty}`"),
        };
        let (w, f) = (shown(self, &wanted), shown(self, &found));
        let mut error = Diagnostic::error_at(
            Code::MismatchedTypes,
            span,
            format!("mismatched types: expected {w}, found {f}"),
        )
        .label(format!("expected {w}"));
        if let Some(help) = self.conversion_help(&wanted, &found) {
            error = error.help(help);
        }
        self.errors.push(error);
    }

    /// Help that converts one type to another.
    fn conversion_help(&self, wanted: &Ty, found: &Ty) -> Option<String> {
        let number = |ty: &Ty| matches!(ty, Ty::Float | Ty::Int(_));
        Some(match (wanted, found) {
            (Ty::Ref(false, inner), other) if **inner == *other => "write `&` before it".to_owned(),
            (Ty::Ref(true, inner), other) if **inner == *other => "write `&mut` before the variable".to_owned(),
            (other, Ty::Ref(_, inner)) if **inner == *other => "read what it refers to: `*`".to_owned(),
            (Ty::Float, other) if self.table.variable_kind(other) == Some(Kind::Integer) => {
                "write a float: `1.0`, or convert with `as f32`".to_owned()
            }
            (Ty::Float, Ty::Bool) => "choose by it: `if condition { 1.0 } else { 0.0 }`".to_owned(),
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
            (Ty::Vector(..), found) if number(found) || self.table.variable_kind(found).is_some() => {
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
    pub fn infer_block(&mut self, block: &'l Block, wanted: Option<&Ty>) -> Ty {
        let mark = self.locals.len();
        let mut leaves = false;
        for statement in &block.statements {
            leaves |= self.infer_statement(statement) == Ty::Never;
        }
        let found = match &block.value {
            Some(value) => self.infer_expr(value, wanted),
            None if leaves => Ty::Never,
            None => Ty::UNIT,
        };
        self.locals.truncate(mark);
        found
    }

    fn infer_statement(&mut self, statement: &'l Statement) -> Ty {
        match statement {
            Statement::Let(pattern, ty, init, span) => {
                let stated = ty.as_ref().map(|ty| self.convert_type(ty, *span));
                let found = match (init, stated) {
                    (Some(init), Some(stated)) => {
                        self.check_expr(init, &stated);
                        stated
                    }
                    (Some(init), None) => self.infer_expr(init, None),
                    (None, stated) => stated.unwrap_or_else(|| self.table.fresh(Kind::Any)),
                };
                let leaves = self.table.resolve_shallow(&found) == Ty::Never;
                self.bind_whole(pattern, &found, init.is_none());
                if init.is_some() && !leaves {
                    self.check_irrefutable(pattern, &found, *span);
                }
                if leaves { Ty::Never } else { Ty::UNIT }
            }
            Statement::Expr(expr) => {
                let found = self.infer_expr(expr, None);
                self.table.resolve_shallow(&found)
            }
            Statement::Const(constant) => {
                let ty = self.convert_type(&constant.ty, constant.value.span);
                self.check_expr(&constant.value, &ty);
                self.declare_local(&constant.name, ty, false, false, constant.value.span);
                Ty::UNIT
            }
        }
    }

    /// The type of an expression. `wanted` is a hint: literals under an `as` take it, as in rustc.
    pub fn infer_expr(&mut self, expr: &'l Expr, wanted: Option<&Ty>) -> Ty {
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
            ExprKind::Str(_) => Ty::Str.into_shared_ref(),
            ExprKind::Path(_) | ExprKind::Field(..) | ExprKind::Index(..) | ExprKind::Deref(_) => {
                self.infer_place(expr).0
            }
            ExprKind::Slice(..) => self.infer_slice_value(expr),
            ExprKind::Unary(op, operand) => self.infer_unary(*op, operand, wanted, span),
            ExprKind::Ref(true, operand) => {
                let (ty, access) = self.infer_place(operand);
                self.check_writable(access, operand, false);
                Ty::Ref(true, Box::new(ty))
            }
            ExprKind::Ref(false, operand) => {
                let inner = match wanted.map(|ty| self.table.resolve_shallow(ty)) {
                    Some(Ty::Ref(_, inner)) => Some(*inner),
                    _ => None,
                };
                self.infer_unsized(operand, inner.as_ref()).into_shared_ref()
            }
            ExprKind::Binary(op, left, right) => {
                let (l, r) = (self.infer_unsized(left, None), self.infer_unsized(right, None));
                let found = self.infer_operator(*op, &l, &r, expr);
                if let (Some(a), Some(b)) = (
                    super::operators::integer_literal(left),
                    super::operators::integer_literal(right),
                ) {
                    self.computed.push((span, *op, [a, b], found.clone()));
                }
                found
            }
            ExprKind::Lazy(_, left, right) => {
                self.check_expr(left, &Ty::Bool);
                self.check_expr(right, &Ty::Bool);
                Ty::Bool
            }
            ExprKind::Assign(target, op, value) => self.infer_assign(target, *op, value, expr),
            ExprKind::Call(path, constants, args) => self.infer_call(path, constants, args, span),
            ExprKind::Invoke(callee, args) => self.infer_invoke(callee, args, span),
            ExprKind::Method(receiver, name, constants, args) => {
                self.infer_method_call(receiver, name, constants, args, span)
            }
            ExprKind::If(condition, then, otherwise, _) => {
                self.check_expr(condition, &Ty::Bool);
                let left = self.infer_block(then, wanted);
                match otherwise {
                    Some(otherwise) => {
                        let at = then.value.as_ref().map_or(span, |value| value.span);
                        let left = self.as_object(left, wanted, at);
                        let right = self.infer_expr(otherwise, wanted);
                        let right = self.as_object(right, wanted, otherwise.span);
                        self.join_types(left, right, otherwise.span)
                    }
                    None => {
                        let at = then.value.as_ref().map_or(span, |value| value.span);
                        self.coerce(&Ty::UNIT, &left, at);
                        Ty::UNIT
                    }
                }
            }
            ExprKind::Match(subject, arms, _) => {
                let subject = self.infer_unsized(subject, None);
                let mut all = Ty::Never;
                for arm in arms {
                    let mark = self.locals.len();
                    self.bind_whole(&arm.pattern, &subject, false);
                    if let Some(guard) = &arm.guard {
                        self.check_expr(guard, &Ty::Bool);
                    }
                    let found = self.infer_expr(&arm.body, wanted);
                    let found = self.as_object(found, wanted, arm.body.span);
                    self.locals.truncate(mark);
                    all = self.join_types(all, found, arm.body.span);
                }
                self.check_exhaustive(&subject, arms, span);
                all
            }
            ExprKind::Block(block) => self.infer_block(block, wanted),
            ExprKind::Labelled(label, block) => {
                let label = Some(label.as_str());
                self.loops.push(Around { label, block: true });
                let found = self.infer_block(block, wanted);
                self.loops.pop();
                // A `break` out of the block continues after it.
                match self.table.resolve_shallow(&found) {
                    Ty::Never if has_break(block, label) => Ty::UNIT,
                    _ => found,
                }
            }
            ExprKind::Tuple(parts) => {
                let hints = match wanted.map(|ty| self.table.resolve_shallow(ty)) {
                    Some(Ty::Tuple(types)) if types.len() == parts.len() => types,
                    _ => Vec::new(),
                };
                let types = parts.iter().enumerate().map(|(k, part)| match hints.get(k) {
                    // A reference that is wanted may be made of another one.
                    Some(hint) if matches!(self.table.resolve_shallow(hint), Ty::Ref(..)) => {
                        self.check_expr(part, hint);
                        hint.clone()
                    }
                    hint => self.infer_expr(part, hint),
                });
                let types = types.collect();
                self.limit_type_size(Ty::Tuple(types))
            }
            ExprKind::Array(parts) => {
                let element = match wanted.map(|ty| self.table.resolve_shallow(ty)) {
                    Some(Ty::Array(element)) => *element,
                    _ => self.table.fresh(Kind::Any),
                };
                parts.iter().for_each(|part| self.check_expr(part, &element));
                self.limit_type_size(Ty::Array(Box::new(element)))
            }
            ExprKind::Repeat(value, len) => {
                let hint = match wanted.map(|ty| self.table.resolve_shallow(ty)) {
                    Some(Ty::Array(element)) => Some(*element),
                    _ => None,
                };
                let element = self.infer_expr(value, hint.as_ref());
                self.check_expr(len, &Ty::USIZE);
                Ty::Array(Box::new(element))
            }
            ExprKind::Struct(path, fields, rest) => self.infer_struct(path, fields, rest.as_deref()),
            ExprKind::Cast(value, ty) => self.infer_cast(value, ty, span),
            ExprKind::Range(start, end, _) => {
                let ty = self.infer_expr(start, None);
                let other = self.infer_expr(end, None);
                self.coerce(&ty, &other, end.span);
                Ty::Range(Box::new(ty))
            }
            ExprKind::For(f) => self.infer_for(f),
            ExprKind::While(condition, body, label, _) => {
                self.loops.push(Around {
                    label: label.as_deref(),
                    block: false,
                });
                self.check_expr(condition, &Ty::Bool);
                let found = self.infer_block(body, None);
                self.loops.pop();
                let at = body.value.as_ref().map_or(span, |value| value.span);
                self.coerce(&Ty::UNIT, &found, at);
                // A `while true` without a `break` of its own only ends by a `return` or by a `break` of a loop around it.
                if matches!(condition.kind, ExprKind::Bool(true)) && !has_break(body, label.as_deref()) {
                    Ty::Never
                } else {
                    Ty::UNIT
                }
            }
            ExprKind::Try(value) => self.infer_try(value, span),
            ExprKind::Return(value) => {
                let wanted = self.result.clone();
                match value {
                    Some(value) => self.check_expr(value, &wanted),
                    None => self.coerce(&wanted, &Ty::UNIT, span),
                }
                Ty::Never
            }
            ExprKind::Break(label) => self.leaves_loop("break", label.as_deref(), span),
            ExprKind::Continue(label) => self.leaves_loop("continue", label.as_deref(), span),
            ExprKind::Closure(closure) => self.infer_closure(closure, wanted, span),
            ExprKind::Unreachable => Ty::Never,
            ExprKind::Assert { condition, .. } => {
                self.check_expr(condition, &Ty::Bool);
                Ty::UNIT
            }
        }
    }

    /// A type that is not too large to be looked at; the evaluator refuses values of so many parts.
    fn limit_type_size(&mut self, ty: Ty) -> Ty {
        if self.table.size(&ty, LARGEST) > LARGEST {
            Ty::Unknown
        } else {
            ty
        }
    }

    /// The type of an arm where `&dyn Trait` is wanted: each arm may refer to another type.
    fn as_object(&mut self, found: Ty, wanted: Option<&Ty>, span: Span) -> Ty {
        let Some(wanted) = wanted.map(|ty| self.table.resolve_shallow(ty)) else {
            return found;
        };
        let is_object = |ty: &Ty| matches!(ty, Ty::Param(name) if name.starts_with("dyn "));
        match &wanted {
            Ty::Ref(_, inner)
                if is_object(&self.table.resolve_shallow(inner)) && self.table.resolve_shallow(&found) != Ty::Never =>
            {
                self.coerce(&wanted, &found, span);
                wanted
            }
            _ => found,
        }
    }

    /// The type of what is one of two values.
    fn join_types(&mut self, left: Ty, right: Ty, span: Span) -> Ty {
        match (self.table.resolve_shallow(&left), self.table.resolve_shallow(&right)) {
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

    fn infer_unary(&mut self, op: UnaryOp, operand: &'l Expr, wanted: Option<&Ty>, span: Span) -> Ty {
        let found = self.infer_expr(operand, wanted);
        let (bare, _) = self.peel_refs(&found);
        if let Some(result) = self.unary_of(op, &bare) {
            return result;
        }
        let fits = match (op, &bare) {
            (UnaryOp::Neg, Ty::Bool | Ty::Array(_) | Ty::Tuple(_) | Ty::Struct(..) | Ty::Enum(..)) => false,
            (UnaryOp::Neg, Ty::Vector(kind, _)) => *kind != crate::ir::Scalar::U32,
            (UnaryOp::Not, Ty::Float | Ty::Array(_) | Ty::Tuple(_) | Ty::Struct(..) | Ty::Enum(..) | Ty::Matrix(_)) => {
                false
            }
            (UnaryOp::Not, Ty::Int(kind)) => kind.narrow_bits().is_none(),
            (UnaryOp::Not, Ty::Vector(kind, _)) => *kind != crate::ir::Scalar::F32,
            (UnaryOp::Not, other) => self.table.variable_kind(other) != Some(Kind::Float),
            _ => true,
        };
        if !fits {
            let sign = if op == UnaryOp::Neg { "-" } else { "!" };
            let message = format!("cannot apply unary operator `{sign}` to type `{bare}`");
            let error = Diagnostic::error_at(Code::OperatorTypes, span, message).label("not for this type");
            self.errors.push(match bare {
                Ty::Int(kind) => error.help(format!("compute in 32 bits: `!(x as u32) as {}`", kind.name())),
                _ => error,
            });
            return Ty::Unknown;
        }
        if op == UnaryOp::Neg {
            self.negated.push((span, bare.clone(), operand.span));
        }
        bare
    }

    fn infer_cast(&mut self, value: &'l Expr, ty: &'l Type, span: Span) -> Ty {
        let target = self.convert_type(ty, span);
        if matches!(target, Ty::Fn(..)) {
            self.check_expr(value, &target);
            return target;
        }
        let found = self.infer_expr(value, Some(&target));
        self.observed.push(found.clone());
        // A literal under a cast is of that type, if it can be.
        if self.is_literal(value) {
            let kind = self.table.variable_kind(&found);
            if kind == Some(Kind::Integer) && matches!(target, Ty::Int(_))
                || kind == Some(Kind::Float) && target == Ty::Float
            {
                self.table.unify(&found, &target);
            }
        }
        match self.table.resolve_shallow(&found) {
            Ty::Bool if target == Ty::Float => {
                self.errors.push(
                    Diagnostic::error_at(Code::Cast, span, "casting `bool` as `f32` is invalid")
                        .label("not a number")
                        .help("cast through an integer: `as u32 as f32`"),
                );
            }
            Ty::Enum(name, _) if matches!(target, Ty::Int(_)) && self.is_fieldless(&name) => {}
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
                    Ty::Enum(..) if target == Ty::Float => "cast through an integer: `as i32 as f32`",
                    Ty::Enum(..) => "give the number by a `match` on the variants",
                    _ => "convert its parts",
                };
                self.errors.push(
                    Diagnostic::error_at(Code::Cast, span, format!("non-primitive cast: `{found}` as `{target}`"))
                        .label("not one number")
                        .help(help),
                );
            }
            _ => {}
        }
        target
    }

    /// Returns whether no variant of an enum has fields, so that it can be cast.
    fn is_fieldless(&self, name: &str) -> bool {
        let definition = self.library.enums.get(name);
        definition.is_some_and(|definition| definition.variants.iter().all(|variant| variant.fields.is_empty()))
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
            None if in_block => Diagnostic::error_at(
                Code::Leaving,
                span,
                format!("`{word}` without a label in a block with a label"),
            )
            .label("of the loop, or of the block?")
            .help("write the label of what it is to leave"),
            Some(label) if in_block && word == "continue" => Diagnostic::error_at(
                Code::Leaving,
                span,
                format!("`continue` of the block `'{label}`, which is no loop"),
            )
            .label("a block has no next iteration")
            .help(format!("write `break '{label}`")),
            None if self.loops.is_empty() => {
                Diagnostic::error_at(Code::Leaving, span, format!("`{word}` outside of a loop"))
                    .label("no loop is around it")
                    .help("`return` leaves a function")
            }
            Some(label) if target.is_none() => {
                let labels = self.loops.iter().filter_map(|around| around.label);
                let known: Vec<String> = labels.map(|label| format!("'{label}")).collect();
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                let help = crate::suggest::suggest_name(&format!("'{label}"), &known, "labels around it are");
                Diagnostic::error_at(Code::UnknownLabel, span, format!("cannot find the label `'{label}`"))
                    .label("not found")
                    .help(help)
            }
            _ => return Ty::Never,
        };
        self.errors.push(error);
        Ty::Never
    }

    fn infer_for(&mut self, f: &'l ForLoop) -> Ty {
        let over = self.infer_expr(&f.over, None);
        self.solve_deferred();
        let item = match self.table.resolve_shallow(&over) {
            Ty::Range(t) | Ty::Iter(t) | Ty::Array(t) => *t,
            Ty::Struct(name, args) if name == "__Filtered" && args.len() == 1 => args[0].clone(),
            Ty::Ref(mutable, inner) => match self.table.resolve_shallow(&inner) {
                Ty::Array(t) => Ty::Ref(mutable, t),
                Ty::Range(t) | Ty::Iter(t) => *t,
                _ => Ty::Unknown,
            },
            _ => Ty::Unknown,
        };
        let mark = self.locals.len();
        self.bind_whole(&f.pattern, &item, false);
        self.check_irrefutable(&f.pattern, &item, f.over.span);
        self.loops.push(Around {
            label: f.label.as_deref(),
            block: false,
        });
        let found = self.infer_block(&f.body, None);
        self.loops.pop();
        let at = f.body.value.as_ref().map_or(f.over.span, |value| value.span);
        self.coerce(&Ty::UNIT, &found, at);
        self.locals.truncate(mark);
        Ty::UNIT
    }
}
