//! Functions by the type or trait that they are of: `Type::name`, `Trait::name` and `<Type as Trait>::name`.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, Function, Generic, generic_arguments, qualify_name, split_qualified};
use std::collections::HashMap;

impl<'l> Checker<'l> {
    /// `Type::name(args)` of a type parameter, of a trait, or where several functions go by the name.
    pub fn of_type(
        &mut self,
        (of, name): (&str, &str),
        constants: &'l [Expr],
        args: &'l [Expr],
        span: Span,
    ) -> Option<Ty> {
        let library = self.library;
        if self.params.iter().any(|param| param == of) {
            let Some(declared) = self.declared_of(of, name) else {
                self.infer_loose_args(args);
                self.no_member(of, name, span);
                return Some(match name {
                    "default" | "from" | "new" => Ty::Param(of.to_owned()),
                    _ => Ty::Unknown,
                });
            };
            return Some(self.of_parameter(of, declared, name, None, args, span));
        }
        if of == "Default" && name == "default" && args.is_empty() {
            return Some(self.given_back(None, span));
        }
        let declared = library.declaring_trait(of, name);
        if let (Some((of, function)), false) = (declared, library.has_type(of)) {
            let own = function.params.first().is_some_and(|own| own.name == "self");
            let found: Vec<Ty> = args.iter().map(|arg| self.infer_expr(arg, None)).collect();
            let first = found.first().map(|first| self.peel_refs(first).0);
            return Some(match first.filter(|_| own) {
                Some(Ty::Param(parameter)) => {
                    self.methods.insert(span, qualify_name(&parameter, of, name));
                    let mut given = self.instantiate_function(function, &[]);
                    given.insert("Self".to_owned(), Ty::Param(parameter));
                    self.substitute_type(&function.result, &given, span)
                }
                Some(first) => match self.type_name(&first) {
                    Some(ty) => self.infer_overloaded(&library.trait_keys(&ty, of, name), &found, name, span),
                    None => Ty::Unknown,
                },
                None => {
                    self.errors.push(
                        Diagnostic::error_at(
                            Code::TypeNeeded,
                            span,
                            format!("cannot call `{of}::{name}` without the type that it is of"),
                        )
                        .label("of which type?")
                        .help(format!("write the type: `Type::{name}(...)`")),
                    );
                    Ty::Unknown
                }
            });
        }
        let all = self.keys_of(of, name);
        let is_plain = |key: &&str| split_qualified(key).is_none();
        if all.is_empty() || all.len() == 1 && all.iter().all(is_plain) {
            return None;
        }
        let keys = self.keys_of_owner(&all, constants);
        if let ([key], true) = (keys.as_slice(), all.len() > 1) {
            self.methods.insert(span, (*key).to_owned());
            return Some(self.infer_function_call(key, &library.functions[*key], constants, None, args, span));
        }
        let found: Vec<Ty> = args.iter().map(|arg| self.infer_expr(arg, None)).collect();
        Some(self.infer_overloaded(&keys, &found, name, span))
    }

    /// `<Type as Trait>::name(args)`.
    pub fn qualified_call(
        &mut self,
        (ty, of, name): (&str, &str, &str),
        constants: &'l [Expr],
        args: &'l [Expr],
        span: Span,
    ) -> Ty {
        let library = self.library;
        if self.params.iter().any(|param| param == ty)
            && let Some(declared) = library.declaring_trait(of, name)
        {
            return self.of_parameter(ty, declared, name, None, args, span);
        }
        let of = library.declaring_trait(of, name).map_or(of, |(of, _)| of);
        let keys = library.trait_keys(ty, of, name);
        let keys = self.keys_of_owner(&keys, constants);
        match keys.as_slice() {
            [] => {
                self.note_unsatisfied(ty, of, span);
                self.infer_loose_args(args);
                Ty::Unknown
            }
            [key] => {
                self.methods.insert(span, (*key).to_owned());
                self.infer_function_call(key, &library.functions[*key], constants, None, args, span)
            }
            _ => {
                let found: Vec<Ty> = args.iter().map(|arg| self.infer_expr(arg, None)).collect();
                self.infer_overloaded(&keys, &found, name, span)
            }
        }
    }

    /// A call of a function of a type parameter's trait. Evaluation finds the function of this trait for the parameter's type.
    pub fn of_parameter(
        &mut self,
        parameter: &str,
        (of, function): (&'l str, &'l Function),
        name: &str,
        receiver: Option<&Ty>,
        args: &'l [Expr],
        span: Span,
    ) -> Ty {
        let mut given = self.instantiate_function(function, &[]);
        given.insert("Self".to_owned(), Ty::Param(parameter.to_owned()));
        self.methods.insert(span, qualify_name(parameter, of, name));
        self.with_given(function, given, receiver, args, span)
    }

    /// The trait of a type parameter that declares a function, and the function.
    pub fn declared_of(&self, parameter: &str, name: &str) -> Option<(&'l str, &'l Function)> {
        let library = self.library;
        let traits = self.traits_of(parameter);
        traits.iter().find_map(|of| library.declaring_trait(of, name))
    }

