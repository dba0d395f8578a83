//! Types that type parameters stand for, with their arguments as far as these are known: the `Lanczos<3>` of `T`.

use super::Evaluator;
use super::value::Value;
use crate::front::name::Name;
use crate::front::tree::{Generic, Type as SourceType};
use std::rc::Rc;

/// Returns the name of the hidden field of a parameter, which no kernel can use.
pub fn hidden(parameter: &str) -> Name {
    format!("#{parameter}").into()
}

/// Returns a parameter stored in a structure's value.
pub fn hidden_field(fields: &[(Name, Value)], parameter: &str) -> Option<Value> {
    let name = hidden(parameter);
    let found = fields.iter().find(|(field, _)| *field == name);
    found.map(|(_, value)| value.clone())
}

/// A type by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownType {
    /// Name of the type.
    pub name: String,
    /// A type or a constant for each of its parameters; `None` of what is not known.
    pub args: Vec<Option<Value>>,
}

impl KnownType {
    /// A type without arguments, or with arguments that are not known.
    pub fn from_name(name: &str) -> Rc<KnownType> {
        Rc::new(KnownType {
            name: name.to_owned(),
            args: Vec::new(),
        })
    }

    /// Returns whether all arguments are known.
    pub fn is_complete(&self) -> bool {
        self.args.iter().all(|arg| match arg {
            Some(Value::Type(ty)) => ty.is_complete(),
            other => other.is_some(),
        })
    }

    /// Argument that stands for a parameter of an `impl` of this type: of `Window<3>` for the `N` of `impl<const N: usize> Window<N>`.
    pub fn argument_of(&self, of: &SourceType, parameter: &str) -> Option<Value> {
        let patterns = of.arguments();
        let mut pairs = patterns.iter().zip(&self.args);
        pairs.find_map(|(pattern, arg)| match arg {
            Some(arg) if pattern.is_parameter(parameter) => Some(arg.clone()),
            Some(Value::Type(inner)) => inner.argument_of(pattern, parameter),
            _ => None,
        })
    }
}

impl<'a> Evaluator<'a> {
    /// Returns the type that a type parameter stands for, or an associated type of one: `T`, `T::Space`.
    pub fn type_behind(&self, of: &str) -> Option<Rc<KnownType>> {
        let (parameter, associated) = match of.split_once("::") {
            Some((parameter, name)) => (parameter, Some(name)),
            None => (of, None),
        };
        let Some(Value::Type(ty)) = self.scope.get(parameter) else {
            return None;
        };
        let Some(name) = associated else {
            return Some(Rc::clone(ty));
        };
        let SourceType::Name(found, _) = self.library.associated.get(&(ty.name.clone(), name.to_owned()))? else {
            return None;
        };
        // A parameter of the type.
        let own = self.generics_of(&ty.name).iter().position(|own| own.name() == found);
        match own.map(|k| ty.args.get(k)) {
            None => Some(KnownType::from_name(found)),
            Some(Some(Some(Value::Type(argument)))) => Some(Rc::clone(argument)),
            Some(_) => None,
        }
    }

    /// Returns the type that is written, with the type parameters and constants of the function that is evaluated.
    pub fn resolve_type(&mut self, ty: &SourceType) -> Option<Rc<KnownType>> {
        let SourceType::Name(name, args) = ty.peel_refs() else {
            let name = ty.listed_name()?;
            let arguments = ty.arguments();
            let args = arguments.iter().map(|arg| match arg {
                SourceType::Const(_) => {
                    let constant = self.constant_argument(arg)?;
                    self.as_constant(&constant).map(Value::Const)
                }
                ty => self.resolve_type(ty).map(Value::Type),
            });
            let args = args.collect();
            return Some(Rc::new(KnownType { name, args }));
        };
        if args.is_empty()
            && let Some(known) = self.type_behind(name)
        {
            return Some(known);
        }
        if self.is_unknown_name(name) {
            return None;
        }
        let args = self
            .generics_of(name)
            .iter()
            .zip(args)
            .map(|(generic, arg)| match generic {
                Generic::Const(..) => {
                    let constant = self.constant_argument(arg)?;
                    self.as_constant(&constant).map(Value::Const)
                }
                Generic::Type(_) => self.resolve_type(arg).map(Value::Type),
            });
        let args = args.collect();
        let name = name.clone();
        Some(Rc::new(KnownType { name, args }))
    }

