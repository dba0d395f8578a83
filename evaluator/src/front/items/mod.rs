//! Items of a kernel's files.

mod reached;
mod signature;

use super::cfg::is_test;
use super::check::Check;
use super::expr::Lower;
use super::foreign::{Import, is_prelude_type};
use super::library::Library;
use super::names::Names;
use super::reach::Mentions;
use super::tree::{Enum, EnumVariant, Fields, Function, Generic, Param, Struct, Type};
use crate::diagnostic::{Code, Diagnostic};
use proc_macro2::{Span, TokenStream};
use quote::ToTokens;
use std::collections::HashMap;
use std::rc::Rc;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

/// Items lowered so far, and the errors of each by its name.
#[derive(Default)]
pub struct Items {
    pub(super) library: Library,
    errors: HashMap<String, Vec<Diagnostic>>,
    pub(super) duplicates: Vec<Diagnostic>,
    pub(super) mentions: Mentions,
    /// Names that files import.
    imports: Vec<Import>,
    /// `true` if the files may use names that they do not show: by `use module::*`, or by a macro that defines items.
    unknown_names: bool,
    pub(super) names: Rc<Names>,
    /// Traits as they are written, with their files.
    pub(super) traits: HashMap<String, (u32, syn::ItemTrait)>,
    /// Implementations of traits, with their files.
    pub(super) implementations: Vec<(u32, syn::ItemImpl)>,
    /// Errors of implementations of traits that `check` reports whether or not the kernel reaches them.
    pub(super) implementation_errors: Vec<Diagnostic>,
    /// Functions of implementations of traits that are refused, as `Type::name`.
    of_traits: Vec<(String, Vec<Diagnostic>)>,
}

/// The type that an `impl` is of.
pub(super) struct Owner {
    pub name: String,
    pub generics: Vec<Generic>,
    /// The traits that its type parameters have.
    pub bounds: HashMap<String, Vec<String>>,
    /// The type with its arguments.
    pub ty: Type,
    /// The type as it is written.
    pub shown: String,
    /// Types that other names stand for in it.
    pub stands: HashMap<String, Type>,
    /// Type parameters that are called, with their types.
    pub functions: HashMap<String, Type>,
}

impl Items {
    /// For files whose names are known.
    pub fn new(files: &[(u32, syn::File)]) -> Self {
        let (names, wrong) = Names::from_files(files);
        let mut items = Items {
            names: Rc::new(names),
            ..Items::default()
        };
        for (here, there) in Rc::clone(&items.names).renamed_functions() {
            items.note_errors_of(&here, Vec::new());
            items.mentions.add_need(&here, &there);
        }
        for (name, error) in wrong {
            items.note_errors_of(&name, vec![error]);
        }
        items
    }

    /// Takes a file. Tests and what `cfg` removes are passed over; items that are not part of the kernel language are noted by their
    /// names, and refused where the kernel reaches them.
    pub fn add_file(&mut self, file: u32, parsed: &mut syn::File) {
        let mut check = Check::new(file);
        let kept = check.keeps(&mut parsed.attrs);
        self.duplicates.extend(check.into_errors());
        if kept {
            self.add_items(file, &mut parsed.items);
        }
    }

