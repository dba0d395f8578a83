//! Checks that implementations match the declarations of their traits and structures.

use super::types::Ty;
use super::{Checker, Known, infer_item};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::Library;
use crate::front::tree::{Const, Function, Generic, Type};
use std::collections::{BTreeSet, HashMap};

/// Notes where functions and constants are unlike what their traits say of them: of all traits, or of those of which the kernel
/// reaches something, which are looked at for every type.
pub fn check_declared(library: &Library, reached: Option<&BTreeSet<String>>, errors: &mut Vec<Diagnostic>) {
    let functions = || {
        library.implemented.iter().flat_map(|(key, implemented)| {
            let (ty, name) = key.split_once("::").unwrap_or_default();
            implemented.iter().filter_map(move |i| {
                let declared = library.traits.get(&i.of)?.functions.get(name)?;
                Some((&i.of, ty, name, declared, &i.key, library.functions.get(&i.key)?))
            })
        })
    };
    let constants = || {
        library.implements.iter().flat_map(|(ty, of)| {
            let declared = library.traits.get(of).into_iter().flat_map(|of| &of.consts);
            declared.flat_map(move |(name, declared)| {
                let keys = library.trait_constants(ty, of, name).into_iter();
                keys.map(move |key| (of, declared, &library.consts[key]))
            })
        })
    };
    let is_reached = |key: &String| reached.is_none_or(|reached| reached.contains(key));
    let called = functions().filter(|(.., key, _)| is_reached(key)).map(|(of, ..)| of);
    let read = constants()
        .filter(|(.., given)| is_reached(&given.name))
        .map(|(of, ..)| of);
    let traits: BTreeSet<&String> = called.chain(read).collect();
    for (of, ty, name, declared, _, function) in functions().filter(|(of, ..)| traits.contains(of)) {
        infer_item(library, &mut Known::default(), errors, |checker| {
            checker.as_declared((of, declared), (ty, function), name);
        });
    }
    for (of, declared, given) in constants().filter(|(of, ..)| traits.contains(of)) {
        infer_item(library, &mut Known::default(), errors, |checker| {
            checker.constant_as_declared(of, declared, given);
        });
    }
}

/// Notes implementations whose parameters are not those of their structures or enums, of the types that are `looked_at`.
pub fn check_owners(library: &Library, looked_at: impl Fn(&str) -> bool, errors: &mut Vec<Diagnostic>) {
    for (of, generics, span) in &library.owners {
        if let Type::Name(name, args) = of
            && looked_at(name)
        {
            infer_item(library, &mut Known::default(), errors, |checker| {
                checker.declare_generics(generics, *span);
                checker.check_owner((name, args), generics, *span);
            });
        }
    }
}

impl<'l> Checker<'l> {
    /// Of functions with type parameters calls alone tell.
    fn as_declared(&mut self, (of, declared): (&str, &'l Function), (ty, function): (&str, &'l Function), name: &str) {
        let span = function.span;
        let (wanted, found) = (declared.params.len(), function.params.len());
        if wanted != found {
            self.errors.push(
                Diagnostic::error_at(
                    Code::TraitImplementation,
                    span,
                    format!(
                        "`{name}` has {}, but {wanted} in the trait `{of}`",
                        counted_parameters(found)
                    ),
                )
                .label(format!("expected {}", counted_parameters(wanted)))
                .help("give it those that the trait declares"),
            );
            return;
        }
        let plain = |f: &Function| f.generics.iter().all(|generic| generic.name() == "Self");
        if !plain(declared) || !plain(function) {
            return;
        }
        let own = self.quietly(|c| c.convert_named_type(ty, &[], &HashMap::new(), span));
        let given = HashMap::from([("Self".to_owned(), own)]);
        let types = |f: &'l Function| f.params.iter().map(|p| &p.ty).chain([&f.result]);
        for (k, (wanted, found)) in types(declared).zip(types(function)).enumerate() {
            // Receivers are compared as they are written, by the front end.
            if function.params.get(k).is_some_and(|param| param.name == "self") {
                continue;
            }
            let Some((wanted, found)) = self.type_difference(wanted, found, &given, span) else {
                continue;
            };
            let what = match function.params.get(k) {
                Some(param) => format!("`{}`", param.name),
                None => "the result".to_owned(),
            };
            self.errors.push(
                Diagnostic::error_at(
                    Code::TraitImplementation,
                    span,
                    format!("`{name}` is not as the trait `{of}` declares it: {what} is `{found}`"),
                )
                .label(format!("expected `{wanted}`"))
                .help(format!("write `{wanted}`")),
            );
        }
    }

