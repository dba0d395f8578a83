//! Options of a kernel: their declarations, and the values of one setting.

mod declared;
mod parse;

use super::Evaluator;
use super::enums::EnumValue;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Errors, File};
use crate::front::tree::{OptionField, Type as SourceType};
use crate::front::{Library, raw_name};
use crate::ir::{Op, Override, Scalar, Type, Uniform};
use crate::policy::Policy;
use std::sync::Arc;
use straightline_kernels::{OptionText, OptionValue, OptionValues, kebab};

pub(super) use parse::unknown_settings;
pub use parse::{override_text, parse_settings};

/// An option of a kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct OptionInfo {
    /// Name on the command line: the field's, with `-` for `_`.
    pub name: String,
    /// Documentation of the field.
    pub docs: String,
    /// Kind of its values.
    pub kind: OptionKind,
    /// Default. An option that is set at run time has this value until then.
    pub default: OptionValue,
    /// `true` if the option is set at run time unless a setting overrides that.
    pub uniform: bool,
}

impl OptionInfo {
    /// Value of the option if no setting names it.
    pub fn default_value(&self) -> OptionValue {
        match self.uniform {
            true => OptionValue::Uniform,
            false => self.default.clone(),
        }
    }
}

/// Kind of an option's values.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionKind {
    /// A choice of several values, each with its meaning.
    Choice(Vec<(String, String)>),
    /// A number, `uniform` for one that is set at run time, or `override` for one that is set when the pipeline is
    /// created.
    Number(Numeric),
    /// Several numbers, separated by commas.
    List {
        /// Required length; `None` if any length is allowed.
        len: Option<usize>,
        /// Range of each.
        of: Numeric,
    },
    /// `true` or `false`, or `override`.
    Flag,
}

/// Range of a numeric option: a scalar type with inclusive bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numeric {
    /// `f32`, `i32` or `u32`.
    pub scalar: Scalar,
    /// Smallest value, if it is bounded.
    pub min: Option<f64>,
    /// Largest value, if it is bounded.
    pub max: Option<f64>,
}

impl Numeric {
    /// Returns whether the option allows whole numbers only.
    pub fn is_integer(&self) -> bool {
        self.scalar != Scalar::F32
    }
}

/// The options of the kernel `entry`, in order of declaration.
pub fn describe_options(library: &Library, files: &Arc<Vec<File>>, entry: &str) -> Result<Vec<OptionInfo>, Errors> {
    let (entry, policy) = (&*raw_name(entry), Policy::default());
    let mut evaluator = Evaluator::new(library, files, &policy);
    let mut infos = Vec::new();
    let fields = option_fields(library, entry);
    for error in duplicate_errors(&fields) {
        evaluator.record_error(error);
    }
    for field in fields {
        match evaluator.option_info(field) {
            Ok(info) => infos.push(info),
            Err(exit) => {
                evaluator.record_error(exit);
            }
        }
    }
    match evaluator.report.error_count() {
        0 => Ok(infos),
        _ => Err(evaluator.report.take_located()),
    }
}

/// Options declared for `entry`: the fields of its parameter that is an options structure.
fn option_fields<'a>(library: &'a Library, entry: &str) -> Vec<&'a OptionField> {
    let params = library
        .functions
        .get(entry)
        .map(|f| f.params.as_slice())
        .unwrap_or_default();
    let declared = params.iter().filter_map(|param| match param.ty.peel_refs() {
        SourceType::Name(name, _) => library.options.get(name),
        _ => None,
    });
    declared.flatten().collect()
}

/// Errors for fields whose name was declared before.
fn duplicate_errors(fields: &[&OptionField]) -> Vec<Exit> {
    let again = fields.iter().enumerate().filter_map(|(k, field)| {
        let first = fields[..k].iter().find(|other| other.name == field.name)?;
        let error = Diagnostic::error_at(
            Code::DefinedTwice,
            field.span,
            format!("the option `{}` is declared twice", field.name),
        )
        .label("declared again")
        .label_at(first.span, "first declared here")
        .help("give one of them another name");
        Some(error.into())
    });
    again.collect()
}