    fn add_items(&mut self, file: u32, items: &mut [syn::Item]) {
        for item in items {
            let mut check = Check::new(file);
            let attrs = match item {
                syn::Item::Struct(s) => &s.attrs,
                syn::Item::Enum(e) => &e.attrs,
                _ => &Vec::new(),
            };
            if derived_traits(attrs).iter().any(|derived| derived == "Default") {
                let written = super::derived::derived_default(item);
                self.implementations.extend(written.map(|written| (file, written)));
            }
            match item {
                syn::Item::Fn(f) => {
                    if is_test(&f.attrs) || !check.keeps_function(&mut f.attrs) {
                        continue;
                    }
                    check.check_function(&mut f.sig, &mut f.block);
                    let name = f.sig.ident.to_string();
                    self.add_function(file, &f.sig, &f.block, &f.attrs, None);
                    self.note(&name, f.to_token_stream(), check);
                }
                syn::Item::Const(c) => {
                    if !check.keeps(&mut c.attrs) || c.ident == "_" {
                        continue;
                    }
                    check.constant_name(&c.ident);
                    check.check_constant(&mut c.generics, &mut c.ty, &mut c.expr);
                    let name = c.ident.to_string();
                    self.add_constant(file, c);
                    self.note(&name, c.to_token_stream(), check);
                }
                syn::Item::Static(s) => {
                    if !check.keeps(&mut s.attrs) {
                        continue;
                    }
                    self.add_static(file, s, check);
                }
                syn::Item::Type(t) => {
                    if check.keeps(&mut t.attrs) {
                        check.check_generics(&mut t.generics);
                        check.check_type(&mut t.ty);
                        if let Some(first) = t.generics.params.first() {
                            check.refuse(
                                first.span(),
                                "a name for a type with parameters",
                                "write the type itself",
                            );
                        }
                        self.note(&t.ident.to_string(), t.ty.to_token_stream(), check);
                    }
                }
                syn::Item::Struct(s) => {
                    if !check.keeps(&mut s.attrs) {
                        continue;
                    }
                    self.type_name(&mut check, &s.ident);
                    check.check_struct(s);
                    let name = s.ident.to_string();
                    self.add_struct(file, s);
                    self.note(&name, s.to_token_stream(), check);
                }
                syn::Item::Enum(e) => {
                    if !check.keeps(&mut e.attrs) {
                        continue;
                    }
                    self.type_name(&mut check, &e.ident);
                    check.check_enum(e);
                    let name = e.ident.to_string();
                    if file == super::std::FILE && self.library.has_type(&name) {
                        continue;
                    }
                    self.add_enum(file, e);
                    self.note(&name, e.to_token_stream(), check);
                }
                syn::Item::Impl(i) => {
                    if !check.keeps(&mut i.attrs) {
                        continue;
                    }
                    match i.trait_.is_some() {
                        true => self.implementations.push((file, i.clone())),
                        false => self.add_inherent_impl(file, i, check),
                    }
                }
                syn::Item::Trait(t) => {
                    if check.keeps(&mut t.attrs) {
                        self.add_trait(file, t, check);
                    }
                }
                syn::Item::Mod(m) => {
                    if check.keeps(&mut m.attrs)
                        && let Some((_, inner)) = &mut m.content
                    {
                        self.duplicates.extend(check.into_errors());
                        self.add_items(file, inner);
                    }
                }
                syn::Item::Macro(m) if m.mac.path.segments.last().is_some_and(|s| s.ident == "options") => {
                    if check.keeps(&mut m.attrs) {
                        self.duplicates.extend(check.into_errors());
                        self.add_options(file, &m.mac);
                    }
                }
                other => self.note_foreign_item(other, check),
            }
        }
    }

    /// Notes an item's errors, and what its text mentions.
    pub(super) fn note(&mut self, name: &str, text: TokenStream, check: Check) {
        self.mentions.add(name, text);
        self.note_errors_of(name, check.into_errors());
    }

    /// Notes a function of an implementation of a trait.
    pub(super) fn of_trait(&mut self, name: String, errors: Vec<Diagnostic>) {
        self.of_traits.push((name, errors));
    }

    /// Notes if a `use` or a macro may define names that the files do not show.
    pub(super) fn note_unknown_names(&mut self, unknown: bool) {
        self.unknown_names |= unknown;
    }

    /// Notes a name that a file imports.
    pub(super) fn add_import(&mut self, import: Import) {
        self.imports.push(import);
    }

    /// Returns whether a `use` brings in a name, or may do so.
    pub(super) fn may_import(&self, name: &str) -> bool {
        self.unknown_names || self.imports.iter().any(|import| import.brings(name))
    }

