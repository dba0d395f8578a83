//! A kernel's options: what there are, and the values of one setting.

use super::Evaluator;
use super::enums::Choice;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Errors, File};
use crate::front::tree::{ExprKind, OptionField, Type as SourceType};
use crate::front::{Library, unraw};
use crate::ir::{Op, Scalar, Type, Uniform};
use crate::policy::Policy;
use crate::shorten::shorten;
use std::collections::BTreeMap;
use std::sync::Arc;

/// One option of a kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionInfo {
    /// Name on the command line: the field's, with `-` for `_`.
    pub name: String,
    /// What it decides.
    pub docs: String,
    /// What it can be.
    pub kind: OptionKind,
    /// Its default, as it would be written.
    pub default: String,
    /// Whether it is `uniform` unless a setting says otherwise: a number that is set at run time, with this default.
    pub uniform: bool,
}

/// What an option can be.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionKind {
    /// One of some values, each with its meaning.
    Choice(Vec<(String, String)>),
    /// A number within a range, both ends included; or `uniform`, to be set at run time.
    Number {
        /// Whether it is a whole number.
        integer: bool,
        /// Smallest value, if it is bounded.
        min: Option<f64>,
        /// Largest value, if it is bounded.
        max: Option<f64>,
    },
    /// As many numbers, separated by commas.
    List {
        /// How many; any number of them if there is none.
        len: Option<usize>,
        /// Whether they are whole numbers.
        integer: bool,
        /// Smallest value, if it is bounded.
        min: Option<f64>,
        /// Largest value, if it is bounded.
        max: Option<f64>,
    },
    /// `true` or `false`.
    Flag,
}

/// The word for an option that is set at run time.
const UNIFORM: &str = "uniform";

/// The options of the kernel `entry`, in order of declaration.
pub fn describe(library: &Library, files: &Arc<Vec<File>>, entry: &str) -> Result<Vec<OptionInfo>, Errors> {
    let (entry, policy) = (&*crate::front::raw(entry), Policy::default());
    let mut evaluator = Evaluator::new(library, files, &policy);
    let mut infos = Vec::new();
    let fields = fields(library, entry);
    for error in twice(&fields) {
        evaluator.note(error);
    }
    for field in fields {
        match evaluator.info(field) {
            Ok(info) => infos.push(info),
            Err(exit) => {
                evaluator.note(exit);
            }
        }
    }
    if evaluator.errors.is_empty() {
        Ok(infos)
    } else {
        Err(Errors::new(evaluator.errors, files))
    }
}

/// The options declared for `entry`, of whichever of its parameters is made of options.
fn fields<'a>(library: &'a Library, entry: &str) -> Vec<&'a OptionField> {
    let params = library
        .functions
        .get(entry)
        .map(|f| f.params.as_slice())
        .unwrap_or_default();
    let declared = params.iter().filter_map(|param| match param.ty.bare() {
        SourceType::Name(name, _) => library.options.get(name),
        _ => None,
    });
    declared.flatten().collect()
}

/// An error for every field that has the name of one before it.
fn twice(fields: &[&OptionField]) -> Vec<Exit> {
    let again = fields.iter().enumerate().filter_map(|(k, field)| {
        let first = fields[..k].iter().find(|other| other.name == field.name)?;
        let error = Diagnostic::at(
            Code::DefinedTwice,
            field.span,
            format!("the option `{}` is declared twice", field.name),
        )
        .label("declared again")
        .other(first.span, "first declared here")
        .help("give one of them another name");
        Some(error.into())
    });
    again.collect()
}

