//! Methods of values other than numbers: textures, arrays, ranges, and the kernel's own types.

use super::Evaluator;
use super::objects::OBJECT;
use super::value::{Eval, Exit, Place, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::instead::{Receiver, find_text};
use crate::front::tree::{Expr, ExprKind, Function};
use crate::ir::BinaryOp;
use std::rc::Rc;

/// Methods of known integers that runtime values lack, or that need the 64 bits of a known `usize`.
const INTEGERS: [&str; 7] = [
    "is_multiple_of",
    "rem_euclid",
    "div_euclid",
    "div_ceil",
    "min",
    "max",
    "pow",
];

impl<'a> Evaluator<'a> {
    pub fn eval_method(&mut self, receiver: &Expr, name: &str, constants: &[Expr], args: &[Expr], span: Span) -> Eval {
        let expected = self.expected.take();
        let writing = matches!(name, "iter_mut" | "chunks_mut" | "chunks_exact_mut")
            || self.library.mutating.contains(name.rsplit("::").next().unwrap_or(name));
        let (value, place) = self.eval_receiver(receiver, writing)?;
        let args = self.eval_all(args)?;
        if args.contains(&Value::Poison) {
            return Err(Exit::Noted);
        }
        if let Value::Enum(choice) = &value
            && choice.ty == OBJECT
        {
            return self.method_of_object(choice, name, args, span);
        }
        if let Some(value) = self.lazy_method(&value, name, &args, span)? {
            return Ok(value);
        }
        let own = match self.own_method(&value, name) {
            None => self.method_of_trait(&value, name, &args, span)?,
            own => own,
        };
        if let Some((method, function)) = own {
            let receiver = match function.params.first() {
                Some(own) if own.ty.is_mutable_reference() => {
                    let place = place.unwrap_or_else(|| self.add_temporary(value.clone()));
                    Value::Ref(Rc::new(place))
                }
                _ => value,
            };
            let all = std::iter::once(receiver).chain(args).collect();
            let constants = self.constants_for(Some(function), constants)?;
            self.expected = expected;
            return self.inline_function(method, &constants, all, span);
        }
        // A mutable reference to an array iterates over references to its elements.
        let joins = matches!(name, "zip" | "chain");
        let args = args
            .into_iter()
            .map(|v| match self.deref_value(v.clone(), span)? {
                array if joins && self.array_len(&array).is_some() => Ok(v),
                value => Ok(value),
            })
            .collect::<Eval<Vec<_>>>()?;
        if let Some(value) = self.eval_conversion(name, &value, span)? {
            return Ok(value);
        }
        if name == "clone"
            && args.is_empty()
            && !matches!(
                value,
                Value::Texture(_) | Value::Buffer(_) | Value::Shared(_) | Value::Image(_)
            )
        {
            return Ok(value);
        }
        if let Some(value) = self.order_method(&value, name, &args, span)? {
            return Ok(value);
        }
        match &value {
            Value::Enum(choice)
                if matches!(name, "unwrap" | "expect") && matches!(choice.ty.as_str(), "Option" | "Result") =>
            {
                // Rust panics for what is not a number; here it has any order.
                let comparison = choice.variant_fields(1).and_then(<[_]>::first);
                match comparison.filter(|_| is_partial_comparison(receiver)) {
                    Some((_, ordering)) => Ok(ordering.clone()),
                    None => self.eval_unwrap(choice, name, span),
                }
            }
            Value::Struct { .. } | Value::Enum(_) => {
                let ty = match &value {
                    Value::Struct { ty, .. } => ty,
                    Value::Enum(choice) => &choice.ty,
                    _ => return Err(Exit::Noted),
                };
                if super::matrix::column_count(ty).is_some() {
                    return self.matrix_method(&value, name, &args, span);
                }
                let prefix = format!("{ty}::");
                let functions = self.library.functions.keys();
                let mut names: Vec<&str> = functions.filter_map(|f| f.strip_prefix(prefix.as_str())).collect();
                names.extend(crate::front::std::function_names(ty));
                names.sort_unstable();
                names.dedup();
                let is_choice = matches!(ty.as_str(), "Option" | "Result");
                let instead = match ty.as_str() {
                    "Quat" => find_text(Receiver::Quaternion, name),
                    _ => find_text(Receiver::Choice, name).filter(|_| is_choice),
                };
                let help = match names.is_empty() {
                    _ if instead.is_some() => instead.unwrap_or_default(),
                    true => format!("it has none: write it in an `impl {ty}`"),
                    false => crate::suggest::suggest_name(name, &names, "it has"),
                };
                Err(
                    Diagnostic::error_at(Code::UnknownMethod, span, format!("`{ty}` has no method `{name}`"))
                        .label("not there")
                        .help(help)
                        .into(),
                )
            }
            Value::Texture(index) => self.eval_texture_method(*index, name, &args, span),
            Value::Buffer(index) => self.eval_buffer_method(*index, name, &args, span),
            Value::Image(index) => self.eval_image_method(*index, name, &args, span),
            Value::Shared(index) => self.shared_memory(*index, name, &args, span),
            Value::Range(range) if matches!(name, "rev" | "step_by" | "contains") => {
                self.range_method(range, name, &args, span)
            }
            Value::Range(_) => self.iterator_method(&value, name, &args, span),
            Value::Endless(_) => self.endless_method(&value, name, &args, span),
            Value::Array(_) | Value::Table(_) | Value::Node(_) if name == "iter_mut" && args.is_empty() => {
                match place {
                    Some(place) => self.elements_mut(&Value::Ref(Rc::new(place)), span),
                    None => {
                        let place = self.add_temporary(value);
                        self.elements_mut(&Value::Ref(Rc::new(place)), span)
                    }
                }
            }
            Value::Array(_) | Value::Table(_) | Value::Node(_)
                if matches!(name, "chunks_mut" | "chunks_exact_mut") && args.len() == 1 =>
            {
                let place = place.unwrap_or_else(|| self.add_temporary(value.clone()));
                self.chunks_mut(&value, &place, name, &args[0], span)
            }
            Value::Array(_) | Value::Table(_) => self.iterator_method(&value, name, &args, span),
            Value::Node(id) if self.ty(*id).is_array() => self.iterator_method(&value, name, &args, span),
            Value::Int(_) | Value::Node(_) if args.len() <= 1 && INTEGERS.contains(&name) => {
                match self.known_integer_method(&value, name, &args, span)? {
                    Some(result) => Ok(result),
                    None => self.integer_method(value, name, args, span),
                }
            }
            Value::Poison => Err(Exit::Noted),
            Value::Node(id) if name == "to_array" && args.is_empty() && self.ty(*id).component_count() > 1 => {
                let lanes = self.vector_components(*id);
                Ok(Value::array(lanes.into_iter().map(Value::Node).collect()))
            }
            _ => self.eval_math_method(&value, name, &args, span),
        }
    }

    /// Returns the library function that a method call resolves to: inference has written its path, or it belongs to
    /// one of the kernel's own types. In a generic function only the value determines it.
    pub fn own_method(&self, value: &Value, name: &str) -> Option<(&'a str, &'a Function)> {
        let library = self.library;
        let method = match value {
            _ if name.contains("::") => name.to_owned(),
            Value::Struct { ty, .. } => [ty, "::", name].concat(),
            Value::Enum(choice) => [&choice.ty, "::", name].concat(),
            Value::Node(id) if !crate::front::methods::has_method(self.ty(*id), name) => {
                [&self.ty(*id).in_rust(), "::", name].concat()
            }
            _ => return None,
        };
        if !name.contains("::") && library.alternatives.contains_key(&method) {
            return None;
        }
        let (method, function) = library.functions.get_key_value(&method)?;
        Some((method, function))
    }

    /// Returns the value of a method's receiver and its place, if it is one.
    fn eval_receiver(&mut self, receiver: &Expr, writing: bool) -> Eval<(Value, Option<Place>)> {
        let before = std::mem::replace(&mut self.writing, writing);
        let place = self.eval_place(receiver);
        self.writing = before;
        if let Some(place) = place? {
            let place = self.follow_references(place, receiver.span)?;
            return Ok((self.read_place(&place, receiver.span)?, Some(place)));
        }
        match self.eval_expr(receiver)? {
            Value::Ref(place) => {
                let place = self.follow_references((*place).clone(), receiver.span)?;
                Ok((self.read_place(&place, receiver.span)?, Some(place)))
            }
            value => Ok((value, None)),
        }
    }

    /// Returns mutable references to the elements of an array.
    pub fn elements_mut(&mut self, array: &Value, span: Span) -> Eval {
        let Value::Ref(place) = array else {
            return Err(Exit::Noted);
        };
        let place = self.follow_references((**place).clone(), span)?;
        let array = self.read_place(&place, span)?;
        let Some(len) = self.array_len(&array) else {
            return Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} has no elements to change", array.describe()),
            )
            .into());
        };
        let element = |k: usize| Value::Ref(Rc::new(place.with_step(Step::Index(Value::Int(k as i64)))));
        Ok(Value::array((0..len).map(element).collect()))
    }

    /// Evaluates a method of known integers; `None` if they are not known.
    fn known_integer_method(&mut self, value: &Value, name: &str, args: &[Value], span: Span) -> Eval<Option<Value>> {
        if let Value::Node(id) = value
            && !(self.ty(*id).is_integer() && self.ty(*id).is_scalar())
        {
            return Ok(None);
        }
        let (Some(n), Some(m)) = (
            self.known_int(value),
            args.first().map_or(Some(0), |a| self.known_int(a)),
        ) else {
            return Ok(None);
        };
        let result = match (name, args.len()) {
            ("is_multiple_of", 1) => {
                let multiple = if m == 0 { n == 0 } else { n % m == 0 };
                return Ok(Some(Value::Node(self.builder.bool(multiple))));
            }
            ("rem_euclid", 1) if m > 0 => n.rem_euclid(m),
            ("div_euclid", 1) if m > 0 => n.div_euclid(m),
            ("div_ceil", 1) if n >= 0 && m > 0 => n / m + i64::from(n % m > 0),
            ("min" | "max", 1) if matches!(value, Value::Int(_)) => {
                let op = if name == "min" { BinaryOp::Min } else { BinaryOp::Max };
                return self.eval_binary(op, value, &args[0], span).map(Some);
            }
            ("pow", 1) if matches!(value, Value::Int(_)) => {
                match u32::try_from(m).ok().and_then(|m| n.checked_pow(m)) {
                    Some(power) => power,
                    None => return Ok(None),
                }
            }
            _ => return Ok(None),
        };
        Ok(Some(match value {
            Value::Node(id) => {
                let ty = self.ty(*id);
                Value::Node(self.builder.constant(ty, [result as u32, 0, 0, 0]))
            }
            _ => Value::Int(result),
        }))
    }

    /// Evaluates a method of runtime integers, by the evaluator's own rules or through the library.
    fn integer_method(&mut self, value: Value, name: &str, args: Vec<Value>, span: Span) -> Eval {
        let known = args
            .first()
            .and_then(|divisor| self.known_int(divisor))
            .is_some_and(|n| n > 0);
        let of = match &value {
            Value::Node(id) => self.ty(*id).in_rust(),
            _ => "usize".to_owned(),
        };
        let function = format!("{of}::{name}");
        if (name != "rem_euclid" || !known) && self.library.functions.contains_key(&function) {
            let all = std::iter::once(value).chain(args).collect();
            return self.inline_function(&function, &[], all, span);
        }
        self.eval_math_method(&value, name, &args, span)
    }
}

/// Returns whether an expression calls `partial_cmp`.
fn is_partial_comparison(expr: &Expr) -> bool {
    let name = match &expr.kind {
        ExprKind::Method(_, name, ..) => name,
        ExprKind::Call(path, ..) => path.last().map_or("", String::as_str),
        _ => return false,
    };
    name.rsplit("::").next() == Some("partial_cmp")
}
