//! Trait functions: methods of type parameters, and functions that several implementations provide under one name.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{ARRAY, Function, is_unnamed, qualify_name, tuple_name};
use std::collections::HashMap;

/// A call whose function depends on the type of its result.
pub struct Pending {
    span: Span,
    /// Type of the result.
    wanted: Ty,
    /// Type of the argument; `None` for `Default::default()`.
    from: Option<Ty>,
}

/// A type parameter of a call, and the traits that its type has to have.
pub struct Bound {
    pub(super) span: Span,
    pub(super) ty: Ty,
    pub(super) traits: Vec<String>,
}

impl<'l> Checker<'l> {
    /// Returns the name under which a type's functions are listed; `None` for a type that has no name, or is not known yet.
    pub fn type_name(&self, ty: &Ty) -> Option<String> {
        match self.table.resolve_shallow(ty) {
            Ty::Struct(name, _) | Ty::Enum(name, _) => Some(name),
            Ty::Array(_) => Some(ARRAY.to_owned()),
            Ty::Tuple(parts) => Some(tuple_name(parts.len())),
            ty @ (Ty::Bool | Ty::Int(_) | Ty::Float | Ty::Vector(..) | Ty::Matrix(_)) => Some(ty.to_string()),
            ty => match self.table.variable_kind(&ty)? {
                Kind::Float => Some("f32".to_owned()),
                Kind::Integer => Some("i32".to_owned()),
                Kind::Any => None,
            },
        }
    }

