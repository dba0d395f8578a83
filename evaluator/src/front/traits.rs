//! Traits and their implementations. A function of an implementation is a method of its type like any other, and a default
//! one is lowered for each type that takes it, with `Self` for that type. Where several implementations give a type a
//! function of one name, each has a name of its own, as rustc writes it: `<Complex as Mul<f32>>::mul`.

use super::check::Check;
use super::expr::Lower;
use super::items::{Items, Owner, qualified_name};
use super::rust_traits::{OF_STD, OPERATORS, OWN, is_of_rust};
use super::tree::{ARRAY, Implemented, Trait, Type};
use crate::diagnostic::{Code, Diagnostic};
use proc_macro2::{Span, TokenStream};
use quote::ToTokens;
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;
use syn::spanned::Spanned;

impl Items {
    /// Notes a trait of the kernel's files.
    pub(super) fn add_trait(&mut self, file: u32, item: &mut syn::ItemTrait, mut check: Check) {
        check.check_generics(&mut item.generics);
        let name = item.ident.to_string();
        let declared = Type::Name("Self".to_owned(), Vec::new());
        let owner = Owner {
            name: name.clone(),
            generics: self.lower_of(file).lower_generics(&item.generics),
            bounds: HashMap::new(),
            ty: declared,
            shown: name.clone(),
            stands: HashMap::new(),
            functions: HashMap::new(),
        };
        let mut of_trait = Trait {
            functions: HashMap::new(),
            consts: HashMap::new(),
            supers: item.supertraits.iter().filter_map(trait_name).collect(),
        };
        for inner in &mut item.items {
            match inner {
                syn::TraitItem::Fn(f) => {
                    if !check.keeps_function(&mut f.attrs) {
                        continue;
                    }
                    // The body of a default function is checked for each type that takes it.
                    let mut of_signature = check.for_same_file();
                    of_signature.check_function(
                        &mut f.sig,
                        &mut syn::Block {
                            brace_token: syn::token::Brace::default(),
                            stmts: Vec::new(),
                        },
                    );
                    let empty = syn::Block {
                        brace_token: syn::token::Brace::default(),
                        stmts: Vec::new(),
                    };
                    let (function, errors) = self.lower_function(file, &f.sig, &empty, &f.attrs, Some(&owner));
                    self.note_errors_of(&name, errors);
                    if f.default.is_none() {
                        self.note(&name, f.to_token_stream(), of_signature);
                    }
                    of_trait.functions.insert(f.sig.ident.to_string(), function);
                }
                syn::TraitItem::Const(c) => {
                    if check.keeps(&mut c.attrs) {
                        check.constant_name(&c.ident);
                        check.check_type(&mut c.ty);
                        let mut lower = self.lower_within(file, &owner);
                        of_trait.consts.insert(c.ident.to_string(), lower.lower_type(&c.ty));
                        self.note_errors_of(&name, lower.errors);
                    }
                }
                syn::TraitItem::Type(t) => {
                    if check.keeps(&mut t.attrs)
                        && let Some(first) = t.generics.params.first()
                    {
                        check.refuse(first.span(), "a generic type of a trait", "write a trait for each");
                    }
                }
                // A macro, or unstable syntax.
                other => self.refuse_definitions(other.to_token_stream(), check.for_same_file()),
            }
        }
        if self.library.traits.insert(name.clone(), of_trait).is_some() {
            check.note_duplicate(&item.ident);
        }
        let text = item.supertraits.to_token_stream();
        self.note(&name, text, check);
        self.traits.insert(name, (file, item.clone()));
    }

    /// Takes the implementations of traits, after all that types have themselves.
    pub(super) fn implement_all(&mut self) {
        for (file, mut item) in std::mem::take(&mut self.implementations) {
            self.add_trait_impl(file, &mut item);
        }
    }

