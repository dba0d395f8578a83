//! Expressions.

use super::control::Tail;
use super::enums::EnumValue;
use super::value::{Eval, Exit, Jump, Step, Value};
use super::{Evaluator, MAX_PARTS};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::glam::public_fields;
use crate::front::is_prelude_type;
use crate::front::name::Name;
use crate::front::tree::{Expr, ExprKind, IntType};
use crate::ir::{BinaryOp, NodeId, Op, Place, Scalar, Type};
use std::sync::Arc;

impl Evaluator<'_> {
    /// Evaluates an expression; for a mutable reference, returns its referent.
    pub fn eval_value(&mut self, expr: &Expr) -> Eval {
        let value = self.eval_expr(expr)?;
        self.deref_value(value, expr.span)
    }

    pub fn eval_expr(&mut self, expr: &Expr) -> Eval {
        self.count_step(expr.span)?;
        self.report.enter_expr(expr.span)?;
        let value = self.eval_expr_kind(expr);
        self.report.leave_expr();
        if expr.span.file != Span::LIBRARY {
            let counters = self.loops.counters();
            self.builder.place_nodes(|| {
                Some(Place {
                    span: expr.span,
                    counters: Arc::clone(counters),
                })
            });
        }
        value
    }

    fn eval_expr_kind(&mut self, expr: &Expr) -> Eval {
        let span = expr.span;
        match &expr.kind {
            ExprKind::Int(n, None | Some(IntType::Usize)) => Ok(Value::Int(*n)),
            // The literal of `i32::MIN` without its sign exceeds `i32::MAX`. It wraps here, and the sign is applied
            // afterwards.
            ExprKind::Int(n, Some(kind)) if kind.scalar() == Scalar::I32 => {
                Ok(Value::Node(self.builder.i32(*n as i32)))
            }
            ExprKind::Int(n, Some(_)) => Ok(Value::Node(self.int_node(*n, Scalar::U32, span)?)),
            ExprKind::Float(x, _) => Ok(Value::Node(self.builder.f32(*x))),
            ExprKind::Bool(b) => Ok(Value::Node(self.builder.bool(*b))),
            ExprKind::Str(text) => Ok(Value::Str(text.clone())),
            ExprKind::Path(path) => self.eval_path(path, span),
            ExprKind::Unary(op, operand) => {
                let value = self.eval_value(operand)?;
                self.eval_unary(*op, &value, span)
            }
            ExprKind::Binary(op, left, right) => {
                let (left, right) = (self.eval_value(left)?, self.eval_value(right)?);
                self.eval_binary(*op, &left, &right, span)
            }
            ExprKind::Ref(true, operand) => self.borrow_mutably(operand),
            ExprKind::Ref(false, operand) => self.eval_expr(operand),
            ExprKind::Deref(reference) => match self.eval_expr(reference)? {
                Value::Ref(place) => self.read_place(&place, span),
                value => Ok(value),
            },
            ExprKind::Lazy(and, left, right) => self.eval_lazy_op(*and, left, right, span),
            ExprKind::Assign(place, op, value) => self.eval_assign(place, *op, value, span),
            ExprKind::Call(path, constants, args) => self.eval_call(path, constants, args, span),
            ExprKind::Invoke(callee, args) => {
                let callee = self.eval_value(callee)?;
                let values = self.eval_all(args)?;
                self.call_value(&callee, values, span)
            }
            ExprKind::Method(receiver, name, constants, args) => {
                self.eval_method(receiver, name, constants, args, span)
            }
            ExprKind::Field(base, name) => {
                let base = self.eval_value(base)?;
                self.value_field(&base, name, span)
            }
            ExprKind::Index(base, index) => {
                // Rust reads an element after evaluating the index, which may have changed the array.
                match self.base_place(base)? {
                    Some(place) => {
                        let index = self.eval_expr(index)?;
                        let whole = self.read_place(&place, span)?;
                        match self.other_index(&whole, &index, span)? {
                            Some(value) => Ok(value),
                            None => self.read_place(&place.with_step(Step::Index(index)), span),
                        }
                    }
                    None => {
                        let (base, index) = (self.eval_value(base)?, self.eval_value(index)?);
                        match self.other_index(&base, &index, span)? {
                            Some(value) => Ok(value),
                            None => self.array_element(&base, &index, span),
                        }
                    }
                }
            }
            ExprKind::Slice(base, bounds) => self.eval_slice(base, bounds, span),
            ExprKind::If(condition, then, otherwise, branches) => {
                self.eval_if(condition, then, otherwise.as_deref(), *branches, Tail::Open, span)
            }
            ExprKind::Match(subject, arms, branches) => self.eval_match(subject, arms, *branches, Tail::Open, span),
            ExprKind::Block(block) => self.eval_block(block),
            ExprKind::Labelled(label, block) => self.eval_labelled_block(label, block, span),
            ExprKind::Tuple(parts) => {
                let value = Value::Tuple(self.eval_all(parts)?);
                self.check_size(value, span)
            }
            ExprKind::Array(parts) => {
                let value = Value::array(self.eval_all(parts)?);
                self.check_size(value, span)
            }
            ExprKind::Repeat(value, len) => self.eval_repeat(value, len),
            ExprKind::Struct(path, fields, rest) => self.eval_struct(path, fields, rest.as_deref(), span),
            ExprKind::Cast(value, ty) => {
                let value = self.eval_value(value)?;
                self.eval_cast(&value, ty, span)
            }
            ExprKind::Range(start, end, inclusive) => self.eval_range(start, end, *inclusive),
            ExprKind::For(f) => self.eval_for(f, span),
            ExprKind::While(condition, body, label, unroll) => {
                self.eval_while(condition, body, label.as_deref(), *unroll, span)
            }
            ExprKind::Try(value) => self.eval_try(value, span),
            ExprKind::Return(value) => {
                let value = value.as_ref().map_or(Ok(Value::unit()), |e| self.eval_expr(e))?;
                Err(Exit::Left(Jump::Return(value)))
            }
            ExprKind::Break(label) => Err(Exit::Left(Jump::Break(label.clone()))),
            ExprKind::Continue(label) => Err(Exit::Left(Jump::Continue(label.clone()))),
            ExprKind::Unreachable => Err(Exit::Left(Jump::Unreachable(span))),
            ExprKind::Assert {
                condition,
                message,
                only_debug,
            } => self.eval_assert(condition, message, *only_debug),
            ExprKind::Closure(closure) => self.eval_closure(closure, span),
        }
    }

    /// Evaluates several expressions.
    pub fn eval_all(&mut self, exprs: &[Expr]) -> Eval<Vec<Value>> {
        let mut values = Vec::with_capacity(exprs.len());
        for e in exprs {
            values.push(self.eval_expr(e)?);
        }
        Ok(values)
    }

    fn eval_repeat(&mut self, value: &Expr, len: &Expr) -> Eval {
        let element = self.eval_expr(value)?;
        let count = self.eval_expr(len)?;
        match self.known_int(&count) {
            Some(n @ 1..=65536) if element.count_parts(MAX_PARTS) * n as usize <= MAX_PARTS => {
                Ok(Value::array(vec![element; n as usize]))
            }
            Some(1..=65536) => Err(too_many_parts(len.span)),
            Some(n) => Err(
                Diagnostic::error_at(Code::TooLarge, len.span, format!("an array of {n} elements"))
                    .help("use 1 to 65536")
                    .into(),
            ),
            None => {
                let error = Diagnostic::error_at(
                    Code::RuntimeValue,
                    len.span,
                    "the length of an array must be a compile-time constant",
                )
                .label("a runtime value")
                .help("use a constant, an option, or a loop counter");
                Err(self.demand_of(&[&count], error))
            }
        }
    }

    /// Returns a value unless it has too many parts.
    pub fn check_size(&self, value: Value, span: Span) -> Eval {
        if value.count_parts(MAX_PARTS) > MAX_PARTS {
            return Err(too_many_parts(span));
        }
        Ok(value)
    }

    fn eval_struct(&mut self, path: &[String], fields: &[(Name, Expr)], rest: Option<&Expr>, span: Span) -> Eval {
        let library = self.library;
        let name = path.last().map(String::as_str).unwrap_or_default();
        let variant = library.find_variant(path);
        let own = variant.map(|(_, _, variant)| &variant.fields);
        let own = own.or_else(|| library.structs.get(name).map(|s| &s.fields));
        let generics = match variant {
            Some((ty, ..)) => library.enums[ty].generics.as_slice(),
            None => library
                .structs
                .get(name)
                .map_or(&[][..], |definition| &definition.generics),
        };
        let of_glam = public_fields(name, span).filter(|_| own.is_none());
        let Some(stated) = own.or(of_glam.as_ref()) else {
            let known: Vec<&str> = self.library.structs.keys().map(String::as_str).collect();
            return Err(Diagnostic::error_at(
                Code::UnknownType,
                span,
                format!("there is no structure `{name}` in the kernel's files"),
            )
            .label("not found")
            .help(match is_prelude_type(name) {
                true => format!("call its function: `{name}::new(...)`"),
                false => crate::suggest::suggest_name(name, &known, "there are"),
            })
            .into());
        };
        let mut given = Vec::new();
        for (field, value) in fields {
            let Some((_, ty, _)) = stated.iter().find(|(name, ..)| name == field) else {
                return Err(Diagnostic::error_at(
                    Code::UnknownField,
                    value.span,
                    format!("`{name}` has no field `{field}`"),
                )
                .into());
            };
            let given_value = self.eval_expr(value)?;
            let given_value = self.ascribe_field(given_value, ty, generics, &[], value.span)?;
            given.push((field.clone(), given_value));
        }
        // As in Rust, the base is read last, after the changes made by the fields' expressions.
        let rest = rest.map(|e| self.eval_value(e)).transpose()?;
        let mut values = Vec::new();
        for (field, _, _) in stated {
            let value = match given.iter().find(|(name, _)| name == field) {
                Some((_, value)) => value.clone(),
                None => match &rest {
                    Some(rest) => self.value_field(rest, field, span)?,
                    None => {
                        return Err(Diagnostic::error_at(
                            Code::UnknownField,
                            span,
                            format!("`{name}` lacks its field `{field}`"),
                        )
                        .label("here")
                        .help(format!("add `{field}: ...`, or `..other`"))
                        .into());
                    }
                },
            };
            values.push((field.clone(), value));
        }
        let made = match variant {
            Some((ty, k, _)) => EnumValue::with_variant(ty, &library.enums[ty], k, values),
            None if of_glam.is_some() => self.structure_of_glam(name, values, span)?,
            None => self.structure_of(name, values, span),
        };
        self.check_size(made, span)
    }

    /// Makes a vector or a matrix of its fields.
    fn structure_of_glam(&mut self, name: &str, fields: Vec<(Name, Value)>, span: Span) -> Eval {
        let parts: Eval<Vec<NodeId>> = fields.iter().map(|(_, value)| self.value_node(value, span)).collect();
        let parts = parts?;
        Ok(match super::call::vector_type(name) {
            Some((kind, lanes)) => Value::Node(self.builder.add(Op::Compose, parts, Type::value(kind, lanes))),
            None => super::matrix::matrix_value(&parts),
        })
    }

    /// Evaluates `&&` and `||`.
    fn eval_lazy_op(&mut self, and: bool, left: &Expr, right: &Expr, span: Span) -> Eval {
        let value = self.eval_value(left)?;
        let left = self.value_node(&value, left.span)?;
        self.eval_short_circuit(and, left, |e| e.eval_value(right), span)
    }

    /// Evaluates `left && right` or `left || right`; the right side is evaluated only where it decides.
    pub fn eval_short_circuit(
        &mut self,
        and: bool,
        left: NodeId,
        right: impl FnOnce(&mut Self) -> Eval,
        span: Span,
    ) -> Eval {
        match self.known_bool(left) {
            Some(known) if known != and => Ok(Value::Node(left)),
            Some(_) => right(self),
            None => {
                let before = self.scope.clone();
                let value = self.eval_under(&[(left, and)], |e| e.lazy_side(left, right, span))?;
                if self.scope == before {
                    let op = if and { BinaryOp::And } else { BinaryOp::Or };
                    return self.eval_binary(op, &Value::Node(left), &value, span);
                }
                // Assignments in the right side happen only where the right side is evaluated.
                let decided = Value::Node(self.builder.bool(!and));
                let after = std::mem::replace(&mut self.scope, before);
                if and {
                    return self.join_sides(left, None, (after, value), decided, span);
                }
                let before = std::mem::replace(&mut self.scope, after);
                self.join_sides(left, None, (before, decided), value, span)
            }
        }
    }

    /// Returns a field of a structure, a part of a tuple, or components of a vector.
    pub fn value_field(&mut self, base: &Value, name: &str, span: Span) -> Eval {
        match base {
            Value::Range(range) if name == "start" && !range.inclusive => Ok((*range.start).clone()),
            Value::Range(range) if name == "end" && !range.inclusive => Ok((*range.end).clone()),
            Value::Struct { ty, fields } => match fields.iter().find(|(field, _)| field == name) {
                Some((_, value)) => Ok(value.clone()),
                None => {
                    let names: Vec<&str> = fields.iter().map(|(field, _)| field.as_str()).collect();
                    Err(
                        Diagnostic::error_at(Code::UnknownField, span, format!("`{ty}` has no field `{name}`"))
                            .label("not there")
                            .help(crate::suggest::suggest_name(name, &names, "it has"))
                            .into(),
                    )
                }
            },
            Value::Tuple(parts) => match name.parse::<usize>().ok().and_then(|k| parts.get(k)) {
                Some(part) => Ok(part.clone()),
                None => Err(Diagnostic::error_at(
                    Code::UnknownField,
                    span,
                    format!("a tuple of {} parts has no `.{name}`", parts.len()),
                )
                .into()),
            },
            Value::Node(id) => {
                let ty = self.ty(*id);
                match component_index(name) {
                    Some(k) if ty.component_count() > 1 && k < ty.component_count() && !ty.is_array() => {
                        let part = Type::value(ty.scalar_kind().unwrap_or(Scalar::F32), 1);
                        Ok(Value::Node(self.builder.add(Op::Extract(k), [*id], part)))
                    }
                    _ => Err(Diagnostic::error_at(
                        Code::UnknownField,
                        span,
                        format!("a {} has no field `{name}`", ty.in_rust()),
                    )
                    .label("not there")
                    .help(match ty.component_count() {
                        1 => "a number has no fields".to_owned(),
                        n => format!("it has {}", ["x", "y", "z", "w"][..n as usize].join(", ")),
                    })
                    .into()),
                }
            }
            Value::Poison => Err(Exit::Noted),
            other => Err(Diagnostic::error_at(
                Code::UnknownField,
                span,
                format!("{} has no field `{name}`", other.describe()),
            )
            .into()),
        }
    }

    /// Returns all elements of an array of known length.
    pub fn array_elements(&mut self, value: &Value, len: usize, span: Span) -> Eval<Vec<Value>> {
        if matches!(value, Value::Poison) {
            return Ok(vec![Value::Poison; len]);
        }
        if matches!(value, Value::Elements(_)) {
            let listed = self.listed_elements(value, &Value::Int(len as i64), None, span)?;
            return self.rows(&listed, span);
        }
        let found = self.array_len(value).unwrap_or(0);
        if found != len {
            return Err(Diagnostic::error_at(
                Code::Pattern,
                span,
                format!("a pattern of {len} elements for {}", value.describe()),
            )
            .label("of another length")
            .into());
        }
        (0..len as i64)
            .map(|k| self.array_element(value, &Value::Int(k), span))
            .collect()
    }

    /// Returns an element of an array.
    pub fn array_element(&mut self, base: &Value, index: &Value, span: Span) -> Eval {
        if let (Value::Array(elements), Some(k)) = (base, self.known_int(index)) {
            return match usize::try_from(k).ok().and_then(|k| elements.get(k)) {
                Some(element) => Ok(element.clone()),
                None => Err(out_of_range(k, elements.len(), span).into()),
            };
        }
        if let Value::Table(table) = base {
            return self.row_of_table(table, index, span);
        }
        if let Value::Node(id) = base
            && matches!(self.ty(*id), Type::Value { components: 2.., .. })
        {
            let lanes = self.vector_components(*id).into_iter().map(Value::Node).collect();
            return self.array_element(&Value::array(lanes), index, span);
        }
        let index = self.index_node(index, span)?;
        let element = self.element_of_many(base, index, span);
        if let Some(element) = self.demand_on_error(&[index], element)? {
            return Ok(element);
        }
        let array = self.array_node(base, span);
        let array = self.demand_on_error(&[index], array)?;
        let ty = self.ty(array);
        if let (Type::Array { len, .. }, Some(bits)) = (ty, self.builder.graph().constant_bits(index))
            && bits[0] >= len
        {
            return Err(out_of_range(i64::from(bits[0] as i32), len as usize, span).into());
        }
        Ok(Value::Node(self.builder.add(
            Op::ArrayGet,
            [array, index],
            ty.element_type(),
        )))
    }
}

fn too_many_parts(span: Span) -> Exit {
    Diagnostic::error_at(Code::TooLarge, span, format!("a value of more than {MAX_PARTS} parts"))
        .label("too large")
        .help("keep less at a time: a shader has a few hundred registers")
        .into()
}

/// Returns an error for an index that is known to be out of range.
pub fn out_of_range(index: i64, len: usize, span: Span) -> Diagnostic {
    Diagnostic::error_at(
        Code::IndexOutOfRange,
        span,
        format!("index {index} of an array of {len}"),
    )
    .label("out of range")
    .help(match len.checked_sub(1) {
        Some(last) => format!("indices go from 0 to {last}"),
        None => "the array is empty".to_owned(),
    })
}

/// Returns the index of a component by its name.
pub fn component_index(name: &str) -> Option<u8> {
    match name {
        "x" => Some(0),
        "y" => Some(1),
        "z" => Some(2),
        "w" => Some(3),
        _ => None,
    }
}
