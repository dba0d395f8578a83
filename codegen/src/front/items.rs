//! Items of a kernel's files.

use super::expr::Lower;
use super::reach::reach;
use super::tree::{Enum, Expr, ExprKind, Function, Generic, Library, OptionField, Param, Struct, Type};
use crate::diagnostic::Diagnostic;
use proc_macro2::Span;
use std::collections::HashMap;
use syn::parse::{Parse, ParseStream};
use syn::spanned::Spanned;

/// Items lowered so far, and the errors of each by its name.
#[derive(Default)]
pub struct Items {
    library: Library,
    errors: HashMap<String, Vec<Diagnostic>>,
    duplicates: Vec<Diagnostic>,
}

impl Items {
    /// Takes the items of one file. Tests and native-only items are passed over.
    pub fn collect(&mut self, file: u32, items: &[syn::Item]) {
        for item in items {
            match item {
                syn::Item::Fn(f) if !native_only(&f.attrs) => self.function(file, &f.sig, &f.block, &f.attrs, None),
                syn::Item::Const(c) if !native_only(&c.attrs) => self.constant(file, c, None),
                syn::Item::Struct(s) if !native_only(&s.attrs) => self.structure(file, s),
                syn::Item::Enum(e) if !native_only(&e.attrs) => {
                    let variants = e
                        .variants
                        .iter()
                        .map(|v| (v.ident.to_string(), docs(&v.attrs)))
                        .collect();
                    self.library.enums.insert(e.ident.to_string(), Enum { variants });
                }
                syn::Item::Impl(i) if !native_only(&i.attrs) && i.trait_.is_none() => self.implementation(file, i),
                syn::Item::Mod(m) if !native_only(&m.attrs) => {
                    if let Some((_, inner)) = &m.content {
                        self.collect(file, inner);
                    }
                }
                syn::Item::Macro(m) if m.mac.path.segments.last().is_some_and(|s| s.ident == "options") => {
                    self.options(file, &m.mac);
                }
                _ => {}
            }
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
        let mut params = Vec::new();
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
                        other => lower.unsupported(other.span(), "a pattern as parameter", "give the parameter a name"),
                    }
                }
            }
        }
        let result = match &sig.output {
            syn::ReturnType::Default => Type::Tuple(Vec::new()),
            syn::ReturnType::Type(_, ty) => lower.ty(ty),
        };
        let body = lower.block(body);
        let span = lower.span(sig.ident.span());
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
        self.errors.insert(name, lower.errors);
    }

    fn constant(&mut self, file: u32, item: &syn::ItemConst, of: Option<&str>) {
        let mut lower = Lower::new(file, of.map(str::to_owned));
        let constant = lower.constant(item, of);
        if self.library.consts.contains_key(&constant.name) {
            self.duplicate(&lower, item.ident.span(), &constant.name);
        }
        self.errors.insert(constant.name.clone(), lower.errors);
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
    }

    fn implementation(&mut self, file: u32, item: &syn::ItemImpl) {
        let mut lower = Lower::new(file, None);
        let Type::Name(of, _) = lower.ty(&item.self_ty) else {
            return;
        };
        for inner in &item.items {
            match inner {
                syn::ImplItem::Fn(f) if !native_only(&f.attrs) => {
                    self.function(file, &f.sig, &f.block, &f.attrs, Some(&of));
                }
                syn::ImplItem::Const(c) if !native_only(&c.attrs) => {
                    let mut lower = Lower::new(file, Some(of.clone()));
                    let name = format!("{of}::{}", c.ident);
                    let value = lower.expr(&c.expr);
                    let ty = lower.ty(&c.ty);
                    self.errors.insert(name.clone(), lower.errors);
                    self.library
                        .consts
                        .insert(name.clone(), super::tree::Const { name, value, ty });
                }
                _ => {}
            }
        }
    }

    fn options(&mut self, file: u32, mac: &syn::Macro) {
        let mut lower = Lower::new(file, None);
        match mac.parse_body::<OptionsSyntax>() {
            Ok(syntax) => {
                let name = syntax.name.to_string();
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
    pub fn lower(self, entry: &str) -> Result<Library, Vec<Diagnostic>> {
        let reached = reach(&self.library.functions, &self.library.consts, entry);
        let mut errors = self.duplicates;
        for name in &reached {
            errors.extend(self.errors.get(name).into_iter().flatten().cloned());
        }
        if !errors.is_empty() {
            return Err(errors);
        }
        let mut library = self.library;
        crate::infer::infer(&mut library, &reached)?;
        Ok(library)
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

/// `#[cfg(test)]` and `#[test]`.
fn native_only(attrs: &[syn::Attribute]) -> bool {
    attrs.iter().any(|attr| {
        attr.path().is_ident("test")
            || attr.path().is_ident("cfg") && attr.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"))
    })
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

struct OptionsSyntax {
    name: syn::Ident,
    fields: Vec<OptionSyntax>,
}

struct OptionSyntax {
    attrs: Vec<syn::Attribute>,
    name: syn::Ident,
    ty: syn::Type,
    range: Option<syn::Expr>,
    default: syn::Expr,
}

impl Parse for OptionsSyntax {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        input.call(syn::Attribute::parse_outer)?;
        input.parse::<syn::Visibility>()?;
        input.parse::<syn::Token![struct]>()?;
        let name = input.parse()?;
        let body;
        syn::braced!(body in input);
        let fields = body.parse_terminated(OptionSyntax::parse, syn::Token![,])?;
        Ok(OptionsSyntax {
            name,
            fields: fields.into_iter().collect(),
        })
    }
}

impl Parse for OptionSyntax {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let attrs = input.call(syn::Attribute::parse_outer)?;
        input.parse::<syn::Visibility>()?;
        let name = input.parse()?;
        input.parse::<syn::Token![:]>()?;
        let ty = input.parse()?;
        let range = if input.peek(syn::token::Bracket) {
            let inner;
            syn::bracketed!(inner in input);
            Some(inner.parse()?)
        } else {
            None
        };
        input.parse::<syn::Token![=]>()?;
        Ok(OptionSyntax {
            attrs,
            name,
            ty,
            range,
            default: input.parse()?,
        })
    }
}

/// The default of an option, and whether it is `uniform(default)`: a number that is set at run time.
fn at_run_time(default: Expr) -> (Expr, bool) {
    match default.kind {
        ExprKind::Call(path, constants, mut arguments)
            if constants.is_empty() && arguments.len() == 1 && path.last().is_some_and(|name| name == "uniform") =>
        {
            (arguments.remove(0), true)
        }
        kind => (Expr { kind, ..default }, false),
    }
}