    /// Checks the parameters of an `impl` against those of its structure or enum.
    fn check_owner(&mut self, (name, args): (&str, &'l [Type]), own: &'l [Generic], span: Span) {
        let library = self.library;
        let of_struct = library.structs.get(name).map(|of| (&of.generics, &of.functions));
        let of_enum = || library.enums.get(name).map(|of| (&of.generics, &of.functions));
        let Some((generics, functions)) = of_struct.or_else(of_enum) else {
            return;
        };
        let constant = |arg: &Type| {
            own.iter().find_map(|generic| match generic {
                Generic::Const(name, ty) if arg.is_parameter(name) => Some(ty),
                _ => None,
            })
        };
        let mut unlike = None;
        for (generic, arg) in generics.iter().zip(args) {
            if let (Generic::Const(_, declared), Some(given)) = (generic, constant(arg)) {
                let differs = self.type_difference(declared, given, &HashMap::new(), span);
                unlike = unlike.or(differs);
            }
        }
        let args = args
            .iter()
            .map(|arg| self.quietly(|c| c.substitute_type(arg, &HashMap::new(), span)));
        let args: Vec<Ty> = args.collect();
        if let Some((found, wanted)) = self.call_arguments(generics, functions, &args) {
            unlike = unlike.or_else(|| Some((self.table.resolve_deep(&wanted), self.table.resolve_deep(&found))));
        }
        if let Some((wanted, found)) = unlike {
            self.errors.push(
                Diagnostic::error_at(
                    Code::MismatchedTypes,
                    span,
                    format!("the parameters of this `impl` are not those of `{name}`: one is `{found}`"),
                )
                .label(format!("expected `{wanted}`"))
                .help("declare the parameters as the structure does"),
            );
        }
    }

    fn constant_as_declared(&mut self, of: &str, declared: &'l Type, given: &'l Const) {
        let span = given.value.span;
        let Some((wanted, found)) = self.type_difference(declared, &given.ty, &HashMap::new(), span) else {
            return;
        };
        let name = given.name.rsplit("::").next().unwrap_or_default();
        self.errors.push(
            Diagnostic::error_at(
                Code::TraitImplementation,
                span,
                format!("`{name}` is not as the trait `{of}` declares it: it is `{found}`"),
            )
            .label(format!("expected `{wanted}`"))
            .help(format!("write `const {name}: {wanted}`")),
        );
    }

    /// The type that a trait declares and the one that is given, where they differ. Types that are not known here, such as those
    /// that a trait has of its own, do for any.
    pub fn type_difference(
        &mut self,
        declared: &'l Type,
        given: &'l Type,
        types: &HashMap<String, Ty>,
        span: Span,
    ) -> Option<(Ty, Ty)> {
        let wanted = self.quietly(|c| c.substitute_type(declared, types, span));
        let found = self.quietly(|c| c.substitute_type(given, &HashMap::new(), span));
        let same = matches!(wanted, Ty::Unknown) || self.table.unify(&wanted, &found);
        (!same).then(|| (self.table.resolve_deep(&wanted), self.table.resolve_deep(&found)))
    }

    /// Leaves out what is wrong with a type: it may belong to a function that the kernel does not reach.
    pub fn quietly<T>(&mut self, look: impl FnOnce(&mut Self) -> T) -> T {
        let known = self.errors.len();
        let found = look(self);
        self.errors.truncate(known);
        found
    }
}

fn counted_parameters(count: usize) -> String {
    format!("{count} parameter{}", if count == 1 { "" } else { "s" })
}
