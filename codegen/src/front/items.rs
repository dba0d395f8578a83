//! Items of a kernel's files.

use super::Parsed;
use super::cfg::is_test;
use super::check::Check;
use super::expr::Lower;
use super::foreign::{Import, is_prelude_type};
use super::options::{OptionsSyntax, at_run_time};
use super::reach::Mentions;
use super::tree::{Enum, Function, Generic, Library, OptionField, Param, Struct, Type};
use crate::diagnostic::Diagnostic;
use proc_macro2::{Span, TokenStream};
use quote::ToTokens;
use std::collections::HashMap;
use syn::spanned::Spanned;

/// Items lowered so far, and the errors of each by its name.
#[derive(Default)]
pub struct Items {
    library: Library,
    errors: HashMap<String, Vec<Diagnostic>>,
    duplicates: Vec<Diagnostic>,
    mentions: Mentions,
    /// Names that files import.
    imports: Vec<Import>,
    /// Functions of implementations of traits, as `Type::name`.
    of_traits: Vec<(String, Vec<Diagnostic>)>,
}

impl Items {
    /// Takes a file. Tests and what `cfg` removes are passed over; items that are not part of the kernel language are noted by their
    /// names, and refused where the kernel reaches them.
    pub fn file(&mut self, file: u32, parsed: &mut syn::File) {
        let mut check = Check::new(file);
        let kept = check.keeps(&mut parsed.attrs);
        self.duplicates.extend(check.errors());
        if kept {
            self.collect(file, &mut parsed.items);
        }
    }

    fn collect(&mut self, file: u32, items: &mut [syn::Item]) {
        for item in items {
            let mut check = Check::new(file);
            match item {
                syn::Item::Fn(f) => {
                    if is_test(&f.attrs) || !check.keeps(&mut f.attrs) {
                        continue;
                    }
                    check.function(&mut f.sig, &mut f.block);
                    let name = f.sig.ident.to_string();
                    self.function(file, &f.sig, &f.block, &f.attrs, None);
                    self.note(&name, f.to_token_stream(), check);
                }
                syn::Item::Const(c) => {
                    if !check.keeps(&mut c.attrs) || c.ident == "_" {
                        continue;
                    }
                    check.constant_name(&c.ident);
                    check.constant(&mut c.generics, &mut c.ty, &mut c.expr);
                    let name = c.ident.to_string();
                    self.constant(file, c, None);
                    self.note(&name, c.to_token_stream(), check);
                }
                syn::Item::Struct(s) => {
                    if !check.keeps(&mut s.attrs) {
                        continue;
                    }
                    self.type_name(&mut check, &s.ident);
                    check.structure(s);
                    let name = s.ident.to_string();
                    self.structure(file, s);
                    self.note(&name, s.to_token_stream(), check);
                }
                syn::Item::Enum(e) => {
                    if !check.keeps(&mut e.attrs) {
                        continue;
                    }
                    self.type_name(&mut check, &e.ident);
                    check.variants(e);
                    let variants = e
                        .variants
                        .iter()
                        .map(|v| (v.ident.to_string(), docs(&v.attrs)))
                        .collect();
                    let name = e.ident.to_string();
                    self.library.enums.insert(name.clone(), Enum { variants });
                    self.note(&name, e.to_token_stream(), check);
                }
                syn::Item::Impl(i) => {
                    if check.keeps(&mut i.attrs) {
                        self.implementation(file, i, check);
                    }
                }
                syn::Item::Mod(m) => {
                    if check.keeps(&mut m.attrs)
                        && let Some((_, inner)) = &mut m.content
                    {
                        self.duplicates.extend(check.errors());
                        self.collect(file, inner);
                    }
                }
                syn::Item::Macro(m) if m.mac.path.segments.last().is_some_and(|s| s.ident == "options") => {
                    if check.keeps(&mut m.attrs) {
                        self.duplicates.extend(check.errors());
                        self.options(file, &m.mac);
                    }
                }
                other => self.elsewhere(other, check),
            }
        }
    }