impl Evaluator<'_> {
    /// Builds the options structure, with each field set or at its default.
    pub fn configure_options(&mut self, ty: &str, settings: &[OptionText], chosen: &mut OptionValues) -> Eval {
        let library = self.library;
        let mut values = Vec::new();
        let declared = &library.options[ty];
        for error in duplicate_errors(&declared.iter().collect::<Vec<_>>()) {
            self.record_error(error);
        }
        for field in declared {
            let info = match self.option_info(field) {
                Ok(info) => info,
                Err(exit) => {
                    self.record_error(exit);
                    values.push(((&field.name).into(), Value::Poison));
                    continue;
                }
            };
            let (chosen_value, value) = match parse::setting_value(&info, settings) {
                Ok(parsed) => {
                    // The options of earlier structures have been inserted.
                    let id = chosen.iter().len() as u32;
                    let value = self.value_of(field, &info, &parsed, id)?;
                    (parsed, value)
                }
                Err(errors) => {
                    errors.into_iter().for_each(|error| {
                        self.record_error(error.into());
                    });
                    (info.default_value(), Value::Poison)
                }
            };
            chosen.insert(info.name, chosen_value);
            values.push(((&field.name).into(), value));
        }
        Ok(Value::structure(ty, values))
    }

    /// Value of an option in the kernel, whose position is `id`. A setting equal to the default shares its node, so
    /// that both emit the same text.
    fn value_of(&mut self, field: &OptionField, info: &OptionInfo, value: &OptionValue, id: u32) -> Eval {
        if *value == info.default {
            let default = self.eval_expr(&field.default)?;
            return self.ascribe_type(default, Some(&field.ty), field.default.span);
        }
        match (value, &info.kind) {
            (OptionValue::Flag(on), _) => Ok(Value::Node(self.builder.bool(*on))),
            (OptionValue::Choice(name), _) => {
                let SourceType::Name(ty, _) = field.ty.peel_refs() else {
                    return Err(self.bad_type(field));
                };
                let definition = self.library.enums.get(ty).ok_or_else(|| self.bad_type(field))?;
                let variant = definition.variants.iter().position(|v| kebab(&v.name) == *name);
                let variant = variant.ok_or_else(|| self.bad_type(field))?;
                Ok(EnumValue::with_variant(ty, definition, variant, Vec::new()))
            }
            (OptionValue::Number(number), OptionKind::Number(of)) => Ok(self.number_of(of.scalar, *number)),
            (OptionValue::Numbers(numbers), OptionKind::List { of, .. }) => {
                let numbers = numbers.iter().map(|number| self.number_of(of.scalar, *number));
                Ok(Value::array(numbers.collect()))
            }
            (OptionValue::Uniform, OptionKind::Number(of)) => Ok(self.add_uniform(
                &self.option_name(&field.name),
                Type::scalar(of.scalar),
                info.default.number(),
            )),
            (OptionValue::Override(default), kind) => {
                let (ty, range, default) = match (kind, &**default) {
                    (OptionKind::Number(of), OptionValue::Number(default)) => (
                        Type::scalar(of.scalar),
                        of.min.zip(of.max).map(|(low, high)| [low, high].map(canonical_number)),
                        *default,
                    ),
                    (OptionKind::Flag, OptionValue::Flag(on)) => (Type::BOOL, None, f64::from(u8::from(*on))),
                    _ => return Err(self.bad_type(field)),
                };
                let name = self.option_name(&field.name);
                let overrides = &mut self.builder.graph_mut().overrides;
                overrides.push(Override {
                    name,
                    id,
                    ty,
                    default,
                    range,
                });
                let index = overrides.len() as u32 - 1;
                Ok(Value::Node(self.builder.add(Op::Override(index), Vec::new(), ty)))
            }
            _ => Err(self.bad_type(field)),
        }
    }

    fn number_of(&mut self, scalar: Scalar, number: f64) -> Value {
        Value::Node(match scalar {
            Scalar::F32 => self.builder.f32(number as f32),
            Scalar::U32 => self.builder.constant(Type::U32, [number as u32, 0, 0, 0]),
            _ => self.builder.i32(number as i32),
        })
    }

    /// Adds a value that is set at run time.
    pub fn add_uniform(&mut self, name: &str, ty: Type, default: Option<f64>) -> Value {
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

/// Canonical form of a number, so that all spellings of one `f32` or integer agree: the shortest decimal, or all digits
/// of a whole number.
fn canonical_number(number: f64) -> f64 {
    if number.fract() == 0.0 && number.abs() < 1e15 {
        // -0 + 0 is 0.
        number + 0.0
    } else {
        // `Display` of an f32 always parses.
        (number as f32).to_string().parse().unwrap_or(number)
    }
}
