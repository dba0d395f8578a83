//! Names, fields, elements and references: their types, and whether they may be written.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, ExprKind, IntType, Type};
use crate::ir::{BinaryOp, Scalar};
use std::collections::HashMap;

/// Permission to write a place.
#[derive(Clone, Debug)]
pub enum Access {
    /// Can be written.
    Writable,
    /// A variable that is not `mut`: its name, where it is declared, and whether it was declared without a value.
    Immutable(String, Span, bool),
    /// A part of an immutable variable.
    Part(String, Span),
    /// Behind a shared reference.
    Shared,
}

impl<'l> Checker<'l> {
    /// The type of an expression that may be a place, and whether that may be written.
    pub fn infer_place(&mut self, expr: &'l Expr) -> (Ty, Access) {
        match &expr.kind {
            ExprKind::Path(path) => self.infer_path(path, expr.span),
            ExprKind::Field(base, name) => {
                let (base, access) = self.infer_place(base);
                let (bare, access) = self.peel_base(&base, access);
                (self.infer_field(&bare, name, expr.span), access)
            }
            ExprKind::Index(base, index) => {
                let (base, access) = self.infer_place(base);
                let (bare, access) = self.peel_base(&base, access);
                let found = self.infer_expr(index, None);
                (self.infer_element(&bare, &found, index), access)
            }
            ExprKind::Slice(base, bounds) => {
                let (base, access) = self.infer_place(base);
                let (bare, access) = self.peel_base(&base, access);
                for end in bounds.ends() {
                    let found = self.infer_expr(end, None);
                    self.check_index(&bare, &found, end);
                }
                (self.slice_type(&bare, expr.span), access)
            }
            ExprKind::Deref(reference) => {
                let (ty, access) = self.infer_place(reference);
                match self.table.resolve_shallow(&ty) {
                    Ty::Ref(true, inner) => (*inner, Access::Writable),
                    Ty::Ref(false, inner) => (*inner, Access::Shared),
                    Ty::Unknown | Ty::Var(_) | Ty::Param(_) => (Ty::Unknown, access),
                    other => {
                        self.errors.push(
                            Diagnostic::error_at(
                                Code::OperatorTypes,
                                expr.span,
                                format!("type `{}` cannot be dereferenced", self.table.resolve_deep(&other)),
                            )
                            .label("not a reference")
                            .help("leave out the `*`"),
                        );
                        (other, access)
                    }
                }
            }
            _ => (self.infer_expr(expr, None), Access::Writable),
        }
    }

    /// A type without the references around it, and whether the outermost of them are all `&mut`.
    pub fn peel_refs(&self, ty: &Ty) -> (Ty, Option<bool>) {
        let (mut ty, mut mutable) = (self.table.resolve_shallow(ty), None);
        while let Ty::Ref(m, inner) = &ty {
            mutable = Some(mutable.unwrap_or(true) && *m);
            ty = self.table.resolve_shallow(inner);
        }
        (ty, mutable)
    }

    /// Returns the type of the value that a field or an element belongs to, behind any references.
    fn peel_base(&mut self, base: &Ty, access: Access) -> (Ty, Access) {
        if self.table.variable_kind(base) == Some(Kind::Any) {
            self.solve_deferred();
        }
        let (bare, reference) = self.peel_refs(base);
        let access = match (reference, access) {
            (Some(true), _) => Access::Writable,
            (Some(false), _) => Access::Shared,
            (None, Access::Immutable(name, span, _)) => Access::Part(name, span),
            (None, access) => access,
        };
        (bare, access)
    }

