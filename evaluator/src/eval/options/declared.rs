//! Option declarations: kind, default and range of each, read from `options!`.

use super::super::Evaluator;
use super::super::value::{Eval, Exit, Value};
use super::{Numeric, OptionInfo, OptionKind, canonical_number, kebab};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::tree::{ExprKind, OptionField, Type as SourceType};
use crate::front::unraw;
use crate::ir::{Scalar, Type};
use straightline_kernels::OptionValue;

impl Evaluator<'_> {
    /// Evaluates the declaration of an option, including its default.
    pub(super) fn option_info(&mut self, field: &OptionField) -> Eval<OptionInfo> {
        let default = self.eval_expr(&field.default)?;
        let default = self.ascribe_type(default, Some(&field.ty), field.default.span)?;
        let ty = match field.ty.peel_refs() {
            SourceType::Name(ty, _) => ty,
            SourceType::Array(..) => return self.list_info(field, &default),
            SourceType::Tuple(_) | SourceType::Ref(..) | SourceType::Fn(..) | SourceType::Const(_) => {
                return Err(self.bad_type(field));
            }
        };
        let (kind, default) = match (ty.as_str(), &default) {
            ("bool", Value::Node(id)) => {
                let on = self.known_bool(*id).unwrap_or_default();
                (OptionKind::Flag, OptionValue::Flag(on))
            }
            ("f32" | "i32" | "u32", value) => {
                let number = self.known_number(value).ok_or_else(|| self.bad_type(field))?;
                let of = self.numeric_range(field, ty)?;
                in_range(field, &[number], &of)?;
                (OptionKind::Number(of), OptionValue::Number(canonical_number(number)))
            }
            (_, Value::Enum(choice)) => {
                let definition = self.library.enums.get(&*choice.ty);
                let variants = definition.map_or(&[][..], |e| &e.variants);
                let holds = variants.iter().any(|variant| !variant.fields.is_empty());
                let variant = self.known_variant(choice).filter(|_| !holds);
                let variant = variant.ok_or_else(|| self.bad_type(field))?;
                let choices = variants.iter().map(|v| (kebab(&v.name), v.docs.clone())).collect();
                let default = OptionValue::Choice(kebab(&variants[variant].name));
                (OptionKind::Choice(choices), default)
            }
            _ => return Err(self.bad_type(field)),
        };
        if field.uniform && !matches!(kind, OptionKind::Number(_)) {
            return Err(only_numbers(field));
        }
        Ok(OptionInfo {
            name: unraw(&field.name).replace('_', "-"),
            docs: field.docs.clone(),
            kind,
            default,
            uniform: field.uniform,
        })
    }

    /// Evaluates the declaration of an option that is an array of numbers.
    fn list_info(&mut self, field: &OptionField, default: &Value) -> Eval<OptionInfo> {
        let element = match field.ty.peel_refs() {
            SourceType::Array(element, _) => match &**element {
                SourceType::Name(name, _) if matches!(name.as_str(), "f32" | "i32" | "u32") => name.clone(),
                _ => return Err(self.bad_type(field)),
            },
            _ => return Err(self.bad_type(field)),
        };
        let numbers: Option<Vec<f64>> = match default {
            Value::Array(values) => values.iter().map(|v| self.known_number(v)).collect(),
            _ => None,
        };
        let numbers = numbers.ok_or_else(|| self.bad_type(field))?;
        let of = self.numeric_range(field, &element)?;
        in_range(field, &numbers, &of)?;
        if field.uniform {
            return Err(only_numbers(field));
        }
        Ok(OptionInfo {
            name: unraw(&field.name).replace('_', "-"),
            docs: field.docs.clone(),
            kind: OptionKind::List {
                len: match field.ty.peel_refs() {
                    SourceType::Array(_, None) => None,
                    _ => Some(numbers.len()),
                },
                of,
            },
            default: OptionValue::Numbers(numbers.into_iter().map(canonical_number).collect()),
            uniform: false,
        })
    }

    pub(super) fn bad_type(&self, field: &OptionField) -> Exit {
        Diagnostic::error_at(
            Code::OptionDeclaration,
            field.span,
            format!(
                "the option `{}` is neither a number, a boolean, an enum nor an array of numbers",
                field.name
            ),
        )
        .label("of this type")
        .help("options are f32, i32, u32, bool, an enum of the kernel's files, or an array of numbers")
        .into()
    }

    /// Range of the option `field` of scalar type `ty`.
    fn numeric_range(&mut self, field: &OptionField, ty: &str) -> Eval<Numeric> {
        let (min, max) = self.stated_limits(field)?;
        let scalar = match ty {
            "i32" => Scalar::I32,
            "u32" => Scalar::U32,
            _ => Scalar::F32,
        };
        Ok(Numeric { scalar, min, max })
    }

    /// Declared minimum and maximum of a number.
    fn stated_limits(&mut self, field: &OptionField) -> Eval<(Option<f64>, Option<f64>)> {
        let Some(range) = &field.range else {
            return Ok((None, None));
        };
        let ExprKind::Range(low, high, true) = &range.kind else {
            return Err(Diagnostic::error_at(
                Code::OptionDeclaration,
                range.span,
                "the range of an option includes both ends",
            )
            .help("write `[0.0..=1.0]`")
            .into());
        };
        let (low, high) = (self.eval_expr(low)?, self.eval_expr(high)?);
        let limits = (self.known_number(&low), self.known_number(&high));
        if let (Some(low), Some(high)) = limits
            && low > high
        {
            let text = format!("the range of the option `{}` holds no number", field.name);
            let help = format!(
                "it goes from {} to {}: write the lower end first",
                canonical_number(low),
                canonical_number(high)
            );
            return Err(Diagnostic::error_at(Code::OptionDeclaration, range.span, text)
                .help(help)
                .into());
        }
        Ok(limits)
    }

    fn known_number(&self, value: &Value) -> Option<f64> {
        match value {
            Value::Int(n) => Some(*n as f64),
            Value::Node(id) => {
                let bits = self.builder.graph().constant_bits(*id)?[0];
                match self.ty(*id) {
                    Type::F32 => Some(f64::from(f32::from_bits(bits))),
                    Type::I32 => Some(f64::from(bits as i32)),
                    Type::U32 => Some(f64::from(bits)),
                    _ => None,
                }
            }
            _ => None,
        }
    }
}

/// Rejects a default with a number outside the option's range.
fn in_range(field: &OptionField, defaults: &[f64], of: &Numeric) -> Result<(), Exit> {
    let (low, high) = (of.min.unwrap_or(f64::NEG_INFINITY), of.max.unwrap_or(f64::INFINITY));
    match defaults.iter().find(|n| !(low..=high).contains(*n)) {
        None => Ok(()),
        Some(n) => {
            let text = format!(
                "the default of the option `{}` is {}, outside of its range from {} to {}",
                field.name,
                canonical_number(*n),
                canonical_number(low),
                canonical_number(high)
            );
            Err(Diagnostic::error_at(Code::OptionDeclaration, field.default.span, text)
                .label("not in the range")
                .help("widen the range, or choose a default within it")
                .into())
        }
    }
}

fn only_numbers(field: &OptionField) -> Exit {
    Diagnostic::error_at(
        Code::OptionDeclaration,
        field.default.span,
        format!("the option `{}` cannot be set at run time", field.name),
    )
    .label("its default")
    .help("only single numbers can: give this one a default without `uniform(...)`")
    .into()
}
