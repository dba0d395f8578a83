//! Calls: the kernel's own functions, inlined, and the prelude's.

use super::Evaluator;
use super::control::Tail;
use super::report::MAX_CALLS;
use super::value::{ConstantDemand, Eval, Exit, Jump, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::instead::{Receiver, find_text};
use crate::front::testing::{COUNT, RECORD};
use crate::front::tree::{Expr, ExprKind, Function, Generic, Type as SourceType, generic_arguments, split_qualified};
use crate::ir::{Naming, NodeId, Op, Scalar, Type};
use std::borrow::Cow;
use std::rc::Rc;

pub use crate::front::tree::vector_named as vector_type;

impl<'a> Evaluator<'a> {
    pub fn eval_call(&mut self, path: &[String], constants: &[Expr], args: &[Expr], span: Span) -> Eval {
        let expected = self.expected.take();
        if args.is_empty()
            && let Some(value) = self.owned_constant(path, constants, span)?
        {
            return Ok(value);
        }
        let mut constants = self.generic_constants(path, constants)?;
        let values = self.eval_all(args)?;
        if values.contains(&Value::Poison) {
            return Err(Exit::Noted);
        }
        if let ([method], [receiver, rest @ ..]) = (path, values.as_slice())
            && method.contains("::")
            && let Some(value) = self.lazy_method(receiver, method, rest, span)?
        {
            return Ok(value);
        }
        let resolved = self.resolve_path(path, &values, span)?;
        if let Some(resolved) = &resolved {
            self.add_owner_arguments(path, &resolved.join("::"), &mut constants);
        }
        let path = resolved.as_deref().unwrap_or(path);
        if let [name] = path
            && let Some(callee) = self.scope.get(name).cloned()
        {
            let callee = match callee {
                Value::Alias(place) => self.read_place(&place, span)?,
                other => self.deref_value(other, span)?,
            };
            if callee.is_called() {
                return self.call_value(&callee, values, span);
            }
        }
        self.expected = expected;
        let outcome = self.call_path(path, &constants, values, span);
        self.expected = None;
        outcome
    }

    /// Returns the constants in the `::<>` of a call; type arguments are inferred.
    fn generic_constants(&mut self, path: &[String], stated: &[Expr]) -> Eval<Vec<Value>> {
        if stated.is_empty() {
            return Ok(Vec::new());
        }
        let library = self.library;
        let method = path.join("::");
        let function = library.functions.get(&method);
        let function = function.or_else(|| {
            library
                .functions
                .get(path.last().filter(|_| crate::front::is_by_last(path))?)
        });
        self.constants_for(function, stated)
    }

    /// Returns the constants in the `::<>` of a call of a resolved function.
    pub fn constants_for(&mut self, function: Option<&Function>, stated: &[Expr]) -> Eval<Vec<Value>> {
        let (stated, owner) = generic_arguments(stated);
        let generics = function.map_or(&[][..], |function| &function.generics);
        let count = match owner {
            Some(_) => generics.len(),
            None => stated.len(),
        };
        let mut values = Vec::new();
        for k in 0..count {
            let generic = generics.get(k);
            let of_owner = || generic.and_then(|generic| function?.argument_of(owner?, generic.name()));
            // For `_`, the type before the function or the values determine the constant.
            let own = stated.get(k).filter(|expr| !is_inferred(expr));
            values.push(match (own, generic) {
                (Some(expr), Some(Generic::Const(..))) => self.eval_expr(expr)?,
                // The length of `array::from_fn::<f32, 4, _>`.
                (Some(expr), None) if matches!(expr.kind, ExprKind::Int(..) | ExprKind::Block(_)) => {
                    self.eval_expr(expr)?
                }
                (Some(expr), Some(Generic::Type(_)) | None) => self.type_argument(expr),
                (None, Some(Generic::Const(..))) => {
                    let argument = of_owner();
                    let constant = argument.and_then(|argument| self.constant_argument(argument));
                    constant.unwrap_or_else(Value::unit)
                }
                (None, Some(Generic::Type(_))) => {
                    let known = of_owner().and_then(|argument| self.resolve_type(argument));
                    known.map_or_else(Value::unit, Value::Type)
                }
                (None, None) => Value::unit(),
            });
        }
        Ok(values)
    }

    /// Returns a type argument of `::<>`.
    fn type_argument(&mut self, expr: &Expr) -> Value {
        let known = match &expr.kind {
            ExprKind::Path(path) if path.len() == 1 => match self.scope.get(&path[0]) {
                // A type parameter that is unknown here too.
                Some(ty) if !matches!(ty, Value::Type(_)) => None,
                _ => self.resolve_type(&SourceType::Name(path[0].clone(), Vec::new())),
            },
            ExprKind::Cast(_, ty) => self.resolve_type(ty),
            _ => None,
        };
        known.map_or_else(Value::unit, Value::Type)
    }

    /// Adds the arguments that the type of a type parameter has, for a function of this type.
    fn add_owner_arguments(&mut self, path: &[String], key: &str, constants: &mut Vec<Value>) {
        let parameter = match path {
            [of, _] => Some(of.as_str()),
            [name] => split_qualified(name).map(|(of, ..)| of),
            _ => None,
        };
        let ty = parameter.and_then(|parameter| self.type_behind(parameter));
        let function = self.library.functions.get(key);
        let (Some(ty), Some(function)) = (ty, function) else {
            return;
        };
        let Some(of) = function.of.as_ref().filter(|_| !ty.args.is_empty()) else {
            return;
        };
        for (k, generic) in function.generics.iter().enumerate() {
            let stated = constants.get(k).filter(|value| **value != Value::unit());
            let value = stated.cloned().or_else(|| ty.argument_of(of, generic.name()));
            match constants.get_mut(k) {
                Some(place) => *place = value.unwrap_or_else(Value::unit),
                None => constants.push(value.unwrap_or_else(Value::unit)),
            }
        }
    }

    /// Calls a function by its path.
    pub fn call_path(&mut self, path: &[String], constants: &[Value], values: Vec<Value>, span: Span) -> Eval {
        let last = path.last().map(String::as_str).unwrap_or_default();
        if let Some(value) = self.sequence_call(path, &values, span)? {
            return Ok(value);
        }
        if let [ty, name] = path {
            let method = format!("{ty}::{name}");
            if self.library.functions.contains_key(&method) {
                return self.inline_function(&method, constants, values, span);
            }
        }
        if crate::front::is_by_last(path) && self.library.functions.contains_key(last) {
            return self.inline_function(last, constants, values, span);
        }
        if let Some(value) = self.eval_mem_call(path, &values, span)? {
            return Ok(value);
        }
        if let Some(value) = self.tuple_struct(last, &values, span)? {
            return Ok(value);
        }
        if self.library.find_variant(path).is_some() {
            // A mutable reference in an option stays one.
            return Ok(self.variant_of(path, values, span)?.unwrap_or(Value::Poison));
        }
        let values = values
            .into_iter()
            .map(|v| self.deref_value(v, span))
            .collect::<Eval<Vec<_>>>()?;
        if let ([.., name], [f]) = (path, values.as_slice())
            && name == "from_fn"
            && f.is_called()
        {
            let made = Value::Elements(Rc::new(f.clone()));
            return match constants.get(1) {
                Some(len) if *len != Value::unit() => self.listed_elements(&made, len, None, span),
                _ => Ok(made),
            };
        }
        if let ([name], [items]) = (path, values.as_slice())
            && let Some(name @ ("sum" | "product")) = name.strip_suffix("_of_some")
        {
            let items = self.collect_items(items, span)?;
            return self.reduced_some(name, &items, span);
        }
        if let Some(value) = self.matrix_function(path, &values, span)? {
            return Ok(value);
        }
        if let Some(value) = self.quad_function(path, &values, span)? {
            return Ok(value);
        }
        if let ([.., of, name], [left, right]) = (path, values.as_slice())
            && let Some(op) = crate::infer::operator_function(of, name)
        {
            return self.eval_binary(op, left, right, span);
        }
        if let Some((kind, lanes)) = parse_constructor(path) {
            return self.compose_vector(kind, lanes, &values, span);
        }
        if let ([.., ty, from], [value]) = (path, values.as_slice())
            && from == "from"
            && let Some(value) = self.from(ty, value, span)?
        {
            return Ok(value);
        }
        match (path, values.as_slice()) {
            ([.., ty, splat], [value]) if splat == "splat" => {
                let Some((kind, lanes)) = vector_type(ty) else {
                    return Err(self.unknown_function(path, span));
                };
                let value = self.lane_node(value, kind, span)?;
                Ok(Value::Node(self.build_splat(value, lanes)))
            }
            ([.., ty, from], [array])
                if matches!(from.as_str(), "from_array" | "from_slice")
                    && let Some((kind, lanes)) = vector_type(ty) =>
            {
                let lanes = usize::from(lanes);
                let values = match (from.as_str(), self.array_len(array)) {
                    ("from_slice", Some(len)) if len > lanes => {
                        let mut values = self.array_elements(array, len, span)?;
                        values.truncate(lanes);
                        values
                    }
                    _ => self.array_elements(array, lanes, span)?,
                };
                let lanes = lanes as u8;
                self.compose_vector(kind, lanes, &values, span)
            }
            ([.., name], [Value::Str(tally), value]) if name == "tally" => self.eval_tally(tally, value, span),
            ([name], [probe]) if name == COUNT => self.eval_count(probe, span),
            ([name], [site, condition, left, right]) if name == RECORD => {
                self.eval_record(site, condition, [left, right], span)
            }
            ([.., ty, from], [value]) if ty == "f32" && from == "from_bits" => {
                let bits = self.int_or_node(value, Scalar::U32, span)?;
                Ok(Value::Node(self.builder.add(Op::Bitcast, [bits], Type::F32)))
            }
            ([.., ty, name], [receiver, rest @ ..])
                if matches!(ty.as_str(), "f32" | "i32" | "u32") || vector_type(ty).is_some() =>
            {
                self.eval_math_method(receiver, name, rest, span)
            }
            ([.., name], _) => match self.eval_prelude_call(name, &values, span)? {
                Some(value) => Ok(value),
                None => Err(self.unknown_function(path, span)),
            },
            _ => Err(self.unknown_function(path, span)),
        }
    }

    #[cold]
    fn unknown_function(&self, path: &[String], span: Span) -> Exit {
        let name = path.join("::");
        let mut known: Vec<&str> = self.library.functions.keys().map(String::as_str).collect();
        known.extend(crate::front::FUNCTIONS);
        known.sort_unstable();
        let close = known.iter().find(|k| crate::suggest::is_close(&name, k));
        let help = match close {
            Some(close) => format!("did you mean `{close}`?"),
            None => "define it in one of the kernel's files, or use a function of the prelude".to_owned(),
        };
        let help = match path {
            [.., ty, name] if ty == "Quat" => find_text(Receiver::Quaternion, name).unwrap_or(help),
            _ => help,
        };
        Diagnostic::error_at(Code::UnknownFunction, span, format!("there is no function `{name}`"))
            .label("not found in the kernel's files")
            .help(help)
            .into()
    }

    /// Evaluates an expression with a stated type; for a call, the type determines constants of the function.
    pub fn expecting(&mut self, expr: &Expr, ty: Option<&SourceType>) -> Eval {
        if let (ExprKind::Tuple(parts), Some(SourceType::Tuple(types))) = (&expr.kind, ty)
            && parts.len() == types.len()
        {
            let pairs = parts.iter().zip(types);
            let values = pairs.map(|(part, ty)| self.expecting(part, Some(ty)));
            return Ok(Value::Tuple(values.collect::<Eval<_>>()?));
        }
        if matches!(expr.kind, ExprKind::Call(..) | ExprKind::Method(..)) {
            self.expected = ty.cloned().map(Box::new);
        }
        self.eval_expr(expr)
    }

    /// Evaluates a function's body with its parameters bound.
    pub fn inline_function(&mut self, name: &str, constants: &[Value], args: Vec<Value>, span: Span) -> Eval {
        let library = self.library;
        let Some((name, function)) = library.functions.get_key_value(name) else {
            return Err(
                Diagnostic::error_at(Code::UnknownFunction, span, format!("there is no function `{name}`")).into(),
            );
        };
        match name == Self::PHASE && function.span.file == crate::front::std::FILE {
            true => self.eval_phase(function, args, span),
            false => self.inline_known(name, function, constants, args, span),
        }
    }

    /// Evaluates the body of an existing function that is not a phase of a workgroup.
    pub(super) fn inline_known(
        &mut self,
        name: &'a str,
        function: &Function,
        constants: &[Value],
        args: Vec<Value>,
        span: Span,
    ) -> Eval {
        let expected = self.expected.take();
        if args.len() != function.params.len() {
            return Err(miscounted(name, function, args.len(), span));
        }
        if self.report.is_too_deep() {
            return Err(self.too_deep(name, span));
        }
        let mut bound = self.constants_of(function, constants, &args, expected.as_deref(), span)?;
        bound.extend(self.types_of(function, constants, &args, span)?);
        let of_library = function.span.file == crate::front::std::FILE;
        let outer = self.scope.enter_function();
        for (name, value) in &bound {
            self.scope.bind(name, value.clone());
        }
        for (param, value) in function.params.iter().zip(args) {
            let value = match self.ascribe_type(value, Some(&param.ty), span) {
                Ok(value) => value,
                Err(exit) => {
                    self.scope.leave_function(outer);
                    return Err(match exit {
                        Exit::Error(error) => error
                            .label_at(param.span, format!("`{}` is stated here", param.name))
                            .into(),
                        other => other,
                    });
                }
            };
            if !of_library && !self.was_named(&value, &param.name) {
                self.name_as(&value, &param.name, Naming::Parameter, span);
            }
            self.scope.bind(&param.name, value);
        }
        self.report.enter_call(name);
        let unroll = self.policy.unroll;
        self.policy.unroll = function.unroll.unwrap_or(unroll);
        let result = self.eval_without_exits(|e| {
            let result = e.block_in(&function.body, Tail::Function);
            e.merge_exits(0, result, outer.1, &|way| matches!(way, Jump::Return(_)), function.span)
        });
        self.policy.unroll = unroll;
        self.report.leave_call();
        // Constant parameters are also visible in the result type.
        for (name, value) in &bound {
            self.scope.bind(name, value.clone());
        }
        let result = result.and_then(|value| self.ascribe_type(value, Some(&function.result), function.span));
        self.scope.leave_function(outer);
        if let Ok(value) = &result {
            // The kernel's own name does not describe its result.
            let result = if self.report.call_depth() == 0 {
                Cow::Borrowed("result")
            } else {
                result_name(name)
            };
            self.name_as(value, &result, Naming::Function, span);
        }
        match result {
            // The library's body is hidden, so the error belongs to the call.
            Err(Exit::Error(error)) if of_library => Err(error.called_at(span, name).into()),
            Err(Exit::Demand(needs)) if of_library => Err(Exit::Demand(called_at(needs, span, name))),
            Err(exit @ Exit::Left(Jump::Unreachable(_))) => Err(exit),
            Err(Exit::Left(_)) => {
                Err(
                    Diagnostic::error_at(Code::Leaving, function.span, "`break` or `continue` outside of a loop")
                        .into(),
                )
            }
            other => other,
        }
    }

    /// Returns an error for calls that are nested too deeply.
    #[cold]
    fn too_deep(&self, name: &str, span: Span) -> Exit {
        let error = Diagnostic::error_at(
            Code::Recursion,
            span,
            format!("calls are nested more than {MAX_CALLS} deep, in `{name}`"),
        )
        .label("recursion that does not end?")
        .help("let it end by a condition that is a compile-time constant; where runtime values decide, write a loop");
        self.demand_constants(&self.decides_within(name), error)
    }

    /// Evaluates `Name(a, b)` of a tuple structure.
    fn tuple_struct(&mut self, name: &str, values: &[Value], span: Span) -> Eval<Option<Value>> {
        let library = self.library;
        let Some(definition) = library.structs.get(name) else {
            return Ok(None);
        };
        if definition
            .fields
            .iter()
            .any(|(field, ..)| field.parse::<usize>().is_err())
        {
            return Ok(None);
        }
        if definition.fields.len() != values.len() {
            let (wanted, found) = (definition.fields.len(), values.len());
            return Err(Diagnostic::error_at(
                Code::ArgumentCount,
                span,
                format!("`{name}` has {wanted} fields, not {found}"),
            )
            .into());
        }
        let mut fields = Vec::new();
        for ((field, ty, _), value) in definition.fields.iter().zip(values) {
            let value = self.ascribe_field(value.clone(), ty, &definition.generics, &[], span)?;
            fields.push((field.clone(), value));
        }
        Ok(Some(self.structure_of(name, fields, span)))
    }

    /// Composes a vector from components and shorter vectors.
    pub fn compose_vector(&mut self, kind: Scalar, lanes: u8, values: &[Value], span: Span) -> Eval {
        let mut parts: Vec<NodeId> = Vec::new();
        for value in values {
            let id = self.lane_node(value, kind, span)?;
            parts.extend(self.vector_components(id));
        }
        if parts.len() != lanes as usize {
            return Err(Diagnostic::error_at(
                Code::ArgumentCount,
                span,
                format!("a vector of {lanes} components from {}", parts.len()),
            )
            .label("numbers and components of vectors count together")
            .help(format!("give {lanes}, or `splat` one"))
            .into());
        }
        Ok(Value::Node(self.builder.add(
            Op::Compose,
            parts,
            Type::value(kind, lanes),
        )))
    }

    fn lane_node(&mut self, value: &Value, kind: Scalar, span: Span) -> Eval<NodeId> {
        let id = match value {
            Value::Int(n) => self.int_node(*n, kind, span)?,
            other => self.value_node(other, span)?,
        };
        if self.ty(id).scalar_kind() == Some(kind) && !self.ty(id).is_array() {
            return Ok(id);
        }
        Err(Diagnostic::error_at(
            Code::MismatchedTypes,
            span,
            format!("{} where {kind} is needed", self.ty(id).in_rust()),
        )
        .label("of another type")
        .help(format!("convert it with `as {kind}`"))
        .into())
    }

    /// Returns a known integer as a node of a scalar kind, or a node that already has it.
    pub fn int_or_node(&mut self, value: &Value, kind: Scalar, span: Span) -> Eval<NodeId> {
        self.lane_node(value, kind, span)
    }

    fn eval_tally(&mut self, name: &str, value: &Value, span: Span) -> Eval {
        let id = self.value_node(value, span)?;
        let tallies = &mut self.builder.graph_mut().tallies;
        let index = tallies.iter().position(|known| known == name).unwrap_or_else(|| {
            tallies.push(name.to_owned());
            tallies.len() - 1
        });
        let ty = self.ty(id);
        Ok(Value::Node(self.builder.add(Op::Tally(index as u32), [id], ty)))
    }
}

/// Moves constant demands inside a library function to its call site.
fn called_at(needs: Vec<ConstantDemand>, span: Span, name: &str) -> Vec<ConstantDemand> {
    let each = needs.into_iter().map(|need| ConstantDemand {
        error: need.error.called_at(span, name),
        ..need
    });
    each.collect()
}

/// Parses `vec3`, `Vec3::new`, ...
pub fn parse_constructor(path: &[String]) -> Option<(Scalar, u8)> {
    match path {
        [.., ty, new] if new == "new" => vector_type(ty),
        [.., name] => {
            let (kind, lanes) = name.split_once("vec")?;
            let kind = match kind {
                "" => Scalar::F32,
                "i" => Scalar::I32,
                "u" => Scalar::U32,
                "b" => Scalar::Bool,
                _ => return None,
            };
            let lanes = lanes.parse().ok().filter(|lanes| (2..=4).contains(lanes))?;
            Some((kind, lanes))
        }
        [] => None,
    }
}

/// Returns the default name of a function's result: the function's name, or the type for a constructor.
fn result_name(function: &str) -> Cow<'_, str> {
    match function.rsplit_once("::") {
        Some((ty, "new" | "default" | "from" | "make")) => {
            let mut name = String::new();
            for c in ty.chars() {
                if c.is_ascii_uppercase() && !name.is_empty() {
                    name.push('_');
                }
                name.push(c.to_ascii_lowercase());
            }
            name.into()
        }
        Some((_, method)) => method.into(),
        None => function.into(),
    }
}

/// `true` if a generic argument is `_`, or left open by inference.
fn is_inferred(stated: &Expr) -> bool {
    match &stated.kind {
        ExprKind::Path(path) => path == &[crate::front::INFERRED],
        ExprKind::Tuple(parts) => parts.is_empty(),
        _ => false,
    }
}

/// Returns an error for a call with the wrong number of arguments.
#[cold]
fn miscounted(name: &str, function: &Function, given: usize, span: Span) -> Exit {
    let wanted = function.params.len();
    let plural = if wanted == 1 { "" } else { "s" };
    Diagnostic::error_at(
        Code::ArgumentCount,
        span,
        format!("`{name}` takes {wanted} argument{plural}, not {given}"),
    )
    .label("called here")
    .label_at(function.span, "defined here")
    .into()
}
