//! Functions with their parameters, results and bodies.

use super::{Items, Owner, doc_text};
use crate::diagnostic::Diagnostic;
use crate::front::closure::conversion_of;
use crate::front::expr::Lower;
use crate::front::parts;
use crate::front::tree::{Function, Generic, Param, Type};
use syn::spanned::Spanned;

impl Items {
    /// A function, and what is wrong with it.
    pub(in crate::front) fn lower_function(
        &self,
        file: u32,
        sig: &syn::Signature,
        body: &syn::Block,
        attrs: &[syn::Attribute],
        of: Option<&Owner>,
    ) -> (Function, Vec<Diagnostic>) {
        let mut lower = match of {
            Some(of) => self.lower_within(file, of),
            None => self.lower_of(file),
        };
        lower.called_parameters(&sig.generics);
        let (mut params, mut parts) = (Vec::new(), Vec::new());
        // Evaluation is on values, so a type parameter is whatever comes; constants are bound by name.
        let mut generics = lower.lower_generics(&sig.generics);
        let mut bounds = lower.trait_bounds(&sig.generics);
        for input in &sig.inputs {
            match input {
                syn::FnArg::Receiver(receiver) => {
                    params.push(Param {
                        name: "self".into(),
                        ty: receiver_type(&mut lower, receiver),
                        mutable: receiver.mutability.is_some(),
                        span: lower.token_span(receiver.span()),
                    });
                }
                syn::FnArg::Typed(typed) => {
                    lower.in_parameters = true;
                    let ty = lower.lower_type(&typed.ty);
                    lower.in_parameters = false;
                    match &*typed.pat {
                        syn::Pat::Ident(p) => params.push(Param {
                            name: p.ident.to_string().into(),
                            ty,
                            mutable: p.mutability.is_some(),
                            span: lower.token_span(p.span()),
                        }),
                        other => {
                            let (param, taken) = lower.pattern_parameter(other, ty, params.len());
                            params.push(param);
                            parts.push(taken);
                        }
                    }
                }
            }
        }
        for (name, traits) in std::mem::take(&mut lower.anonymous) {
            generics.push(Generic::Type(name.clone()));
            bounds.insert(name, traits);
        }
        if let Some(of) = of {
            generics.extend(of.generics.iter().cloned());
            bounds.extend(of.bounds.clone());
        }
        let result = match &sig.output {
            syn::ReturnType::Default => Type::Tuple(Vec::new()),
            syn::ReturnType::Type(_, ty) => lower.lower_type(ty),
        };
        let span = lower.token_span(sig.ident.span());
        let mut body = parts::prepend_statements(parts, lower.lower_block(body), span);
        body.exact = lower.exact_attribute(attrs);
        if lower.half_attribute(attrs) {
            lower.half.push(sig.ident.to_string());
        }
        let conversions = generics.iter().filter_map(|generic| {
            let ty = lower.functions.get(&conversion_of(generic.name()))?;
            Some((generic.name().to_owned(), ty.clone()))
        });
        let function = Function {
            conversions: conversions.collect(),
            default_of: None,
            docs: doc_text(attrs),
            half: std::mem::take(&mut lower.half),
            unroll: lower.unroll_of_function(attrs),
            generics,
            of: of.map(|of| of.ty.clone()),
            bounds,
            params,
            result,
            body,
            span,
        };
        (function, lower.errors)
    }
}

/// The type of `self`, `&self`, `&mut self` or `self: T`.
fn receiver_type(lower: &mut Lower, receiver: &syn::Receiver) -> Type {
    let own = lower.self_type().cloned().unwrap_or(Type::Tuple(Vec::new()));
    match &receiver.kind {
        syn::ReceiverKind::Value => own,
        syn::ReceiverKind::Reference(_, _, mutability) => Type::Ref(mutability.is_some(), Box::new(own)),
        syn::ReceiverKind::Typed(_, ty) => lower.lower_type(ty),
        _ => {
            lower.note_unsupported(receiver.span(), "this receiver", "take `self`, `&self` or `&mut self`");
            own
        }
    }
}
