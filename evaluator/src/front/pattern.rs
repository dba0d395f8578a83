//! Patterns and types.

use super::expr::Lower;
use super::tree::{Pattern, Type};
use crate::diagnostic::{Code, Diagnostic};
use std::collections::HashMap;
use syn::spanned::Spanned;

impl Lower {
    /// A pattern of a `let`, `for` or `match`.
    pub fn lower_pattern(&mut self, pattern: &syn::Pat) -> Pattern {
        match pattern {
            syn::Pat::Ident(p) if p.subpat.is_none() && p.by_ref.is_none() => {
                let name = p.ident.to_string();
                // A name in capitals is a constant, as everywhere in Rust.
                if name.chars().next().is_some_and(char::is_uppercase) {
                    let path = self.path_segments(&syn::Path::from(p.ident.clone()));
                    Pattern::Value(Box::new(self.path_expr(path, p.span())))
                } else {
                    Pattern::Name(name.into(), p.mutability.is_some(), self.token_span(p.ident.span()))
                }
            }
            syn::Pat::Ident(p) if p.by_ref.is_none() => {
                let inner = match &p.subpat {
                    Some((_, inner)) => self.lower_pattern(inner),
                    None => Pattern::Wild,
                };
                let (name, span) = (p.ident.to_string(), self.token_span(p.ident.span()));
                Pattern::At(name.into(), p.mutability.is_some(), Box::new(inner), span)
            }
            syn::Pat::Wild(_) => Pattern::Wild,
            syn::Pat::Tuple(p) => {
                let parts = p.elems.iter().map(|e| match e {
                    syn::Pat::Rest(_) => Pattern::Rest,
                    other => self.lower_pattern(other),
                });
                let parts = parts.collect();
                self.one_rest(&p.elems);
                Pattern::Tuple(parts, self.token_span(p.span()))
            }
            syn::Pat::Slice(p) => {
                let parts = p.elems.iter().map(|e| match e {
                    syn::Pat::Rest(_) => Pattern::Rest,
                    syn::Pat::Ident(named) if is_rest(e) && named.by_ref.is_none() => {
                        let (name, span) = (named.ident.to_string(), self.token_span(named.ident.span()));
                        Pattern::At(name.into(), named.mutability.is_some(), Box::new(Pattern::Rest), span)
                    }
                    other => self.lower_pattern(other),
                });
                let parts = parts.collect();
                self.one_rest(&p.elems);
                Pattern::Array(parts, self.token_span(p.span()))
            }
            syn::Pat::Paren(p) => self.lower_pattern(&p.pat),
            syn::Pat::Reference(p) => Pattern::Ref(Box::new(self.lower_pattern(&p.pat)), self.token_span(p.span())),
            syn::Pat::Or(p) => Pattern::Or(p.cases.iter().map(|c| self.lower_pattern(c)).collect()),
            syn::Pat::Path(p) => {
                let segments = self.path_segments(&p.path);
                Pattern::Value(Box::new(self.path_expr(segments, p.span())))
            }
            syn::Pat::Lit(p) => {
                let expr = self.lower_literal(&p.lit, p.span());
                Pattern::Value(Box::new(expr))
            }
            syn::Pat::Struct(p) => {
                let mut fields = Vec::new();
                for field in &p.fields {
                    fields.push((super::expr::member_name(&field.member), self.lower_pattern(&field.pat)));
                }
                Pattern::Struct(self.path_segments(&p.path), fields, self.token_span(p.span()))
            }
            // Fields of a structure without names are named by their numbers.
            syn::Pat::TupleStruct(p) if p.qself.is_none() => {
                // Fields that `..` leaves out may be anything.
                let rest = p.elems.last().is_some_and(|last| matches!(last, syn::Pat::Rest(_)));
                let fields = p
                    .elems
                    .iter()
                    .take(p.elems.len() - usize::from(rest))
                    .enumerate()
                    .map(|(k, e)| (k.to_string().into(), self.lower_pattern(e)));
                let fields = fields.collect();
                Pattern::Struct(self.path_segments(&p.path), fields, self.token_span(p.span()))
            }
            syn::Pat::Range(p) => {
                let inclusive = matches!(p.limits, syn::RangeLimits::Closed(_));
                let mut end = |end: &Option<Box<syn::Expr>>| end.as_ref().map(|e| Box::new(self.lower_expr(e)));
                let (low, high) = (end(&p.start), end(&p.end));
                Pattern::Range(low, high, inclusive)
            }
            other => {
                let (what, instead) = match other {
                    syn::Pat::Ident(p) if p.by_ref.is_some() => ("`ref`", "leave it out: values are copied"),
                    syn::Pat::Rest(_) => (
                        "`..` here",
                        "of a structure without field names, let it stand last; of an array, `rest @ ..` may name it",
                    ),
                    syn::Pat::Const(_) => ("a `const` block in a pattern", "give the constant a name"),
                    syn::Pat::Macro(_) => ("a macro in a pattern", "write the pattern out"),
                    syn::Pat::Type(_) => ("a type inside of a pattern", "state the type of the whole pattern"),
                    _ => (
                        "this pattern",
                        "match on enum variants, numbers, `0..=3`, `a | b` or `_`, and bind names, tuples and fields",
                    ),
                };
                self.note_unsupported(other.span(), what, instead);
                Pattern::Wild
            }
        }
    }

