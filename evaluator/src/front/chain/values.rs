//! Expressions of a chain, with the passes and chains in them.

use super::read;
use super::refused;
use super::signature::{param_name, picture_type, returns_pictures};
use super::state::{Known, Place, Variable, Walk};
use super::syntax::{call_name, is_new_list, variable_of};
use super::value::{Image, Value};
use quote::{ToTokens, quote_spanned};
use std::collections::HashMap;
use std::rc::Rc;

/// Deepest nesting of chains that call chains.
const DEEPEST: usize = 16;

impl<'s> Walk<'s> {
    /// Walks an expression that may have passes, and returns its value.
    pub(super) fn value(&mut self, expr: &syn::Expr, place: Place<'_>) -> Known {
        match expr {
            syn::Expr::Paren(inner) => self.value(&inner.expr, place),
            syn::Expr::Reference(inner) => self.value(&inner.expr, place),
            syn::Expr::Block(block) => self.block(&block.block, place),
            syn::Expr::If(branch) => self.branch(branch, place),
            syn::Expr::Match(choice) => self.choice(choice, place),
            syn::Expr::ForLoop(each) => self.for_loop(each).map(|()| Some(Value::Unit)),
            syn::Expr::While(looping) => self.while_loop(looping).map(|()| Some(Value::Unit)),
            syn::Expr::Tuple(tuple) => self.tuple(tuple, place),
            syn::Expr::Macro(call) if call.mac.path.is_ident("vec") => self.list(&call.mac, place),
            syn::Expr::Array(array) => self.images(array.elems.iter(), place),
            syn::Expr::Call(call) => match call_name(call) {
                Some(name) if name == "draw" => self.draw(call, place).map(Some),
                Some(name) if name == "swap" => self.swap(call).map(|()| Some(Value::Unit)),
                Some(name) if is_new_list(call) && name == "new" => Ok(Some(Value::Images(Vec::new()))),
                Some(name) => match self.chain_named(&name) {
                    Some((file, function)) => self.call(file, function, call, place),
                    None => self.known(expr),
                },
                None => self.known(expr),
            },
            syn::Expr::MethodCall(call) => self.method(call, expr),
            expr => self.known(expr),
        }
    }

    /// A method call: `pop().unwrap()` of a list, or a method without passes.
    pub(super) fn method(&mut self, call: &syn::ExprMethodCall, expr: &syn::Expr) -> Known {
        let method = call.method.to_string();
        if let ("unwrap" | "expect", syn::Expr::MethodCall(inner)) = (method.as_str(), &*call.receiver)
            && inner.method == "pop"
            && let Some(name) = variable_of(&inner.receiver)
            && let Some(Value::Images(images)) = self.variable_named(&name.to_string()).map(|v| v.value.clone())
        {
            let Some(last) = images.last().cloned() else {
                return Err(refused(
                    self.file,
                    call,
                    format!("`{name}` is empty"),
                    "check what was pushed before",
                ));
            };
            self.changes_list(inner)?;
            return Ok(Some(Value::Image(last)));
        }
        self.known(expr)
    }

    pub(super) fn tuple(&mut self, tuple: &syn::ExprTuple, place: Place<'_>) -> Known {
        let mut values = Vec::new();
        for (k, expr) in tuple.elems.iter().enumerate() {
            let ty = match place.ty {
                Some(syn::Type::Tuple(types)) => types.elems.get(k),
                _ => None,
            };
            match self.value(expr, Place { ty, ..place })? {
                Some(value) => values.push(value),
                None => return Ok(None),
            }
        }
        Ok(Some(Value::Tuple(values)))
    }

    /// Chain of the files that a call names.
    pub(super) fn chain_named(&self, name: &str) -> Option<(u32, &'s syn::ItemFn)> {
        read::find_function(self.syntax, name).filter(|(_, function)| returns_pictures(&function.sig))
    }

    /// Walks a chain that this one calls.
    pub(super) fn call(&mut self, file: u32, function: &syn::ItemFn, call: &syn::ExprCall, place: Place<'_>) -> Known {
        if self.depth == DEEPEST {
            let what = format!("more than {DEEPEST} chains inside one another");
            return Err(refused(self.file, call, what, "a chain cannot call itself"));
        }
        if function.sig.inputs.len() != call.args.len() {
            let what = format!("`{}` takes {} arguments", function.sig.ident, function.sig.inputs.len());
            return Err(refused(self.file, call, what, "give it these"));
        }
        let mut scope = HashMap::new();
        for (input, argument) in function.sig.inputs.iter().zip(&call.args) {
            let Some((name, ty)) = param_name(input) else {
                continue;
            };
            let value = match self.value(argument, Place::default())? {
                Some(Value::Image(image)) => Value::Image(Image {
                    ty: picture_type(ty).map_or(image.ty, Rc::new),
                    ..image
                }),
                Some(Value::Later(_)) | None => {
                    let argument = argument.to_token_stream();
                    let statement = quote_spanned!(name.span()=> let #name: #ty = #argument;);
                    Value::Later(self.defer(statement, call)?)
                }
                Some(value) => value,
            };
            scope.insert(
                name.to_string(),
                Variable {
                    value,
                    ty: Some(ty.clone()),
                },
            );
        }
        let ty = match &function.sig.output {
            syn::ReturnType::Type(_, ty) => Some(&**ty),
            syn::ReturnType::Default => None,
        };
        let outer = std::mem::replace(&mut self.scopes, vec![scope]);
        let outer_file = std::mem::replace(&mut self.file, file);
        self.depth += 1;
        let value = self.block(&function.block, Place { ty, ..place });
        self.depth -= 1;
        self.scopes = outer;
        self.file = outer_file;
        value
    }
}