impl Evaluator<'_> {
    /// A structure of options with each field set or at its default.
    pub fn configure(
        &mut self,
        ty: &str,
        settings: &[(String, String)],
        chosen: &mut BTreeMap<String, String>,
    ) -> Eval {
        let library = self.library;
        let mut values = Vec::new();
        let declared = &library.options[ty];
        for error in twice(&declared.iter().collect::<Vec<_>>()) {
            self.note(error);
        }
        for field in declared {
            let info = match self.info(field) {
                Ok(info) => info,
                Err(exit) => {
                    self.note(exit);
                    values.push(((&field.name).into(), Value::Poison));
                    continue;
                }
            };
            let mut set = settings.iter().filter(|(name, _)| *name == info.name);
            let first = set.next().map(|(_, value)| value.as_str());
            if let Some((_, again)) = set.next() {
                let error = Diagnostic::new(
                    Code::OptionValue,
                    format!(
                        "the option `{}` is set twice, to `{}` and to `{}`",
                        info.name,
                        shorten(first.unwrap_or_default()),
                        shorten(again)
                    ),
                );
                self.note(error.help("set it once").into());
            }
            let text = first.or(info.uniform.then_some(UNIFORM));
            let value = match text {
                Some(text) => match self.parse(field, &info, text) {
                    Ok(value) => value,
                    Err(exit) => {
                        self.note(exit);
                        Value::Poison
                    }
                },
                None => {
                    let default = self.expr(&field.default)?;
                    self.ascribe(default, Some(&field.ty), field.default.span)?
                }
            };
            chosen.insert(info.name.clone(), text.unwrap_or(&info.default).to_owned());
            values.push(((&field.name).into(), value));
        }
        Ok(Value::structure(ty, values))
    }

    fn info(&mut self, field: &OptionField) -> Eval<OptionInfo> {
        let default = self.expr(&field.default)?;
        let default = self.ascribe(default, Some(&field.ty), field.default.span)?;
        let ty = match field.ty.bare() {
            SourceType::Name(ty, _) => ty,
            SourceType::Array(..) => return self.list_info(field, &default),
            SourceType::Tuple(_) | SourceType::Ref(..) | SourceType::Fn(..) | SourceType::Const(_) => {
                return Err(self.bad_type(field));
            }
        };
        let (kind, default) = match (ty.as_str(), &default) {
            ("bool", Value::Node(id)) => {
                let on = self.known_bool(*id).unwrap_or_default();
                (OptionKind::Flag, on.to_string())
            }
            ("f32" | "i32" | "u32", value) => {
                let (min, max) = self.limits(field)?;
                let integer = ty != "f32";
                let number = self.number(value).ok_or_else(|| self.bad_type(field))?;
                in_range(field, &[number], min, max)?;
                (OptionKind::Number { integer, min, max }, shortest(number))
            }
            (_, Value::Enum(choice)) => {
                let definition = self.library.enums.get(&*choice.ty);
                let variants = definition.map_or(&[][..], |e| &e.variants);
                let holds = variants.iter().any(|variant| !variant.fields.is_empty());
                let variant = self.known_variant(choice).filter(|_| !holds);
                let variant = variant.ok_or_else(|| self.bad_type(field))?;
                let choices = variants.iter().map(|v| (kebab(&v.name), v.docs.clone())).collect();
                (OptionKind::Choice(choices), kebab(&variants[variant].name))
            }
            _ => return Err(self.bad_type(field)),
        };
        if field.uniform && !matches!(kind, OptionKind::Number { .. }) {
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

    /// An option that is an array of numbers.
    fn list_info(&mut self, field: &OptionField, default: &Value) -> Eval<OptionInfo> {
        let element = match field.ty.bare() {
            SourceType::Array(element, _) => match &**element {
                SourceType::Name(name, _) if matches!(name.as_str(), "f32" | "i32" | "u32") => name.clone(),
                _ => return Err(self.bad_type(field)),
            },
            _ => return Err(self.bad_type(field)),
        };
        let numbers: Option<Vec<f64>> = match default {
            Value::Array(values) => values.iter().map(|v| self.number(v)).collect(),
            _ => None,
        };
        let numbers = numbers.ok_or_else(|| self.bad_type(field))?;
        let (min, max) = self.limits(field)?;
        in_range(field, &numbers, min, max)?;
        if field.uniform {
            return Err(only_numbers(field));
        }
        Ok(OptionInfo {
            name: unraw(&field.name).replace('_', "-"),
            docs: field.docs.clone(),
            kind: OptionKind::List {
                len: match field.ty.bare() {
                    SourceType::Array(_, None) => None,
                    _ => Some(numbers.len()),
                },
                integer: element != "f32",
                min,
                max,
            },
            default: numbers.into_iter().map(shortest).collect::<Vec<_>>().join(","),
            uniform: false,
        })
    }

    fn bad_type(&self, field: &OptionField) -> Exit {
        Diagnostic::at(
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

    /// Smallest and largest value of a number.
    fn limits(&mut self, field: &OptionField) -> Eval<(Option<f64>, Option<f64>)> {
        let Some(range) = &field.range else {
            return Ok((None, None));
        };
        let ExprKind::Range(low, high, true) = &range.kind else {
            return Err(Diagnostic::at(
                Code::OptionDeclaration,
                range.span,
                "the range of an option includes both ends",
            )
            .help("write `[0.0..=1.0]`")
            .into());
        };
        let (low, high) = (self.expr(low)?, self.expr(high)?);
        let limits = (self.number(&low), self.number(&high));
        if let (Some(low), Some(high)) = limits
            && low > high
        {
            let text = format!("the range of the option `{}` holds no number", field.name);
            let help = format!(
                "it goes from {} to {}: write the lower end first",
                shortest(low),
                shortest(high)
            );
            return Err(Diagnostic::at(Code::OptionDeclaration, range.span, text)
                .help(help)
                .into());
        }
        Ok(limits)
    }

    fn number(&self, value: &Value) -> Option<f64> {
        match value {
            Value::Int(n) => Some(*n as f64),
            Value::Node(id) => {
                let bits = self.builder.graph().constant(*id)?[0];
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

    /// The value that `text` stands for.
    fn parse(&mut self, field: &OptionField, info: &OptionInfo, text: &str) -> Eval {
        let refuse = |allowed: String| -> Exit {
            Diagnostic::new(
                Code::OptionValue,
                format!("`{}` is not a value of the option `{}`", shorten(text), info.name),
            )
            .help(allowed)
            .into()
        };
        match &info.kind {
            OptionKind::Flag => match text {
                "true" => Ok(Value::Node(self.builder.bool(true))),
                "false" => Ok(Value::Node(self.builder.bool(false))),
                _ => Err(refuse("use true or false".to_owned())),
            },
            OptionKind::Choice(choices) => {
                let SourceType::Name(ty, _) = &field.ty else {
                    return Err(self.bad_type(field));
                };
                let library = self.library;
                let definition = library.enums.get(ty).ok_or_else(|| self.bad_type(field))?;
                match definition.variants.iter().position(|v| kebab(&v.name) == text) {
                    Some(k) => Ok(Choice::known(ty, definition, k, Vec::new())),
                    None => {
                        let names: Vec<&str> = choices.iter().map(|(name, _)| name.as_str()).collect();
                        Err(refuse(format!("use one of {}", names.join(", "))))
                    }
                }
            }
            OptionKind::List { len, integer, min, max } => {
                let one = OptionInfo {
                    kind: OptionKind::Number {
                        integer: *integer,
                        min: *min,
                        max: *max,
                    },
                    ..info.clone()
                };
                let mut parts: Vec<&str> = text.split(',').map(str::trim).collect();
                let many = len.map_or("any number of".to_owned(), |len| len.to_string());
                match len {
                    None if text.trim().is_empty() => parts.clear(),
                    Some(len) if parts.len() != *len => {
                        return Err(refuse(format!("give {many} numbers, separated by commas")));
                    }
                    _ => {}
                }
                if parts.contains(&UNIFORM) {
                    return Err(refuse(format!(
                        "give {many} numbers; a list is a compile-time constant"
                    )));
                }
                let values: Eval<Vec<Value>> = parts.iter().map(|part| self.parse(field, &one, part)).collect();
                Ok(Value::array(values?))
            }
            OptionKind::Number { integer, min, max } => {
                let ty = match field.ty.bare() {
                    SourceType::Array(element, _) => element,
                    other => other,
                };
                let kind = match ty {
                    SourceType::Name(name, _) if name == "i32" => Scalar::I32,
                    SourceType::Name(name, _) if name == "u32" => Scalar::U32,
                    _ => Scalar::F32,
                };
                if text == UNIFORM {
                    return Ok(self.uniform(
                        &self.option_name(&field.name),
                        Type::scalar(kind),
                        info.default.parse().ok(),
                    ));
                }
                // An `f32` is compared with the bounds as the `f32` that it becomes: 0.001 is not below 0.001f32.
                let held = |n: f64| match kind {
                    Scalar::F32 => f64::from(n as f32),
                    _ => n,
                };
                let (low, high) = match kind {
                    Scalar::I32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
                    Scalar::U32 => (0.0, f64::from(u32::MAX)),
                    _ => (f64::from(f32::MIN), f64::from(f32::MAX)),
                };
                let (low, high) = (
                    min.map_or(low, |min| min.max(low)),
                    max.map_or(high, |max| max.min(high)),
                );
                let what = if *integer { "a whole number" } else { "a number" };
                let allowed = match (kind, min, max) {
                    (Scalar::F32, None, None) => {
                        format!("use {what} that an f32 can hold, or `{UNIFORM}` to set it at run time")
                    }
                    (Scalar::F32, ..) => {
                        let (low, high) = (shortest(low), shortest(high));
                        format!("use {what} from {low} to {high}, or `{UNIFORM}` to set it at run time")
                    }
                    _ => format!("use {what} from {low} to {high}, or `{UNIFORM}` to set it at run time"),
                };
                let number = text
                    .parse::<f64>()
                    .ok()
                    .filter(|n| n.is_finite() && (!integer || n.fract() == 0.0));
                match number {
                    Some(n) if (low..=high).contains(&held(n)) => Ok(match kind {
                        Scalar::F32 => Value::Node(self.builder.f32(n as f32)),
                        Scalar::U32 => Value::Node(self.builder.constant(Type::U32, [n as u32, 0, 0, 0])),
                        _ => Value::Node(self.builder.i32(n as i32)),
                    }),
                    _ => Err(refuse(allowed)),
                }
            }
        }
    }

    /// A value that is set at run time.
    pub fn uniform(&mut self, name: &str, ty: Type, default: Option<f64>) -> Value {
        let uniforms = &mut self.builder.graph_mut().uniforms;
        uniforms.push(Uniform {
            name: name.to_owned(),
            ty,
            default,
            part: None,
        });
        let index = uniforms.len() as u32 - 1;
        Value::Node(self.builder.add(Op::Uniform(index), Vec::new(), ty))
    }
}

/// Refuses a default with a number outside of the option's range.
fn in_range(field: &OptionField, defaults: &[f64], min: Option<f64>, max: Option<f64>) -> Result<(), Exit> {
    let (low, high) = (min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY));
    match defaults.iter().find(|n| !(low..=high).contains(*n)) {
        None => Ok(()),
        Some(n) => {
            let text = format!(
                "the default of the option `{}` is {}, outside of its range from {} to {}",
                field.name,
                shortest(*n),
                shortest(low),
                shortest(high)
            );
            Err(Diagnostic::at(Code::OptionDeclaration, field.default.span, text)
                .label("not in the range")
                .help("widen the range, or choose a default within it")
                .into())
        }
    }
}

fn only_numbers(field: &OptionField) -> Exit {
    Diagnostic::at(
        Code::OptionDeclaration,
        field.default.span,
        format!("the option `{}` cannot be set at run time", field.name),
    )
    .label("its default")
    .help("only single numbers can: give this one a default without `uniform(...)`")
    .into()
}

/// `DepthNormals` as `depth-normals`.
fn kebab(name: &str) -> String {
    let mut text = String::new();
    for (k, c) in name.chars().enumerate() {
        if c.is_uppercase() && k > 0 {
            text.push('-');
        }
        text.extend(c.to_lowercase());
    }
    text
}

/// A number in as few digits as tell it from every other `f32`; a whole one in all of its digits.
fn shortest(number: f64) -> String {
    if number.fract() == 0.0 && number.abs() < 1e15 {
        format!("{number}")
    } else {
        format!("{}", number as f32)
    }
}
