//! Resolution of paths: variable, constant, function, variant.

use super::Evaluator;
use super::call::vector_type;
use super::enums::EnumValue;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use std::rc::Rc;

impl Evaluator<'_> {
    /// Evaluates a path to a variable, a constant or a variant.
    pub fn eval_path(&mut self, path: &[String], span: Span) -> Eval {
        let of_parameter = match path {
            [of, name] => self.type_behind(of).map(|ty| vec![ty, name.clone()]),
            _ => None,
        };
        let path = of_parameter.as_deref().unwrap_or(path);
        let last = path.last().map(String::as_str).unwrap_or_default();
        if path.len() == 1
            && let Some(value) = self.scope.get(last)
        {
            return match value {
                Value::Poison => Err(Exit::Noted),
                Value::Unset => Err(self.unset_error(last, span)),
                Value::Alias(place) => {
                    let place = Rc::clone(place);
                    self.read_place(&place, span)
                }
                other => Ok(other.clone()),
            };
        }
        if let [.., ty, variant] = path
            && let Some(found) = self.library.enums.get(ty)
        {
            if let Some(k) = found.position(variant) {
                return Ok(match found.variants[k].fields.is_empty() {
                    true => EnumValue::with_variant(ty, found, k, Vec::new()),
                    false => Value::Function(path.to_vec()),
                });
            }
            if !self.library.consts.contains_key(&path.join("::")) {
                let names: Vec<&str> = found.variants.iter().map(|v| v.name.as_str()).collect();
                return Err(Diagnostic::error_at(
                    Code::UnknownVariant,
                    span,
                    format!("`{ty}` has no variant `{variant}`"),
                )
                .label("not there")
                .help(crate::suggest::suggest_name(variant, &names, "it has"))
                .into());
            }
        }
        let joined = path.join("::");
        let name = if self.library.consts.contains_key(&joined) {
            joined.as_str()
        } else {
            last
        };
        if self.library.structs.get(last).is_some_and(|s| s.fields.is_empty()) {
            return Ok(Value::structure(last, Vec::new()));
        }
        if let Some(value) = self.eval_constant(name, span)? {
            return Ok(value);
        }
        match self.known_constant(path) {
            Some(value) => Ok(value),
            None if self.is_function(path) => Ok(Value::Function(path.to_vec())),
            None => {
                let names = self.scope.variable_names();
                Err(Diagnostic::error_at(
                    Code::UnknownName,
                    span,
                    format!("there is no `{}` here", path.join("::")),
                )
                .label("not found")
                .help(crate::suggest::suggest_name(last, &names, "variables here are"))
                .into())
            }
        }
    }

    /// Returns the name of the type that a type parameter stands for, or an associated type of one: `T`, `T::Space`.
    pub fn type_behind(&self, of: &str) -> Option<String> {
        let (parameter, associated) = match of.split_once("::") {
            Some((parameter, name)) => (parameter, Some(name)),
            None => (of, None),
        };
        let Some(Value::Type(ty)) = self.scope.get(parameter) else {
            return None;
        };
        let Some(name) = associated else {
            return Some(ty.clone());
        };
        let Some(crate::front::tree::Type::Name(found, _)) =
            self.library.associated.get(&(ty.clone(), name.to_owned()))
        else {
            return None;
        };
        // A parameter of the type: what it stands for is known from the value.
        match self.scope.get(&format!("{parameter}::{found}")) {
            Some(Value::Type(argument)) => Some(argument.clone()),
            _ => Some(found.clone()),
        }
    }

    /// Returns whether a path names a function: one in the kernel's files, or a method of a number or a vector.
    fn is_function(&self, path: &[String]) -> bool {
        let functions = &self.library.functions;
        match path {
            [name] => functions.contains_key(name) || crate::front::UNARY.contains(&name.as_str()),
            [.., ty, name] => {
                functions.contains_key(&path.join("::"))
                    || functions.contains_key(name)
                    || ((vector_type(ty).is_some() || matches!(ty.as_str(), "f32" | "i32" | "u32"))
                        && name.starts_with(char::is_lowercase))
            }
            [] => false,
        }
    }

    /// Evaluates a constant of the kernel's files, once.
    fn eval_constant(&mut self, name: &str, span: Span) -> Eval<Option<Value>> {
        if let Some(value) = self.consts.get(name).map(|(_, value)| value) {
            return Ok(Some(value.clone()));
        }
        let library = self.library;
        let Some((name, constant)) = library.consts.get_key_value(name) else {
            return Ok(None);
        };
        if self.report.is_too_deep() {
            return Err(Diagnostic::error_at(
                Code::EndlessDefinition,
                span,
                format!("the constant `{name}` needs itself"),
            )
            .label("used here")
            .help("write out one of the values in the cycle")
            .into());
        }
        // The parameters of its `impl` have the values of the function that mentions it.
        let mut given = Vec::new();
        for generic in &constant.generics {
            let Some(value) = self.scope.get(generic.name()).cloned() else {
                return Err(unknown_parameter(name, generic.name(), span));
            };
            given.push((generic.name(), value));
        }
        let outer = self.scope.enter_function();
        let is_shared = given.is_empty();
        for (parameter, value) in given {
            self.scope.bind(parameter, value);
        }
        self.report.enter_call(name);
        let value = self.eval_expr(&constant.value);
        self.report.leave_call();
        self.scope.leave_function(outer);
        let value = self.ascribe_type(value?, Some(&constant.ty), constant.value.span)?;
        if is_shared {
            let made = self.builder.graph().nodes.len();
            self.consts.insert(name.to_owned(), (made, value.clone()));
        }
        Ok(Some(value))
    }
}

fn unknown_parameter(constant: &str, parameter: &str, span: Span) -> Exit {
    Diagnostic::error_at(
        Code::TypeNeeded,
        span,
        format!("the parameter `{parameter}` of the constant `{constant}` is not known here"),
    )
    .label("outside of its type's own functions")
    .help("compute it in a function of the type, which has the parameter")
    .into()
}
