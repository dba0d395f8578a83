//! Names that stand for others: `Some` of the standard prelude, variants that a `use` brings in, names that a `use` or a
//! `type` gives what has another one. They hold in all of a kernel's files, so that one that would stand for two things is
//! refused.

use super::cfg::Carrier;
use super::expr::Lower;
use super::inner::list_imports;
use super::tree::Type;
use crate::diagnostic::{Code, Diagnostic};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use std::collections::HashMap;
use std::rc::Rc;
use syn::spanned::Spanned;

/// Aliases of aliases after which they are taken for a cycle.
const MAX_ALIASES: u32 = 32;

/// Errors in names, by name.
pub type Wrong = Vec<(String, Diagnostic)>;

/// Names that stand for other names.
pub struct Names {
    paths: HashMap<String, Vec<String>>,
    /// Types by other names, with the files that they are written in.
    types: HashMap<String, (u32, syn::Type)>,
    /// Functions by other names, with the files that say so: the name here, and the name there.
    functions: Vec<(u32, syn::Ident, syn::Ident)>,
    /// Numbers of parameters of functions.
    arities: HashMap<String, usize>,
    /// Defaults of the parameters of types.
    defaults: HashMap<String, Vec<Option<syn::GenericArgument>>>,
}

impl Default for Names {
    fn default() -> Self {
        let mut names = Names {
            paths: HashMap::new(),
            types: HashMap::new(),
            functions: Vec::new(),
            arities: HashMap::new(),
            defaults: HashMap::new(),
        };
        for (ty, variant) in [
            ("Option", "Some"),
            ("Option", "None"),
            ("Result", "Ok"),
            ("Result", "Err"),
        ] {
            let path = vec![ty.to_owned(), variant.to_owned()];
            names.paths.insert(variant.to_owned(), path);
        }
        names
    }
}

impl Names {
    fn note_arities(&mut self, items: &[syn::Item]) {
        for item in items {
            match item {
                syn::Item::Fn(f) => drop(self.arities.insert(f.sig.ident.to_string(), f.sig.inputs.len())),
                syn::Item::Mod(m) => self.note_arities(m.content.as_ref().map_or(&[], |(_, items)| items)),
                _ => {}
            }
        }
    }

    /// Number of parameters of a function that is of no type.
    pub fn arity(&self, function: &str) -> Option<usize> {
        self.arities.get(function).copied()
    }

    /// The names that files give, and what is wrong with each.
    pub fn from_files(files: &[(u32, syn::File)]) -> (Names, Wrong) {
        let (mut names, mut errors) = (Names::default(), Wrong::new());
        let orders = ["Less", "Equal", "Greater"].map(str::to_owned);
        let mut enums = HashMap::from([("Ordering".to_owned(), orders.to_vec())]);
        for (_, file) in files {
            names.note_arities(&file.items);
            collect_enums(&file.items, &mut enums);
        }
        for (file, parsed) in files {
            names.add_items(*file, &parsed.items, &enums, &mut errors);
        }
        let renamed = std::mem::take(&mut names.functions);
        for (file, here, there) in renamed {
            let called = |item: &syn::Item| only_called(item, &here.to_string());
            if files.iter().all(|(_, parsed)| parsed.items.iter().all(called)) {
                names.functions.push((file, here, there));
                continue;
            }
            // A variable may have the name too.
            names.paths.remove(&here.to_string());
            let mut lower = Lower::new(file, None, Rc::default());
            let what = "`use` of a function by another name that is not only called";
            lower.note_unsupported(here.span(), what, &format!("use it as `{there}`"));
            errors.extend(lower.errors.into_iter().map(|error| (here.to_string(), error)));
        }
        (names, errors)
    }

    fn add_items(&mut self, file: u32, items: &[syn::Item], enums: &HashMap<String, Vec<String>>, errors: &mut Wrong) {
        for item in items.iter().filter(|item| is_there(file, item)) {
            match item {
                syn::Item::Type(t) if t.generics.params.is_empty() => {
                    let name = t.ident.to_string();
                    let alias = (file, (*t.ty).clone());
                    if self
                        .types
                        .get(&name)
                        .is_some_and(|known| text_of(&known.1) != text_of(&alias.1))
                    {
                        errors.push((name.clone(), duplicate_error(file, &t.ident)));
                    }
                    self.types.insert(name, alias);
                }
                syn::Item::Struct(s) => self.add_defaults(&s.ident, &s.generics),
                syn::Item::Enum(e) => self.add_defaults(&e.ident, &e.generics),
                syn::Item::Mod(m) => {
                    if let Some((_, items)) = &m.content {
                        self.add_items(file, items, enums, errors);
                    }
                }
                syn::Item::Use(u) => {
                    for (path, name) in list_imports(&u.tree) {
                        self.add_import(file, &path, name, enums, errors);
                    }
                }
                _ => {}
            }
        }
    }

    fn add_defaults(&mut self, name: &syn::Ident, generics: &syn::Generics) {
        let defaults = generics.params.iter().filter_map(|param| match param {
            syn::GenericParam::Lifetime(_) => None,
            syn::GenericParam::Type(t) => Some(t.default.clone().map(|(_, ty)| syn::GenericArgument::Type(ty))),
            syn::GenericParam::Const(c) => Some(c.default.clone().map(|(_, value)| syn::GenericArgument::Const(value))),
        });
        let defaults: Vec<_> = defaults.collect();
        if defaults.iter().any(Option::is_some) {
            self.defaults.insert(name.to_string(), defaults);
        }
    }