    /// Notes an item's errors, and what its text mentions.
    pub(super) fn note(&mut self, name: &str, text: TokenStream, mut check: Check) {
        check.raw_names(text.clone());
        self.mentions.add(name, text);
        self.blame(name, check.errors());
    }

    /// Notes a function of an implementation of a trait.
    pub(super) fn of_trait(&mut self, name: String, errors: Vec<Diagnostic>) {
        self.of_traits.push((name, errors));
    }

    /// Notes a name that a file imports.
    pub(super) fn takes(&mut self, import: Import) {
        self.imports.push(import);
    }

    /// Notes errors that concern every kernel of the files.
    pub(super) fn refuse_all(&mut self, check: Check) {
        self.duplicates.extend(check.errors());
    }

    fn blame(&mut self, name: &str, errors: Vec<Diagnostic>) {
        self.errors.entry(name.to_owned()).or_default().extend(errors);
    }

    /// Checks that a type's name is its alone.
    fn type_name(&mut self, check: &mut Check, name: &syn::Ident) {
        let shown = name.to_string();
        if is_prelude_type(&shown) {
            check.refuse(
                name.span(),
                &format!("a type of one's own by the name of `{shown}`"),
                "give it another name",
            );
        }
        if self.library.structs.contains_key(&shown) || self.library.enums.contains_key(&shown) {
            check.twice(name);
        }
    }

    fn function(
        &mut self,
        file: u32,
        sig: &syn::Signature,
        body: &syn::Block,
        attrs: &[syn::Attribute],
        of: Option<&str>,
    ) {
        let mut lower = Lower::new(file, of.map(str::to_owned));
        let name = qualified(of, &sig.ident);
        lower.called_parameters(&sig.generics);
        let (mut params, mut parts) = (Vec::new(), Vec::new());
        // Evaluation is on values, so a type parameter is whatever comes; constants are bound by name.
        let generics = sig.generics.params.iter().filter_map(|p| match p {
            syn::GenericParam::Const(c) => Some(Generic::Const(c.ident.to_string(), lower.ty(&c.ty))),
            syn::GenericParam::Type(t) => Some(Generic::Type(t.ident.to_string())),
            syn::GenericParam::Lifetime(_) => None,
        });
        let generics = generics.collect();
        for input in &sig.inputs {
            match input {
                syn::FnArg::Receiver(receiver) => {
                    params.push(Param {
                        name: "self".to_owned(),
                        ty: receiver_type(&mut lower, receiver, of.unwrap_or_default()),
                        mutable: receiver.mutability.is_some(),
                        span: lower.span(receiver.span()),
                    });
                }
                syn::FnArg::Typed(typed) => {
                    let ty = lower.ty(&typed.ty);
                    match &*typed.pat {
                        syn::Pat::Ident(p) => params.push(Param {
                            name: p.ident.to_string(),
                            ty,
                            mutable: p.mutability.is_some(),
                            span: lower.span(p.span()),
                        }),
                        other => {
                            let (param, taken) = lower.pattern_parameter(other, ty, params.len());
                            params.push(param);
                            parts.push(taken);
                        }
                    }
                }
            }
        }
        let result = match &sig.output {
            syn::ReturnType::Default => Type::Tuple(Vec::new()),
            syn::ReturnType::Type(_, ty) => lower.ty(ty),
        };
        let span = lower.span(sig.ident.span());
        let body = super::parts::before(parts, lower.block(body), span);
        if file == super::std::FILE && self.library.functions.contains_key(&name) {
            return;
        }
        if self.library.functions.contains_key(&name) {
            self.duplicate(&lower, sig.ident.span(), &name);
        }
        let mutates = params
            .first()
            .is_some_and(|p| p.name == "self" && p.ty.is_mutable_reference());
        if mutates {
            self.library.mutating.insert(sig.ident.to_string());
        }
        self.library.functions.insert(
            name.clone(),
            Function {
                docs: docs(attrs),
                generics,
                params,
                result,
                body,
                span,
            },
        );
        self.blame(&name, lower.errors);
    }