    /// Notes errors that concern every kernel of the files.
    pub(super) fn refuse_all(&mut self, check: Check) {
        self.duplicates.extend(check.into_errors());
    }

    /// Notes errors of an item under its name: they count for the kernels that reach it.
    pub(super) fn note_errors_of(&mut self, name: &str, errors: Vec<Diagnostic>) {
        self.errors.entry(name.to_owned()).or_default().extend(errors);
    }

    /// Checks that a type's name is its alone.
    pub(super) fn type_name(&mut self, check: &mut Check, name: &syn::Ident) {
        let shown = name.to_string();
        if is_prelude_type(&shown) {
            check.refuse(
                name.span(),
                &format!("a type of one's own by the name of `{shown}`"),
                "give it another name",
            );
        }
        if self.library.has_type(&shown) {
            check.note_duplicate(name);
        }
    }

    fn add_function(
        &mut self,
        file: u32,
        sig: &syn::Signature,
        body: &syn::Block,
        attrs: &[syn::Attribute],
        of: Option<&Owner>,
    ) -> String {
        let plain = qualified_name(of.map(|of| of.name.as_str()), &sig.ident);
        let (function, errors) = self.lower_function(file, sig, body, attrs, of);
        if file == super::std::FILE && self.library.functions.contains_key(&plain) {
            return plain;
        }
        let name = self.inherent_key(plain, of, sig.ident.span(), file);
        self.insert(&name, &sig.ident, function);
        self.note_errors_of(&name, errors);
        name
    }

    /// Key of a function or a constant of an `impl`: its type and its name, with the type's arguments if another `impl` gives the
    /// type one of this name.
    fn inherent_key(&mut self, plain: String, of: Option<&Owner>, at: Span, file: u32) -> String {
        let library = &mut self.library;
        if !library.functions.contains_key(&plain) && !library.consts.contains_key(&plain) {
            return plain;
        }
        let known = library.alternatives.get(&plain).cloned();
        let mut known = known.unwrap_or_else(|| vec![plain.clone()]);
        match of {
            Some(of) if known.iter().all(|key| self.is_other_type(key, of)) => {
                let name = plain.rsplit("::").next().unwrap_or(&plain);
                let key = format!("{}::{name}", of.shown);
                known.push(key.clone());
                self.library.alternatives.insert(plain, known);
                key
            }
            _ => {
                self.note_duplicate(&self.lower_of(file), at, &plain);
                plain
            }
        }
    }

    /// Returns whether a function or a constant is of an `impl` of no type that another `impl` is of.
    pub(super) fn is_other_type(&self, key: &str, owner: &Owner) -> bool {
        let library = &self.library;
        let generics = library.functions.get(key).map(|function| &function.generics);
        let generics = generics.or_else(|| library.consts.get(key).map(|constant| &constant.generics));
        let both = || generics.into_iter().flatten().chain(&owner.generics);
        let is_parameter = |name: &str| both().any(|generic| generic.name() == name);
        library
            .owner_of(key)
            .is_some_and(|of| of.is_apart(&owner.ty, &is_parameter))
    }

    /// Adds a function.
    pub(super) fn insert(&mut self, key: &str, name: &syn::Ident, function: Function) {
        let own = function.params.first();
        // Methods of arrays in the library have no `self`.
        let receives = |p: &Param| p.name == "self" || key.starts_with("Array::");
        if own.is_some_and(|p| receives(p) && p.ty.is_mutable_reference()) {
            self.library.mutating.insert(name.to_string());
        }
        self.library.functions.insert(key.to_owned(), function);
    }