    /// A variable, a constant or a variant.
    fn infer_path(&mut self, path: &'l [String], span: Span) -> (Ty, Access) {
        if let [name] = path
            && let Some(local) = self.locals.iter().rev().find(|local| local.name == *name)
        {
            let access = match local.mutable {
                true => Access::Writable,
                false => Access::Immutable(name.clone(), local.span, local.deferred),
            };
            return (local.ty.clone(), access);
        }
        if let [of, name] = path
            && self.params.iter().any(|param| param == of)
        {
            let found = self.constant_of(of, name, span);
            if found.is_none() && self.declared_of(of, name).is_none() {
                self.no_member(of, name, span);
            }
            return (found.unwrap_or(Ty::Unknown), Access::Writable);
        }
        // An associated type of a type parameter, which only the evaluator knows.
        if path.first().is_some_and(|of| of.contains("::")) {
            return (Ty::Unknown, Access::Writable);
        }
        let joined = path.join("::");
        let last = path.last().map(String::as_str).unwrap_or_default();
        let library = self.library;
        if let [of, name] = path
            && !library.broken.contains(&joined)
            && let Some(found) = self.constant_by_type(of, name, span)
        {
            return (found, Access::Writable);
        }
        if library.find_variant(path).is_some()
            && let Some((ty, fields, types)) = self.made_by(path)
        {
            if let Some((field, ..)) = fields.first().filter(|(name, ..)| name.parse::<usize>().is_err()) {
                self.errors.push(
                    Diagnostic::error_at(
                        Code::VariantForm,
                        span,
                        format!("expected value, found struct variant `{}`", path.join("::")),
                    )
                    .label("not a value")
                    .help(format!("write `{} {{ {field}: ... }}`", path.join("::"))),
                );
            }
            // A variant that holds values is a function of them.
            let made = match types.is_empty() {
                true => ty,
                false => Ty::Fn(types, Box::new(ty)),
            };
            return (made, Access::Writable);
        }
        if library.structs.get(last).is_some_and(|s| s.fields.is_empty())
            && let Some((ty, ..)) = self.made_by(path)
        {
            return (ty, Access::Writable);
        }
        if library.broken.contains(&joined) || library.broken.contains(last) {
            return (Ty::Unknown, Access::Writable);
        }
        if library.is_tuple_structure(last)
            && let Some((ty, _, types)) = self.made_by(path)
        {
            return (Ty::Fn(types, Box::new(ty)), Access::Writable);
        }
        if let Some(constant) = library.consts.get(&joined).or_else(|| library.consts.get(last)) {
            return (self.field_type(&constant.ty, constant.value.span), Access::Writable);
        }
        if let Some(function) = self.function_value(path, span) {
            return (function, Access::Writable);
        }
        let known = known_constant(path);
        if let ([.., of, _], Ty::Unknown) = (path, &known) {
            self.no_type(of, span);
        }
        if let ([name], Ty::Unknown) = (path, &known)
            && !library.has_type(name)
        {
            let names: Vec<&str> = self.locals.iter().map(|local| local.name.as_str()).collect();
            self.errors.push(
                Diagnostic::error_at(Code::UnknownName, span, format!("cannot find `{name}`"))
                    .label("not found")
                    .help(crate::suggest::suggest_name(name, &names, "variables here are")),
            );
        }
        (known, Access::Writable)
    }

    /// The type that another item states, whose errors are that item's.
    pub fn field_type(&mut self, ty: &'l Type, span: Span) -> Ty {
        let errors = self.errors.len();
        let ty = self.substitute_type(ty, &HashMap::new(), span);
        self.errors.truncate(errors);
        ty
    }

    fn infer_field(&mut self, base: &Ty, name: &str, span: Span) -> Ty {
        let found = self.known_field(base, name);
        let fields = match base {
            Ty::Var(_) if self.table.variable_kind(base) == Some(Kind::Any) => return found,
            Ty::Unknown | Ty::Param(_) | Ty::Never => return found,
            Ty::Vector(_, lanes) => ["x", "y", "z", "w"][..usize::from(*lanes)].to_vec(),
            Ty::Matrix(n) => ["x_axis", "y_axis", "z_axis", "w_axis"][..usize::from(*n)].to_vec(),
            Ty::Struct(of, _) => match self.library.structs.get(of) {
                Some(definition) => definition.fields.iter().map(|(field, ..)| field.as_str()).collect(),
                None => return found,
            },
            Ty::Tuple(parts) if name.parse::<usize>().is_ok_and(|k| k < parts.len()) => return found,
            Ty::Range(_) if found != Ty::Unknown => return found,
            _ => Vec::new(),
        };
        if !fields.contains(&name) {
            let shown = match self.table.variable_kind(base) {
                Some(_) => "a number".to_owned(),
                None => format!("type `{}`", self.table.resolve_deep(base)),
            };
            let mut error = Diagnostic::error_at(Code::UnknownField, span, format!("no field `{name}` on {shown}"))
                .label("unknown field");
            if !fields.is_empty() {
                error = error.help(crate::suggest::suggest_name(name, &fields, "it has"));
            }
            self.errors.push(error);
        }
        found
    }

