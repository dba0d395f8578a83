//! Operators, with the impls that Rust and glam have of them.

use super::types::{Kind, Ty};
use super::{Checker, Deferred};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::tree::{Expr, ExprKind, IntType};
use crate::ir::{BinaryOp, Scalar, UnaryOp};

impl<'l> Checker<'l> {
    /// The type of `left op right`; `expr` is the whole.
    pub fn infer_operator(&mut self, op: BinaryOp, left: &Ty, right: &Ty, expr: &'l Expr) -> Ty {
        let unknown =
            |checker: &Self, ty: &Ty| checker.table.variable_kind(&checker.peel_refs(ty).0) == Some(Kind::Any);
        if unknown(self, left) || unknown(self, right) {
            self.solve_deferred();
        }
        let is_decided = !unknown(self, left) && self.has_one_operand(op, left);
        if !is_decided && (unknown(self, left) || unknown(self, right)) {
            let result = match op.is_comparison() {
                true => Ty::Bool,
                false => self.table.fresh(Kind::Any),
            };
            self.deferred.push(Deferred {
                op,
                left: left.clone(),
                right: right.clone(),
                result: result.clone(),
                expr,
            });
            return result;
        }
        match self.operator_result(op, left, right) {
            Some(ty) => ty,
            None => {
                self.note_operator_error(op, left, right, expr);
                if op.is_comparison() { Ty::Bool } else { Ty::Unknown }
            }
        }
    }

    /// Returns whether a type of the kernel's implements an operator for one operand alone, so that the operand's type is
    /// inferred from it.
    fn has_one_operand(&self, op: BinaryOp, left: &Ty) -> bool {
        let left = self.peel_refs(left).0;
        if !matches!(left, Ty::Struct(..) | Ty::Enum(..)) {
            return false;
        }
        let keys = super::overloads::trait_of(op)
            .zip(self.type_name(&left))
            .map(|((of, name), ty)| self.library.trait_keys(&ty, of, name).len());
        keys == Some(1)
    }

    /// Looks again at operators whose operands were not known.
    pub fn solve_deferred(&mut self) {
        loop {
            let waiting = std::mem::take(&mut self.deferred);
            let before = waiting.len();
            for Deferred {
                op,
                left,
                right,
                result,
                expr,
            } in waiting
            {
                let any = |ty: &Ty| self.table.variable_kind(&self.peel_refs(ty).0) == Some(Kind::Any);
                if any(&left) || any(&right) {
                    self.deferred.push(Deferred {
                        op,
                        left,
                        right,
                        result,
                        expr,
                    });
                    continue;
                }
                match self.operator_result(op, &left, &right) {
                    Some(ty) => self.coerce(&result, &ty, expr.span),
                    None => self.note_operator_error(op, &left, &right, expr),
                }
            }
            if self.deferred.len() == before {
                return;
            }
        }
    }

    /// Returns the type of an operator's result; `None` if it does not accept these operands.
    fn operator_result(&mut self, op: BinaryOp, left: &Ty, right: &Ty) -> Option<Ty> {
        if op.is_comparison() {
            return self.check_comparison(op, left, right).then_some(Ty::Bool);
        }
        if let Some(of) = super::overloads::trait_of(op)
            && let Some(result) = self.operator_of(of, left, right)
        {
            return Some(result);
        }
        // Numbers and vectors have operators on shared references too; on `&mut` there are none.
        let ((l, left_ref), (r, right_ref)) = (self.peel_refs(left), self.peel_refs(right));
        if left_ref == Some(true) && !matches!(l, Ty::Unknown | Ty::Param(_)) {
            return None;
        }
        if right_ref == Some(true) && !matches!(r, Ty::Unknown | Ty::Param(_)) {
            return None;
        }
        self.arithmetic_result(op, &l, &r)
    }

