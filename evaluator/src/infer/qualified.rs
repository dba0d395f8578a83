//! Functions by the type or trait that they are of: `Type::name`, `Trait::name` and `<Type as Trait>::name`.

use super::Checker;
use super::types::Ty;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, Function, qualify_name, split_qualified};

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
