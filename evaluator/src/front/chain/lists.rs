//! Lists of pictures.

use super::refused;
use super::signature::element_type;
use super::state::{Known, Place, Walk};
use super::syntax::{identifier, variable_of};
use super::value::Value;
use crate::diagnostic::Diagnostic;
use proc_macro2::Ident;
use syn::punctuated::Punctuated;

impl Walk<'_> {
    /// Runs a method that changes a list of pictures; `false` if it is no such method.
    pub(super) fn changes_list(&mut self, call: &syn::ExprMethodCall) -> Result<bool, Box<Diagnostic>> {
        let Some(name) = variable_of(&call.receiver).map(Ident::to_string) else {
            return Ok(false);
        };
        let Some(Value::Images(mut images)) = self.variable_named(&name).map(|variable| variable.value.clone()) else {
            return Ok(false);
        };
        let ty = self.variable_named(&name).and_then(|variable| variable.ty.clone());
        let element = ty.as_ref().and_then(element_type);
        let method = call.method.to_string();
        match (method.as_str(), call.args.iter().collect::<Vec<_>>().as_slice()) {
            ("push", [pushed]) => {
                let ident = identifier(&name, call.method.span());
                let place = Place {
                    name: Some(&ident),
                    ty: element.as_ref(),
                    ..Place::default()
                };
                match self.value(pushed, place)? {
                    Some(Value::Image(image)) => images.push(image),
                    _ => {
                        return Err(refused(
                            self.file,
                            pushed,
                            "no picture",
                            "push one that `draw` returned",
                        ));
                    }
                }
            }
            ("pop", []) => {
                images.pop();
            }
            ("reverse", []) => images.reverse(),
            ("clear", []) => images.clear(),
            _ => return Ok(false),
        }
        if let Some(variable) = self.scopes.iter_mut().rev().find_map(|scope| scope.get_mut(&name)) {
            variable.value = Value::Images(images);
        }
        Ok(true)
    }

    pub(super) fn list(&mut self, call: &syn::Macro, place: Place<'_>) -> Known {
        let elements = call.parse_body_with(Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated);
        match elements {
            Ok(elements) => self.images(elements.iter(), place),
            Err(_) => Err(refused(
                self.file,
                call,
                "this `vec!`",
                "list its pictures: `vec![first, second]`",
            )),
        }
    }

    pub(super) fn images<'e>(&mut self, elements: impl Iterator<Item = &'e syn::Expr>, place: Place<'_>) -> Known {
        let element = place.ty.and_then(element_type);
        let mut images = Vec::new();
        for expr in elements {
            let place = Place {
                ty: element.as_ref(),
                ..place
            };
            match self.value(expr, place)? {
                Some(Value::Image(image)) => images.push(image),
                _ => return Ok(None),
            }
        }
        Ok(Some(Value::Images(images)))
    }

    /// `swap(&mut a, &mut b)` of two variables.
    pub(super) fn swap(&mut self, call: &syn::ExprCall) -> Result<(), Box<Diagnostic>> {
        let names: Vec<Ident> = call.args.iter().filter_map(variable_of).cloned().collect();
        let [a, b] = names.as_slice() else {
            return Err(refused(
                self.file,
                call,
                "this `swap`",
                "swap two variables: `std::mem::swap(&mut a, &mut b)`",
            ));
        };
        let value = |name: &Ident| {
            self.variable_named(&name.to_string())
                .map(|variable| variable.value.clone())
        };
        let (of_a, of_b) = (value(a), value(b));
        self.set(a, of_b)?;
        self.set(b, of_a)
    }
}
