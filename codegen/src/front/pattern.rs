//! Patterns and types.

use super::expr::Lower;
use super::tree::{Pattern, Type};
use quote::ToTokens;
use syn::spanned::Spanned;

impl Lower {
    /// A pattern of a `let`, `for` or `match`.
    pub fn pattern(&mut self, pattern: &syn::Pat) -> Pattern {
        match pattern {
            syn::Pat::Ident(p) if p.subpat.is_none() && p.by_ref.is_none() => {
                let name = p.ident.to_string();
                // A name in capitals is a constant, as everywhere in Rust.
                if name.chars().next().is_some_and(char::is_uppercase) {
                    Pattern::Value(Box::new(self.path_expr(vec![name], p.span())))
                } else {
                    Pattern::Name(name, p.mutability.is_some(), self.span(p.ident.span()))
                }
            }
            syn::Pat::Wild(_) => Pattern::Wild,
            syn::Pat::Tuple(p) => {
                Pattern::Tuple(p.elems.iter().map(|e| self.pattern(e)).collect(), self.span(p.span()))
            }
            syn::Pat::Slice(p) => {
                Pattern::Array(p.elems.iter().map(|e| self.pattern(e)).collect(), self.span(p.span()))
            }
            syn::Pat::Paren(p) => self.pattern(&p.pat),
            syn::Pat::Reference(p) => self.pattern(&p.pat),
            syn::Pat::Or(p) => Pattern::Or(p.cases.iter().map(|c| self.pattern(c)).collect()),
            syn::Pat::Path(p) => {
                let segments = self.segments(&p.path);
                Pattern::Value(Box::new(self.path_expr(segments, p.span())))
            }
            syn::Pat::Lit(p) => {
                let expr = self.literal(&p.lit, p.span());
                Pattern::Value(Box::new(expr))
            }
            syn::Pat::Struct(p) => {
                let mut fields = Vec::new();
                for field in &p.fields {
                    if let syn::Member::Named(name) = &field.member {
                        fields.push((name.to_string(), self.pattern(&field.pat)));
                    }
                }
                Pattern::Struct(fields, self.span(p.span()))
            }
            syn::Pat::Range(p) => match (&p.start, &p.end) {
                (Some(low), Some(high)) if matches!(p.limits, syn::RangeLimits::Closed(_)) => {
                    Pattern::Range(Box::new(self.expr(low)), Box::new(self.expr(high)))
                }
                _ => {
                    self.unsupported(p.span(), "a range without both ends", "write both: `0..=3`");
                    Pattern::Wild
                }
            },
            other => {
                self.unsupported(
                    other.span(),
                    "this pattern",
                    "match on enum variants, integers, `0..=3`, `a | b` or `_`, and bind names, tuples and fields",
                );
                Pattern::Wild
            }
        }
    }

    /// A type; lifetimes and parentheses are dropped.
    pub fn ty(&mut self, ty: &syn::Type) -> Type {
        match ty {
            syn::Type::Reference(t) => Type::Ref(t.mutability.is_some(), Box::new(self.ty(&t.elem))),
            syn::Type::Paren(t) => self.ty(&t.elem),
            syn::Type::Group(t) => self.ty(&t.elem),
            syn::Type::Array(t) => Type::Array(Box::new(self.ty(&t.elem)), Some(Box::new(self.expr(&t.len)))),
            syn::Type::Slice(t) => Type::Array(Box::new(self.ty(&t.elem)), None),
            syn::Type::Tuple(t) => Type::Tuple(t.elems.iter().map(|e| self.ty(e)).collect()),
            syn::Type::Path(t) if t.qself.is_none() => {
                let last = t.path.segments.last().expect("a path has a segment");
                let mut args = Vec::new();
                if let syn::PathArguments::AngleBracketed(list) = &last.arguments {
                    for arg in &list.args {
                        if let syn::GenericArgument::Type(t) = arg {
                            args.push(self.ty(t));
                        }
                    }
                }
                Type::Name(self.self_name(last.ident.to_string()), args)
            }
            other => {
                let text = other.to_token_stream().to_string();
                self.unsupported(
                    other.span(),
                    &format!("the type `{text}`"),
                    "use numbers, vectors, arrays, tuples, structures, enums and the prelude's textures",
                );
                Type::Tuple(Vec::new())
            }
        }
    }
}
