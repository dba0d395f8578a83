//! A kernel's options: what there are, and the values of one setting.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Errors, File};
use crate::front::Library;
use crate::front::tree::{ExprKind, OptionField, Type as SourceType};
use crate::ir::{Op, Scalar, Type, Uniform};
use crate::policy::Policy;
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
    let policy = Policy::default();
    let mut evaluator = Evaluator::new(library, files, &policy);
    let mut infos = Vec::new();
    for field in fields(library, entry) {
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
        for field in &library.options[ty] {
            let info = self.info(field)?;
            let text = settings
                .iter()
                .rev()
                .find(|(name, _)| *name == info.name)
                .map(|(_, value)| value.as_str())
                .or(info.uniform.then_some(UNIFORM));
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
            values.push((field.name.clone(), value));
        }
        Ok(Value::structure(ty, values))
    }

    fn info(&mut self, field: &OptionField) -> Eval<OptionInfo> {
        let default = self.expr(&field.default)?;
        let default = self.ascribe(default, Some(&field.ty), field.default.span)?;
        let ty = match field.ty.bare() {
            SourceType::Name(ty, _) => ty,
            SourceType::Array(..) => return self.list_info(field, &default),
            SourceType::Tuple(_) | SourceType::Ref(..) => return Err(self.bad_type(field)),
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
                (OptionKind::Number { integer, min, max }, shortest(number))
            }
            (_, Value::Enum { ty, variant }) => {
                let variants = self
                    .library
                    .enums
                    .get(ty)
                    .map(|e| e.variants.as_slice())
                    .unwrap_or_default();
                let choices = variants
                    .iter()
                    .map(|(name, docs)| (kebab(name), docs.clone()))
                    .collect();
                (OptionKind::Choice(choices), kebab(variant))
            }
            _ => return Err(self.bad_type(field)),
        };
        if field.uniform && !matches!(kind, OptionKind::Number { .. }) {
            return Err(only_numbers(field));
        }
        Ok(OptionInfo {
            name: field.name.replace('_', "-"),
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
        let numbers: Option<Vec<String>> = match default {
            Value::Array(values) => values.iter().map(|v| self.number(v).map(shortest)).collect(),
            _ => None,
        };
        let numbers = numbers.ok_or_else(|| self.bad_type(field))?;
        let (min, max) = self.limits(field)?;
        if field.uniform {
            return Err(only_numbers(field));
        }
        Ok(OptionInfo {
            name: field.name.replace('_', "-"),
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
            default: numbers.join(","),
            uniform: false,
        })
    }

    fn bad_type(&self, field: &OptionField) -> Exit {
        Diagnostic::at(
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
            return Err(Diagnostic::at(range.span, "the range of an option includes both ends")
                .help("write `[0.0..=1.0]`")
                .into());
        };
        let (low, high) = (self.expr(low)?, self.expr(high)?);
        Ok((self.number(&low), self.number(&high)))
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
            Diagnostic::new(format!("`{text}` is not a value of the option `{}`", info.name))
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
                let variants = self
                    .library
                    .enums
                    .get(ty)
                    .map(|e| e.variants.as_slice())
                    .unwrap_or_default();
                match variants.iter().find(|(name, _)| kebab(name) == text) {
                    Some((variant, _)) => Ok(Value::Enum {
                        ty: ty.clone(),
                        variant: variant.clone(),
                    }),
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
                        "give {many} numbers; a list is known when the shader is made"
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
                    return Ok(self.uniform(&field.name, Type::scalar(kind), info.default.parse().ok()));
                }
                let (low, high) = (min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY));
                let allowed = match (min, max) {
                    (Some(low), Some(high)) => {
                        format!("use a number from {low} to {high}, or `{UNIFORM}` to set it at run time")
                    }
                    _ => format!("use a number, or `{UNIFORM}` to set it at run time"),
                };
                let number = text
                    .parse::<f64>()
                    .ok()
                    .filter(|n| n.is_finite() && (!integer || n.fract() == 0.0));
                match number {
                    Some(n) if n >= low && n <= high && (n as f32).is_finite() => Ok(match kind {
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
        });
        let index = uniforms.len() as u32 - 1;
        Value::Node(self.builder.add(Op::Uniform(index), Vec::new(), ty))
    }
}

fn only_numbers(field: &OptionField) -> Exit {
    Diagnostic::at(
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

fn shortest(number: f64) -> String {
    format!("{}", number as f32)
}