    /// Defaults of the parameters of a type that follow so many arguments.
    pub fn defaults_after(&self, name: &str, count: usize) -> impl Iterator<Item = &syn::GenericArgument> {
        let all = self.defaults.get(name).map_or(&[][..], Vec::as_slice);
        all.iter().skip(count).map_while(Option::as_ref)
    }

    fn add_import(
        &mut self,
        file: u32,
        path: &[syn::Ident],
        name: Option<(syn::Ident, syn::Ident)>,
        enums: &HashMap<String, Vec<String>>,
        errors: &mut Wrong,
    ) {
        let of = path.last().map(ToString::to_string).unwrap_or_default();
        let variants = enums.get(&of);
        let Some((there, here)) = name else {
            for variant in variants.into_iter().flatten() {
                self.paths.insert(variant.clone(), vec![of.clone(), variant.clone()]);
            }
            return;
        };
        let is_variant = variants.is_some_and(|variants| variants.contains(&there.to_string()));
        if !is_variant && there == here || here == "_" {
            return;
        }
        if here.to_string().starts_with(|c: char| c.is_lowercase()) {
            self.functions.push((file, here.clone(), there.clone()));
        }
        let stands = vec![of, there.to_string()];
        let known = self.paths.insert(here.to_string(), stands.clone());
        if known.is_some_and(|known| known != stands) {
            errors.push((here.to_string(), duplicate_error(file, &here)));
        }
    }

    /// Functions by other names: the name here, and the name there.
    pub fn renamed_functions(&self) -> impl Iterator<Item = (String, String)> + '_ {
        self.functions
            .iter()
            .map(|(_, here, there)| (here.to_string(), there.to_string()))
    }

    /// The path that a name stands for.
    pub fn aliased_path(&self, name: &str) -> Option<&[String]> {
        self.paths.get(name).map(Vec::as_slice)
    }

    /// Returns whether a name stands for another.
    pub fn is_alias(&self, name: &str) -> bool {
        self.paths.contains_key(name) || self.types.contains_key(name)
    }
}

impl Lower {
    /// The type that a name stands for.
    pub fn aliased_type(&mut self, name: &str) -> Option<Type> {
        let names = self.names();
        let (file, ty) = names.types.get(name)?;
        if self.aliases >= MAX_ALIASES {
            let error = Diagnostic::error_at(
                Code::EndlessDefinition,
                self.token_span(ty.span()),
                format!("the type `{name}` stands for itself"),
            )
            .label("a cycle of names")
            .help("write the type itself");
            self.errors.push(error);
            return Some(Type::Tuple(Vec::new()));
        }
        let mut there = Lower::new(*file, None, Rc::clone(&names));
        there.aliases = self.aliases + 1;
        let lowered = there.lower_type(ty);
        self.errors.extend(there.errors);
        Some(lowered)
    }

    /// A type's own name where another one stands for it.
    pub fn type_name(&mut self, name: String) -> String {
        if let Some(of) = self.aliased_type(&name).and_then(|ty| ty.listed_name()) {
            return of;
        }
        match self.names().aliased_path(&name) {
            Some([.., of]) => of.clone(),
            _ => name,
        }
    }
}

/// Returns whether a name is only used for calls, wherever it occurs: a variable may have the name of a function too.
fn only_called(item: &syn::Item, name: &str) -> bool {
    match item {
        syn::Item::Use(_) => true,
        item => called_in(item.to_token_stream(), name),
    }
}

fn called_in(text: TokenStream, name: &str) -> bool {
    let tokens: Vec<TokenTree> = text.into_iter().collect();
    let is = |k: usize, of: &str| matches!(tokens.get(k), Some(TokenTree::Punct(p)) if of.contains(p.as_char()));
    tokens.iter().enumerate().all(|(k, token)| match token {
        TokenTree::Group(group) => called_in(group.stream(), name),
        TokenTree::Ident(word) if word == name => {
            let call = matches!(tokens.get(k + 1), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
            let before = k.checked_sub(1);
            let method = before.is_some_and(|k| is(k, ".:"));
            let defined = before.is_some_and(|k| matches!(&tokens[k], TokenTree::Ident(word) if word == "fn"));
            method || (call || (is(k + 1, ":") && is(k + 2, ":"))) && !defined
        }
        _ => true,
    })
}

/// Enums with their variants.
fn collect_enums(items: &[syn::Item], enums: &mut HashMap<String, Vec<String>>) {
    for item in items {
        match item {
            syn::Item::Enum(e) => {
                let variants = e.variants.iter().map(|v| v.ident.to_string());
                enums.insert(e.ident.to_string(), variants.collect());
            }
            syn::Item::Mod(m) => {
                if let Some((_, items)) = &m.content {
                    collect_enums(items, enums);
                }
            }
            _ => {}
        }
    }
}

/// A type's tokens as text, wherever they stand.
fn text_of(ty: &syn::Type) -> String {
    ty.to_token_stream().to_string()
}

/// Returns whether `cfg` keeps an item.
fn is_there(file: u32, item: &syn::Item) -> bool {
    let attrs = match item {
        syn::Item::Mod(m) => &m.attrs,
        syn::Item::Type(t) => &t.attrs,
        syn::Item::Use(u) => &u.attrs,
        _ => return true,
    };
    // Errors in attributes are reported when the item is lowered.
    Lower::new(file, None, Rc::default()).keeps_by_cfg(&mut attrs.clone(), Carrier::Function)
}

fn duplicate_error(file: u32, name: &syn::Ident) -> Diagnostic {
    let lower = Lower::new(file, None, Rc::default());
    Diagnostic::error_at(
        Code::DefinedTwice,
        lower.token_span(name.span()),
        format!("`{name}` stands for two things among the kernel's files"),
    )
    .label("another one")
    .help("names hold in all of the files: give one of them another name")
}
