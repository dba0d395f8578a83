//! Closures, and the types of what is called: `impl Fn(A) -> B`, `&dyn Fn(A) -> B`, `F` with `F: Fn(A) -> B`.

use super::expr::Lower;
use super::tree::{Closure, ExprKind, Type};
use std::collections::HashMap;
use std::sync::Arc;
use syn::spanned::Spanned;

impl Lower {
    /// `|x: f32| x * 2.0`.
    pub fn lower_closure(&mut self, e: &syn::ExprClosure) -> ExprKind {
        if let Some(token) = &e.asyncness {
            self.note_unsupported(token.span(), "an `async` closure", "write `|x| ...` alone");
        }
        if let Some(token) = &e.constness {
            self.note_unsupported(token.span(), "a `const` closure", "write `|x| ...` alone");
        }
        if let Some(lifetimes) = &e.lifetimes {
            self.note_unsupported(lifetimes.span(), "`for<..>` before a closure", "leave it out");
        }
        let params = e.inputs.iter().map(|input| match input {
            syn::Pat::Type(typed) => (self.lower_pattern(&typed.pat), Some(self.lower_type(&typed.ty))),
            other => (self.lower_pattern(other), None),
        });
        let params = params.collect();
        let result = match &e.output {
            syn::ReturnType::Default => None,
            syn::ReturnType::Type(_, ty) => Some(self.lower_type(ty)),
        };
        let targets = std::mem::take(&mut self.targets);
        let body = self.lower_expr(&e.body);
        self.targets = targets;
        ExprKind::Closure(Arc::new(Closure {
            params,
            result,
            body,
            moves: e.capture.is_some(),
        }))
    }

    /// Notes which type parameters are called, by their bounds.
    pub fn called_parameters(&mut self, generics: &syn::Generics) {
        let found = self.functions_of(generics);
        self.functions.extend(found);
    }

    /// The types of functions that type parameters stand for, and those that `into` gives, by their bounds.
    pub fn functions_of(&mut self, generics: &syn::Generics) -> HashMap<String, Type> {
        let mut found = HashMap::new();
        for param in &generics.params {
            if let syn::GenericParam::Type(t) = param {
                found.extend(self.fn_bound_type(&t.bounds).map(|ty| (t.ident.to_string(), ty)));
                let target = self.conversion_among(&t.bounds);
                found.extend(target.map(|ty| (conversion_of(&t.ident.to_string()), ty)));
            }
        }
        for predicate in generics.where_clause.iter().flat_map(|clause| &clause.predicates) {
            if let syn::WherePredicate::Type(t) = predicate
                && let syn::Type::Path(path) = &t.bounded_ty
                && let Some(name) = path.path.get_ident()
            {
                found.extend(self.fn_bound_type(&t.bounds).map(|ty| (name.to_string(), ty)));
                let target = self.conversion_among(&t.bounds);
                found.extend(target.map(|ty| (conversion_of(&name.to_string()), ty)));
            }
        }
        found
    }

    /// The type that `into` gives, among bounds: of `Into<Vec3>`.
    pub fn conversion_among<'b>(&mut self, bounds: impl IntoIterator<Item = &'b syn::TypeParamBound>) -> Option<Type> {
        let arguments = bounds.into_iter().find_map(|bound| match bound {
            syn::TypeParamBound::Trait(bound) => match bound.path.segments.last() {
                Some(last) if last.ident == "Into" => Some(&last.arguments),
                _ => None,
            },
            _ => None,
        });
        match arguments {
            Some(syn::PathArguments::AngleBracketed(list)) => list.args.iter().find_map(|arg| match arg {
                syn::GenericArgument::Type(ty) => Some(self.lower_type(ty)),
                _ => None,
            }),
            _ => None,
        }
    }

    /// The type of functions among bounds: `Fn(A) -> B`, `FnMut`, `FnOnce`.
    pub fn fn_bound_type<'b>(&mut self, bounds: impl IntoIterator<Item = &'b syn::TypeParamBound>) -> Option<Type> {
        for bound in bounds {
            if let syn::TypeParamBound::Trait(bound) = bound
                && let Some(last) = bound.path.segments.last()
                && matches!(last.ident.to_string().as_str(), "Fn" | "FnMut" | "FnOnce")
                && let syn::PathArguments::Parenthesized(list) = &last.arguments
            {
                let params = list.inputs.iter().map(|input| self.lower_type(&input.ty)).collect();
                let result = match &list.output {
                    syn::ReturnType::Default => Type::Tuple(Vec::new()),
                    syn::ReturnType::Type(_, ty) => self.lower_type(ty),
                };
                return Some(Type::Fn(params, Box::new(result)));
            }
        }
        None
    }
}

/// Key of the type that `into` gives, among the types of functions that type parameters stand for.
pub fn conversion_of(parameter: &str) -> String {
    format!("{parameter}.into")
}