    fn add_trait_impl(&mut self, file: u32, item: &mut syn::ItemImpl) {
        let mut check = Check::new(file);
        let Some((path, _)) = item.trait_.clone() else { return };
        let mut lower = self.lower_of(file);
        lower.called_parameters(&item.generics);
        let ty = lower.lower_type(&item.self_ty);
        lower.stands_in(&ty);
        let generics = lower.lower_generics(&item.generics);
        let bounds = lower.trait_bounds(&item.generics);
        let trait_name = path.segments.last().map(|s| s.ident.to_string()).unwrap_or_default();
        let args = trait_arguments(&mut lower, &path);
        let own: BTreeSet<&str> = generics.iter().map(super::tree::Generic::name).collect();
        let of = match ty.listed_name() {
            Some(of) if !own.contains(of.as_str()) => of,
            found => {
                let (what, instead) = match found {
                    Some(_) => ("an implementation of a trait for every type", "write one for each type"),
                    None => (
                        "an implementation of a trait for functions",
                        "write it for a structure that holds one",
                    ),
                };
                check.refuse(item.self_ty.span(), what, instead);
                return self.refuse_functions(item, "impl", &check.into_errors());
            }
        };
        // In rustc a method of the trait precedes that of slices, but not where the value is a slice.
        if of == ARRAY {
            for name in item.items.iter().filter_map(item_name) {
                if super::methods::is_of_slices(&name) {
                    let what = format!("the method `{name}` of a trait for arrays, which slices have too,");
                    check.refuse(item.self_ty.span(), &what, "give it another name");
                }
            }
        }
        if OWN.contains(&trait_name.as_str()) {
            check.refuse(
                path.span(),
                &format!("`{trait_name}` written by hand"),
                "write a method of the type and call it by its name",
            );
            self.note(&of, TokenStream::new(), check.take_current());
            return self.refuse_functions(item, &of, &[]);
        }
        let mut stands = HashMap::new();
        for inner in &item.items {
            if let syn::ImplItem::Type(t) = inner {
                let found = lower.lower_type(&t.ty);
                let key = (of.clone(), t.ident.to_string());
                let general = self.by_parameter_of(&ty, &found);
                self.library.associated.insert(key, general);
                stands.insert(format!("Self::{}", t.ident), found);
            }
        }
        let declared = self.traits.get(&trait_name).cloned();
        if declared.is_none() && self.is_unknown(&path) {
            let what = format!("cannot find trait `{trait_name}`");
            let error = Diagnostic::error_at(Code::UnknownType, lower.token_span(path.span()), what)
                .label("not found in the kernel's files")
                .help("define it in one of the kernel's files, or import it");
            self.implementation_errors.push(error);
        }
        if let Some((_, declared)) = &declared {
            let types = declared.generics.params.iter().filter_map(|param| match param {
                syn::GenericParam::Type(t) => Some(t.ident.to_string()),
                _ => None,
            });
            stands.extend(types.zip(args.iter().cloned()));
        }
        check.check_generics(&mut item.generics);
        let owner = Owner {
            name: of.clone(),
            generics,
            bounds,
            ty: ty.clone(),
            shown: super::cfg::as_written(&item.self_ty).replace(' ', ""),
            stands,
            functions: lower.functions.clone(),
        };
        self.library.implements.insert((of.clone(), trait_name.clone()));
        let place = lower.token_span(item.self_ty.span());
        self.library.owners.push((ty.clone(), owner.generics.clone(), place));
        let mut errors = lower.errors;
        errors.extend(check.into_errors());
        let given: BTreeSet<String> = item.items.iter().filter_map(item_name).collect();
        let own = item.items.iter().map(|inner| (file, inner.clone(), false));
        let mut all: Vec<(u32, syn::ImplItem, bool)> = own.collect();
        if let Some((at, declared)) = &declared {
            errors.extend(self.missing_members(file, &path, declared, &given));
            let taken = declared.items.iter().filter_map(default_of);
            let taken = taken.filter(|inner| item_name(inner).is_some_and(|name| !given.contains(&name)));
            all.extend(taken.map(|inner| (*at, inner, true)));
            errors.extend(self.not_members(file, &trait_name, declared, &item.items));
        }
        // An implementation with a wrong receiver is reached as a right one is.
        let is_reached = errors.is_empty();
        let of_trait = declared.as_ref().map(|(_, declared)| declared);
        let mut unlike = self.unlike_receivers(file, &trait_name, of_trait, &item.items);
        if let Some((at, declared)) = &declared {
            unlike.extend(self.unsized_receivers(*at, declared, &given));
        }
        self.implementation_errors.extend(unlike.iter().cloned());
        errors.extend(unlike);
        let mut named = Named {
            is_default: false,
            trait_name: &trait_name,
            args: &args,
            shown: format_trait(&path),
        };
        for (file, mut inner, is_default) in all {
            named.is_default = is_default;
            self.add_impl_item(file, &mut inner, &owner, &named, item, &errors);
        }
        if is_reached {
            self.reached_by(&of, &named, &owner);
        }
    }

