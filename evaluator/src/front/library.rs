//! Everything that a kernel's files define, and the lookup of names in it.

use super::tree::{
    Const, Enum, EnumVariant, Function, Generic, Implemented, OptionField, Struct, Trait, Type, is_unnamed,
};
use crate::diagnostic::Span;
use crate::ir::Purpose;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// Everything that a kernel's files define, by name.
#[derive(Clone, Debug, Default)]
pub struct Library {
    /// Functions and methods (`Type::name`).
    pub functions: FxHashMap<String, Function>,
    /// Names of the methods that take `&mut self`.
    pub mutating: FxHashSet<String>,
    /// Constants.
    pub consts: FxHashMap<String, Const>,
    /// Structures.
    pub structs: FxHashMap<String, Struct>,
    /// Enums.
    pub enums: FxHashMap<String, Enum>,
    /// Structures declared by `options!`.
    pub options: FxHashMap<String, Vec<OptionField>>,
    /// Traits.
    pub traits: FxHashMap<String, Trait>,
    /// Functions and constants that implementations of traits give types, by `Type::name`.
    pub implemented: FxHashMap<String, Vec<Implemented>>,
    /// Keys of functions and constants that several `impl`s of one type give under one name, by `Type::name`: those of
    /// `impl Window<3>` and `impl Window<5>`.
    pub alternatives: FxHashMap<String, Vec<String>>,
    /// Types and traits that they implement.
    pub implements: FxHashSet<(String, String)>,
    /// Type, generic parameters and place of each implementation.
    pub owners: Vec<(Type, Vec<Generic>, Span)>,
    /// Associated types, by the type that has them and their name.
    pub associated: FxHashMap<(String, String), Type>,
    /// Purposes of the functions of the kernel's files, in order of their places.
    pub purposes: Arc<[Purpose]>,
    /// Functions and constants in which an error was found: inference says nothing of their uses.
    pub broken: FxHashSet<String>,
}

impl Library {
    /// Returns whether a structure or an enum has this name, or arrays or tuples are listed under it.
    pub fn has_type(&self, name: &str) -> bool {
        self.structs.contains_key(name) || self.enums.contains_key(name) || is_unnamed(name)
    }

    /// Returns whether a structure has fields without names, so that its name is a function of them.
    pub fn is_tuple_structure(&self, name: &str) -> bool {
        let first = self.structs.get(name).and_then(|definition| definition.fields.first());
        first.is_some_and(|(field, ..)| field.parse::<usize>().is_ok())
    }

    /// Keys of the functions that `Type::name` may mean: those of the type itself alone, or those of traits.
    pub fn method_keys(&self, ty: &str, name: &str) -> Vec<&str> {
        let mut keys = self.member_keys(ty, name);
        keys.retain(|key| self.functions.contains_key(*key));
        keys
    }

    /// Keys of the constants that `Type::NAME` may mean, as of [`Library::method_keys`].
    pub fn constant_keys(&self, ty: &str, name: &str) -> Vec<&str> {
        let mut keys = self.member_keys(ty, name);
        keys.retain(|key| self.consts.contains_key(*key));
        keys
    }

    fn member_keys(&self, ty: &str, name: &str) -> Vec<&str> {
        let plain = format!("{ty}::{name}");
        let of_traits = self.implemented.get(&plain).map_or(&[][..], Vec::as_slice);
        let function = self.functions.get_key_value(&plain).map(|(key, _)| key);
        let constant = || self.consts.get_key_value(&plain).map(|(key, _)| key);
        match (self.alternatives.get(&plain), function.or_else(constant)) {
            (Some(several), _) => several.iter().map(String::as_str).collect(),
            (None, Some(key)) if of_traits.iter().all(|i| i.key != plain) => vec![key],
            _ => of_traits.iter().map(|i| i.key.as_str()).collect(),
        }
    }

    /// Type of the `impl` that gives a function or a constant.
    pub fn owner_of(&self, key: &str) -> Option<&Type> {
        let function = self.functions.get(key).map(|function| &function.of);
        function
            .or_else(|| self.consts.get(key).map(|constant| &constant.of))?
            .as_ref()
    }

    /// Keys of the functions that a trait gives a type.
    pub fn trait_keys(&self, ty: &str, of: &str, name: &str) -> Vec<&str> {
        let keys = self.trait_members(ty, of, name);
        keys.filter(|key| self.functions.contains_key(*key)).collect()
    }

    /// Keys of the constants that a trait gives a type.
    pub fn trait_constants(&self, ty: &str, of: &str, name: &str) -> Vec<&str> {
        let keys = self.trait_members(ty, of, name);
        keys.filter(|key| self.consts.contains_key(*key)).collect()
    }

    fn trait_members(&self, ty: &str, of: &str, name: &str) -> impl Iterator<Item = &str> {
        let of_traits = self.implemented.get(&format!("{ty}::{name}"));
        let of_traits = of_traits.into_iter().flatten().filter(move |i| i.of == of);
        of_traits.map(|i| i.key.as_str())
    }

    /// The function of a trait, or of one that it needs.
    pub fn declared_function(&self, of: &str, name: &str) -> Option<&Function> {
        self.declaring_trait(of, name).map(|(_, function)| function)
    }

    /// The trait that declares a function, which is `of` or one that it needs.
    pub fn declaring_trait(&self, of: &str, name: &str) -> Option<(&str, &Function)> {
        let (of, found) = self.traits.get_key_value(of)?;
        let own = found.functions.get(name).map(|function| (of.as_str(), function));
        own.or_else(|| found.supers.iter().find_map(|of| self.declaring_trait(of, name)))
    }

    /// The trait that declares a constant, which is `of` or one that it needs, and the constant's type.
    pub fn declared_const(&self, of: &str, name: &str) -> Option<(&str, &Type)> {
        let (of, found) = self.traits.get_key_value(of)?;
        let supers = || found.supers.iter().find_map(|of| self.declared_const(of, name));
        found.consts.get(name).map(|ty| (of.as_str(), ty)).or_else(supers)
    }

    /// The enum and the variant that a path ends with, and the variant's position.
    pub fn find_variant<'l>(&'l self, path: &'l [String]) -> Option<(&'l str, usize, &'l EnumVariant)> {
        let [.., ty, name] = path else { return None };
        let definition = self.enums.get(ty)?;
        let k = definition.position(name)?;
        Some((ty, k, &definition.variants[k]))
    }
}
