//! Signatures of chains: pictures as results, and kinds of parameters.

use crate::front::foreign::is_resource;
use crate::front::textures::TextureType;
use proc_macro2::TokenStream;
use quote::ToTokens;

/// Type of a picture: `Frame<T>` or `Texture<T>`.
#[derive(Clone)]
pub struct PictureType {
    /// `true` of a frame, which has the size of every picture that is drawn from it.
    pub is_frame: bool,
    /// Type as it is written.
    pub ty: syn::Type,
    /// Type of a texel.
    pub texel: TokenStream,
}

/// Kind of a parameter of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParamKind {
    /// A texture of one layer, which has a size.
    Image,
    /// Another texture, a sampler or a buffer.
    Resource,
    /// A value that is set at run time.
    Uniform,
    /// The options.
    Options,
}

/// Returns the picture that a type is; `None` of another type.
pub fn picture_type(ty: &syn::Type) -> Option<PictureType> {
    let ty = match ty {
        syn::Type::Paren(inner) => &inner.elem,
        syn::Type::Reference(inner) if inner.mutability.is_none() => &inner.elem,
        other => other,
    };
    let syn::Type::Path(path) = ty else {
        return None;
    };
    let last = path.path.segments.last()?;
    let is_frame = last.ident == "Frame";
    if !is_frame && last.ident != "Texture" {
        return None;
    }
    let syn::PathArguments::AngleBracketed(arguments) = &last.arguments else {
        return None;
    };
    let syn::GenericArgument::Type(texel) = arguments.args.first()? else {
        return None;
    };
    Some(PictureType {
        is_frame,
        ty: ty.clone(),
        texel: texel.to_token_stream(),
    })
}

/// Type of the elements of a list: of `Vec<T>`, `[T; N]` or `&[T]`.
pub fn element_type(ty: &syn::Type) -> Option<syn::Type> {
    match ty {
        syn::Type::Array(array) => Some((*array.elem).clone()),
        syn::Type::Slice(slice) => Some((*slice.elem).clone()),
        syn::Type::Reference(inner) => element_type(&inner.elem),
        syn::Type::Path(path) => {
            let last = path.path.segments.last().filter(|last| last.ident == "Vec")?;
            let syn::PathArguments::AngleBracketed(arguments) = &last.arguments else {
                return None;
            };
            match arguments.args.first()? {
                syn::GenericArgument::Type(ty) => Some(ty.clone()),
                _ => None,
            }
        }
        _ => None,
    }
}

/// Returns whether a function returns pictures that it owns: one, a list of them, or a tuple of these.
pub fn returns_pictures(signature: &syn::Signature) -> bool {
    let is_value = |ty: &syn::Type| !matches!(ty, syn::Type::Reference(_));
    let is_picture = |ty: &syn::Type| is_value(ty) && picture_type(ty).is_some();
    let owned = |ty: &syn::Type| {
        is_picture(ty) || (is_value(ty) && element_type(ty).is_some_and(|element| is_picture(&element)))
    };
    match &signature.output {
        syn::ReturnType::Type(_, ty) => match &**ty {
            syn::Type::Tuple(tuple) => !tuple.elems.is_empty() && tuple.elems.iter().all(owned),
            ty => owned(ty),
        },
        syn::ReturnType::Default => false,
    }
}

/// Name and type of a parameter; `None` of `self` and of patterns.
pub fn param_name(input: &syn::FnArg) -> Option<(&syn::Ident, &syn::Type)> {
    let syn::FnArg::Typed(typed) = input else {
        return None;
    };
    match &*typed.pat {
        syn::Pat::Ident(name) => Some((&name.ident, &typed.ty)),
        _ => None,
    }
}

/// Kind of a parameter by its type. A structure is the options.
pub fn param_kind(ty: &syn::Type) -> ParamKind {
    let inner = match ty {
        syn::Type::Reference(reference) => &reference.elem,
        other => other,
    };
    let syn::Type::Path(path) = inner else {
        return ParamKind::Uniform;
    };
    let Some(name) = path.path.segments.last().map(|segment| segment.ident.to_string()) else {
        return ParamKind::Uniform;
    };
    match name.as_str() {
        "Frame" | "Texture" | "DepthTexture" => ParamKind::Image,
        name if TextureType::from_name(name).is_some() || is_resource(name) => ParamKind::Resource,
        _ if matches!(ty, syn::Type::Reference(_)) => ParamKind::Options,
        _ => ParamKind::Uniform,
    }
}
