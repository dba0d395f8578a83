//! Patterns and types.

use super::expr::Lower;
use super::tree::{Pattern, Type};
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
            syn::Pat::Ident(p) if p.by_ref.is_none() => {
                let inner = match &p.subpat {
                    Some((_, inner)) => self.pattern(inner),
                    None => Pattern::Wild,
                };
                let (name, span) = (p.ident.to_string(), self.span(p.ident.span()));
                Pattern::At(name, p.mutability.is_some(), Box::new(inner), span)
            }
            syn::Pat::Wild(_) => Pattern::Wild,
            syn::Pat::Tuple(p) => {
                Pattern::Tuple(p.elems.iter().map(|e| self.pattern(e)).collect(), self.span(p.span()))
            }
            syn::Pat::Slice(p) => {
                Pattern::Array(p.elems.iter().map(|e| self.pattern(e)).collect(), self.span(p.span()))
            }
            syn::Pat::Paren(p) => self.pattern(&p.pat),
            syn::Pat::Reference(p) => Pattern::Ref(Box::new(self.pattern(&p.pat)), self.span(p.span())),
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
                    fields.push((super::expr::member(&field.member), self.pattern(&field.pat)));
                }
                Pattern::Struct(self.segments(&p.path), fields, self.span(p.span()))
            }
            // Fields of a structure without names are named by their numbers.
            syn::Pat::TupleStruct(p) if p.qself.is_none() => {
                let fields = p
                    .elems
                    .iter()
                    .enumerate()
                    .map(|(k, e)| (k.to_string(), self.pattern(e)));
                let fields = fields.collect();
                Pattern::Struct(self.segments(&p.path), fields, self.span(p.span()))
            }
            syn::Pat::Range(p) => {
                let inclusive = matches!(p.limits, syn::RangeLimits::Closed(_));
                let mut end = |end: &Option<Box<syn::Expr>>| end.as_ref().map(|e| Box::new(self.expr(e)));
                let (low, high) = (end(&p.start), end(&p.end));
                Pattern::Range(low, high, inclusive)
            }
            other => {
                let (what, instead) = match other {
                    syn::Pat::Ident(p) if p.by_ref.is_some() => ("`ref`", "leave it out: values are copied"),
                    syn::Pat::Rest(_) => ("`..` in a tuple or array", "write `_` for each part that is not used"),
                    syn::Pat::Const(_) => ("a `const` block in a pattern", "give the constant a name"),
                    syn::Pat::Macro(_) => ("a macro in a pattern", "write the pattern out"),
                    syn::Pat::Type(_) => ("a type inside of a pattern", "state the type of the whole pattern"),
                    _ => (
                        "this pattern",
                        "match on enum variants, numbers, `0..=3`, `a | b` or `_`, and bind names, tuples and fields",
                    ),
                };
                self.unsupported(other.span(), what, instead);
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
            syn::Type::Path(t)
                if t.path
                    .get_ident()
                    .is_some_and(|name| self.functions.contains_key(&name.to_string())) =>
            {
                let name = t.path.segments[0].ident.to_string();
                self.functions[&name].clone()
            }
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
            syn::Type::ImplTrait(t) if is_called(&t.bounds) => {
                self.called(&t.bounds).unwrap_or(Type::Tuple(Vec::new()))
            }
            syn::Type::TraitObject(t) if is_called(&t.bounds) => {
                self.called(&t.bounds).unwrap_or(Type::Tuple(Vec::new()))
            }
            other => {
                let text = super::cfg::as_written(other);
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

/// Whether one of some bounds is of what is called.
fn is_called<'b>(bounds: impl IntoIterator<Item = &'b syn::TypeParamBound>) -> bool {
    bounds.into_iter().any(|bound| match bound {
        syn::TypeParamBound::Trait(bound) => bound.path.segments.last().is_some_and(|last| {
            matches!(last.arguments, syn::PathArguments::Parenthesized(_))
                && matches!(last.ident.to_string().as_str(), "Fn" | "FnMut" | "FnOnce")
        }),
        _ => false,
    })
}