    fn known_field(&mut self, base: &Ty, name: &str) -> Ty {
        match base {
            Ty::Struct(..) => match self.fields_of(base, None) {
                Some((fields, types)) => {
                    let k = fields.iter().position(|(field, ..)| field == name);
                    k.map_or(Ty::Unknown, |k| types[k].clone())
                }
                None => Ty::Unknown,
            },
            Ty::Tuple(parts) => match name.parse::<usize>().ok().and_then(|k| parts.get(k)) {
                Some(part) => part.clone(),
                None => Ty::Unknown,
            },
            Ty::Vector(kind, _) => Ty::scalar(*kind),
            Ty::Matrix(n) if name.ends_with("_axis") => Ty::Vector(Scalar::F32, *n),
            // The evaluator refuses those of a closed range, which Rust has as methods.
            Ty::Range(end) if matches!(name, "start" | "end") => (**end).clone(),
            _ => Ty::Unknown,
        }
    }

    fn infer_element(&mut self, base: &Ty, index: &Ty, at: &Expr) -> Ty {
        let element = match base {
            Ty::Array(element) => (**element).clone(),
            Ty::Vector(kind, _) => Ty::scalar(*kind),
            Ty::Struct(..) => match self.infer_indexed(base, index) {
                Some(element) => return element,
                None => return Ty::Unknown,
            },
            _ => return Ty::Unknown,
        };
        if let Ty::Range(_) = self.table.resolve_shallow(index) {
            return self.slice_type(base, at.span);
        }
        self.check_index(base, index, at);
        element
    }

    /// The type of a part of an array. A slice is of its array's type, which states no length.
    fn slice_type(&mut self, base: &Ty, span: Span) -> Ty {
        match base {
            Ty::Array(_) | Ty::Unknown => base.clone(),
            Ty::Var(_) if self.table.variable_kind(base) == Some(Kind::Any) => Ty::Unknown,
            other => {
                let shown = self.table.resolve_deep(other);
                let error = Diagnostic::error_at(
                    Code::IndexType,
                    span,
                    format!("the type `{shown}` cannot be indexed by a range"),
                )
                .label("not an array");
                self.errors.push(match other {
                    Ty::Vector(..) => error.help("take its components: `.xy()`, or `.to_array()` to slice them"),
                    _ => error.help("a range takes a part of an array: `&array[1..3]`"),
                });
                Ty::Unknown
            }
        }
    }

    /// Notes an error about an index that is no `usize`.
    fn check_index(&mut self, base: &Ty, index: &Ty, at: &Expr) {
        if !self.table.unify(&Ty::USIZE, index) {
            let (base, found) = (self.table.resolve_deep(base), self.table.resolve_deep(index));
            let found = match self.table.variable_kind(&found) {
                Some(Kind::Float) => "a float".to_owned(),
                _ => format!("`{found}`"),
            };
            self.errors.push(
                Diagnostic::error_at(
                    Code::IndexType,
                    at.span,
                    format!("the type `{base}` cannot be indexed by {found}"),
                )
                .label("an index is a `usize`")
                .help("convert it with `as usize`"),
            );
        }
    }

    /// The type of an operand that may be a slice, as rustc takes a reference to it: in a comparison or a `match`.
    pub fn infer_unsized(&mut self, operand: &'l Expr, wanted: Option<&Ty>) -> Ty {
        match operand.kind {
            ExprKind::Slice(..) => self.infer_place(operand).0,
            _ => self.infer_expr(operand, wanted),
        }
    }

    /// The type of a slice where a value is needed, which rustc refuses.
    pub fn infer_slice_value(&mut self, expr: &'l Expr) -> Ty {
        let ty = self.infer_place(expr).0;
        let shown = self.table.resolve_deep(&ty);
        if shown != Ty::Unknown {
            self.errors.push(
                Diagnostic::error_at(
                    Code::MismatchedTypes,
                    expr.span,
                    "a slice is no value of its own: its size is known only when it is evaluated",
                )
                .label("a slice")
                .help("take a reference to it: write `&` or `&mut` before it"),
            );
        }
        Ty::Unknown
    }

