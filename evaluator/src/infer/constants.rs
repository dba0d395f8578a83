//! Constants by the type or trait that they are of: `Window::<3>::SIZE`, `<f32 as Zero>::ZERO`, `T::ZERO`.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, Generic, generic_arguments, split_qualified};
use std::collections::HashMap;

impl<'l> Checker<'l> {
    /// Returns those keys of functions or constants whose `impl` may be of the type before the function, if that is written with arguments.
    pub fn keys_of_owner(&mut self, keys: &[&'l str], constants: &'l [Expr]) -> Vec<&'l str> {
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
}