    fn constant(&mut self, file: u32, item: &syn::ItemConst, of: Option<&str>) {
        let mut lower = Lower::new(file, of.map(str::to_owned));
        let constant = lower.constant(item, of);
        if self.library.consts.contains_key(&constant.name) {
            self.duplicate(&lower, item.ident.span(), &constant.name);
        }
        self.blame(&constant.name, lower.errors);
        self.library.consts.insert(constant.name.clone(), constant);
    }

    fn structure(&mut self, file: u32, item: &syn::ItemStruct) {
        let mut lower = Lower::new(file, None);
        let fields = item.fields.iter().enumerate().map(|(k, field)| {
            let name = field.ident.as_ref().map_or(k.to_string(), syn::Ident::to_string);
            (name, lower.ty(&field.ty), lower.span(field.span()))
        });
        let fields = fields.collect();
        self.library.structs.insert(item.ident.to_string(), Struct { fields });
        self.blame(&item.ident.to_string(), lower.errors);
    }

    fn implementation(&mut self, file: u32, item: &mut syn::ItemImpl, mut check: Check) {
        let mut lower = Lower::new(file, None);
        let ty = lower.ty(&item.self_ty);
        if let Some((path, _)) = &item.trait_ {
            return self.trait_implementation(path, &ty, &item.items, check);
        }
        let Type::Name(of, _) = ty else {
            return self.duplicates.extend(lower.errors);
        };
        if let Some(default) = &item.modifiers.defaultness {
            check.refuse(default.span(), "`default`", "leave it out");
        }
        let of_all = check.errors();
        for inner in &mut item.items {
            let mut check = Check::new(file);
            check.generics(&mut item.generics);
            let name = match inner {
                syn::ImplItem::Fn(f) => {
                    if !check.keeps(&mut f.attrs) {
                        continue;
                    }
                    check.function(&mut f.sig, &mut f.block);
                    self.function(file, &f.sig, &f.block, &f.attrs, Some(&of));
                    &f.sig.ident
                }
                syn::ImplItem::Const(c) => {
                    if !check.keeps(&mut c.attrs) {
                        continue;
                    }
                    check.constant_name(&c.ident);
                    check.constant(&mut c.generics, &mut c.ty, &mut c.expr);
                    let mut lower = Lower::new(file, Some(of.clone()));
                    let name = format!("{of}::{}", c.ident);
                    let value = lower.expr(&c.expr);
                    let ty = lower.ty(&c.ty);
                    if self.library.consts.contains_key(&name) {
                        self.duplicate(&lower, c.ident.span(), &name);
                    }
                    self.blame(&name, lower.errors);
                    self.library
                        .consts
                        .insert(name.clone(), super::tree::Const { name, value, ty });
                    &c.ident
                }
                syn::ImplItem::Type(t) => {
                    if !check.keeps(&mut t.attrs) {
                        continue;
                    }
                    check.refuse(t.span(), "a type in an `impl`", "write the type out");
                    &t.ident
                }
                other => {
                    self.hidden(other.to_token_stream(), check);
                    continue;
                }
            };
            let name = qualified(Some(&of), name);
            let mut text = item.self_ty.to_token_stream();
            text.extend(inner.to_token_stream());
            self.blame(&name, of_all.clone());
            self.note(&name, text, check);
        }
    }

