//! Statements of a chain: declarations and assignments.

use super::refused;
use super::state::{Known, Let, Place, Walk};
use super::syntax::{bound_names, find_word, is_compound, plain_operator, variable_of};
use super::value::Value;
use crate::diagnostic::{Code, Diagnostic};
use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;
use std::collections::HashMap;
use syn::spanned::Spanned;

impl Walk<'_> {
    /// Walks a block in a scope of its own, and returns its value.
    pub(super) fn block(&mut self, block: &syn::Block, place: Place<'_>) -> Known {
        self.scopes.push(HashMap::new());
        let value = self.statements(&block.stmts, place);
        self.scopes.pop();
        value
    }

    pub(super) fn statements(&mut self, statements: &[syn::Stmt], place: Place<'_>) -> Known {
        let last = statements.len().saturating_sub(1);
        for (k, statement) in statements.iter().enumerate() {
            self.step(statement)?;
            match statement {
                syn::Stmt::Expr(expr, None) if k == last => return self.value(expr, place),
                statement => match self.statement(statement) {
                    Err(error) if error.code() == Some(Code::Limit) => return Err(error),
                    Err(error) => self.errors.push(*error),
                    Ok(()) => {}
                },
            }
        }
        Ok(Some(Value::Unit))
    }

    fn statement(&mut self, statement: &syn::Stmt) -> Result<(), Box<Diagnostic>> {
        match statement {
            syn::Stmt::Local(local) => self.local(local),
            syn::Stmt::Item(_) => Ok(()),
            syn::Stmt::Macro(call) => {
                let help = "leave it out: a chain has pictures, sizes, and what passes compute";
                Err(refused(self.file, call, "a macro as a statement", help))
            }
            syn::Stmt::Expr(expr, _) => match expr {
                syn::Expr::Assign(assign) => self.assign(assign),
                syn::Expr::Binary(binary) if is_compound(&binary.op) => self.compound(binary),
                syn::Expr::MethodCall(call) if self.changes_list(call)? => Ok(()),
                syn::Expr::Return(_) | syn::Expr::Break(_) | syn::Expr::Continue(_) => {
                    let help = "let `if` choose between pictures, and end the function with its result";
                    Err(refused(self.file, expr, "an early exit", help))
                }
                expr => match self.value(expr, Place::default())? {
                    Some(_) => Ok(()),
                    None => {
                        let help = "write it inside the closure of `draw`";
                        Err(refused(self.file, expr, "a statement that only a pass can run", help))
                    }
                },
            },
        }
    }

    pub(super) fn local(&mut self, local: &syn::Local) -> Result<(), Box<Diagnostic>> {
        let (pat, ty) = match &local.pat {
            syn::Pat::Type(typed) => (&*typed.pat, Some(&*typed.ty)),
            pat => (pat, None),
        };
        let name = match pat {
            syn::Pat::Ident(name) => Some(&name.ident),
            _ => None,
        };
        let place = Place {
            name,
            ty,
            attrs: &local.attrs,
        };
        let value = match &local.init {
            Some(init) => match self.value(&init.expr, place) {
                Ok(value) => value,
                Err(error) => {
                    self.errors.push(*error);
                    Some(Value::Broken)
                }
            },
            None => Some(Value::Unset),
        };
        match (name, value) {
            (Some(name), Some(value)) if !matches!(value, Value::Later(_)) => {
                self.declare(&name.to_string(), value, ty.cloned());
            }
            (None, Some(Value::Tuple(values))) => self.declare_tuple(pat, values)?,
            (None, Some(Value::Broken | Value::Unset)) => {}
            _ => {
                self.refuse_pass(local)?;
                let index = self.defer(local.to_token_stream(), local)?;
                let mut names = Vec::new();
                bound_names(pat.to_token_stream(), &mut names);
                for name in names {
                    self.declare(&name, Value::Later(index), None);
                }
            }
        }
        Ok(())
    }

    pub(super) fn declare_tuple(&mut self, pat: &syn::Pat, values: Vec<Value>) -> Result<(), Box<Diagnostic>> {
        let syn::Pat::Tuple(tuple) = pat else {
            return Err(refused(
                self.file,
                pat,
                "this pattern",
                "write names in parentheses: `let (a, b) = ..`",
            ));
        };
        for (pat, value) in tuple.elems.iter().zip(values) {
            if let syn::Pat::Ident(name) = pat {
                self.declare(&name.ident.to_string(), value, None);
            }
        }
        Ok(())
    }

    /// Refuses a statement with a pass whose value is unknown.
    pub(super) fn refuse_pass(&self, statement: &impl ToTokens) -> Result<(), Box<Diagnostic>> {
        match find_word(statement.to_token_stream(), "draw") {
            Some(draw) => {
                let help = "write `let name: Texture<Vec4> = draw(size, |pixel| ..);` as a statement of its own";
                Err(refused(self.file, &draw, "a pass inside another expression", help))
            }
            None => Ok(()),
        }
    }

    /// Leaves a `let` to the passes that mention it.
    pub(super) fn defer(&mut self, statement: TokenStream, at: &impl Spanned) -> Result<usize, Box<Diagnostic>> {
        let captured = self.captured(statement, at)?;
        self.lets.push(Let { captured });
        Ok(self.lets.len() - 1)
    }

    pub(super) fn assign(&mut self, assign: &syn::ExprAssign) -> Result<(), Box<Diagnostic>> {
        let Some(name) = variable_of(&assign.left) else {
            let help = "assign to a variable; a list takes another picture with `push`";
            return Err(refused(self.file, &assign.left, "an assignment to a part", help));
        };
        let ty = self
            .variable_named(&name.to_string())
            .and_then(|variable| variable.ty.clone());
        let place = Place {
            name: Some(name),
            ty: ty.as_ref(),
            ..Place::default()
        };
        let value = self.value(&assign.right, place)?;
        self.set(name, value)
    }

    pub(super) fn compound(&mut self, binary: &syn::ExprBinary) -> Result<(), Box<Diagnostic>> {
        let Some(name) = variable_of(&binary.left) else {
            let help = "assign to a variable";
            return Err(refused(self.file, &binary.left, "an assignment to a part", help));
        };
        let plain = syn::ExprBinary {
            op: plain_operator(&binary.op),
            ..binary.clone()
        };
        let value = self.known(&syn::Expr::Binary(plain))?;
        self.set(name, value)
    }

    pub(super) fn set(&mut self, name: &Ident, value: Option<Value>) -> Result<(), Box<Diagnostic>> {
        let Some(value) = value.filter(|value| !matches!(value, Value::Later(_))) else {
            let help = "a variable that changes holds a picture, a size or an integer: compute the rest in the pass";
            return Err(refused(
                self.file,
                name,
                "a change of a value that only a pass can compute",
                help,
            ));
        };
        let text = name.to_string();
        match self.scopes.iter_mut().rev().find_map(|scope| scope.get_mut(&text)) {
            Some(variable) => variable.value = value,
            None => {
                return Err(refused(
                    self.file,
                    name,
                    format!("`{name}` is not declared"),
                    "declare it with `let mut`",
                ));
            }
        }
        Ok(())
    }
}