    /// `target = value`, `target op= value`.
    pub fn infer_assign(&mut self, target: &'l Expr, op: Option<BinaryOp>, value: &'l Expr, expr: &'l Expr) -> Ty {
        let (ty, access) = self.infer_place(target);
        self.check_writable(access, target, op.is_none());
        match op {
            None => self.check_expr(value, &ty),
            Some(op) => {
                let found = self.infer_expr(value, None);
                if let Some((of, name)) = super::overloads::trait_of(op)
                    && matches!(self.peel_refs(&ty).0, Ty::Struct(..) | Ty::Enum(..))
                {
                    let assigned = (format!("{of}Assign"), format!("{name}_assign"));
                    if self.operator_of((&assigned.0, &assigned.1), &ty, &found).is_none() {
                        self.not_assigned(op, &ty, &assigned.0, expr.span);
                    }
                    return Ty::UNIT;
                }
                let result = self.infer_operator(op, &ty, &found, expr);
                if let Ty::Ref(true, _) = self.table.resolve_shallow(&ty) {
                    let shown = self.table.resolve_deep(&ty);
                    self.errors.push(
                        Diagnostic::error_at(
                            Code::OperatorTypes,
                            expr.span,
                            format!("a binary assignment operation cannot be applied to type `{shown}`"),
                        )
                        .label("a reference")
                        .help("write to what it refers to: `*`"),
                    );
                } else {
                    self.coerce(&ty, &result, expr.span);
                }
            }
        }
        Ty::UNIT
    }

    /// Notes an error about `+=` and its like on a type that has no such operator.
    fn not_assigned(&mut self, op: BinaryOp, ty: &Ty, of: &str, span: Span) {
        let shown = self.table.resolve_deep(ty);
        let sign = super::operators::operator_symbol(op);
        self.errors.push(
            Diagnostic::error_at(
                Code::OperatorTypes,
                span,
                format!("binary assignment operation `{sign}=` cannot be applied to type `{shown}`"),
            )
            .label("not for these types")
            .help(format!("write an `impl {of} for {shown}`, or `a = a {sign} b`")),
        );
    }

    /// Notes an error if a place may not be written. `first` is a whole assignment, which may give a variable its first value.
    pub fn check_writable(&mut self, access: Access, place: &Expr, first: bool) {
        let error = match access {
            Access::Writable => return,
            Access::Immutable(_, _, true) if first => return,
            Access::Immutable(name, declared, _) | Access::Part(name, declared) => Diagnostic::error_at(
                Code::Immutable,
                place.span,
                format!("cannot change `{name}`, as it is not declared as mutable"),
            )
            .label("changed here")
            .label_at(declared, "declared here")
            .help(format!("declare it as `mut {name}`")),
            Access::Shared => Diagnostic::error_at(
                Code::Immutable,
                place.span,
                "cannot change what is behind a `&` reference",
            )
            .label("changed here")
            .help("take it by `&mut`"),
        };
        self.errors.push(error);
    }
}

/// The type of a constant of the standard library or of glam.
fn known_constant(path: &[String]) -> Ty {
    let (ty, name) = match path {
        [.., ty, name] => (ty.as_str(), name.as_str()),
        [name] => ("consts", name.as_str()),
        [] => return Ty::Unknown,
    };
    if let Some((kind, lanes)) = super::signature::vector(ty) {
        let one = Ty::Vector(kind, lanes);
        return match name {
            "AXES" => Ty::Array(Box::new(one)),
            _ => one,
        };
    }
    match ty {
        "Mat2" => Ty::Matrix(2),
        "Mat3" => Ty::Matrix(3),
        "Mat4" => Ty::Matrix(4),
        "f32" => Ty::Float,
        _ if let Some(kind) = IntType::from_name(ty) => match name {
            "BITS" => Ty::U32,
            _ => Ty::Int(kind),
        },
        "consts"
            if name
                .chars()
                .all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_') =>
        {
            Ty::Float
        }
        _ => Ty::Unknown,
    }
}