    fn arithmetic_result(&mut self, op: BinaryOp, l: &Ty, r: &Ty) -> Option<Ty> {
        use BinaryOp::{Add, And, Div, Mul, Or, Rem, Shl, Shr, Sub, Xor};
        match (l, r) {
            (Ty::Unknown | Ty::Param(_) | Ty::Never, _) | (_, Ty::Unknown | Ty::Param(_) | Ty::Never) => {
                // A literal that meets something unknown takes its type from the value.
                let other = if matches!(l, Ty::Unknown | Ty::Param(_) | Ty::Never) {
                    r
                } else {
                    l
                };
                self.table.unify(other, &Ty::Unknown);
                return Some(Ty::Unknown);
            }
            (Ty::Quad(a), Ty::Quad(b)) => {
                let (a, b) = (self.table.resolve_shallow(a), self.table.resolve_shallow(b));
                return self.arithmetic_result(op, &a, &b).map(|t| Ty::Quad(Box::new(t)));
            }
            (Ty::Quad(a), b) => {
                let a = self.table.resolve_shallow(a);
                return self.arithmetic_result(op, &a, b).map(|t| Ty::Quad(Box::new(t)));
            }
            (a, Ty::Quad(b)) => {
                let b = self.table.resolve_shallow(b);
                return self.arithmetic_result(op, a, &b).map(|t| Ty::Quad(Box::new(t)));
            }
            _ => {}
        }
        let narrow = |ty: &Ty| matches!(ty, Ty::Int(kind) if kind.narrow_bits().is_some());
        if matches!(op, Add | Sub | Mul | Div | Rem | Shl) && (narrow(l) || narrow(r) && op != Shl) {
            return None;
        }
        match op {
            Add | Sub | Mul | Div | Rem => match (l, r) {
                (Ty::Vector(a, n), Ty::Vector(b, m)) => (a == b && n == m && *a != Scalar::Bool).then(|| l.clone()),
                (Ty::Vector(kind, _), other) if self.is_number(other) => {
                    self.table.unify(&Ty::scalar(*kind), other).then(|| l.clone())
                }
                (other, Ty::Vector(kind, _)) if self.is_number(other) => {
                    self.table.unify(&Ty::scalar(*kind), other).then(|| r.clone())
                }
                (Ty::Matrix(n), Ty::Matrix(m)) => (n == m && matches!(op, Add | Sub | Mul)).then(|| l.clone()),
                (Ty::Matrix(n), Ty::Vector(Scalar::F32, m)) => (n == m && op == Mul).then(|| r.clone()),
                (Ty::Matrix(_), other) if self.is_number(other) => {
                    (matches!(op, Mul | Div) && self.table.unify(&Ty::Float, other)).then(|| l.clone())
                }
                (other, Ty::Matrix(_)) if self.is_number(other) => {
                    (op == Mul && self.table.unify(&Ty::Float, other)).then(|| r.clone())
                }
                _ if self.is_number(l) && self.is_number(r) => self.table.unify(l, r).then(|| l.clone()),
                _ => None,
            },
            And | Or | Xor => match (l, r) {
                (Ty::Bool, Ty::Bool) => Some(Ty::Bool),
                (Ty::Vector(a, n), Ty::Vector(b, m)) => (a == b && n == m && *a != Scalar::F32).then(|| l.clone()),
                (Ty::Vector(kind, _), other) if *kind != Scalar::F32 && self.is_integer(other) => {
                    self.table.unify(&Ty::scalar(*kind), other).then(|| l.clone())
                }
                _ if self.is_integer(l) && self.is_integer(r) => self.table.unify(l, r).then(|| l.clone()),
                _ => None,
            },
            Shl | Shr => match (l, r) {
                (Ty::Vector(kind, _), _) if *kind == Scalar::F32 => None,
                (Ty::Vector(_, n), Ty::Vector(kind, m)) => (n == m && *kind != Scalar::F32).then(|| l.clone()),
                (Ty::Vector(..), other) if self.is_integer(other) => Some(l.clone()),
                // The number of bits is of any integer type.
                _ if self.is_integer(l) && self.is_integer(r) => Some(l.clone()),
                _ => None,
            },
            _ => Some(Ty::Unknown),
        }
    }

    fn check_comparison(&mut self, op: BinaryOp, left: &Ty, right: &Ty) -> bool {
        if !self.table.unify(left, right) {
            return false;
        }
        self.observed.push(left.clone());
        self.lacks_trait(left, comparison_trait(op)).is_none()
    }

