//! Generic arguments in expressions, and types that expressions state.

use super::{INFERRED, Lower};
use crate::front::rust_traits::is_of_rust;
use crate::front::tree::{Block, Expr, ExprKind, Pattern, Statement, Type};
use syn::spanned::Spanned;

impl Lower {
    /// `power::<3>` as a value: a closure that calls it.
    pub(super) fn lower_instance(&mut self, e: &syn::ExprPath) -> ExprKind {
        let last = e.path.segments.last().map(|last| last.ident.to_string());
        let Some(count) = last.and_then(|last| self.names().arity(&last)) else {
            let instead = "write a closure that calls it: `|x| power::<3>(x)`";
            self.note_unsupported(e.span(), "a method with generic arguments as a value", instead);
            return ExprKind::Tuple(Vec::new());
        };
        let params: Vec<syn::Ident> = (0..count)
            .map(|k| quote::format_ident!("x{k}", span = e.span()))
            .collect();
        let closure = quote::quote_spanned!(e.span()=> |#(#params),*| #e(#(#params),*));
        match syn::parse2(closure) {
            Ok(closure) => self.lower_closure(&closure),
            Err(_) => ExprKind::Tuple(Vec::new()),
        }
    }

    /// `None::<T>`: a `None` where its type is stated.
    pub(super) fn typed_none(&mut self, held: Type, at: proc_macro2::Span) -> ExprKind {
        let none = ExprKind::Path(vec!["Option".to_owned(), "None".to_owned()]);
        self.typed(none, Type::Name("Option".to_owned(), vec![held]), at)
    }

    /// The type before the last segment of a path, if it has arguments: `Window::<3>::new`, `<Window<3> as Trait>::new`.
    pub(super) fn owner_argument(&mut self, path: &syn::ExprPath) -> Option<Expr> {
        let mut owner = path.path.clone();
        owner.segments.pop();
        owner.segments.pop_punct();
        let ty = match &path.qself {
            Some(own) => match self.lower_type(&own.ty) {
                ty if has_arguments(&ty) => ty,
                _ => return None,
            },
            None => self.stated_type(&owner).or_else(|| self.generic_self(&owner))?,
        };
        let span = self.token_span(owner.span());
        let unit = Box::new(Expr {
            kind: ExprKind::Tuple(Vec::new()),
            span,
        });
        Some(Expr {
            kind: ExprKind::Cast(unit, ty),
            span,
        })
    }

    /// A constant of a type that has arguments, or of a trait that is named.
    pub(super) fn owned_constant(&mut self, path: &syn::ExprPath) -> Option<ExprKind> {
        let last = path.path.segments.last()?;
        if last.ident.to_string().contains(char::is_lowercase) || !last.arguments.is_none() {
            return None;
        }
        let owner = self.owner_argument(path);
        let called = with_trait(path, self.of_type(path)?);
        let is_owned = owner.is_some() || called.len() == 3;
        is_owned.then(|| ExprKind::Call(called, owner.into_iter().collect(), Vec::new()))
    }

    /// `Self` with the generic parameters of its `impl`.
    pub(super) fn generic_self(&self, path: &syn::Path) -> Option<Type> {
        let own = self.self_type().filter(|_| path.is_ident("Self"))?.peel_refs();
        has_arguments(own).then(|| own.clone())
    }

    /// Generic arguments in `::<>`, in order; a type counts as `()`.
    pub(super) fn generic_arguments(&mut self, path: &syn::Path) -> Vec<Expr> {
        let Some(syn::PathArguments::AngleBracketed(list)) = path.segments.last().map(|s| &s.arguments) else {
            return Vec::new();
        };
        self.listed_arguments(list)
    }

    pub(super) fn listed_arguments(&mut self, list: &syn::AngleBracketedGenericArguments) -> Vec<Expr> {
        let mut constants = Vec::new();
        for arg in &list.args {
            let kind = match arg {
                syn::GenericArgument::Const(e) => self.lower_expr(e).kind,
                syn::GenericArgument::Type(syn::Type::Infer(_)) => ExprKind::Path(vec![INFERRED.to_owned()]),
                syn::GenericArgument::Type(ty) => self.type_argument(ty),
                // Lifetimes have no parameter to bind; the others are refused before.
                _ => continue,
            };
            let span = self.token_span(arg.span());
            constants.push(Expr { kind, span });
        }
        constants
    }

    /// A type in `::<>`, written as what has it: a name, which may be a constant's, `[T; n]` or `(A, B)`.
    pub(super) fn type_argument(&mut self, ty: &syn::Type) -> ExprKind {
        match ty {
            syn::Type::Path(t) => {
                let path = self.path_segments(&t.path);
                let own = t.path.is_ident("Self").then(|| self.self_type().cloned()).flatten();
                match self.stated_type(&t.path).or(own) {
                    Some(ty) if path.len() == 1 && has_arguments(&ty) => {
                        let span = self.token_span(t.span());
                        let kind = ExprKind::Path(path);
                        ExprKind::Cast(Box::new(Expr { kind, span }), ty)
                    }
                    _ => ExprKind::Path(path),
                }
            }
            syn::Type::Array(t) => {
                let kind = self.type_argument(&t.elem);
                let span = self.token_span(t.elem.span());
                ExprKind::Repeat(Box::new(Expr { kind, span }), self.boxed(&t.len))
            }
            syn::Type::Tuple(t) => {
                let parts = t.elems.iter().map(|part| Expr {
                    kind: self.type_argument(part),
                    span: self.token_span(part.span()),
                });
                ExprKind::Tuple(parts.collect())
            }
            _ => ExprKind::Tuple(Vec::new()),
        }
    }

    /// The type that a path with generic arguments names: `Window::<3>`.
    pub(super) fn stated_type(&mut self, path: &syn::Path) -> Option<Type> {
        let last = path.segments.last()?;
        if last.arguments.is_none() {
            // Another name of a type that has arguments.
            let named = self.aliased_type(&path.get_ident()?.to_string())?;
            return has_arguments(&named).then_some(named);
        }
        Some(self.lower_type(&syn::Type::Path(syn::TypePath {
            attrs: Vec::new(),
            qself: None,
            path: path.clone(),
        })))
    }

    /// A value where its type is stated.
    pub(super) fn typed(&mut self, value: ExprKind, ty: Type, at: proc_macro2::Span) -> ExprKind {
        let span = self.token_span(at);
        let name = "#typed";
        ExprKind::Block(Block {
            statements: vec![Statement::Let(
                Pattern::Name(name.into(), false, span),
                Some(ty),
                Some(Expr { kind: value, span }),
                span,
            )],
            value: Some(Box::new(self.path_expr(vec![name.to_owned()], at))),
            exact: false,
        })
    }
}

/// Returns whether a path is a function with generic arguments: `power::<3>`.
pub fn names_instance(path: &syn::Path) -> bool {
    let last = path.segments.last();
    last.is_some_and(|last| !last.arguments.is_none() && last.ident.to_string().starts_with(char::is_lowercase))
}

/// The type in `None::<T>` and `Option::<T>::None`.
pub fn held_by_none(path: &syn::Path) -> Option<&syn::Type> {
    let last = path.segments.last().filter(|last| last.ident == "None")?;
    let of = path.segments.iter().rev().nth(1).filter(|of| of.ident == "Option");
    let arguments = [Some(last), of]
        .into_iter()
        .flatten()
        .find_map(|segment| match &segment.arguments {
            syn::PathArguments::AngleBracketed(list) => Some(list),
            _ => None,
        })?;
    match arguments.args.first() {
        Some(syn::GenericArgument::Type(ty)) if arguments.args.len() == 1 => Some(ty),
        _ => None,
    }
}

fn has_arguments(ty: &Type) -> bool {
    match ty {
        Type::Name(_, args) | Type::Tuple(args) => !args.is_empty(),
        other => matches!(other, Type::Array(..)),
    }
}

/// Adds the trait to a call of `<Type as Trait>::name`, unless it is one of Rust's.
pub(super) fn with_trait(path: &syn::ExprPath, called: Vec<String>) -> Vec<String> {
    let position = path.qself.as_ref().map_or(0, |own| own.position);
    let of = position.checked_sub(1).and_then(|last| path.path.segments.get(last));
    match (of, called.as_slice()) {
        (Some(of), [ty, name]) if !is_of_rust(&of.ident.to_string()) && !ty.contains("::") => {
            vec![ty.clone(), of.ident.to_string(), name.clone()]
        }
        _ => called,
    }
}
