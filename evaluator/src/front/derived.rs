//! Implementations that `#[derive(..)]` writes.

use proc_macro2::TokenStream;

/// The implementation that `#[derive(Default)]` writes for a structure, or for an enum with a marked variant; `None` for other items.
pub fn derived_default(item: &syn::Item) -> Option<syn::ItemImpl> {
    let (name, generics, value) = match item {
        syn::Item::Struct(s) => {
            let name = &s.ident;
            let fields = s.fields.iter().enumerate().map(|(k, field)| {
                let member = match &field.ident {
                    Some(name) => syn::Member::Named(name.clone()),
                    None => syn::Member::Unnamed(syn::Index::from(k)),
                };
                let value = default_of_type(&field.ty);
                quote::quote!(#member: #value)
            });
            (name, &s.generics, quote::quote!(#name { #(#fields),* }))
        }
        syn::Item::Enum(e) => {
            let name = &e.ident;
            let marked = |v: &&syn::Variant| v.attrs.iter().any(|attr| attr.path().is_ident("default"));
            let variant = &e.variants.iter().find(marked)?.ident;
            (name, &e.generics, quote::quote!(#name::#variant))
        }
        _ => return None,
    };
    let mut generics = generics.clone();
    for parameter in generics.type_params_mut() {
        parameter.bounds.push(syn::parse_quote!(Default));
    }
    let (before, after, condition) = generics.split_for_impl();
    syn::parse2(quote::quote!(impl #before Default for #name #after #condition { fn default() -> Self { #value } }))
        .ok()
}

/// The default of a type, as an expression.
fn default_of_type(ty: &syn::Type) -> TokenStream {
    match ty {
        syn::Type::Tuple(t) => {
            let parts = t.elems.iter().map(default_of_type);
            quote::quote!((#(#parts,)*))
        }
        syn::Type::Array(t) => {
            let (element, len) = (default_of_type(&t.elem), &t.len);
            quote::quote!([#element; #len])
        }
        syn::Type::Path(t) => {
            let mut path = t.path.clone();
            if let Some(last) = path.segments.last_mut() {
                last.arguments = syn::PathArguments::None;
            }
            quote::quote!(#path::default())
        }
        _ => quote::quote!(Default::default()),
    }
}
