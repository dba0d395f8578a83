//! Small questions about the syntax of a chain.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use quote::ToTokens;

use super::value::Value;
use crate::front::unraw;

/// Last segment of the path of a function that is called.
pub fn call_name(call: &syn::ExprCall) -> Option<String> {
    match &*call.func {
        syn::Expr::Path(path) => Some(path.path.segments.last()?.ident.to_string()),
        _ => None,
    }
}

/// Returns whether a call is that of a function of `Vec`.
pub fn is_new_list(call: &syn::ExprCall) -> bool {
    match &*call.func {
        syn::Expr::Path(path) => path
            .path
            .segments
            .iter()
            .rev()
            .nth(1)
            .is_some_and(|of| of.ident == "Vec"),
        _ => false,
    }
}

/// The variable that an expression names, also behind references.
pub fn variable_of(expr: &syn::Expr) -> Option<&Ident> {
    match expr {
        syn::Expr::Path(path) => path.path.get_ident(),
        syn::Expr::Reference(inner) => variable_of(&inner.expr),
        syn::Expr::Paren(inner) => variable_of(&inner.expr),
        _ => None,
    }
}

/// Returns whether an operator assigns, as `+=` does.
pub fn is_compound(op: &syn::BinOp) -> bool {
    std::mem::discriminant(&plain_operator(op)) != std::mem::discriminant(op)
}

/// The operator that a compound assignment applies.
pub fn plain_operator(op: &syn::BinOp) -> syn::BinOp {
    use syn::BinOp as B;
    match op {
        B::AddAssign(_) => B::Add(Default::default()),
        B::SubAssign(_) => B::Sub(Default::default()),
        B::MulAssign(_) => B::Mul(Default::default()),
        B::DivAssign(_) => B::Div(Default::default()),
        B::RemAssign(_) => B::Rem(Default::default()),
        B::ShlAssign(_) => B::Shl(Default::default()),
        B::ShrAssign(_) => B::Shr(Default::default()),
        B::BitAndAssign(_) => B::BitAnd(Default::default()),
        B::BitOrAssign(_) => B::BitOr(Default::default()),
        B::BitXorAssign(_) => B::BitXor(Default::default()),
        other => *other,
    }
}

/// First occurrence of a word in tokens.
pub fn find_word(tokens: TokenStream, word: &str) -> Option<Ident> {
    tokens.into_iter().find_map(|token| match token {
        TokenTree::Group(group) => find_word(group.stream(), word),
        TokenTree::Ident(ident) if ident == word => Some(ident),
        _ => None,
    })
}

/// Names in lower case that a pattern binds, in order.
pub fn bound_names(pattern: TokenStream, names: &mut Vec<String>) {
    for token in pattern {
        match token {
            TokenTree::Group(group) => bound_names(group.stream(), names),
            TokenTree::Ident(ident) if ident != "mut" && ident != "ref" && ident != "_" => {
                let name = ident.to_string();
                if name.starts_with(|c: char| c.is_lowercase() || c == '_') {
                    names.push(name);
                }
            }
            _ => {}
        }
    }
}

/// Returns whether a pattern takes a value.
pub fn arm_matches(pattern: &syn::Pat, value: &Value) -> bool {
    match pattern {
        syn::Pat::Wild(_) => true,
        syn::Pat::Or(cases) => cases.cases.iter().any(|case| arm_matches(case, value)),
        syn::Pat::Paren(inner) => arm_matches(&inner.pat, value),
        syn::Pat::Lit(literal) => match (&literal.lit, value) {
            (syn::Lit::Int(number), Value::Integer(value)) => {
                number.base10_parse::<i64>().is_ok_and(|number| number == *value)
            }
            (syn::Lit::Bool(flag), Value::Flag(value)) => flag.value == *value,
            _ => false,
        },
        syn::Pat::Path(path) => match (path.path.segments.last(), value) {
            (Some(variant), Value::Choice(choice)) => {
                straightline_kernels::kebab(&variant.ident.to_string()) == *choice
            }
            _ => false,
        },
        _ => false,
    }
}

/// An identifier, which is raw if its name is.
pub fn identifier(name: &str, at: Span) -> Ident {
    match name.strip_prefix("r#") {
        Some(raw) => Ident::new_raw(raw, at),
        None => Ident::new(name, at),
    }
}

/// Pattern of the only parameter of a closure, without its type.
pub fn closure_parameter(closure: &syn::ExprClosure) -> Option<&syn::Pat> {
    let mut inputs = closure.inputs.iter();
    match (inputs.next(), inputs.next()) {
        (Some(syn::Pat::Type(typed)), None) => Some(&typed.pat),
        (Some(pattern), None) => Some(pattern),
        _ => None,
    }
}

/// `stem`, or `stem_2`, `stem_3` and so on: the first that is not taken.
pub fn unused_name(stem: &str, taken: impl Fn(&str) -> bool) -> String {
    let numbered = (2..).map(|k: u32| format!("{stem}_{k}"));
    let mut names = std::iter::once(stem.to_owned()).chain(numbered);
    names.find(|name| !taken(name)).expect("endless")
}

/// Parameters of a kernel that are frames, by name.
pub fn frame_parameters(kernel: &syn::ItemFn) -> Vec<String> {
    let frames = kernel.sig.inputs.iter().filter_map(super::signature::param_name);
    let frames = frames.filter(|(_, ty)| super::signature::picture_type(ty).is_some_and(|picture| picture.is_frame));
    frames.map(|(name, _)| unraw(&name.to_string()).to_owned()).collect()
}

/// Format that the attribute `#[cfg_attr(false, format(rgba8unorm))]` asks for, as it is written.
pub fn format_attribute(attrs: &[syn::Attribute]) -> Option<TokenStream> {
    attrs.iter().find_map(|attr| {
        let syn::Meta::List(list) = &attr.meta else {
            return None;
        };
        let mut tokens = list
            .tokens
            .clone()
            .into_iter()
            .skip_while(|token| token.to_string() != "format");
        let (Some(_), Some(TokenTree::Group(group))) = (tokens.next(), tokens.next()) else {
            return None;
        };
        list.path
            .is_ident("cfg_attr")
            .then(|| group.stream().into_token_stream())
    })
}