    /// The first type in a type that does not implement `PartialEq`, `PartialOrd` or `Ord`.
    pub fn lacks_trait(&mut self, ty: &Ty, of: &str) -> Option<String> {
        let library = self.library;
        let bare = self.peel_refs(ty).0;
        let (name, derives) = match &bare {
            Ty::Struct(name, _) => (name, library.structs.get(name).map(|s| &s.derives)),
            Ty::Enum(name, _) => (name, library.enums.get(name).map(|e| &e.derives)),
            Ty::Tuple(parts) => return parts.iter().find_map(|part| self.lacks_trait(part, of)),
            Ty::Array(element) => return self.lacks_trait(element, of),
            Ty::Vector(..) | Ty::Matrix(_) | Ty::Quad(_) if of != "PartialEq" => return Some(bare.to_string()),
            Ty::Float if of == "Ord" => return Some(bare.to_string()),
            _ => return None,
        };
        let known = derives.is_none_or(|derives| derives.iter().any(|derived| derived == of))
            || library.implements.contains(&(name.clone(), of.to_owned()));
        match (known, &bare) {
            (false, _) => Some(name.clone()),
            (true, Ty::Struct(_, args) | Ty::Enum(_, args)) => args.iter().find_map(|arg| self.lacks_trait(arg, of)),
            _ => None,
        }
    }

    fn is_own(&self, ty: &Ty) -> bool {
        matches!(self.peel_refs(ty).0, Ty::Struct(..) | Ty::Enum(..))
    }

    fn is_number(&self, ty: &Ty) -> bool {
        matches!(self.table.resolve_shallow(ty), Ty::Float | Ty::Int(_))
            || self.table.variable_kind(ty).is_some_and(|k| k != Kind::Any)
    }

    fn is_integer(&self, ty: &Ty) -> bool {
        matches!(self.table.resolve_shallow(ty), Ty::Int(_)) || self.table.variable_kind(ty) == Some(Kind::Integer)
    }

    fn note_operator_error(&mut self, op: BinaryOp, left: &Ty, right: &Ty, expr: &Expr) {
        let (left, right) = (self.table.resolve_deep(left), self.table.resolve_deep(right));
        let shown = |ty: &Ty| match self.table.variable_kind(ty) {
            Some(Kind::Integer) => "an integer".to_owned(),
            Some(Kind::Float) => "a float".to_owned(),
            _ => format!("`{ty}`"),
        };
        // The type may derive an order, or have one by an `impl`.
        if self.unreached && op.is_comparison() && (self.is_own(&left) || self.is_own(&right)) {
            return;
        }
        let sign = operator_symbol(op);
        let (l, r) = (shown(&left), shown(&right));
        let (message, label) = match op.is_comparison() {
            true => (
                format!("cannot compare {l} with {r} by `{sign}`"),
                "not of one type that has an order",
            ),
            false => (format!("cannot apply `{sign}` to {l} and {r}"), "not for these types"),
        };
        let mut error = Diagnostic::error_at(Code::OperatorTypes, expr.span, message).label(label);
        let help = match (&left, &right) {
            _ if op.is_comparison() && left == right && self.is_own(&left) => {
                let of = comparison_trait(op);
                Some(match self.lacks_trait(&left, of) {
                    Some(name) if !crate::front::is_prelude_type(&name) => {
                        format!("write `#[derive({of})]` before `{name}`, or compare what it holds")
                    }
                    _ => "compare what it holds".to_owned(),
                })
            }
            _ if !op.is_comparison() && (self.is_own(&left) || self.is_own(&right)) => {
                let of = super::overloads::trait_of(op).map(|(of, _)| of).unwrap_or_default();
                let named = |ty: &Ty| {
                    self.type_name(ty)
                        .filter(|name| name != "_" && !crate::front::tree::is_unnamed(name))
                };
                match (named(&left), named(&right)) {
                    (Some(l), Some(r)) if l == r => Some(format!("write an `impl {of} for {l}`")),
                    (Some(l), Some(r)) => Some(format!("write an `impl {of}<{r}> for {l}`")),
                    _ => None,
                }
            }
            (Ty::Quad(_), _) | (_, Ty::Quad(_)) if op.is_comparison() => {
                error =
                    error.note("the lanes of a quad do not run in step where one goes to another side than the next");
                Some("compare with `.gt(...)` and its like, and choose lane by lane with `select`".to_owned())
            }
            (Ty::Ref(..), Ty::Ref(..)) => Some("read what they refer to: `*`".to_owned()),
            (Ty::Ref(..), _) | (_, Ty::Ref(..)) => Some("read what it refers to: `*`".to_owned()),
            (Ty::Vector(a, _), Ty::Vector(b, _)) if a != b => Some(format!(
                "convert one of them, for example with `.as_{}()`",
                left.to_string().to_lowercase()
            )),
            (Ty::Vector(..), Ty::Vector(..)) if op.is_comparison() => Some("compare their components".to_owned()),
            (Ty::Matrix(_), Ty::Vector(Scalar::F32, _)) => Some("use `.truncate()` or `.extend(...)`".to_owned()),
            (Ty::Float, _)
                if matches!(
                    op,
                    BinaryOp::And | BinaryOp::Or | BinaryOp::Xor | BinaryOp::Shl | BinaryOp::Shr
                ) =>
            {
                Some("for the bits of a float use `to_bits()`".to_owned())
            }
            (Ty::Vector(kind, _), other) | (other, Ty::Vector(kind, _)) if self.is_number(other) => {
                Some(format!("convert the number with `as {}`", Ty::scalar(*kind)))
            }
            (Ty::Float, other) if self.table.variable_kind(other) == Some(Kind::Integer) => {
                Some("write it as a float: `2.0`".to_owned())
            }
            (other, Ty::Float) if self.table.variable_kind(other) == Some(Kind::Integer) => {
                Some("write it as a float: `2.0`".to_owned())
            }
            (Ty::Int(kind), _) | (_, Ty::Int(kind)) if !op.is_comparison() && kind.narrow_bits().is_some() => {
                let wide = Ty::scalar(kind.scalar());
                Some(format!(
                    "compute in 32 bits: `as {wide}`, and `as {}` of the result",
                    kind.name()
                ))
            }
            (Ty::Int(_) | Ty::Float, Ty::Int(_) | Ty::Float) => {
                Some(format!("convert one of them, for example with `as {left}`"))
            }
            _ => None,
        };
        if let Some(help) = help {
            error = error.help(help);
        }
        self.errors.push(error);
    }
}

