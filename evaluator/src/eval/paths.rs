//! Resolution of paths: variable, constant, function, variant.

use super::Evaluator;
use super::enums::EnumValue;
use super::types::KnownType;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, Generic, generic_arguments, split_qualified};
use std::rc::Rc;

impl Evaluator<'_> {
    /// Evaluates a path to a variable, a constant or a variant.
    pub fn eval_path(&mut self, path: &[String], span: Span) -> Eval {
        let owner = match path {
            [of, _] => self.type_behind(of),
            _ => None,
        };
        if let (Some(ty), [_, name]) = (&owner, path)
            && let Some(key) = self.constant_key(ty, None, name)
        {
            return self.constant_by_key(key, Some(ty), span);
        }
        if let [key] = path
            && key.contains("::")
        {
            return self.constant_by_key(key, None, span);
        }
        let of_parameter = owner.map(|ty| vec![ty.name.clone(), path[1].clone()]);
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
            let joined = path.join("::");
            if !self.library.consts.contains_key(&joined) && !self.library.functions.contains_key(&joined) {
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
        if let Some(value) = self.eval_constant(name, None, span)? {
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

    /// Returns whether a path names a function: one in the kernel's files, or a method of a number or a vector.
    fn is_function(&self, path: &[String]) -> bool {
        let functions = &self.library.functions;
        match path {
            [name] => {
                functions.contains_key(name)
                    || crate::front::UNARY.contains(&name.as_str())
                    || self.library.is_tuple_structure(name)
                    || super::call::parse_constructor(path).is_some()
            }
            [.., ty, name] => {
                functions.contains_key(&path.join("::"))
                    || self.library.declared_function(ty, name).is_some()
                    || functions.contains_key(name)
                    || crate::infer::operator_function(ty, name).is_some()
                    || (crate::front::is_prelude_type(ty) && name.starts_with(char::is_lowercase))
            }
            [] => false,
        }
    }

    /// Evaluates a constant of a type that has arguments or of a trait: `Window::<3>::SIZE`, `<f32 as Zero>::ZERO`; `None` of other
    /// paths.
    pub fn owned_constant(&mut self, path: &[String], constants: &[Expr], span: Span) -> Eval<Option<Value>> {
        let last = path.last().map_or("", |last| last.rsplit("::").next().unwrap_or(last));
        if last.contains(char::is_lowercase) {
            return Ok(None);
        }
        let owner = generic_arguments(constants).1.cloned();
        let owner = owner.and_then(|owner| self.resolve_type(&owner));
        let key = match path {
            [key] if self.library.consts.contains_key(key) || split_qualified(key).is_some() => {
                return self.constant_by_key(key, owner.as_ref(), span).map(Some);
            }
            [ty, name] => {
                let owner = owner.clone().unwrap_or_else(|| KnownType::from_name(ty));
                self.constant_key(&owner, None, name)
            }
            [ty, of, name] => {
                let owner = owner.clone().or_else(|| self.type_behind(ty));
                let owner = owner.unwrap_or_else(|| KnownType::from_name(ty));
                self.constant_key(&owner, Some(of), name)
            }
            _ => None,
        };
        match key {
            Some(key) => self.constant_by_key(key, owner.as_ref(), span).map(Some),
            None if self.library.find_variant(path).is_some() => self.eval_path(path, span).map(Some),
            None => Ok(None),
        }
    }

    /// Evaluates a constant by its key, or by a trait and a type parameter: `<T as Zero>::ZERO`.
    fn constant_by_key(&mut self, key: &str, owner: Option<&Rc<KnownType>>, span: Span) -> Eval {
        if let Some(value) = self.eval_constant(key, owner.map(Rc::as_ref), span)? {
            return Ok(value);
        }
        let behind = split_qualified(key).and_then(|(of, named, name)| Some((self.type_behind(of)?, named, name)));
        if let Some((ty, of, name)) = behind
            && let Some(key) = self.constant_key(&ty, Some(of), name)
            && let Some(value) = self.eval_constant(key, Some(&ty), span)?
        {
            return Ok(value);
        }
        let error = Diagnostic::error_at(
            Code::TypeNeeded,
            span,
            format!("the type of the constant `{key}` is not known"),
        );
        Err(error
            .label("of which type?")
            .help("state the type in the call that leads here: `function::<Type>(...)`")
            .into())
    }

    /// Evaluates a constant of the kernel's files, once. The type that it is of tells the parameters of its `impl`.
    fn eval_constant(&mut self, name: &str, owner: Option<&KnownType>, span: Span) -> Eval<Option<Value>> {
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
        // The parameters of its `impl`, if no type is written, have the values of the function that mentions it.
        let mut given = Vec::new();
        for generic in &constant.generics {
            let of = constant.of.as_ref();
            let value = match owner.filter(|owner| !owner.args.is_empty()).zip(of) {
                Some((owner, of)) => owner.argument_of(of, generic.name()),
                None => self.scope.get(generic.name()).cloned(),
            };
            let Some(value) = value else {
                return Err(unknown_parameter(name, generic.name(), span));
            };
            let value = match generic {
                Generic::Const(_, ty) => self.ascribe_type(value, Some(ty), span)?,
                Generic::Type(_) => value,
            };
            given.push((generic.name(), value));
        }
        let outer = self.scope.enter_function();
        let is_shared = given.is_empty();
        for (parameter, value) in given {
            self.scope.bind(parameter, value);
        }
        self.report.enter_call(name);
        let value = self.expecting(&constant.value, Some(&constant.ty));
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
    .label("of a type whose arguments are not stated")
    .help("state them: `Type::<3>::NAME`, or compute it in a function of the type")
    .into()
}
