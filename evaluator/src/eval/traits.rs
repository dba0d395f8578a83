//! Members that traits add to values: operators of structures, methods overloaded by argument types, members of type
//! parameters. A value carries its type, so a call resolves its function from the values alone.

use super::Evaluator;
use super::enums::EnumValue;
use super::generics::is_parameter;
use super::objects::OBJECT;
use super::types::KnownType;
use super::types::hidden_field;
use super::value::{Eval, Exit, Place, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{
    ARRAY, Expr, Function, Generic, Type as SourceType, qualify_name, split_qualified, tuple_name,
};
use crate::ir::{BinaryOp, UnaryOp};
use std::rc::Rc;

/// Returns the trait of an operator and the trait's function.
fn trait_of(op: BinaryOp) -> Option<(&'static str, &'static str)> {
    match op {
        BinaryOp::Eq | BinaryOp::Ne => Some(("PartialEq", "eq")),
        other => crate::infer::trait_of(other),
    }
}

impl<'a> Evaluator<'a> {
    /// Returns the names under which functions of a value's type are found. A known integer has every integer type.
    pub fn type_names(&self, value: &Value) -> Vec<String> {
        match value {
            Value::Struct { ty, .. } => vec![ty.to_string()],
            Value::Enum(choice) if choice.ty == OBJECT => Vec::new(),
            Value::Enum(choice) => vec![choice.ty.to_string()],
            Value::Int(_) => vec!["usize".to_owned(), "i32".to_owned(), "u32".to_owned()],
            Value::Array(_) | Value::Table(_) => vec![ARRAY.to_owned()],
            Value::Node(id) if self.ty(*id).is_array() => vec![ARRAY.to_owned()],
            Value::Tuple(parts) => vec![tuple_name(parts.len())],
            Value::Node(id) => vec![self.ty(*id).in_rust()],
            _ => Vec::new(),
        }
    }

    /// `true` if a value may have the stated type. References have been resolved already.
    pub fn is_of(&mut self, value: &Value, ty: &SourceType, generics: &[Generic]) -> bool {
        match (ty.peel_refs(), value) {
            (SourceType::Name(name, _), _) if generics.iter().any(|generic| generic.name() == name) => true,
            (SourceType::Name(name, _), Value::Array(_) | Value::Table(_)) => self.is_unknown_name(name),
            (SourceType::Name(name, args), _) => {
                let names = self.type_names(value);
                let is_named = names.is_empty() || names.contains(name);
                is_named && self.has_arguments(value, args, generics) || self.is_unknown_name(name)
            }
            (SourceType::Tuple(types), Value::Tuple(parts)) => {
                types.len() == parts.len() && parts.iter().zip(types).all(|(part, ty)| self.is_of(part, ty, generics))
            }
            (SourceType::Array(element, len), value) if let Some(count) = self.array_len(value) => {
                let is_own = |len: &Expr| generics.iter().any(|own| is_parameter(&len.kind, own.name()));
                let stated = len.as_deref().filter(|len| !is_own(len));
                let stated = stated.and_then(|len| self.eval_expr(len).ok());
                let fits = stated.is_none_or(|len| self.as_constant(&len) == Some(count as i64));
                let first = match fits && count > 0 {
                    true => self.array_element(value, &Value::Int(0), Span::default()).ok(),
                    false => None,
                };
                fits && first.is_none_or(|first| self.is_of(&first, element, generics))
            }
            (SourceType::Fn(..), value) => value.is_called(),
            _ => false,
        }
    }

    /// `true` if a name does not denote a type; the values determine what inference found there.
    pub fn is_unknown_name(&self, name: &str) -> bool {
        matches!(name, "_" | "Self") || !(self.library.has_type(name) || crate::front::is_prelude_type(name))
    }

    /// Returns the overload that accepts the values.
    pub fn find_overload(&mut self, keys: &[&'a str], values: &[Value], span: Span) -> Eval<Option<&'a str>> {
        if keys.len() < 2 {
            return Ok(keys.first().copied());
        }
        let mut loaded = Vec::new();
        for value in values {
            loaded.push(self.deref_value(value.clone(), span)?);
        }
        let library = self.library;
        let mut found = Vec::new();
        for key in keys {
            let function = &library.functions[*key];
            let mut pairs = function.params.iter().zip(&loaded);
            if function.params.len() == loaded.len()
                && pairs.all(|(param, value)| self.is_of(value, &param.ty, &function.generics))
            {
                found.push(*key);
            }
        }
        match found.as_slice() {
            [] => Ok(None),
            [key] => Ok(Some(key)),
            [first, second, ..] => Err(Diagnostic::error_at(
                Code::TraitBound,
                span,
                format!("`{first}` or `{second}`: the values do not tell which"),
            )
            .label("called here, in a generic function")
            .help("write the function for each type")
            .into()),
        }
    }

    /// Evaluates an operator that a trait defines for its operands; `None` if they are numbers, or values that Rust
    /// compares natively.
    pub fn operator_of_trait(&mut self, op: BinaryOp, left: &Value, right: &Value, span: Span) -> Eval<Option<Value>> {
        let own = |value: &Value| matches!(value, Value::Struct { .. } | Value::Enum(_));
        if !own(left) && !own(right) {
            return Ok(None);
        }
        if matches!(op, BinaryOp::Lt | BinaryOp::Le | BinaryOp::Gt | BinaryOp::Ge) {
            return self.ordered_by_hand(op, left, right, span);
        }
        let Some((of, name)) = trait_of(op) else {
            return Ok(None);
        };
        let keys = self.keys_of_operator(left, of, name);
        let values = vec![left.clone(), right.clone()];
        let Some(key) = self.find_overload(&keys, &values, span)? else {
            return Ok(None);
        };
        let value = self.inline_function(key, &[], values, span)?;
        match op {
            BinaryOp::Ne => self.eval_unary(UnaryOp::Not, &value, span).map(Some),
            _ => Ok(Some(value)),
        }
    }

    /// Returns the functions that a value's type has for a function of an operator's trait.
    pub fn keys_of_operator(&self, value: &Value, of: &str, name: &str) -> Vec<&'a str> {
        let library = self.library;
        let names = self.type_names(value);
        names.iter().flat_map(|ty| library.trait_keys(ty, of, name)).collect()
    }

    /// Evaluates `place op= value` of a structure or an enum; returns `false` if no such operator exists.
    pub fn assigned_by_trait(&mut self, op: BinaryOp, place: &Place, value: &Value, span: Span) -> Eval<bool> {
        let old = self.read_place(place, span)?;
        let (Value::Struct { .. } | Value::Enum(_), Some((of, name))) = (&old, trait_of(op)) else {
            return Ok(false);
        };
        let (of, name) = (format!("{of}Assign"), format!("{name}_assign"));
        let keys = self.keys_of_operator(&old, &of, &name);
        let values = vec![Value::Ref(Rc::new(place.clone())), value.clone()];
        let Some(key) = self.find_overload(&keys, &values, span)? else {
            return Ok(false);
        };
        self.inline_function(key, &[], values, span)?;
        Ok(true)
    }

    /// Evaluates `-value` or `!value` of a structure or an enum.
    pub fn unary_of_trait(&mut self, op: UnaryOp, value: &Value, span: Span) -> Eval<Option<Value>> {
        let (of, name) = match op {
            UnaryOp::Neg => ("Neg", "neg"),
            UnaryOp::Not => ("Not", "not"),
            _ => return Ok(None),
        };
        let ty = match value {
            Value::Struct { ty, .. } => ty,
            Value::Enum(choice) => &choice.ty,
            _ => return Ok(None),
        };
        let library = self.library;
        let keys = library.trait_keys(ty, of, name);
        match self.find_overload(&keys, std::slice::from_ref(value), span)? {
            Some(key) => self.inline_function(key, &[], vec![value.clone()], span).map(Some),
            None => Ok(None),
        }
    }

    /// Evaluates `base[index]` of a structure; also returns the element's place if it is to be written.
    pub fn index_of_trait(
        &mut self,
        base: &Value,
        place: Option<&Place>,
        index: &Value,
        span: Span,
    ) -> Eval<Option<Value>> {
        let Value::Struct { ty, .. } = base else {
            return Ok(None);
        };
        if super::matrix::column_count(ty).is_some() {
            return Ok(None);
        }
        let library = self.library;
        let (own, keys) = match place {
            Some(place) => (
                Value::Ref(Rc::new(place.clone())),
                library.trait_keys(ty, "IndexMut", "index_mut"),
            ),
            None => (base.clone(), library.trait_keys(ty, "Index", "index")),
        };
        let values = vec![own, index.clone()];
        match self.find_overload(&keys, &values, span)? {
            Some(key) => self.inline_function(key, &[], values, span).map(Some),
            None => Ok(None),
        }
    }

    /// Evaluates a method that several traits define for a value's type, or that a trait defines for numbers.
    pub fn method_of_trait(
        &mut self,
        value: &Value,
        name: &str,
        args: &[Value],
        span: Span,
    ) -> Eval<Option<(&'a str, &'a Function)>> {
        let library = self.library;
        let mut names = self.type_names(value);
        let keys = match split_qualified(name) {
            // A conversion of a type parameter's value, which may be of the type already.
            Some((of, "From", _)) if names.iter().any(|own| own == of) => None,
            Some((of, "From", from)) => Some(library.method_keys(of, from)).filter(|keys| !keys.is_empty()),
            Some((_, of, name)) => names
                .iter()
                .map(|ty| library.trait_keys(ty, of, name))
                .find(|keys| !keys.is_empty()),
            None if name.contains("::") => None,
            None => {
                // Inherent methods of numbers take precedence over those of a trait.
                names.retain(|ty| !crate::front::methods::is_inherent(ty, name));
                names
                    .iter()
                    .map(|ty| library.method_keys(ty, name))
                    .find(|keys| !keys.is_empty())
            }
        };
        let Some(keys) = keys else { return Ok(None) };
        let values: Vec<Value> = std::iter::once(value.clone()).chain(args.iter().cloned()).collect();
        match self.find_overload(&keys, &values, span)? {
            Some(key) => Ok(Some((key, &library.functions[key]))),
            None => Err(
                Diagnostic::error_at(Code::TraitBound, span, format!("no `{name}` takes these values"))
                    .label("called here")
                    .into(),
            ),
        }
    }

    /// Resolves a path of two segments: a type parameter by its type, a trait by the type of the first value.
    pub fn resolve_path(&mut self, path: &[String], values: &[Value], span: Span) -> Eval<Option<Vec<String>>> {
        if let [name] = path {
            return self.resolve_qualified(name, values, span);
        }
        let [of, name] = path else { return Ok(None) };
        if let Some(ty) = self.type_behind(of) {
            return Ok(Some(vec![ty.name.clone(), name.clone()]));
        }
        let library = self.library;
        if library.has_type(of)
            || !library.functions.contains_key(&path.join("::")) && library.declared_function(of, name).is_none()
        {
            let keys = library.method_keys(of, name);
            if keys.len() > 1 {
                let key = self.find_overload(&keys, values, span)?;
                return Ok(key.map(|key| vec![key.to_owned()]));
            }
            return Ok(None);
        }
        let (Some(first), true) = (values.first(), library.declared_function(of, name).is_some()) else {
            return Ok(None);
        };
        let first = self.deref_value(first.clone(), span)?;
        let qualified = qualify_name("_", of, name);
        let found = self.method_of_trait(&first, &qualified, &values[1..], span)?;
        Ok(found.map(|(key, _)| vec![key.to_owned()]))
    }

    /// Resolves a function of a trait for a type parameter.
    fn resolve_qualified(&mut self, path: &str, values: &[Value], span: Span) -> Eval<Option<Vec<String>>> {
        let library = self.library;
        let Some((parameter, of, name)) = split_qualified(path).filter(|_| !library.functions.contains_key(path))
        else {
            return Ok(None);
        };
        let takes_self = library
            .declared_function(of, name)
            .is_some_and(|function| function.params.first().is_some_and(|own| own.name == "self"));
        let behind = self.type_behind(parameter);
        let types = match (takes_self.then(|| values.first()).flatten(), &behind) {
            (Some(first), _) => {
                let first = self.deref_value(first.clone(), span)?;
                self.type_names(&first)
            }
            (None, Some(ty)) => vec![ty.name.clone()],
            (None, None) => Vec::new(),
        };
        // Numbers and vectors have `default` themselves.
        let keys_of = |ty: &String| match library.trait_keys(ty, of, name) {
            keys if keys.is_empty() && of == "Default" => library.method_keys(ty, name),
            keys => keys,
        };
        let mut keys = types
            .iter()
            .map(keys_of)
            .find(|keys| !keys.is_empty())
            .unwrap_or_default();
        if let Some(ty) = behind.filter(|_| keys.len() > 1) {
            let known = Value::Type(ty);
            keys.retain(|key| {
                let function = &library.functions[*key];
                let of = function.of.as_ref();
                of.is_none_or(|of| self.may_be(of, Some(&known), &function.generics))
            });
        }
        let found = self.find_overload(&keys, values, span)?;
        Ok(found.map(|key| vec![key.to_owned()]))
    }

    /// Returns the types of type parameters: those stated, or those of the arguments whose parameters have these
    /// types.
    pub fn types_of(
        &mut self,
        function: &Function,
        given: &[Value],
        args: &[Value],
        span: Span,
    ) -> Eval<Vec<(String, Value)>> {
        let mut bound = Vec::new();
        for (k, generic) in function.generics.iter().enumerate() {
            let Generic::Type(name) = generic else { continue };
            let mut ty = match given.get(k) {
                Some(Value::Type(ty)) => Some(Rc::clone(ty)),
                _ => None,
            };
            for (param, value) in function.params.iter().zip(args) {
                if ty
                    .as_ref()
                    .is_some_and(|ty| ty.is_complete() && self.has_all_arguments(ty))
                {
                    break;
                }
                let value = self.deref_value(value.clone(), span)?;
                ty = self.type_in(&param.ty, &value, name).or(ty);
            }
            bound.extend(ty.map(|ty| (name.clone(), Value::Type(ty))));
        }
        Ok(bound)
    }

    /// Deduces what a type parameter stands for in the stated type of a value.
    fn type_in(&self, ty: &SourceType, value: &Value, parameter: &str) -> Option<Rc<KnownType>> {
        let SourceType::Name(name, args) = ty.peel_refs() else {
            return None;
        };
        if name == parameter && args.is_empty() {
            return self.type_of_value(value);
        }
        let definition = self.library.structs.get(name)?;
        let mut pairs = definition.generics.iter().zip(args);
        pairs.find_map(|(generic, arg)| match generic {
            Generic::Type(own) if arg.is_parameter(parameter) => self.type_argument_of(value, own),
            _ => None,
        })
    }

    /// Deduces a type argument of a structure from the fields that have its type, or from its hidden field.
    pub fn type_argument_of(&self, value: &Value, parameter: &str) -> Option<Rc<KnownType>> {
        let Value::Struct { ty, fields } = value else {
            return None;
        };
        if let Some(Value::Type(known)) = hidden_field(fields, parameter) {
            return Some(known);
        }
        let definition = self.library.structs.get(ty.as_str())?;
        let mut pairs = definition.fields.iter().zip(fields.iter());
        pairs.find_map(|((_, ty, _), (_, value))| self.type_in(ty, value, parameter))
    }

    /// Evaluates `into()` and `default()` for built-in types.
    pub fn eval_conversion(&mut self, key: &str, value: &Value, span: Span) -> Eval<Option<Value>> {
        let ty = match split_qualified(key) {
            Some((ty, "From", _)) => ty,
            _ => key.strip_suffix("::from").unwrap_or_default(),
        };
        if ty.is_empty() {
            return Ok(None);
        }
        if let (Value::Node(id), "Array" | "Tuple") = (value, ty) {
            let parts = self.vector_components(*id).into_iter().map(Value::Node).collect();
            return Ok(Some(match ty {
                "Array" => Value::array(parts),
                _ => Value::Tuple(parts),
            }));
        }
        if self.type_names(value).iter().any(|name| name == ty) {
            return Ok(Some(value.clone()));
        }
        if let ("Option", Some(definition)) = (ty, self.library.enums.get(ty)) {
            let fields = vec![("0".into(), value.clone())];
            return Ok(Some(EnumValue::with_variant(ty, definition, 1, fields)));
        }
        match self.from(ty, value, span)? {
            Some(value) => Ok(Some(value)),
            None if matches!(value, Value::Poison) => Err(Exit::Noted),
            None => Ok(None),
        }
    }
}
