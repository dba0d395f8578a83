//! Every node of syn's tree is looked at before it is lowered, so that nothing is dropped in silence: attributes are
//! evaluated, and what the lowering would pass over is refused. Expressions, patterns and types that have no meaning in a
//! kernel are refused by the lowering itself.
//!
//! Matches name the variants that syn has. Those that it may get are refused, here or by the lowering.

mod expr;
mod parts;

use super::cfg::Carrier;
use super::expr::Lower;
use crate::diagnostic::{Code, Diagnostic, Span};
use std::rc::Rc;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;

/// Looks through one item, gathering errors.
pub struct Check {
    lower: Lower,
    depth: u32,
}

impl Check {
    /// For an item of `file`.
    pub fn new(file: u32) -> Self {
        Check {
            lower: Lower::new(file, None, Rc::default()),
            depth: 0,
        }
    }

    /// Another one, for another item of the same file.
    pub fn for_same_file(&self) -> Self {
        Check::new(self.lower.file())
    }

    /// This one, leaving a fresh one.
    pub fn take_current(&mut self) -> Self {
        let fresh = self.for_same_file();
        std::mem::replace(self, fresh)
    }

    /// The place of a token.
    pub fn token_span(&self, span: proc_macro2::Span) -> Span {
        self.lower.token_span(span)
    }

    /// Errors found so far.
    pub fn into_errors(self) -> Vec<Diagnostic> {
        self.lower.errors
    }

    /// Notes that something is not part of the kernel language, and what to write instead.
    pub fn refuse(&mut self, span: proc_macro2::Span, what: &str, instead: &str) {
        self.lower.note_unsupported(span, what, instead);
    }

    /// Returns whether `cfg` keeps text with these attributes.
    pub fn keeps(&mut self, attrs: &mut Vec<syn::Attribute>) -> bool {
        self.lower.keeps_by_cfg(attrs, Carrier::Other)
    }

    /// Returns whether `cfg` keeps a function with these attributes.
    pub fn keeps_function(&mut self, attrs: &mut Vec<syn::Attribute>) -> bool {
        self.lower.keeps_by_cfg(attrs, Carrier::Function)
    }

    /// Notes a second definition of a name.
    pub fn note_duplicate(&mut self, name: &syn::Ident) {
        let span = self.lower.token_span(name.span());
        self.lower.errors.push(
            Diagnostic::error_at(
                Code::DefinedTwice,
                span,
                format!("`{name}` is defined twice among the kernel's files"),
            )
            .label("second definition")
            .help("modules and functions are not told apart: give it another name"),
        );
    }

    /// A function or method: its signature, then its body.
    pub fn check_function(&mut self, sig: &mut syn::Signature, body: &mut syn::Block) {
        let to_plain = "write `fn` alone: a kernel's functions are evaluated when the shader is made";
        if let Some(token) = &sig.asyncness {
            self.refuse(token.span(), "an `async` function", to_plain);
        }
        match &sig.safety {
            syn::Safety::Unsafe(token) => self.refuse(token.span(), "an `unsafe` function", to_plain),
            syn::Safety::Safe(token) => self.refuse(token.span(), "a `safe` function of an `extern` block", to_plain),
            syn::Safety::Default => {}
        }
        if let Some(abi) = &sig.abi {
            self.refuse(abi.span(), "an `extern` function", to_plain);
        }
        if let Some(variadic) = &sig.variadic {
            self.refuse(variadic.span(), "a variadic function", "take an array");
        }
        self.check_generics(&mut sig.generics);
        let mut inputs = Punctuated::new();
        for mut input in std::mem::take(&mut sig.inputs) {
            let attrs = match &mut input {
                syn::FnArg::Receiver(receiver) => &mut receiver.attrs,
                syn::FnArg::Typed(typed) => &mut typed.attrs,
            };
            if !self.keeps(attrs) {
                continue;
            }
            match &mut input {
                syn::FnArg::Receiver(receiver) => self.check_receiver(receiver),
                syn::FnArg::Typed(typed) => {
                    self.check_pattern(&mut typed.pat);
                    self.check_type(&mut typed.ty);
                }
            }
            inputs.push(input);
        }
        sig.inputs = inputs;
        match &mut sig.output {
            syn::ReturnType::Default => {}
            syn::ReturnType::Type(_, ty) => self.check_type(ty),
        }
        self.check_block(body);
    }

