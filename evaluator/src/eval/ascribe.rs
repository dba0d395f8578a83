//! Values where a type is stated.

use super::Evaluator;
use super::enums::EnumValue;
use super::generics::has_waiting;
use super::types::hidden_field;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::mentioned_in;
use crate::front::name::Name;
use crate::front::tree::{Expr, ExprKind, Generic, IntType, Type as SourceType};
use crate::ir::{Scalar, Type};
use std::collections::BTreeSet;
use std::rc::Rc;

impl Evaluator<'_> {
    /// Checks a value against its stated type, as far as shaders distinguish types, and gives a known integer that
    /// type.
    pub fn ascribe_type(&mut self, value: Value, ty: Option<&SourceType>, span: Span) -> Eval {
        let ty = match ty {
            // A mutable reference stays one; if a value or a shared reference is stated, it is read.
            Some(SourceType::Ref(true, _)) => return self.ascribe_reference(value, span),
            // A type parameter may stand for a reference.
            Some(SourceType::Name(name, _)) if matches!(value, Value::Ref(_)) && self.is_unknown_name(name) => {
                return Ok(value);
            }
            Some(ty) => Some(ty.peel_refs()),
            None => return Ok(value),
        };
        let value = self.deref_value(value, span)?;
        if let Some(lane) = ty.and_then(|ty| self.lane_type(ty)) {
            return self.ascribe_type(value, Some(lane), span);
        }
        match (ty, value) {
            (Some(SourceType::Name(_, args)), Value::Enum(choice)) => self.ascribe_choice(choice, args, span),
            (Some(SourceType::Name(name, args)), value @ Value::Struct { .. }) if !args.is_empty() => {
                let value = self.with_constants(value, args, span)?;
                self.ascribe_name(value, name, span)
            }
            (Some(SourceType::Name(name, _)), value) => self.ascribe_name(value, name, span),
            (Some(SourceType::Array(element, Some(len))), Value::Elements(f)) => {
                let len = self.eval_expr(len)?;
                self.listed_elements(&Value::Elements(f), &len, Some(element), span)
            }
            (Some(SourceType::Array(element, len)), Value::Array(elements)) => {
                check_length(len.as_deref(), elements.len(), span)?;
                let each = elements
                    .iter()
                    .map(|e| self.ascribe_type(e.clone(), Some(element), span));
                Ok(Value::array(each.collect::<Eval<_>>()?))
            }
            (Some(SourceType::Array(_, len)), Value::Table(table)) => {
                check_length(len.as_deref(), table.len, span)?;
                Ok(Value::Table(table))
            }
            (Some(SourceType::Array(_, len)), Value::Node(id)) => {
                if let Type::Array { len: found, .. } = self.ty(id) {
                    check_length(len.as_deref(), found as usize, span)?;
                }
                Ok(Value::Node(id))
            }
            (Some(SourceType::Tuple(types)), Value::Tuple(parts)) if types.len() == parts.len() => {
                let each = parts
                    .into_iter()
                    .zip(types)
                    .map(|(part, ty)| self.ascribe_type(part, Some(ty), span));
                Ok(Value::Tuple(each.collect::<Eval<_>>()?))
            }
            (_, value) => Ok(value),
        }
    }

    /// Evaluates the elements of `array::from_fn(f)`, of a type if one is stated.
    pub fn listed_elements(&mut self, array: &Value, len: &Value, element: Option<&SourceType>, span: Span) -> Eval {
        let Value::Elements(f) = array else {
            return Ok(array.clone());
        };
        let Some(len @ 1..=65536) = self.known_int(len) else {
            let error = Diagnostic::error_at(
                Code::RuntimeValue,
                span,
                "the length of this array is no compile-time constant above 0",
            )
            .label("made here")
            .help("use a constant, an option, or a loop counter");
            return Err(self.demand_of(&[len], error));
        };
        let mut elements = Vec::new();
        for k in 0..len {
            self.count_step(span)?;
            let value = self.call_value(f, vec![Value::Int(k)], span)?;
            elements.push(self.ascribe_type(value, element, span)?);
        }
        Ok(Value::array(elements))
    }

    /// Ascribes the type of a field of a structure whose parameters have values as far as they are `known`. A function that makes
    /// the structure may have parameters of the same names. An array whose length is not known yet waits for the structure's type.
    pub fn ascribe_field(
        &mut self,
        value: Value,
        ty: &SourceType,
        generics: &[Generic],
        known: &[(Name, Value)],
        span: Span,
    ) -> Eval {
        if generics.is_empty() {
            return self.ascribe_type(value, Some(ty), span);
        }
        let waits = has_waiting(&value);
        let mark = self.scope.enter();
        for generic in generics {
            let found = hidden_field(known, generic.name());
            let unknown = waits && found.is_none() && length_mentions(ty, generic.name());
            if unknown {
                self.scope.leave(mark);
                return Ok(value);
            }
            let found = match (generic, found) {
                (Generic::Const(_, ty), Some(constant)) => self.ascribe_type(constant, Some(ty), span)?,
                (_, found) => found.unwrap_or(Value::Unset),
            };
            self.scope.bind(generic.name(), found);
        }
        let ascribed = self.ascribe_type(value, Some(ty), span);
        self.scope.leave(mark);
        ascribed
    }

    /// Ascribes types to the fields of an enum's value.
    fn ascribe_choice(&mut self, choice: Rc<EnumValue>, args: &[SourceType], span: Span) -> Eval {
        let holds = choice.all_fields().next().is_some();
        let Some(definition) = self.library.enums.get(&*choice.ty).filter(|_| holds) else {
            return Ok(Value::Enum(choice));
        };
        let mut ascribed = EnumValue::clone(&choice);
        for (variant, fields) in definition.variants.iter().zip(&mut ascribed.variants) {
            let values = fields.iter_mut().flatten();
            for ((_, ty, _), (_, value)) in variant.fields.iter().zip(values) {
                let parameter = definition.generics.iter().position(
                    |generic| matches!((generic, ty), (Generic::Type(name), SourceType::Name(of, _)) if name == of),
                );
                let ty = match parameter {
                    Some(k) => args.get(k),
                    None => Some(ty),
                };
                *value = self.ascribe_type(value.clone(), ty, span)?;
            }
        }
        Ok(Value::Enum(Rc::new(ascribed)))
    }

    /// Checks a value where `&mut T` is stated.
    fn ascribe_reference(&mut self, value: Value, span: Span) -> Eval {
        match value {
            Value::Ref(_) | Value::Poison => Ok(value),
            other => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} where a mutable reference is stated", other.describe()),
            )
            .label("not a reference")
            .help("write `&mut` before the variable")
            .into()),
        }
    }

    fn ascribe_name(&mut self, value: Value, name: &str, span: Span) -> Eval {
        let stated = match name {
            "f32" => Type::F32,
            "bool" => Type::BOOL,
            other => match (IntType::from_name(other), super::call::vector_type(other)) {
                (Some(kind), _) => Type::scalar(kind.scalar()),
                (None, Some((kind, lanes))) => Type::value(kind, lanes),
                (None, None) => return Ok(value),
            },
        };
        match &value {
            Value::Int(n) if stated == Type::U32 => Ok(Value::Node(self.int_node(*n, Scalar::U32, span)?)),
            Value::Int(_) if name == "usize" => Ok(value),
            Value::Const(n) if stated == Type::BOOL => Ok(Value::Node(self.builder.bool(*n != 0))),
            Value::Const(n) if *n < 0 => Ok(Value::Node(self.builder.i32(*n as i32))),
            Value::Const(n) => self.ascribe_name(Value::Int(*n), name, span),
            Value::Int(n) if stated == Type::I32 => Ok(Value::Node(self.int_node(*n, Scalar::I32, span)?)),
            Value::Node(id) if self.ty(*id) == stated => Ok(value),
            Value::Node(_) | Value::Int(_) => {
                let found = match &value {
                    Value::Node(id) => self.ty(*id),
                    _ => Type::I32,
                };
                let help = match (found.component_count(), stated.component_count()) {
                    (1, 1) => format!("convert it with `as {name}`"),
                    (a, b) if a == b => format!("convert it with `.as_{}()`", name.to_lowercase()),
                    (1, _) => format!("write `{name}::splat(...)`"),
                    (a, b) if a > b => "leave out what is too much with `.truncate()` or `.xy()`".to_owned(),
                    _ => "add what lacks with `.extend(...)`".to_owned(),
                };
                let found = found.in_rust();
                Err(
                    Diagnostic::error_at(Code::MismatchedTypes, span, format!("{found} where `{name}` is stated"))
                        .label("of another type")
                        .help(help)
                        .into(),
                )
            }
            Value::Poison => Ok(value),
            other => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} where `{name}` is stated", other.describe()),
            )
            .into()),
        }
    }
}

/// Returns whether a parameter is a length of an array of a type.
fn length_mentions(ty: &SourceType, parameter: &str) -> bool {
    match ty {
        SourceType::Array(element, len) => {
            let mut names = BTreeSet::new();
            len.iter().for_each(|len| mentioned_in(len, &mut names));
            names.contains(parameter) || length_mentions(element, parameter)
        }
        _ => false,
    }
}

/// Rejects an array whose length differs from the stated one, if that is a number.
fn check_length(stated: Option<&Expr>, found: usize, span: Span) -> Eval<()> {
    let Some(ExprKind::Int(stated, _)) = stated.map(|stated| &stated.kind) else {
        return Ok(());
    };
    match usize::try_from(*stated) == Ok(found) {
        true => Ok(()),
        false => Err(Diagnostic::error_at(
            Code::MismatchedTypes,
            span,
            format!("an array of {found} where one of {stated} is stated"),
        )
        .label("of another length")
        .help(format!("give it {stated} elements, or state `; {found}]`"))
        .into()),
    }
}