    /// A function or a constant of an implementation.
    fn add_impl_item(
        &mut self,
        file: u32,
        inner: &mut syn::ImplItem,
        owner: &Owner,
        named: &Named<'_>,
        item: &syn::ItemImpl,
        errors: &[Diagnostic],
    ) {
        let mut check = Check::new(file);
        check.check_generics(&mut item.generics.clone());
        let text = inner.to_token_stream();
        let key = match inner {
            syn::ImplItem::Fn(f) => {
                if !check.keeps_function(&mut f.attrs) {
                    return;
                }
                check.check_function(&mut f.sig, &mut f.block);
                let plain = qualified_name(Some(&owner.name), &f.sig.ident);
                let key = self.function_key(&plain, owner, named);
                if self.implemented_twice(&plain, owner, named) {
                    self.note_duplicate(&self.lower_of(file), f.sig.ident.span(), &plain);
                    return;
                }
                let (mut function, lowered) = self.lower_function(file, &f.sig, &f.block, &f.attrs, Some(owner));
                function.default_of = named.is_default.then(|| named.trait_name.to_owned());
                self.note_errors_of(&key, lowered);
                self.insert(&key, &f.sig.ident, function);
                self.note_implemented(plain, &key, named);
                key
            }
            syn::ImplItem::Const(c) => {
                if !check.keeps(&mut c.attrs) {
                    return;
                }
                check.constant_name(&c.ident);
                check.check_constant(&mut c.generics, &mut c.ty, &mut c.expr);
                let plain = qualified_name(Some(&owner.name), &c.ident);
                let key = self.function_key(&plain, owner, named);
                if self.implemented_twice(&plain, owner, named) {
                    self.note_duplicate(&self.lower_of(file), c.ident.span(), &plain);
                    return;
                }
                let default_of = named.is_default.then_some(named.trait_name);
                self.insert_constant(&key, (file, c), owner, default_of);
                self.note_implemented(plain, &key, named);
                key
            }
            syn::ImplItem::Type(_) => return,
            other => return self.refuse_definitions(other.to_token_stream(), check),
        };
        let mut mentioned = item.self_ty.to_token_stream();
        mentioned.extend(text);
        self.note_errors_of(&key, errors.to_vec());
        self.note(&key, mentioned, check);
    }

    /// Notes that a trait gives a type a function or a constant.
    fn note_implemented(&mut self, plain: String, key: &str, named: &Named<'_>) {
        self.library.implemented.entry(plain).or_default().push(Implemented {
            of: named.trait_name.to_owned(),
            args: named.args.to_vec(),
            key: key.to_owned(),
        });
    }

    /// Key of a function or a constant of an implementation: its type and its name if those are free.
    fn function_key(&self, plain: &str, owner: &Owner, named: &Named<'_>) -> String {
        let name = plain.rsplit("::").next().unwrap_or(plain);
        let is_taken = |key: &str| self.library.functions.contains_key(key) || self.library.consts.contains_key(key);
        // A method of the type itself goes before one of a trait.
        if !is_taken(plain) && !super::methods::is_inherent(&owner.name, name) {
            return plain.to_owned();
        }
        let key = format!("<{} as {}>::{name}", owner.name, named.shown);
        match is_taken(&key) {
            true => format!("<{} as {}>::{name}", owner.shown, named.shown),
            false => key,
        }
    }