    /// Refuses a second `..` among the parts of a tuple or an array.
    fn one_rest(&mut self, parts: &syn::punctuated::Punctuated<syn::Pat, syn::Token![,]>) {
        if let Some(second) = parts.iter().filter(|part| is_rest(part)).nth(1) {
            let span = self.token_span(second.span());
            self.errors.push(
                Diagnostic::error_at(
                    Code::Pattern,
                    span,
                    "`..` can be used once in a pattern of a tuple or an array",
                )
                .label("the second")
                .help("write `_` for each part that is not used"),
            );
        }
    }

    /// A type; lifetimes and parentheses are dropped.
    pub fn lower_type(&mut self, ty: &syn::Type) -> Type {
        match ty {
            syn::Type::Reference(t) => Type::Ref(t.mutability.is_some(), Box::new(self.lower_type(&t.elem))),
            syn::Type::Paren(t) => self.lower_type(&t.elem),
            syn::Type::Group(t) => self.lower_type(&t.elem),
            syn::Type::Array(t) => Type::Array(
                Box::new(self.lower_element(&t.elem)),
                Some(Box::new(self.lower_expr(&t.len))),
            ),
            syn::Type::Slice(t) => Type::Array(Box::new(self.lower_element(&t.elem)), None),
            syn::Type::Tuple(t) => Type::Tuple(t.elems.iter().map(|e| self.lower_type(e)).collect()),
            syn::Type::Path(t)
                if t.path
                    .get_ident()
                    .is_some_and(|name| self.functions.contains_key(&name.to_string())) =>
            {
                let name = t.path.segments[0].ident.to_string();
                self.functions[&name].clone()
            }
            syn::Type::Path(t) if self.stand_in(t).is_some() => self.stand_in(t).unwrap_or(Type::Tuple(Vec::new())),
            // Inference finds associated types of a type parameter.
            syn::Type::Path(t) if self.belongs_to_a_parameter(t) => Type::Name("_".to_owned(), Vec::new()),
            syn::Type::Path(t) if t.qself.is_none() && !belongs_to_a_type(t) => {
                let last = t.path.segments.last().expect("a path has a segment");
                let mut args = Vec::new();
                if let syn::PathArguments::AngleBracketed(list) = &last.arguments {
                    args.extend(list.args.iter().filter_map(|arg| self.lower_argument(arg)));
                }
                let name = last.ident.to_string();
                let names = self.names();
                for default in names.defaults_after(&name, args.len()) {
                    args.extend(self.lower_argument(default));
                }
                match self.self_type() {
                    Some(own) if name == "Self" => own.clone(),
                    _ => match self.aliased_type(&name) {
                        Some(ty) => ty,
                        None => Type::Name(self.type_name(name), args),
                    },
                }
            }
            syn::Type::ImplTrait(t) if is_called(&t.bounds) => {
                self.fn_bound_type(&t.bounds).unwrap_or(Type::Tuple(Vec::new()))
            }
            syn::Type::TraitObject(t) if is_called(&t.bounds) => {
                self.fn_bound_type(&t.bounds).unwrap_or(Type::Tuple(Vec::new()))
            }
            syn::Type::ImplTrait(t) if self.in_parameters => self.anonymous_parameter("impl", &t.bounds),
            syn::Type::TraitObject(t) if self.in_parameters => self.anonymous_parameter("dyn", &t.bounds),
            syn::Type::FnPtr(t) if t.unsafety.is_none() && t.abi.is_none() && t.variadic.is_none() => {
                let params = t.inputs.iter().map(|input| self.lower_type(&input.ty)).collect();
                let result = match &t.output {
                    syn::ReturnType::Default => Type::Tuple(Vec::new()),
                    syn::ReturnType::Type(_, ty) => self.lower_type(ty),
                };
                Type::Fn(params, Box::new(result))
            }
            // Values determine the type of an `impl Trait` result and of a trait object.
            syn::Type::ImplTrait(_) => Type::Name("_".to_owned(), Vec::new()),
            syn::Type::TraitObject(t) => {
                let traits: Vec<String> = t.bounds.iter().filter_map(super::traits::trait_name).collect();
                Type::Name(format!("dyn {}", traits.join(" + ")), Vec::new())
            }
            other => {
                let text = super::cfg::as_written(other);
                self.note_unsupported(
                    other.span(),
                    &format!("the type `{text}`"),
                    "use numbers, vectors, arrays, tuples, structures, enums and the prelude's textures",
                );
                Type::Tuple(Vec::new())
            }
        }
    }
}