    /// Returns the type of a value; of a known integer, `usize`.
    pub fn type_of_value(&self, value: &Value) -> Option<Rc<KnownType>> {
        let name = self.type_names(value).into_iter().next()?;
        let args = match value {
            Value::Tuple(parts) => parts.iter().map(|part| self.type_of_value(part)).collect(),
            Value::Array(parts) => vec![parts.first().and_then(|part| self.type_of_value(part))],
            _ => Vec::new(),
        };
        let mut args: Vec<_> = args.into_iter().map(|arg| arg.map(Value::Type)).collect();
        if let Some(len) = self.array_len(value) {
            args.resize(1, None);
            args.push(Some(Value::Const(len as i64)));
        }
        if !args.is_empty() {
            return Some(Rc::new(KnownType { name, args }));
        }
        let Value::Struct { fields, .. } = value else {
            return Some(KnownType::from_name(&name));
        };
        let args = self.generics_of(&name).iter().map(|generic| match generic {
            Generic::Const(own, _) => hidden_field(fields, own),
            Generic::Type(own) => self.type_argument_of(value, own).map(Value::Type),
        });
        let args = args.collect();
        Some(Rc::new(KnownType { name, args }))
    }

    /// Returns whether a value can be of a type that an `impl` is of, by the arguments that the value shows.
    pub fn has_arguments(&mut self, value: &Value, args: &[SourceType], own: &[Generic]) -> bool {
        let Value::Struct { ty, fields } = value else {
            return true;
        };
        let Some(definition) = self.library.structs.get(ty.as_str()) else {
            return true;
        };
        let mut pairs = definition.generics.iter().zip(args);
        pairs.all(|(generic, arg)| match generic {
            Generic::Const(name, _) => self.may_be(arg, hidden_field(fields, name).as_ref(), own),
            Generic::Type(name) => {
                let mut of_type = definition.fields.iter().zip(fields.iter());
                let held = of_type.find(|((_, ty, _), _)| ty.is_parameter(name));
                match held {
                    Some((_, (_, value))) => self.is_of(value, arg, own),
                    None => {
                        let known = self.type_argument_of(value, name).map(Value::Type);
                        self.may_be(arg, known.as_ref(), own)
                    }
                }
            }
        })
    }

    /// Returns whether an argument of a type may be that of an `impl`. Of what is not known, nothing is ruled out.
    pub fn may_be(&mut self, of: &SourceType, arg: Option<&Value>, own: &[Generic]) -> bool {
        let is_own = own.iter().any(|generic| of.is_parameter(generic.name()));
        match (of.peel_refs(), arg) {
            _ if is_own => true,
            (_, None) => true,
            (SourceType::Name(name, args), Some(Value::Type(ty))) => {
                let mut pairs = args.iter().zip(&ty.args);
                self.is_unknown_name(name)
                    || *name == ty.name && pairs.all(|(of, arg)| self.may_be(of, arg.as_ref(), own))
            }
            (of @ (SourceType::Array(..) | SourceType::Tuple(_)), Some(Value::Type(ty))) => {
                let patterns = of.arguments();
                let mut pairs = patterns.iter().zip(&ty.args);
                of.listed_name().as_ref() == Some(&ty.name) && pairs.all(|(of, arg)| self.may_be(of, arg.as_ref(), own))
            }
            (of, Some(Value::Const(known))) => {
                let stated = self.constant_argument(of).and_then(|stated| self.as_constant(&stated));
                stated.is_none_or(|stated| stated == *known)
            }
            _ => true,
        }
    }

    /// Returns the key of a constant of a type, of a trait if one is named.
    pub fn constant_key(&mut self, ty: &Rc<KnownType>, of: Option<&str>, name: &str) -> Option<&'a str> {
        let library = self.library;
        let keys = match of {
            Some(of) => library.trait_constants(&ty.name, of, name),
            None => library.constant_keys(&ty.name, name),
        };
        let known = Value::Type(Rc::clone(ty));
        keys.into_iter().find(|key| {
            let constant = &library.consts[*key];
            let of = constant.of.as_ref();
            of.is_none_or(|of| self.may_be(of, Some(&known), &constant.generics))
        })
    }

    /// Returns whether a type has an argument for each of its parameters.
    pub fn has_all_arguments(&self, ty: &KnownType) -> bool {
        ty.args.len() == self.generics_of(&ty.name).len()
    }

    /// Parameters of a structure or an enum.
    fn generics_of(&self, name: &str) -> &'a [Generic] {
        let library = self.library;
        let of_struct = library.structs.get(name).map(|definition| &definition.generics);
        let of_enum = || library.enums.get(name).map(|definition| &definition.generics);
        of_struct.or_else(of_enum).map_or(&[][..], Vec::as_slice)
    }
}