    /// Returns whether there is an implementation of the trait for the type already, ignoring references.
    fn implemented_twice(&self, plain: &str, owner: &Owner, named: &Named<'_>) -> bool {
        let alike = |a: &[Type], b: &[Type]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| bare_type_name(a) == bare_type_name(b))
        };
        let known = self.library.implemented.get(plain);
        known.is_some_and(|known| {
            known
                .iter()
                .any(|i| i.of == named.trait_name && alike(&i.args, named.args) && !self.is_other_type(&i.key, owner))
        })
    }

    /// Lets functions that operators call be reached by the types that they are of.
    fn reached_by(&mut self, of: &str, named: &Named<'_>, owner: &Owner) {
        if !OPERATORS.contains(&named.trait_name) {
            return;
        }
        let keys = self
            .library
            .implemented
            .iter()
            .filter(|(plain, _)| plain.starts_with(&format!("{of}::")));
        let keys = keys.flat_map(|(_, all)| all).filter(|i| i.of == named.trait_name);
        let keys: Vec<String> = keys.map(|i| i.key.clone()).collect();
        let arguments = named.args.iter().filter_map(|ty| match ty.peel_refs() {
            Type::Name(name, _) => Some(name.clone()),
            _ => None,
        });
        let types: Vec<String> = std::iter::once(owner.name.clone()).chain(arguments).collect();
        for ty in types.iter().filter(|ty| !super::foreign::is_prelude_type(ty)) {
            for key in &keys {
                self.mentions.add_need(ty, key);
            }
        }
    }

    /// A type parameter of an implementation under the name that it has in the definition of the structure.
    fn by_parameter_of(&self, owner: &Type, ty: &Type) -> Type {
        let Type::Name(of, args) = owner.peel_refs() else {
            return ty.clone();
        };
        let generics = self
            .library
            .structs
            .get(of)
            .map_or(&[][..], |definition| &definition.generics);
        let is_it = |arg: &Type| matches!(ty, Type::Name(name, args) if args.is_empty() && arg.is_parameter(name));
        let own = generics.iter().zip(args).find(|(_, arg)| is_it(arg));
        own.map_or_else(
            || ty.clone(),
            |(generic, _)| Type::Name(generic.name().to_owned(), Vec::new()),
        )
    }

    /// Returns whether a trait is neither in the files nor one that every Rust file has, and nothing imports it.
    fn is_unknown(&self, path: &syn::Path) -> bool {
        let (Some(only), 1) = (path.segments.first(), path.segments.len()) else {
            return false;
        };
        let name = only.ident.to_string();
        !is_of_rust(&name) && !OF_STD.contains(&name.as_str()) && !self.may_import(&name)
    }

    fn refuse_functions(&mut self, item: &syn::ItemImpl, of: &str, errors: &[Diagnostic]) {
        for name in item.items.iter().filter_map(item_name) {
            self.of_trait(format!("{of}::{name}"), errors.to_vec());
        }
    }

    /// Functions and constants that an implementation lacks.
    fn missing_members(
        &self,
        file: u32,
        path: &syn::Path,
        declared: &syn::ItemTrait,
        given: &BTreeSet<String>,
    ) -> Option<Diagnostic> {
        let needed = declared.items.iter().filter(|item| default_of(item).is_none());
        let needed = needed.filter_map(|item| match item {
            syn::TraitItem::Fn(f) => Some(f.sig.ident.to_string()),
            syn::TraitItem::Const(c) => Some(c.ident.to_string()),
            syn::TraitItem::Type(t) if t.default.is_none() => Some(t.ident.to_string()),
            _ => None,
        });
        let lacking: Vec<String> = needed
            .filter(|name| !given.contains(name))
            .map(|n| format!("`{n}`"))
            .collect();
        if lacking.is_empty() {
            return None;
        }
        let lower = self.lower_of(file);
        Some(
            Diagnostic::error_at(
                Code::TraitImplementation,
                lower.token_span(path.span()),
                format!("not all items of the trait `{}` are implemented", declared.ident),
            )
            .label(format!("missing: {}", lacking.join(", ")))
            .help("write them in this `impl`"),
        )
    }

    /// Functions and constants that are not of the trait.
    fn not_members(
        &self,
        file: u32,
        trait_name: &str,
        declared: &syn::ItemTrait,
        items: &[syn::ImplItem],
    ) -> Vec<Diagnostic> {
        let known: Vec<String> = declared
            .items
            .iter()
            .filter_map(|item| match item {
                syn::TraitItem::Fn(f) => Some(f.sig.ident.to_string()),
                syn::TraitItem::Const(c) => Some(c.ident.to_string()),
                syn::TraitItem::Type(t) => Some(t.ident.to_string()),
                _ => None,
            })
            .collect();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let lower = self.lower_of(file);
        let others = items
            .iter()
            .filter_map(|item| Some((item_name(item)?, item_span(item)?)));
        let others = others.filter(|(name, _)| !known.contains(&name.as_str()));
        let each = others.map(|(name, span)| {
            Diagnostic::error_at(
                Code::TraitImplementation,
                lower.token_span(span),
                format!("`{name}` is not a member of the trait `{trait_name}`"),
            )
            .label("not of this trait")
            .help(crate::suggest::suggest_name(&name, &known, "it has"))
        });
        each.collect()
    }

    /// Lowers what stands in an `impl`.
    pub(super) fn lower_within(&self, file: u32, of: &Owner) -> Lower {
        let mut lower = Lower::new(file, Some(of.ty.clone()), Rc::clone(&self.names));
        lower.stands.clone_from(&of.stands);
        lower.functions.clone_from(&of.functions);
        lower
            .parameters
            .extend(of.generics.iter().map(|generic| generic.name().to_owned()));
        lower
    }
}