impl Lower {
    /// The type of an array's elements. Objects among them may be of several types, so that no parameter stands for one.
    fn lower_element(&mut self, ty: &syn::Type) -> Type {
        match ty {
            syn::Type::Reference(t) if matches!(&*t.elem, syn::Type::TraitObject(t) if !is_called(&t.bounds)) => {
                let in_parameters = std::mem::replace(&mut self.in_parameters, false);
                let element = self.lower_type(ty);
                self.in_parameters = in_parameters;
                element
            }
            _ => self.lower_type(ty),
        }
    }

    /// An argument of a type; `None` of a lifetime.
    fn lower_argument(&mut self, argument: &syn::GenericArgument) -> Option<Type> {
        match argument {
            syn::GenericArgument::Type(syn::Type::Infer(_)) => Some(Type::Name("_".to_owned(), Vec::new())),
            syn::GenericArgument::Type(ty) => Some(self.lower_type(ty)),
            syn::GenericArgument::Const(value) => Some(Type::Const(Box::new(self.lower_expr(value)))),
            _ => None,
        }
    }

    /// The type that a type's name stands for: `Self::Output`, or a type parameter of a trait that is implemented.
    fn stand_in(&self, ty: &syn::TypePath) -> Option<Type> {
        let names: Vec<String> = ty.path.segments.iter().map(|s| s.ident.to_string()).collect();
        match names.as_slice() {
            [name] if ty.qself.is_none() => self.stands.get(name).cloned(),
            [.., own, name] if ty.qself.is_some() || own == "Self" => {
                self.stands.get(&format!("Self::{name}")).cloned()
            }
            _ => None,
        }
    }

    /// Returns whether a path names an associated type of a type parameter: `S::Scalar`, `<S as Trait>::Scalar`.
    fn belongs_to_a_parameter(&self, ty: &syn::TypePath) -> bool {
        let first = match &ty.qself {
            Some(own) => match &*own.ty {
                syn::Type::Path(own) => own.path.get_ident().map(ToString::to_string),
                _ => None,
            },
            None => ty.path.segments.first().map(|s| s.ident.to_string()),
        };
        let known = |name: String| name == "Self" || self.parameters.contains(&name);
        belongs_to_a_type(ty) && first.is_some_and(known)
    }

    /// A parameter of any type that has some traits.
    fn anonymous_parameter<'b>(
        &mut self,
        word: &str,
        bounds: impl IntoIterator<Item = &'b syn::TypeParamBound> + Clone,
    ) -> Type {
        let target = self.conversion_among(bounds.clone());
        let traits: Vec<String> = bounds.into_iter().filter_map(super::traits::trait_name).collect();
        let name = match self.anonymous.len() {
            0 => format!("{word} {}", traits.join(" + ")),
            k => format!("{word} {} #{k}", traits.join(" + ")),
        };
        self.functions
            .extend(target.map(|ty| (super::closure::conversion_of(&name), ty)));
        self.anonymous.push((name.clone(), traits));
        Type::Name(name, Vec::new())
    }

    /// The traits that type parameters are bound by.
    pub fn trait_bounds(&mut self, generics: &syn::Generics) -> HashMap<String, Vec<String>> {
        let mut found: HashMap<String, Vec<String>> = HashMap::new();
        for param in &generics.params {
            if let syn::GenericParam::Type(t) = param {
                let traits = t.bounds.iter().filter_map(super::traits::trait_name);
                found.entry(t.ident.to_string()).or_default().extend(traits);
            }
        }
        for predicate in generics.where_clause.iter().flat_map(|clause| &clause.predicates) {
            if let syn::WherePredicate::Type(t) = predicate
                && let syn::Type::Path(path) = &t.bounded_ty
                && let Some(name) = path.path.get_ident()
            {
                let traits = t.bounds.iter().filter_map(super::traits::trait_name);
                found.entry(name.to_string()).or_default().extend(traits);
            }
        }
        found
    }
}

/// Returns whether a pattern is `..` or `name @ ..`.
fn is_rest(pattern: &syn::Pat) -> bool {
    match pattern {
        syn::Pat::Rest(_) => true,
        syn::Pat::Ident(p) => p
            .subpat
            .as_ref()
            .is_some_and(|(_, inner)| matches!(**inner, syn::Pat::Rest(_))),
        _ => false,
    }
}

/// Returns whether a path of two names is an associated type.
fn belongs_to_a_type(ty: &syn::TypePath) -> bool {
    let first = ty
        .path
        .segments
        .first()
        .map(|s| s.ident.to_string())
        .unwrap_or_default();
    // Modules are in lower case.
    ty.qself.is_some() || (ty.path.segments.len() > 1 && first.starts_with(char::is_uppercase))
}

/// Returns whether some bound is `Fn`, `FnMut` or `FnOnce`.
fn is_called<'b>(bounds: impl IntoIterator<Item = &'b syn::TypeParamBound>) -> bool {
    bounds.into_iter().any(|bound| match bound {
        syn::TypeParamBound::Trait(bound) => bound.path.segments.last().is_some_and(|last| {
            matches!(last.arguments, syn::PathArguments::Parenthesized(_))
                && matches!(last.ident.to_string().as_str(), "Fn" | "FnMut" | "FnOnce")
        }),
        _ => false,
    })
}