    /// A `static`, which is a constant where nothing changes it.
    fn add_static(&mut self, file: u32, item: &mut syn::ItemStatic, mut check: Check) {
        if let syn::StaticMutability::Mut(token) = &item.mutability {
            check.refuse(
                token.span(),
                "a `static` that is changed",
                "give the value to the functions that need it",
            );
        }
        check.constant_name(&item.ident);
        check.check_constant(&mut syn::Generics::default(), &mut item.ty, &mut item.expr);
        let (name, ty, value) = (&item.ident, &item.ty, &item.expr);
        if let Ok(constant) = syn::parse2(quote::quote!(const #name: #ty = #value;)) {
            self.add_constant(file, &constant);
        }
        self.note(&name.to_string(), item.to_token_stream(), check);
    }

    fn add_constant(&mut self, file: u32, item: &syn::ItemConst) {
        let mut lower = self.lower_of(file);
        let constant = lower.lower_constant(item);
        if self.library.consts.contains_key(&constant.name) {
            self.note_duplicate(&lower, item.ident.span(), &constant.name);
        }
        self.note_errors_of(&constant.name, lower.errors);
        self.library.consts.insert(constant.name.clone(), constant);
    }

    fn add_struct(&mut self, file: u32, item: &syn::ItemStruct) {
        let mut lower = self.lower_of(file);
        let definition = Struct {
            generics: lower.lower_generics(&item.generics),
            functions: lower.functions_of(&item.generics),
            fields: lower_fields(&mut lower, &item.fields),
            derives: derived_traits(&item.attrs),
        };
        self.library.structs.insert(item.ident.to_string(), definition);
        self.note_errors_of(&item.ident.to_string(), lower.errors);
    }

    fn add_enum(&mut self, file: u32, item: &syn::ItemEnum) {
        let name = item.ident.to_string();
        let mut lower = self.lower_of(file);
        let variants = item.variants.iter().map(|variant| EnumVariant {
            name: variant.ident.to_string(),
            docs: doc_text(&variant.attrs),
            fields: lower_fields(&mut lower, &variant.fields),
            discriminant: variant.discriminant.as_ref().map(|(_, value)| lower.lower_expr(value)),
        });
        let variants = variants.collect();
        let definition = Enum {
            generics: lower.lower_generics(&item.generics),
            functions: lower.functions_of(&item.generics),
            variants,
            derives: derived_traits(&item.attrs),
        };
        self.library.enums.insert(name.clone(), definition);
        self.note_errors_of(&name, lower.errors);
    }

    /// Lowers an item that stands by itself.
    pub(super) fn lower_of(&self, file: u32) -> Lower {
        Lower::new(file, None, Rc::clone(&self.names))
    }

    fn add_inherent_impl(&mut self, file: u32, item: &mut syn::ItemImpl, mut check: Check) {
        let mut lower = self.lower_of(file);
        lower.called_parameters(&item.generics);
        let ty = lower.lower_type(&item.self_ty);
        let Type::Name(of, _) = &ty else {
            return self.duplicates.extend(lower.errors);
        };
        let of = Owner {
            name: of.clone(),
            generics: lower.lower_generics(&item.generics),
            bounds: lower.trait_bounds(&item.generics),
            ty: ty.clone(),
            shown: super::cfg::as_written(&item.self_ty).replace(' ', ""),
            stands: HashMap::new(),
            functions: std::mem::take(&mut lower.functions),
        };
        let place = lower.token_span(item.self_ty.span());
        self.library.owners.push((ty.clone(), of.generics.clone(), place));
        if let Some(default) = &item.modifiers.defaultness {
            check.refuse(default.span(), "`default`", "leave it out");
        }
        let of_all = check.into_errors();
        for inner in &mut item.items {
            let mut check = Check::new(file);
            check.check_generics(&mut item.generics);
            let name = match inner {
                syn::ImplItem::Fn(f) => {
                    if !check.keeps_function(&mut f.attrs) {
                        continue;
                    }
                    check.check_function(&mut f.sig, &mut f.block);
                    self.add_function(file, &f.sig, &f.block, &f.attrs, Some(&of))
                }
                syn::ImplItem::Const(c) => {
                    if !check.keeps(&mut c.attrs) {
                        continue;
                    }
                    check.constant_name(&c.ident);
                    check.check_constant(&mut c.generics, &mut c.ty, &mut c.expr);
                    let plain = qualified_name(Some(&of.name), &c.ident);
                    let name = self.inherent_key(plain, Some(&of), c.ident.span(), file);
                    self.insert_constant(&name, (file, c), &of, None);
                    name
                }
                syn::ImplItem::Type(t) => {
                    if !check.keeps(&mut t.attrs) {
                        continue;
                    }
                    check.refuse(t.span(), "a type in an `impl`", "write the type out");
                    qualified_name(Some(&of.name), &t.ident)
                }
                other => {
                    self.refuse_definitions(other.to_token_stream(), check);
                    continue;
                }
            };
            let mut text = item.self_ty.to_token_stream();
            text.extend(inner.to_token_stream());
            self.note_errors_of(&name, of_all.clone());
            self.note(&name, text, check);
        }
    }

    /// Adds a constant of an `impl`, which may be the default of a trait.
    pub(super) fn insert_constant(
        &mut self,
        key: &str,
        (file, item): (u32, &syn::ImplItemConst),
        of: &Owner,
        default_of: Option<&str>,
    ) {
        let mut lower = self.lower_within(file, of);
        let constant = super::tree::Const {
            name: key.to_owned(),
            generics: of.generics.clone(),
            of: Some(of.ty.clone()),
            bounds: of.bounds.clone(),
            default_of: default_of.map(str::to_owned),
            value: lower.lower_expr(&item.expr),
            ty: lower.lower_type(&item.ty),
        };
        self.note_errors_of(key, lower.errors);
        self.library.consts.insert(key.to_owned(), constant);
    }

    pub(super) fn note_duplicate(&mut self, lower: &Lower, span: Span, name: &str) {
        let error = Diagnostic::error_at(
            Code::DefinedTwice,
            lower.token_span(span),
            format!("`{name}` is defined twice among the kernel's files"),
        )
        .label("second definition")
        .help("modules and functions are not told apart: give it another name");
        self.note_errors_of(name, vec![error]);
    }
}

/// The fields of a structure or of a variant.
fn lower_fields(lower: &mut Lower, fields: &syn::Fields) -> Fields {
    let each = fields.iter().enumerate().map(|(k, field)| {
        let name = field.ident.as_ref().map_or(k.to_string(), syn::Ident::to_string);
        (name.into(), lower.lower_type(&field.ty), lower.token_span(field.span()))
    });
    each.collect()
}

/// The traits that attributes derive, by the last segments of their paths.
fn derived_traits(attrs: &[syn::Attribute]) -> Vec<String> {
    let mut names = Vec::new();
    for attr in attrs.iter().filter(|attr| attr.path().is_ident("derive")) {
        let parser = Punctuated::<syn::Path, syn::Token![,]>::parse_terminated;
        for path in attr.parse_args_with(parser).into_iter().flatten() {
            names.extend(path.segments.last().map(|last| last.ident.to_string()));
        }
    }
    names
}

/// A function's name, of a type's with the type before it.
pub(super) fn qualified_name(of: Option<&str>, name: &syn::Ident) -> String {
    match of {
        Some(ty) => format!("{ty}::{name}"),
        None => name.to_string(),
    }
}

/// Documentation comments as one text.
pub(super) fn doc_text(attrs: &[syn::Attribute]) -> String {
    let mut lines = Vec::new();
    for attr in attrs {
        if attr.path().is_ident("doc")
            && let syn::Meta::NameValue(pair) = &attr.meta
            && let syn::Expr::Lit(syn::ExprLit {
                lit: syn::Lit::Str(text),
                ..
            }) = &pair.value
        {
            lines.push(text.value().trim().to_owned());
        }
    }
    lines.join(" ").trim().to_owned()
}
