//! `options!`: its syntax, and what becomes of it.

use super::check::Check;
use super::items::{Items, doc_text};
use super::tree::{Expr, ExprKind, OptionField, Struct};
use crate::diagnostic::{Code, Diagnostic};
use std::collections::HashMap;
use syn::parse::{Parse, ParseStream};

/// Contents of `options!`.
pub struct OptionsSyntax {
    pub attrs: Vec<syn::Attribute>,
    pub name: syn::Ident,
    pub fields: Vec<OptionSyntax>,
}

/// A line of `options!`.
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

impl Items {
    /// Notes the options of a kernel.
    pub(super) fn add_options(&mut self, file: u32, mac: &syn::Macro) {
        let mut lower = self.lower_of(file);
        match mac.parse_body::<OptionsSyntax>() {
            Ok(mut syntax) => {
                let name = syntax.name.to_string();
                let mut check = Check::new(file);
                check.keeps(&mut syntax.attrs);
                self.type_name(&mut check, &syntax.name);
                syntax.fields.retain_mut(|field| {
                    let kept = check.keeps(&mut field.attrs);
                    if kept {
                        check.check_type(&mut field.ty);
                        field.range.iter_mut().for_each(|range| check.check_expr(range));
                        check.check_expr(&mut field.default);
                    }
                    kept
                });
                let twice = |k: &usize| syntax.fields[..*k].iter().any(|f| f.name == syntax.fields[*k].name);
                if let Some(k) = (0..syntax.fields.len()).find(twice) {
                    check.note_duplicate(&syntax.fields[k].name);
                }
                self.mentions.add(&name, mac.tokens.clone());
                self.duplicates.extend(check.into_errors());
                let fields = syntax.fields.iter().map(|field| {
                    let (default, uniform) = at_run_time(lower.lower_expr(&field.default));
                    OptionField {
                        name: field.name.to_string(),
                        docs: doc_text(&field.attrs),
                        ty: lower.lower_type(&field.ty),
                        range: field.range.as_ref().map(|r| lower.lower_expr(r)),
                        default,
                        uniform,
                        span: lower.token_span(field.name.span()),
                    }
                });
                let fields: Vec<OptionField> = fields.collect();
                let plain = fields
                    .iter()
                    .map(|f| ((&f.name).into(), f.ty.clone(), f.span))
                    .collect();
                let plain = Struct {
                    generics: Vec::new(),
                    functions: HashMap::new(),
                    fields: plain,
                    derives: Vec::new(),
                };
                self.library.structs.insert(name.clone(), plain);
                self.library.options.insert(name, fields);
            }
            Err(error) => {
                let span = lower.token_span(error.span());
                lower.errors.push(
                    Diagnostic::error_at(Code::OptionsSyntax, span, format!("not a list of options: {error}"))
                        .help("write `pub name: type = default,`, with the range of a number as `pub name: f32 [0.0..=1.0] = 0.5,`"),
                );
            }
        }
        self.duplicates.extend(lower.errors);
    }
}