/// Trait of a comparison.
fn comparison_trait(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Eq | BinaryOp::Ne => "PartialEq",
        _ => "PartialOrd",
    }
}

/// The value of an integer literal, with a minus sign before it or without.
pub fn integer_literal(expr: &Expr) -> Option<i64> {
    match &expr.kind {
        ExprKind::Int(value, _) => Some(*value),
        ExprKind::Unary(UnaryOp::Neg, operand) => integer_literal(operand).map(|value| -value),
        _ => None,
    }
}

/// Returns whether an operation on literals leaves the range of its type or divides by zero, which rustc refuses.
pub fn literals_overflow(op: BinaryOp, a: i64, b: i64, kind: IntType) -> bool {
    let result = match op {
        BinaryOp::Div | BinaryOp::Rem => return b == 0,
        BinaryOp::Add => a.checked_add(b),
        BinaryOp::Sub => a.checked_sub(b),
        BinaryOp::Mul => a.checked_mul(b),
        BinaryOp::Shl | BinaryOp::Shr => return kind != IntType::Usize && !(0..32).contains(&b),
        _ => return false,
    };
    match (result, kind) {
        (Some(n), kind) => !(kind.range().0..=kind.range().1).contains(&n),
        (None, _) => true,
    }
}

/// An operator as it is written.
pub fn operator_symbol(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Add => "+",
        BinaryOp::Sub => "-",
        BinaryOp::Mul => "*",
        BinaryOp::Div => "/",
        BinaryOp::Rem => "%",
        BinaryOp::And => "&",
        BinaryOp::Or => "|",
        BinaryOp::Xor => "^",
        BinaryOp::Shl => "<<",
        BinaryOp::Shr => ">>",
        BinaryOp::Eq => "==",
        BinaryOp::Ne => "!=",
        BinaryOp::Lt => "<",
        BinaryOp::Le => "<=",
        BinaryOp::Gt => ">",
        BinaryOp::Ge => ">=",
        _ => "this operator",
    }
}