    /// The function among several that takes some types, which are those of all its parameters.
    pub fn select_overload(&mut self, keys: &[&'l str], found: &[Ty]) -> Option<(&'l str, &'l Function)> {
        let library = self.library;
        for key in keys {
            let function = &library.functions[*key];
            if function.params.len() != found.len() {
                continue;
            }
            let (table, errors) = (self.table.clone(), self.errors.len());
            let given = self.instantiate_function(function, &[]);
            let fits = function.params.iter().zip(found).all(|(param, found)| {
                let wanted = self.substitute_type(&param.ty, &given, param.span);
                self.fits_parameter(&wanted, found)
            });
            self.table = table;
            self.errors.truncate(errors);
            if fits {
                return Some((key, function));
            }
        }
        None
    }

    /// Returns whether a value of a type can be passed for a parameter. An unknown type fits everything.
    pub(super) fn fits_parameter(&mut self, wanted: &Ty, found: &Ty) -> bool {
        match (self.table.resolve_shallow(wanted), self.table.resolve_shallow(found)) {
            (
                Ty::Ref(..),
                found @ (Ty::Struct(..)
                | Ty::Enum(..)
                | Ty::Float
                | Ty::Int(_)
                | Ty::Vector(..)
                | Ty::Array(_)
                | Ty::Tuple(_)),
            ) => {
                // Of a method's own `&self`.
                let inner = self.peel_refs(wanted).0;
                self.table.unify(&inner, &found)
            }
            _ => self.table.unify(wanted, found),
        }
    }

    /// A call of one of several functions of one name, by the types of all arguments, of which the receiver is the first.
    pub fn infer_overloaded(&mut self, keys: &[&'l str], found: &[Ty], name: &str, span: Span) -> Ty {
        if let ([], Some(first)) = (keys, found.first()) {
            let shown = self.table.resolve_deep(&self.peel_refs(first).0).to_string();
            self.errors.push(
                Diagnostic::error_at(Code::TraitBound, span, format!("no `{name}` for `{shown}`"))
                    .label(format!("`{shown}` has no such function"))
                    .help(format!("write an `impl` of the trait for `{shown}`")),
            );
            return Ty::Unknown;
        }
        let Some((key, function)) = self.select_overload(keys, found) else {
            let shown: Vec<String> = found
                .iter()
                .map(|ty| format!("`{}`", self.table.resolve_deep(ty)))
                .collect();
            let known: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
            self.errors.push(
                Diagnostic::error_at(
                    Code::TraitBound,
                    span,
                    format!("no `{name}` takes {}", shown.join(" and ")),
                )
                .label("not of these types")
                .help(format!("there are {}", known.join(", "))),
            );
            return Ty::Unknown;
        };
        let is_settled = |ty: &Ty| {
            let bare = self.peel_refs(ty).0;
            self.table.variable_kind(&bare).is_none() && !matches!(bare, Ty::Unknown)
        };
        let others: Vec<&str> = match found.iter().all(is_settled) {
            true => keys.iter().copied().filter(|other| *other != key).collect(),
            false => Vec::new(),
        };
        if let Some((other, of_other)) = self.select_overload(&others, found) {
            if function
                .of
                .as_ref()
                .zip(of_other.of.as_ref())
                .is_some_and(|(a, b)| a.is_apart(b, &|_| false))
            {
                return self.one_of_several(&others, (key, function), found, span);
            }
            self.errors.push(
                Diagnostic::error_at(
                    Code::TraitBound,
                    span,
                    format!("`{key}` or `{other}`: the arguments do not tell which"),
                )
                .label("called here")
                .help("give the functions of these implementations other names"),
            );
            return Ty::Unknown;
        }
        self.methods.insert(span, key.to_owned());
        self.called_with(function, key, found, span)
    }

    /// A call of one of the functions of several `impl`s of a type, of which the value alone tells the arguments: the type of the
    /// result, if all of them give the same.
    fn one_of_several(
        &mut self,
        others: &[&'l str],
        (key, function): (&'l str, &'l Function),
        found: &[Ty],
        span: Span,
    ) -> Ty {
        let library = self.library;
        let fitting: Vec<&str> = others
            .iter()
            .copied()
            .filter(|other| self.select_overload(&[*other], found).is_some())
            .collect();
        let (table, instances) = (self.table.clone(), self.instances.len());
        let first = self.called_with(function, key, found, span);
        let first = self.table.resolve_deep(&first);
        let is_same = fitting.iter().all(|other| {
            self.table = table.clone();
            let result = self.called_with(&library.functions[*other], other, found, span);
            self.table.resolve_deep(&result) == first
        });
        self.table = table;
        self.instances.truncate(instances);
        if is_same { first } else { Ty::Unknown }
    }

    /// Returns the type of a function's result for arguments of some types.
    fn called_with(&mut self, function: &'l Function, key: &str, found: &[Ty], span: Span) -> Ty {
        let given = self.instantiate_function(function, &[]);
        for (param, found) in function.params.iter().zip(found) {
            let wanted = self.substitute_type(&param.ty, &given, span);
            self.fits_parameter(&wanted, found);
        }
        self.note_instance(key, function, &given, span);
        self.substitute_type(&function.result, &given, span)
    }

    /// The traits that a type parameter has, or that a `dyn` names.
    pub fn traits_of(&self, parameter: &str) -> Vec<String> {
        if let Some(traits) = self.bounds.and_then(|bounds| bounds.get(parameter)) {
            return traits.clone();
        }
        let of_object = parameter.strip_prefix("dyn ").into_iter();
        of_object
            .flat_map(|traits| traits.split(" + "))
            .map(str::to_owned)
            .collect()
    }

    /// The type of a constant of a type parameter.
    pub fn constant_of(&mut self, parameter: &str, name: &str, span: Span) -> Option<Ty> {
        let traits = self.traits_of(parameter);
        self.constant_of_traits(parameter, &traits, name, span)
    }

    /// The type of a constant of one of a type parameter's traits. Evaluation finds the constant of this trait for the parameter's type.
    pub fn constant_of_traits(&mut self, parameter: &str, traits: &[String], name: &str, span: Span) -> Option<Ty> {
        let library = self.library;
        let (of, ty) = traits.iter().find_map(|of| library.declared_const(of, name))?;
        self.methods.insert(span, qualify_name(parameter, of, name));
        let given = HashMap::from([("Self".to_owned(), Ty::Param(parameter.to_owned()))]);
        Some(self.substitute_type(ty, &given, span))
    }

    /// Notes an error about `dyn Trait` of a trait that is not the kernel's, or of which Rust makes no such type.
    pub fn check_trait_object(&mut self, name: &str, span: Span) {
        let library = self.library;
        let of = name
            .trim_start_matches("dyn ")
            .split([' ', '#'])
            .next()
            .unwrap_or_default();
        let error = match library.traits.get(of) {
            None => Diagnostic::error_at(
                Code::NotInLanguage,
                span,
                format!("the type `{name}` is not part of the kernel language"),
            )
            .label("not supported")
            .help("take a reference to a trait of the kernel's own, or the value itself"),
            Some(found) => {
                let is_sized = |f: &Function| f.bounds.get("Self").is_some_and(|of| of.iter().any(|of| of == "Sized"));
                let takes_self = |f: &Function| f.params.first().is_some_and(|own| own.name == "self");
                let is_compatible = |f: &Function| takes_self(f) || is_sized(f);
                if found.consts.is_empty() && found.functions.values().all(is_compatible) {
                    return;
                }
                Diagnostic::error_at(Code::DynTrait, span, format!("the trait `{of}` is not dyn compatible"))
                    .label("it has a constant, or a function without `self`")
                    .help(format!(
                        "take `&impl {of}`, or put what has no `self` into a trait of its own"
                    ))
            }
        };
        self.errors.push(error);
    }

    /// Notes an error about what a type parameter does not have; of traits that are not the kernel's nothing is known.
    pub fn no_member(&mut self, parameter: &str, name: &str, span: Span) {
        let library = self.library;
        let traits = self
            .bounds
            .and_then(|bounds| bounds.get(parameter))
            .map_or(&[][..], Vec::as_slice);
        let known = |of: &String| library.traits.contains_key(of) || matches!(of.as_str(), "Copy" | "Clone" | "Sized");
        let unknown = traits.iter().find(|of| !known(of) && !crate::front::is_of_rust(of));
        if let Some(of) = unknown {
            self.errors.push(
                Diagnostic::error_at(
                    Code::UnknownType,
                    span,
                    format!("cannot find trait `{of}`, which `{parameter}` has to have"),
                )
                .label(format!("`{name}` of it"))
                .help("define it in one of the kernel's files"),
            );
        } else if traits.iter().all(known) {
            self.errors.push(
                Diagnostic::error_at(
                    Code::TraitBound,
                    span,
                    format!("no `{name}` for the type parameter `{parameter}`"),
                )
                .label("no trait that it has gives it one")
                .help(format!("bound it by a trait that does: `{parameter}: Trait`")),
            );
        }
    }

    /// `x.into()`, or `Default::default()`: which function that is, what it has to give tells.
    pub fn given_back(&mut self, from: Option<Ty>, span: Span) -> Ty {
        let target = match from.as_ref().map(|from| self.peel_refs(from).0) {
            Some(Ty::Param(parameter)) => self.conversions.and_then(|known| known.get(&parameter)),
            _ => None,
        };
        let wanted = match target {
            Some(target) => self.convert_type(target, span),
            None => self.table.fresh(Kind::Any),
        };
        self.pending.push(Pending {
            span,
            wanted: wanted.clone(),
            from,
        });
        wanted
    }

    /// The conversion of a vector to an array or a tuple of its components.
    fn components_as(&mut self, wanted: &Ty, kind: crate::ir::Scalar, lanes: u8) -> Option<&'static str> {
        let part = Ty::scalar(kind);
        match wanted {
            Ty::Array(element) => self.table.unify(&part, element).then_some("Array::from"),
            Ty::Tuple(parts) if parts.len() == usize::from(lanes) => {
                let all = parts.iter().all(|own| self.table.unify(&part, own));
                all.then_some("Tuple::from")
            }
            _ => None,
        }
    }

    /// Finds the functions that what they have to give tells, and checks the traits of type parameters.
    pub fn settle_traits(&mut self) {
        for Pending { span, wanted, from } in std::mem::take(&mut self.pending) {
            if let (Some(from), found) = (&from, self.table.resolve_shallow(&wanted))
                && let Ty::Vector(kind, lanes) = self.peel_refs(from).0
                && let Some(key) = self.components_as(&found, kind, lanes)
            {
                self.methods.insert(span, key.to_owned());
                continue;
            }
            if let (None, Ty::Param(parameter)) = (&from, self.table.resolve_shallow(&wanted)) {
                self.methods
                    .insert(span, qualify_name(&parameter, "Default", "default"));
                continue;
            }
            let Some(of) = self.type_name(&wanted) else {
                if !matches!(self.table.resolve_shallow(&wanted), Ty::Unknown | Ty::Param(_)) {
                    self.errors.push(
                        Diagnostic::error_at(
                            Code::TypeNeeded,
                            span,
                            "type annotations needed: nothing says what this is to give",
                        )
                        .label("of which type?")
                        .help("state the type of its variable: `let x: Type = ...`"),
                    );
                }
                continue;
            };
            let library = self.library;
            let key = match &from {
                None => library.method_keys(&of, "default").first().map(|key| (*key).to_owned()),
                // The value tells which conversion that is.
                Some(from) if matches!(self.peel_refs(from).0, Ty::Param(_)) => Some(qualify_name(&of, "From", "from")),
                Some(from) => {
                    if let ("Option", Ty::Enum(_, args)) = (of.as_str(), self.table.resolve_shallow(&wanted))
                        && !matches!(self.peel_refs(from).0, Ty::Enum(of, _) if of == "Option")
                    {
                        self.table.unify(&args[0], from);
                    }
                    let keys = library.method_keys(&of, "from");
                    let found = self.select_overload(&keys, std::slice::from_ref(from));
                    let builtin = crate::front::is_prelude_type(&of)
                        || of == "Option"
                        || self.peel_refs(from).0 == self.table.resolve_shallow(&wanted);
                    found
                        .map(|(key, _)| key.to_owned())
                        .or_else(|| builtin.then(|| format!("{of}::from")))
                }
            };
            if let (None, Some(function)) = (&from, key.as_ref().and_then(|key| library.functions.get_key_value(key))) {
                let (key, function) = function;
                let given = self.instantiate_function(function, &[]);
                let made = self.quietly(|c| c.substitute_type(&function.result, &given, span));
                self.table.unify(&made, &wanted);
                self.note_instance(key, function, &given, span);
            }
            match key {
                Some(key) => drop(self.methods.insert(span, key)),
                None => {
                    let what = match &from {
                        None => "Default".to_owned(),
                        Some(from) => format!("From<{}>", self.table.resolve_deep(from)),
                    };
                    let shown = match is_unnamed(&of) {
                        true => self.table.resolve_deep(&wanted).to_string(),
                        false => of,
                    };
                    self.note_unsatisfied(&shown, &what, span);
                }
            }
        }
        for Bound { span, ty, traits } in std::mem::take(&mut self.bounded) {
            let found = self.table.resolve_shallow(&ty);
            let of_parameter = match &found {
                Ty::Param(name) => self.traits_of(name),
                _ => Vec::new(),
            };
            for of in traits.iter().filter(|of| self.library.traits.contains_key(*of)) {
                let satisfied = match (&found, self.type_name(&found)) {
                    (Ty::Param(_), _) => of_parameter.iter().any(|known| self.has_trait(known, of)),
                    (_, Some(name)) => self.library.implements.contains(&(name, of.clone())),
                    (Ty::Ref(..) | Ty::Tuple(_) | Ty::Array(_), None) => false,
                    _ => true,
                };
                if !satisfied {
                    let shown = match self.table.variable_kind(&found) {
                        Some(_) => self.type_name(&found).unwrap_or_default(),
                        None => self.table.resolve_deep(&found).to_string(),
                    };
                    self.note_unsatisfied(&shown, of, span);
                }
            }
        }
    }

    /// Returns whether a trait is another, or has it as a supertrait.
    fn has_trait(&self, known: &str, of: &str) -> bool {
        let supers = self.library.traits.get(known).map_or(&[][..], |known| &known.supers);
        known == of || supers.iter().any(|known| self.has_trait(known, of))
    }

    pub fn note_unsatisfied(&mut self, ty: &str, of: &str, span: Span) {
        self.errors.push(
            Diagnostic::error_at(
                Code::TraitBound,
                span,
                format!("the trait bound `{ty}: {of}` is not satisfied"),
            )
            .label(format!("`{of}` is not implemented for `{ty}`"))
            .help(format!(
                "write an `impl {of} for {ty}`, or give a value of a type that has it"
            )),
        );
    }
}
