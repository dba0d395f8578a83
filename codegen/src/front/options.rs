//! The syntax of `options!`.

use super::tree::{Expr, ExprKind};
use syn::parse::{Parse, ParseStream};

/// What stands in `options!`.
pub struct OptionsSyntax {
    pub attrs: Vec<syn::Attribute>,
    pub name: syn::Ident,
    pub fields: Vec<OptionSyntax>,
}

/// One line of it.
pub struct OptionSyntax {
    pub attrs: Vec<syn::Attribute>,
    pub name: syn::Ident,
    pub ty: syn::Type,
    pub range: Option<syn::Expr>,
    pub default: syn::Expr,
}

impl Parse for OptionsSyntax {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let attrs = input.call(syn::Attribute::parse_outer)?;
        input.parse::<syn::Visibility>()?;
        input.parse::<syn::Token![struct]>()?;
        let name = input.parse()?;
        let body;
        syn::braced!(body in input);
        let fields = body.parse_terminated(OptionSyntax::parse, syn::Token![,])?;
        Ok(OptionsSyntax {
            attrs,
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
pub fn at_run_time(default: Expr) -> (Expr, bool) {
    match default.kind {
        ExprKind::Call(path, constants, mut arguments)
            if constants.is_empty() && arguments.len() == 1 && path.last().is_some_and(|name| name == "uniform") =>
        {
            (arguments.remove(0), true)
        }
        kind => (Expr { kind, ..default }, false),
    }
}
