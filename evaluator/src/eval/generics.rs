//! Constant parameters of functions and structures: the 3 of `power::<3>(x)`, of `[f32; 3]` and of `Window<3>`.
//!
//! A structure stores its constant parameters as hidden fields. Their values come from the stated type, or from the
//! length of an array in the structure. It stores a type parameter too if no field shows what it stands for.

use super::Evaluator;
use super::types::{hidden, hidden_field};
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::{ExprKind, Function, Generic, Type as SourceType};
use crate::ir::Type;

impl Evaluator<'_> {
    /// Returns the constant parameters of a generic function: those stated, or those deduced from the types of its
    /// arguments or its result.
    pub fn constants_of(
        &mut self,
        function: &Function,
        given: &[Value],
        args: &[Value],
        expected: Option<&SourceType>,
        span: Span,
    ) -> Eval<Vec<(String, Value)>> {
        let mut bound: Vec<(String, Value)> = Vec::new();
        for (k, generic) in function.generics.iter().enumerate() {
            let Generic::Const(name, ty) = generic else { continue };
            let stated = given.get(k).filter(|value| **value != Value::unit()).cloned();
            let mut found = stated;
            for (param, value) in function.params.iter().zip(args) {
                found = match found {
                    None => self.constant_in(&param.ty, value, name, span),
                    found => found,
                };
            }
            if let (None, Some(expected)) = (&found, expected) {
                found = self.constant_between(&function.result, expected, name);
            }
            let Some(value) = found else {
                let of_type = match &function.of {
                    Some(SourceType::Name(of, args)) if args.iter().any(|arg| arg.is_parameter(name)) => Some(of),
                    _ => None,
                };
                let help = match of_type {
                    Some(of) => {
                        format!("state the type of the value: `let x: {of}<3> = ...`, or `{of}::<3>` where it is made")
                    }
                    None => format!("state it: `::<{name}>`"),
                };
                return Err(Diagnostic::error_at(
                    Code::TypeNeeded,
                    span,
                    format!("the constant `{name}` of this call is not known"),
                )
                .label("called here")
                .label_at(function.span, "defined here")
                .help(help)
                .into());
            };
            let value = self.ascribe_type(value, Some(ty), span)?;
            bound.push((name.clone(), value));
        }
        Ok(bound)
    }

    /// Deduces a constant parameter of a type from a value of the type.
    fn constant_in(&mut self, ty: &SourceType, value: &Value, parameter: &str, span: Span) -> Option<Value> {
        let value = match value {
            Value::Ref(place) => {
                let place = self.follow_references((**place).clone(), span).ok()?;
                self.read_place(&place, span).ok()?
            }
            other => other.clone(),
        };
        match (ty.peel_refs(), &value) {
            (SourceType::Array(element, len), array) => {
                let count = self.array_len(array)?;
                if len.as_ref().is_some_and(|len| is_parameter(&len.kind, parameter)) {
                    return Some(Value::Int(count as i64));
                }
                let first = (count > 0).then(|| self.array_element(array, &Value::Int(0), span).ok())??;
                self.constant_in(element, &first, parameter, span)
            }
            (SourceType::Tuple(types), Value::Tuple(parts)) => {
                let mut pairs = types.iter().zip(parts);
                pairs.find_map(|(ty, part)| self.constant_in(ty, part, parameter, span))
            }
            (SourceType::Name(name, args), Value::Struct { ty, fields }) if *ty == name.as_str() => {
                let definition = self.library.structs.get(name)?;
                let mut pairs = definition.generics.iter().zip(args);
                pairs.find_map(|(generic, arg)| match generic {
                    Generic::Const(own, _) if arg.is_parameter(parameter) => hidden_field(fields, own),
                    _ => None,
                })
            }
            _ => None,
        }
    }

    /// Deduces a constant parameter of a type from a stated type, whose constants are those of the enclosing
    /// function.
    fn constant_between(&mut self, ty: &SourceType, stated: &SourceType, parameter: &str) -> Option<Value> {
        match (ty.peel_refs(), stated.peel_refs()) {
            (SourceType::Array(element, Some(len)), SourceType::Array(other, Some(count))) => {
                match is_parameter(&len.kind, parameter) {
                    true => self.eval_expr(count).ok(),
                    false => self.constant_between(element, other, parameter),
                }
            }
            (SourceType::Tuple(types), SourceType::Tuple(others)) => {
                let mut pairs = types.iter().zip(others);
                pairs.find_map(|(ty, other)| self.constant_between(ty, other, parameter))
            }
            (SourceType::Name(name, args), SourceType::Name(other, others)) if name == other => {
                let mut pairs = args.iter().zip(others);
                pairs.find_map(|(arg, other)| match arg.is_parameter(parameter) {
                    true => self.constant_argument(other),
                    false => self.constant_between(arg, other, parameter),
                })
            }
            _ => None,
        }
    }

    /// Returns the value of a constant among the arguments of a type.
    pub fn constant_argument(&mut self, argument: &SourceType) -> Option<Value> {
        match argument {
            SourceType::Const(value) => self.eval_expr(value).ok(),
            SourceType::Name(name, args) if args.is_empty() => match self.scope.get(name) {
                Some(Value::Type(_)) => None,
                Some(value) => Some(value.clone()),
                None if self.library.consts.contains_key(name) => {
                    self.eval_path(std::slice::from_ref(name), Span::default()).ok()
                }
                None => None,
            },
            _ => None,
        }
    }

    /// Returns a structure with the arguments of its stated type.
    pub fn with_constants(&mut self, value: Value, args: &[SourceType], span: Span) -> Eval {
        let Value::Struct { ty, fields } = &value else {
            return Ok(value);
        };
        let library = self.library;
        let generics = library.structs.get(ty.as_str()).map_or(&[][..], |s| &s.generics);
        let mut added = Vec::new();
        for (generic, arg) in generics.iter().zip(args) {
            let Generic::Const(name, _) = generic else {
                let name = generic.name();
                if self.type_argument_of(&value, name).is_none()
                    && let Some(known) = self.resolve_type(arg)
                {
                    added.push((hidden(name), Value::Type(known)));
                }
                continue;
            };
            let Some(stated) = self.constant_argument(arg).and_then(|stated| self.as_constant(&stated)) else {
                continue;
            };
            match fields.iter().find(|(field, _)| *field == hidden(name)) {
                Some((_, Value::Const(known))) if *known != stated => {
                    return Err(Diagnostic::error_at(
                        Code::MismatchedTypes,
                        span,
                        format!("a `{ty}` whose `{name}` is {known} where {stated} is stated"),
                    )
                    .label("of another type")
                    .help(format!("state {known}, or make a `{ty}` of {stated}"))
                    .into());
                }
                Some(_) => {}
                None => added.push((hidden(name), Value::Const(stated))),
            }
        }
        if added.is_empty() {
            return Ok(value);
        }
        let mut all: Vec<(Name, Value)> = fields.iter().cloned().chain(added).collect();
        self.complete_fields(ty, &mut all, span)?;
        Ok(Value::structure(ty.clone(), all))
    }

    /// Gives the fields of a structure the arguments of its type.
    fn complete_fields(&mut self, ty: &str, fields: &mut [(Name, Value)], span: Span) -> Eval<()> {
        let library = self.library;
        let Some(definition) = library.structs.get(ty) else {
            return Ok(());
        };
        let known = fields.to_vec();
        for ((_, stated, _), (_, field)) in definition.fields.iter().zip(fields) {
            let has_arguments = matches!(stated.peel_refs(), SourceType::Name(_, args) if !args.is_empty());
            if has_waiting(field) || has_arguments && matches!(field, Value::Struct { .. }) {
                *field = self.ascribe_field(field.clone(), stated, &definition.generics, &known, span)?;
            }
        }
        Ok(())
    }

    /// Returns a structure built from its fields, with the constants that they determine.
    pub fn structure_of(&mut self, name: &str, mut fields: Vec<(Name, Value)>, span: Span) -> Value {
        let library = self.library;
        let definition = library.structs.get(name);
        for generic in definition.iter().flat_map(|definition| &definition.generics) {
            let Generic::Const(parameter, _) = generic else {
                continue;
            };
            let stated = definition.iter().flat_map(|definition| &definition.fields);
            let mut pairs = stated.zip(fields.clone());
            let found = pairs.find_map(|((_, ty, _), (_, value))| self.constant_in(ty, &value, parameter, span));
            if let Some(constant) = found.and_then(|found| self.as_constant(&found)) {
                fields.push((hidden(parameter), Value::Const(constant)));
            }
        }
        let mut completed = fields.clone();
        // A wrong field is refused where the type is stated.
        if fields.len() > definition.map_or(0, |definition| definition.fields.len())
            && self.complete_fields(name, &mut completed, span).is_ok()
        {
            fields = completed;
        }
        Value::structure(name, fields)
    }

    /// Returns a compile-time constant as a number.
    pub fn as_constant(&self, value: &Value) -> Option<i64> {
        match value {
            Value::Const(known) => Some(*known),
            Value::Node(id) if self.ty(*id) == Type::BOOL => self.known_bool(*id).map(i64::from),
            other => self.known_int(other),
        }
    }
}

/// Returns whether the length of an array is a constant parameter.
pub fn is_parameter(length: &ExprKind, parameter: &str) -> bool {
    matches!(length, ExprKind::Path(path) if matches!(path.as_slice(), [name] if name == parameter))
}

/// Returns whether a value is an array whose length is not known yet, or a list of such.
pub fn has_waiting(value: &Value) -> bool {
    match value {
        Value::Elements(_) => true,
        Value::Array(parts) => parts.first().is_some_and(has_waiting),
        _ => false,
    }
}