    /// Those of some functions or constants whose `impl` may be of the type before the function, if that is written with arguments.
    fn keys_of_owner(&mut self, keys: &[&'l str], constants: &'l [Expr]) -> Vec<&'l str> {
        let Some(owner) = generic_arguments(constants).1 else {
            return keys.to_vec();
        };
        let library = self.library;
        let span = Span::default();
        let each = keys.iter().copied().filter(|key| {
            let table = self.table.clone();
            let written = self.quietly(|c| c.substitute_type(owner, &HashMap::new(), span));
            let of = match (library.functions.get(*key), library.consts.get(*key)) {
                (Some(function), _) => function.of.as_ref().map(|of| (of, &function.generics)),
                (None, constant) => constant.and_then(|constant| Some((constant.of.as_ref()?, &constant.generics))),
            };
            let fits = of.is_none_or(|(of, generics)| {
                let given = self.fresh_generics(generics);
                let of = self.quietly(|c| c.substitute_type(of, &given, span));
                self.table.unify(&of, &written)
            });
            self.table = table;
            fits
        });
        each.collect()
    }

    /// Parameters of an `impl` as variables.
    fn fresh_generics(&mut self, generics: &[Generic]) -> HashMap<String, Ty> {
        let each = generics.iter();
        each.map(|generic| (generic.name().to_owned(), self.table.fresh(Kind::Any)))
            .collect()
    }

    /// The type of a constant of a type that has arguments or of a trait: `Window::<3>::SIZE`, `<f32 as Zero>::ZERO`.
    pub fn owned_constant(&mut self, path: &'l [String], constants: &'l [Expr], span: Span) -> Option<Ty> {
        let library = self.library;
        let (ty, of, name) = match path {
            [ty, name] => (ty, None, name),
            [ty, of, name] => (ty, Some(of), name),
            _ => return None,
        };
        if name.contains(char::is_lowercase) {
            return None;
        }
        if self.params.contains(ty) {
            let traits = of.map_or_else(|| self.traits_of(ty), |of| vec![of.clone()]);
            return self.constant_of_traits(ty, &traits, name, span);
        }
        let keys = match of {
            Some(of) => {
                let of = library.declared_const(of, name).map_or(of.as_str(), |(of, _)| of);
                library.trait_constants(ty, of, name)
            }
            None => self.constant_keys(ty, name),
        };
        let found = self.keys_of_owner(&keys, constants);
        match (found.as_slice(), of) {
            ([key], _) => {
                self.methods.insert(span, (*key).to_owned());
                let constant = &library.consts[*key];
                let given = self.fresh_generics(&constant.generics);
                if let (Some(owner), Some(of)) = (generic_arguments(constants).1, &constant.of) {
                    let written = self.convert_type(owner, span);
                    let of = self.quietly(|c| c.substitute_type(of, &given, span));
                    self.table.unify(&of, &written);
                }
                Some(self.quietly(|c| c.substitute_type(&constant.ty, &given, span)))
            }
            ([], Some(of)) if library.traits.contains_key(of) => {
                self.note_unsatisfied(ty, of, span);
                Some(Ty::Unknown)
            }
            ([first, second, ..], _) => {
                self.note_several(first, second, span);
                Some(Ty::Unknown)
            }
            ([], _) => match self.made_by(path) {
                Some((made, _, types)) if library.find_variant(path).is_some() => match types.is_empty() {
                    true => Some(made),
                    false => Some(Ty::Fn(types, Box::new(made))),
                },
                _ => None,
            },
        }
    }

    /// Notes an error about a constant that several `impl`s give.
    fn note_several(&mut self, first: &str, second: &str, span: Span) {
        let message = format!("`{first}` or `{second}`: the path does not tell which");
        self.errors.push(
            Diagnostic::error_at(Code::TypeNeeded, span, message)
                .label("of which type?")
                .help("write the arguments of the type: `Type::<3>::NAME`, or its trait: `<Type as Trait>::NAME`"),
        );
    }

    /// The type of a constant `Type::NAME` of the kernel's files; `None` if there is none, or if it is one of Rust's or glam's.
    pub fn constant_by_type(&mut self, ty: &str, name: &str, span: Span) -> Option<Ty> {
        let library = self.library;
        match self.constant_keys(ty, name).as_slice() {
            [] => None,
            [key] => {
                if split_qualified(key).is_some() {
                    self.methods.insert(span, (*key).to_owned());
                }
                let constant = &library.consts[*key];
                let given = self.fresh_generics(&constant.generics);
                Some(self.quietly(|c| c.substitute_type(&constant.ty, &given, span)))
            }
            [first, second, ..] => {
                self.note_several(first, second, span);
                Some(Ty::Unknown)
            }
        }
    }

    /// Keys of the constants that a name of a type means, as of [`Checker::keys_of`].
    fn constant_keys(&self, ty: &str, name: &str) -> Vec<&'l str> {
        let library = self.library;
        if let Some((own, of)) = self.default_of.filter(|(own, _)| *own == ty)
            && let Some((of, _)) = library.declared_const(of, name)
        {
            return library.trait_constants(own, of, name);
        }
        let mut keys = library.constant_keys(ty, name);
        if crate::front::methods::is_inherent(ty, name) {
            keys.retain(|key| split_qualified(key).is_none());
        }
        keys
    }

    /// Keys of the functions that a name of a type means. A function of the type itself precedes those of traits. In a default
    /// function of a trait, of which nothing but this trait is known, `Self` has the trait's functions.
    pub fn keys_of(&self, ty: &str, name: &str) -> Vec<&'l str> {
        let library = self.library;
        if let Some((own, of)) = self.default_of.filter(|(own, _)| *own == ty)
            && let Some((of, _)) = library.declaring_trait(of, name)
        {
            return library.trait_keys(own, of, name);
        }
        let mut keys = library.method_keys(ty, name);
        if crate::front::methods::is_inherent(ty, name) {
            keys.retain(|key| split_qualified(key).is_none());
        }
        keys
    }
}
