//! Expressions.

use super::departures::Tail;
use super::enums::Choice;
use super::value::{Eval, Exit, Step, Value, Way};
use super::{Evaluator, MAX_EXPRESSIONS, MAX_PARTS};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::{Expr, ExprKind, IntType};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type};

impl Evaluator<'_> {
    /// The value of an expression; of a mutable reference, what it refers to.
    pub fn value(&mut self, expr: &Expr) -> Eval {
        let value = self.expr(expr)?;
        self.loaded(value, expr.span)
    }

    pub fn expr(&mut self, expr: &Expr) -> Eval {
        self.step(expr.span)?;
        if self.depth >= MAX_EXPRESSIONS {
            let what = format!("calls and expressions are nested more than {MAX_EXPRESSIONS} deep");
            let error = Diagnostic::at(Code::Recursion, expr.span, what).label("reached here");
            return Err(error.help("the command line goes deeper than a browser can").into());
        }
        self.depth += 1;
        let value = self.evaluated(expr);
        self.depth -= 1;
        if expr.span.file != Span::LIBRARY {
            self.places.resize(self.builder.graph().nodes.len(), expr.span);
        }
        value
    }

    fn evaluated(&mut self, expr: &Expr) -> Eval {
        let span = expr.span;
        match &expr.kind {
            ExprKind::Int(n, None | Some(IntType::Usize)) => Ok(Value::Int(*n)),
            // The digits of i32::MIN are one more than there are of i32: its sign is applied to what they wrap to.
            ExprKind::Int(n, Some(IntType::I32)) => Ok(Value::Node(self.builder.i32(*n as i32))),
            ExprKind::Int(n, Some(IntType::U32)) => Ok(Value::Node(self.int_node(*n, Scalar::U32, span)?)),
            ExprKind::Float(x, _) => Ok(Value::Node(self.builder.f32(*x))),
            ExprKind::Bool(b) => Ok(Value::Node(self.builder.bool(*b))),
            ExprKind::Str(text) => Ok(Value::Str(text.clone())),
            ExprKind::Path(path) => self.path(path, span),
            ExprKind::Unary(op, operand) => {
                let value = self.value(operand)?;
                self.unary(*op, &value, span)
            }
            ExprKind::Binary(op, left, right) => {
                let (left, right) = (self.value(left)?, self.value(right)?);
                self.binary(*op, &left, &right, span)
            }
            ExprKind::Ref(true, operand) => self.borrow_mutably(operand),
            ExprKind::Ref(false, operand) => self.expr(operand),
            ExprKind::Deref(reference) => match self.expr(reference)? {
                Value::Ref(place) => self.read(&place, span),
                value => Ok(value),
            },
            ExprKind::Lazy(and, left, right) => self.lazy(*and, left, right, span),
            ExprKind::Assign(place, op, value) => self.assign(place, *op, value, span),
            ExprKind::Call(path, constants, args) => self.call(path, constants, args, span),
            ExprKind::Invoke(callee, args) => {
                let callee = self.value(callee)?;
                let values = self.all(args)?;
                self.invoke(&callee, values, span)
            }
            ExprKind::Method(receiver, name, constants, args) => self.method(receiver, name, constants, args, span),
            ExprKind::Field(base, name) => {
                let base = self.value(base)?;
                self.field(&base, name, span)
            }
            ExprKind::Index(base, index) => {
                // Rust reads an element when the index is known, which may have changed the array.
                match self.base(base)? {
                    Some(place) => {
                        let index = self.expr(index)?;
                        let whole = self.read(&place, span)?;
                        match self.index_of_trait(&whole, None, &index, span)? {
                            Some(value) => Ok(value),
                            None => self.read(&place.part(Step::Index(index)), span),
                        }
                    }
                    None => {
                        let (base, index) = (self.value(base)?, self.value(index)?);
                        match self.index_of_trait(&base, None, &index, span)? {
                            Some(value) => Ok(value),
                            None => self.element(&base, &index, span),
                        }
                    }
                }
            }
            ExprKind::If(condition, then, otherwise, branches) => {
                self.if_(condition, then, otherwise.as_deref(), *branches, Tail::Open, span)
            }
            ExprKind::Match(subject, arms, branches) => self.match_(subject, arms, *branches, Tail::Open, span),
            ExprKind::Block(block) => self.block(block),
            ExprKind::Labelled(label, block) => self.labelled(label, block, span),
            ExprKind::Tuple(parts) => {
                let value = Value::Tuple(self.all(parts)?);
                self.bounded(value, span)
            }
            ExprKind::Array(parts) => {
                let value = Value::array(self.all(parts)?);
                self.bounded(value, span)
            }
            ExprKind::Repeat(value, len) => self.repeat(value, len),
            ExprKind::Struct(path, fields, rest) => self.structure(path, fields, rest.as_deref(), span),
            ExprKind::Cast(value, ty) => {
                let value = self.value(value)?;
                self.cast(&value, ty, span)
            }
            ExprKind::Range(start, end, inclusive) => self.range(start, end, *inclusive),
            ExprKind::For(f) => self.for_(f, span),
            ExprKind::While(condition, body, label, unroll) => {
                self.while_(condition, body, label.as_deref(), *unroll, span)
            }
            ExprKind::Try(value) => self.tried(value, span),
            ExprKind::Return(value) => {
                let value = value.as_ref().map_or(Ok(Value::unit()), |e| self.expr(e))?;
                Err(Exit::Left(Way::Return(value)))
            }
            ExprKind::Break(label) => Err(Exit::Left(Way::Break(label.clone()))),
            ExprKind::Continue(label) => Err(Exit::Left(Way::Continue(label.clone()))),
            ExprKind::Assert(condition, message) => self.assert(condition, message),
            ExprKind::Closure(closure) => self.closure(closure, span),
        }
    }

    /// Values of several expressions.
    pub fn all(&mut self, exprs: &[Expr]) -> Eval<Vec<Value>> {
        let mut values = Vec::with_capacity(exprs.len());
        for e in exprs {
            values.push(self.expr(e)?);
        }
        Ok(values)
    }

    fn repeat(&mut self, value: &Expr, len: &Expr) -> Eval {
        let element = self.expr(value)?;
        let count = self.expr(len)?;
        match self.known_int(&count) {
            Some(n @ 1..=65536) if element.parts(MAX_PARTS) * n as usize <= MAX_PARTS => {
                Ok(Value::array(vec![element; n as usize]))
            }
            Some(1..=65536) => Err(too_many_parts(len.span)),
            Some(n) => Err(
                Diagnostic::at(Code::TooLarge, len.span, format!("an array of {n} elements"))
                    .help("use 1 to 65536")
                    .into(),
            ),
            None => {
                let error = Diagnostic::at(
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

    /// A value that is not too large to be worked with.
    fn bounded(&self, value: Value, span: Span) -> Eval {
        if value.parts(MAX_PARTS) > MAX_PARTS {
            return Err(too_many_parts(span));
        }
        Ok(value)
    }

    fn structure(&mut self, path: &[String], fields: &[(Name, Expr)], rest: Option<&Expr>, span: Span) -> Eval {
        let library = self.library;
        let name = path.last().map(String::as_str).unwrap_or_default();
        let variant = library.variant(path);
        let stated = variant.map(|(_, _, variant)| &variant.fields);
        let Some(stated) = stated.or_else(|| library.structs.get(name).map(|s| &s.fields)) else {
            let known: Vec<&str> = self.library.structs.keys().map(String::as_str).collect();
            return Err(Diagnostic::at(
                Code::UnknownType,
                span,
                format!("there is no structure `{name}` in the kernel's files"),
            )
            .label("not found")
            .help(crate::suggest::suggest(name, &known, "there are"))
            .into());
        };
        let mut given = Vec::new();
        for (field, value) in fields {
            let Some((_, ty, _)) = stated.iter().find(|(name, ..)| name == field) else {
                return Err(Diagnostic::at(
                    Code::UnknownField,
                    value.span,
                    format!("`{name}` has no field `{field}`"),
                )
                .into());
            };
            let given_value = self.expr(value)?;
            given.push((field.clone(), self.ascribe(given_value, Some(ty), value.span)?));
        }
        // As in Rust the base is read last, with what the fields' values have changed of it.
        let rest = rest.map(|e| self.value(e)).transpose()?;
        let mut values = Vec::new();
        for (field, _, _) in stated {
            let value = match given.iter().find(|(name, _)| name == field) {
                Some((_, value)) => value.clone(),
                None => match &rest {
                    Some(rest) => self.field(rest, field, span)?,
                    None => {
                        return Err(Diagnostic::at(
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
            Some((ty, k, _)) => Choice::known(ty, &library.enums[ty], k, values),
            None => self.structure_of(name, values, span),
        };
        self.bounded(made, span)
    }

    /// `&&` and `||`.
    fn lazy(&mut self, and: bool, left: &Expr, right: &Expr, span: Span) -> Eval {
        let value = self.value(left)?;
        let left = self.node(&value, left.span)?;
        self.lazily(and, left, |e| e.value(right), span)
    }

    /// `left && right`, or `left || right`, of which the right side is only looked at where it decides.
    pub fn lazily(&mut self, and: bool, left: NodeId, right: impl FnOnce(&mut Self) -> Eval, span: Span) -> Eval {
        match self.known_bool(left) {
            Some(known) if known != and => Ok(Value::Node(left)),
            Some(_) => right(self),
            None => {
                let before = self.scope.clone();
                let value = self.narrowed(&[(left, and)], |e| e.lazy_side(left, right, span))?;
                if self.scope == before {
                    let op = if and { BinaryOp::And } else { BinaryOp::Or };
                    return self.binary(op, &Value::Node(left), &value, span);
                }
                // What the right side assigns, it assigns only where it is looked at.
                let decided = Value::Node(self.builder.bool(!and));
                let after = std::mem::replace(&mut self.scope, before);
                if and {
                    return self.join(left, None, (after, value), decided, span);
                }
                let before = std::mem::replace(&mut self.scope, after);
                self.join(left, None, (before, decided), value, span)
            }
        }
    }

    /// A field of a structure, a part of a tuple, or components of a vector.
    pub fn field(&mut self, base: &Value, name: &str, span: Span) -> Eval {
        match base {
            Value::Struct { ty, fields } => match fields.iter().find(|(field, _)| field == name) {
                Some((_, value)) => Ok(value.clone()),
                None => {
                    let names: Vec<&str> = fields.iter().map(|(field, _)| field.as_str()).collect();
                    Err(
                        Diagnostic::at(Code::UnknownField, span, format!("`{ty}` has no field `{name}`"))
                            .label("not there")
                            .help(crate::suggest::suggest(name, &names, "it has"))
                            .into(),
                    )
                }
            },
            Value::Tuple(parts) => match name.parse::<usize>().ok().and_then(|k| parts.get(k)) {
                Some(part) => Ok(part.clone()),
                None => Err(Diagnostic::at(
                    Code::UnknownField,
                    span,
                    format!("a tuple of {} parts has no `.{name}`", parts.len()),
                )
                .into()),
            },
            Value::Node(id) => {
                let ty = self.ty(*id);
                match lane(name) {
                    Some(k) if ty.components() > 1 && k < ty.components() && !ty.is_array() => {
                        let part = Type::value(ty.kind().unwrap_or(Scalar::F32), 1);
                        Ok(Value::Node(self.builder.add(Op::Extract(k), [*id], part)))
                    }
                    _ => Err(Diagnostic::at(
                        Code::UnknownField,
                        span,
                        format!("a {} has no field `{name}`", ty.in_rust()),
                    )
                    .label("not there")
                    .help(match ty.components() {
                        1 => "a number has no fields".to_owned(),
                        n => format!("it has {}", ["x", "y", "z", "w"][..n as usize].join(", ")),
                    })
                    .into()),
                }
            }
            Value::Poison => Err(Exit::Noted),
            other => Err(Diagnostic::at(
                Code::UnknownField,
                span,
                format!("{} has no field `{name}`", other.describe()),
            )
            .into()),
        }
    }

    /// All elements of an array of a length.
    pub fn elements(&mut self, value: &Value, len: usize, span: Span) -> Eval<Vec<Value>> {
        if matches!(value, Value::Poison) {
            return Ok(vec![Value::Poison; len]);
        }
        let found = self.array_len(value).unwrap_or(0);
        if found != len {
            return Err(Diagnostic::at(
                Code::Pattern,
                span,
                format!("a pattern of {len} elements for {}", value.describe()),
            )
            .label("of another length")
            .into());
        }
        (0..len as i64)
            .map(|k| self.element(value, &Value::Int(k), span))
            .collect()
    }

    /// An element of an array.
    pub fn element(&mut self, base: &Value, index: &Value, span: Span) -> Eval {
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
            let lanes = self.lanes(*id).into_iter().map(Value::Node).collect();
            return self.element(&Value::array(lanes), index, span);
        }
        let index = self.index_node(index, span)?;
        let element = self.element_of_many(base, index, span);
        if let Some(element) = self.demanding(&[index], element)? {
            return Ok(element);
        }
        let array = self.array_node(base, span);
        let array = self.demanding(&[index], array)?;
        let ty = self.ty(array);
        if let (Type::Array { len, .. }, Some(bits)) = (ty, self.builder.graph().constant(index))
            && bits[0] >= len
        {
            return Err(out_of_range(i64::from(bits[0] as i32), len as usize, span).into());
        }
        Ok(Value::Node(self.builder.add(
            Op::ArrayGet,
            [array, index],
            ty.element(),
        )))
    }
}

fn too_many_parts(span: Span) -> Exit {
    Diagnostic::at(Code::TooLarge, span, format!("a value of more than {MAX_PARTS} parts"))
        .label("too large")
        .help("keep less at a time: a shader has a few hundred registers")
        .into()
}

/// An index that is known to be wrong.
pub fn out_of_range(index: i64, len: usize, span: Span) -> Diagnostic {
    Diagnostic::at(
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

/// Number of a component by its name.
pub fn lane(name: &str) -> Option<u8> {
    match name {
        "x" => Some(0),
        "y" => Some(1),
        "z" => Some(2),
        "w" => Some(3),
        _ => None,
    }
}