    fn check_receiver(&mut self, receiver: &mut syn::Receiver) {
        match &mut receiver.kind {
            syn::ReceiverKind::Value | syn::ReceiverKind::Reference(..) => {}
            syn::ReceiverKind::Typed(_, ty) => {
                self.refuse(
                    ty.span(),
                    "a type for `self`",
                    "write `self`, `&self` or `&mut self` without a type",
                );
            }
            _ => self.refuse(receiver.span(), "this `self`", "write `self`, `&self` or `&mut self`"),
        }
    }

    /// Generic parameters and the bounds on them, which rustc checks.
    pub fn check_generics(&mut self, generics: &mut syn::Generics) {
        let mut params = Punctuated::new();
        for mut param in std::mem::take(&mut generics.params) {
            let attrs = match &mut param {
                syn::GenericParam::Lifetime(p) => &mut p.attrs,
                syn::GenericParam::Type(p) => &mut p.attrs,
                syn::GenericParam::Const(p) => &mut p.attrs,
            };
            if !self.keeps(attrs) {
                continue;
            }
            params.push(param);
        }
        generics.params = params;
    }

    /// A constant's type and value.
    pub fn check_constant(&mut self, generics: &mut syn::Generics, ty: &mut syn::Type, value: &mut syn::Expr) {
        if let Some(param) = generics.params.first() {
            self.refuse(
                param.span(),
                "a generic constant",
                "write a `const fn`, or a constant for each type",
            );
        }
        self.check_type(ty);
        self.check_expr(value);
    }

    /// A structure's fields.
    pub fn check_struct(&mut self, item: &mut syn::ItemStruct) {
        self.check_generics(&mut item.generics);
        match &mut item.fields {
            syn::Fields::Named(fields) => self.check_fields(&mut fields.named),
            syn::Fields::Unnamed(fields) => self.check_fields(&mut fields.unnamed),
            syn::Fields::Unit => {}
        }
        if let Some(field) = item.fields.iter().find(|f| f.default.is_some()) {
            self.refuse(
                field.span(),
                "a default of a field",
                "give the field a value wherever the structure is made",
            );
        }
    }

    fn check_fields(&mut self, fields: &mut Punctuated<syn::Field, syn::Token![,]>) {
        let mut kept = Punctuated::new();
        for mut field in std::mem::take(fields) {
            if self.keeps(&mut field.attrs) {
                self.check_type(&mut field.ty);
                kept.push(field);
            }
        }
        *fields = kept;
    }

    /// An enum's variants and what they hold.
    pub fn check_enum(&mut self, item: &mut syn::ItemEnum) {
        self.check_generics(&mut item.generics);
        let mut kept = Punctuated::new();
        for mut variant in std::mem::take(&mut item.variants) {
            if !self.keeps(&mut variant.attrs) {
                continue;
            }
            match &mut variant.fields {
                syn::Fields::Named(fields) => self.check_fields(&mut fields.named),
                syn::Fields::Unnamed(fields) => self.check_fields(&mut fields.unnamed),
                syn::Fields::Unit => {}
            }
            if let Some((_, value)) = &mut variant.discriminant {
                self.check_expr(value);
            }
            if variant.ident.to_string().starts_with(|c: char| !c.is_uppercase()) {
                self.refuse(
                    variant.ident.span(),
                    "a variant in lower case",
                    "begin its name with a capital: in a pattern, a name in lower case is a new variable",
                );
            }
            kept.push(variant);
        }
        item.variants = kept;
    }
}
