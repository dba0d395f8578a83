//! Receivers of trait functions: `self`, `&self` or `&mut self`, the same in a trait and in its implementations.
//!
//! In the language a reference is its value, so the types of both say nothing of it; rustc refuses what differs.

use super::items::Items;
use crate::diagnostic::{Code, Diagnostic};
use std::collections::BTreeSet;
use syn::spanned::Spanned;

/// Traits of Rust whose functions take `&self`; those that assign take `&mut self`, and the others `self`.
const BY_REFERENCE: [&str; 4] = ["Index", "Ord", "PartialEq", "PartialOrd"];

/// Traits of Rust whose functions have no receiver.
const WITHOUT: [&str; 4] = ["Default", "From", "Product", "Sum"];

impl Items {
    /// Functions of an implementation whose receivers are not those of the trait. Without `declared`, the trait is one of Rust's.
    pub(super) fn unlike_receivers(
        &self,
        file: u32,
        trait_name: &str,
        declared: Option<&syn::ItemTrait>,
        items: &[syn::ImplItem],
    ) -> Vec<Diagnostic> {
        let lower = self.lower_of(file);
        let functions = items.iter().filter_map(|item| match item {
            syn::ImplItem::Fn(function) => Some(&function.sig),
            _ => None,
        });
        let unlike = functions.filter_map(|signature| {
            let wanted = match declared {
                Some(declared) => receiver_of(declared_signature(declared, &signature.ident)?)?,
                None => receiver_in_rust(trait_name)?,
            };
            let found = receiver_of(signature)?;
            (found != wanted).then_some((signature, wanted, found))
        });
        let each = unlike.map(|(signature, wanted, found)| {
            let name = &signature.ident;
            let what = format!("`{name}` is not as the trait `{trait_name}` declares it: it takes `{found}`");
            let at = signature.inputs.first().map_or(name.span(), Spanned::span);
            Diagnostic::error_at(Code::TraitImplementation, lower.token_span(at), what)
                .label(format!("expected `{wanted}`"))
                .help(format!("write `{wanted}`"))
        });
        each.collect()
    }

    /// Default functions of a trait, other than those that are `given`, that take `self` by value, though a type with the trait
    /// may have no size.
    pub(super) fn unsized_receivers(
        &self,
        file: u32,
        item: &syn::ItemTrait,
        given: &BTreeSet<String>,
    ) -> Vec<Diagnostic> {
        // Traits above it may say that types have a size, as `Copy` does.
        if !item.supertraits.is_empty() || item.generics.where_clause.is_some() {
            return Vec::new();
        }
        let lower = self.lower_of(file);
        let defaults = item.items.iter().filter_map(|inner| match inner {
            syn::TraitItem::Fn(f) if f.default.is_some() && f.sig.generics.where_clause.is_none() => Some(&f.sig),
            _ => None,
        });
        let by_value = defaults.filter(|signature| {
            receiver_of(signature) == Some("self") && !given.contains(&signature.ident.to_string())
        });
        let each = by_value.map(|signature| {
            let what = format!(
                "`{}` takes `self` by value, and `Self` may have no size",
                signature.ident
            );
            let at = signature.inputs.span();
            Diagnostic::error_at(Code::TraitBound, lower.token_span(at), what)
                .label("in a function with a body")
                .help(format!("write `&self`, or `trait {}: Copy`", item.ident))
        });
        each.collect()
    }
}

/// Signature of a function of a trait.
fn declared_signature<'t>(declared: &'t syn::ItemTrait, name: &syn::Ident) -> Option<&'t syn::Signature> {
    declared.items.iter().find_map(|item| match item {
        syn::TraitItem::Fn(function) if function.sig.ident == *name => Some(&function.sig),
        _ => None,
    })
}

/// Receiver of the functions of a trait of Rust; `None` if they have none, or several.
fn receiver_in_rust(trait_name: &str) -> Option<&'static str> {
    match trait_name {
        name if WITHOUT.contains(&name) || !super::rust_traits::is_operator(name) => None,
        name if BY_REFERENCE.contains(&name) => Some("&self"),
        name if name.ends_with("Assign") || name == "IndexMut" => Some("&mut self"),
        _ => Some("self"),
    }
}

/// Receiver of a function in its short form; `None` of another form, or of none.
fn receiver_of(signature: &syn::Signature) -> Option<&'static str> {
    let syn::FnArg::Receiver(receiver) = signature.inputs.first()? else {
        return None;
    };
    match &receiver.kind {
        syn::ReceiverKind::Value => Some("self"),
        syn::ReceiverKind::Reference(_, _, None) => Some("&self"),
        syn::ReceiverKind::Reference(_, _, Some(_)) => Some("&mut self"),
        _ => None,
    }
}