    fn options(&mut self, file: u32, mac: &syn::Macro) {
        let mut lower = Lower::new(file, None);
        match mac.parse_body::<OptionsSyntax>() {
            Ok(mut syntax) => {
                let name = syntax.name.to_string();
                let mut check = Check::new(file);
                check.keeps(&mut syntax.attrs);
                self.type_name(&mut check, &syntax.name);
                syntax.fields.retain_mut(|field| {
                    let kept = check.keeps(&mut field.attrs);
                    if kept {
                        check.ty(&mut field.ty);
                        field.range.iter_mut().for_each(|range| check.expr(range));
                        check.expr(&mut field.default);
                    }
                    kept
                });
                let twice = |k: &usize| syntax.fields[..*k].iter().any(|f| f.name == syntax.fields[*k].name);
                if let Some(k) = (0..syntax.fields.len()).find(twice) {
                    check.twice(&syntax.fields[k].name);
                }
                check.raw_names(mac.tokens.clone());
                self.mentions.add(&name, mac.tokens.clone());
                self.duplicates.extend(check.errors());
                let fields = syntax.fields.iter().map(|field| {
                    let (default, uniform) = at_run_time(lower.expr(&field.default));
                    OptionField {
                        name: field.name.to_string(),
                        docs: docs(&field.attrs),
                        ty: lower.ty(&field.ty),
                        range: field.range.as_ref().map(|r| lower.expr(r)),
                        default,
                        uniform,
                        span: lower.span(field.name.span()),
                    }
                });
                let fields: Vec<OptionField> = fields.collect();
                let plain = fields.iter().map(|f| (f.name.clone(), f.ty.clone(), f.span)).collect();
                self.library.structs.insert(name.clone(), Struct { fields: plain });
                self.library.options.insert(name, fields);
            }
            Err(error) => {
                let span = lower.span(error.span());
                lower.errors.push(
                    Diagnostic::at(span, format!("not a list of options: {error}"))
                        .help("write `pub name: type = default,`, with the range of a number as `pub name: f32 [0.0..=1.0] = 0.5,`"),
                );
            }
        }
        self.duplicates.extend(lower.errors);
    }

    fn duplicate(&mut self, lower: &Lower, span: Span, name: &str) {
        self.duplicates.push(
            Diagnostic::at(
                lower.span(span),
                format!("`{name}` is defined twice among the kernel's files"),
            )
            .label("second definition")
            .help("modules are not told apart: give it another name"),
        );
    }

    /// What `entry` needs, or the errors in it.
    pub fn lower(mut self, entry: &str) -> Result<Parsed, Vec<Diagnostic>> {
        // A method of a type itself goes before one of a trait.
        for (name, errors) in std::mem::take(&mut self.of_traits) {
            if !self.library.functions.contains_key(&name) {
                self.blame(&name, errors);
            }
        }
        for import in std::mem::take(&mut self.imports) {
            if let Some((name, error)) = import.refused(&self.library) {
                self.blame(&name, vec![error]);
            }
        }
        let reached = self.mentions.reach(self.errors.keys(), entry);
        let mut errors = self.duplicates;
        for name in &reached {
            errors.extend(self.errors.get(name).into_iter().flatten().cloned());
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        self.library
            .functions
            .retain(|name, function| function.span.file != super::std::FILE || reached.contains(name));
        Ok(Parsed {
            library: self.library,
            reached,
        })
    }
}

/// The type of `self`, `&self`, `&mut self` or `self: T`.
fn receiver_type(lower: &mut Lower, receiver: &syn::Receiver, of: &str) -> Type {
    let own = Type::Name(of.to_owned(), Vec::new());
    match &receiver.kind {
        syn::ReceiverKind::Value => own,
        syn::ReceiverKind::Reference(_, _, mutability) => Type::Ref(mutability.is_some(), Box::new(own)),
        syn::ReceiverKind::Typed(_, ty) => lower.ty(ty),
        _ => {
            lower.unsupported(receiver.span(), "this receiver", "take `self`, `&self` or `&mut self`");
            own
        }
    }
}

fn qualified(of: Option<&str>, name: &syn::Ident) -> String {
    match of {
        Some(ty) => format!("{ty}::{name}"),
        None => name.to_string(),
    }
}

/// Documentation comments as one text.
fn docs(attrs: &[syn::Attribute]) -> String {
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