/// The trait of an implementation.
struct Named<'t> {
    trait_name: &'t str,
    /// `true` of a default function.
    is_default: bool,
    args: &'t [Type],
    /// As it is written.
    shown: String,
}

/// The last segment of a bound that is a trait.
pub fn trait_name(bound: &syn::TypeParamBound) -> Option<String> {
    match bound {
        syn::TypeParamBound::Trait(bound) => bound.path.segments.last().map(|s| s.ident.to_string()),
        _ => None,
    }
}

/// The type arguments of a trait.
fn trait_arguments(lower: &mut Lower, path: &syn::Path) -> Vec<Type> {
    let Some(syn::PathArguments::AngleBracketed(list)) = path.segments.last().map(|s| &s.arguments) else {
        return Vec::new();
    };
    let each = list.args.iter().filter_map(|arg| match arg {
        syn::GenericArgument::Type(ty) => Some(lower.lower_type(ty)),
        _ => None,
    });
    each.collect()
}

/// A trait with its arguments, for names and messages.
fn format_trait(path: &syn::Path) -> String {
    let last = path.segments.last().map(super::cfg::as_written).unwrap_or_default();
    last.replace(' ', "")
}

/// A type without the references in it.
fn bare_type_name(ty: &Type) -> String {
    match ty.peel_refs() {
        Type::Name(name, args) => {
            let args: Vec<String> = args.iter().map(bare_type_name).collect();
            format!("{name}<{}>", args.join(","))
        }
        Type::Tuple(parts) => {
            let parts: Vec<String> = parts.iter().map(bare_type_name).collect();
            format!("({})", parts.join(","))
        }
        Type::Array(element, _) => format!("[{}]", bare_type_name(element)),
        Type::Fn(..) => "fn".to_owned(),
        Type::Const(_) => "_".to_owned(),
        Type::Ref(_, inner) => bare_type_name(inner),
    }
}

/// The default of a trait's item, for a type that does not write it.
fn default_of(item: &syn::TraitItem) -> Option<syn::ImplItem> {
    match item {
        syn::TraitItem::Fn(f) => {
            let mut tokens = f.attrs.iter().map(ToTokens::to_token_stream).collect::<TokenStream>();
            tokens.extend(f.sig.to_token_stream());
            tokens.extend(f.default.as_ref()?.to_token_stream());
            syn::parse2(tokens).ok()
        }
        syn::TraitItem::Const(c) => {
            let (_, value) = c.default.as_ref()?;
            let (name, ty) = (&c.ident, &c.ty);
            syn::parse2(quote::quote!(const #name: #ty = #value;)).ok()
        }
        _ => None,
    }
}

fn item_name(item: &syn::ImplItem) -> Option<String> {
    match item {
        syn::ImplItem::Fn(f) => Some(f.sig.ident.to_string()),
        syn::ImplItem::Const(c) => Some(c.ident.to_string()),
        syn::ImplItem::Type(t) => Some(t.ident.to_string()),
        _ => None,
    }
}

fn item_span(item: &syn::ImplItem) -> Option<Span> {
    match item {
        syn::ImplItem::Fn(f) => Some(f.sig.ident.span()),
        syn::ImplItem::Const(c) => Some(c.ident.span()),
        syn::ImplItem::Type(t) => Some(t.ident.span()),
        _ => None,
    }
}
