//! State of the walk through a chain.

use super::capture::{Captured, Lookup, capture};
use super::signature::returns_pictures;
use super::value::Value;
use super::{Chain, MOST_STEPS, refused};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::token_span;
use proc_macro2::{Ident, TokenStream};
use std::collections::{BTreeMap, HashMap};
use straightline_kernels::OptionValues;
use syn::spanned::Spanned;

/// A value that is known; `None` if only a pass can compute it.
pub type Known = Result<Option<Value>, Box<Diagnostic>>;

/// A `let` of a value that passes compute for themselves.
pub struct Let {
    /// The statement, with the values that it mentions.
    pub captured: Captured,
}

/// A variable of a chain.
pub struct Variable {
    /// Its value.
    pub value: Value,
    /// Its type, if it is written.
    pub ty: Option<syn::Type>,
}

/// Destination of a value, as far as it is written.
#[derive(Clone, Copy, Default)]
pub struct Place<'e> {
    /// Name of the variable.
    pub name: Option<&'e Ident>,
    /// Type of the variable.
    pub ty: Option<&'e syn::Type>,
    /// Attributes of the statement.
    pub attrs: &'e [syn::Attribute],
}

/// State of the walk.
pub struct Walk<'s> {
    /// Files of the chain, with their indices.
    pub syntax: &'s [(u32, syn::File)],
    /// Values of the options, but of floats.
    pub options: &'s OptionValues,
    /// File of the function that is being walked.
    pub file: u32,
    /// Parameters of the chain, by name.
    pub params: BTreeMap<String, syn::FnArg>,
    /// Parameters of the chain that are frames.
    pub frames: Vec<String>,
    /// Variables by name: a scope for each block, the innermost last.
    pub scopes: Vec<HashMap<String, Variable>>,
    /// Values that passes compute for themselves.
    pub lets: Vec<Let>,
    /// The chain as it is known so far.
    pub chain: Chain,
    /// Kernels of the passes, each once.
    pub kernels: Vec<syn::ItemFn>,
    /// Names of kernels by their text.
    pub entries: HashMap<String, String>,
    /// Statements and iterations so far.
    pub steps: usize,
    /// Chains that are being walked, but for the outermost.
    pub depth: usize,
    /// Statements that no chain has.
    pub errors: Vec<Diagnostic>,
}

impl Walk<'_> {
    pub(super) fn declare(&mut self, name: &str, value: Value, ty: Option<syn::Type>) {
        if let Some(scope) = self.scopes.last_mut() {
            scope.insert(name.to_owned(), Variable { value, ty });
        }
    }

    /// Variable of a name in the function that is being walked.
    pub(super) fn variable_named(&self, name: &str) -> Option<&Variable> {
        self.scopes.iter().rev().find_map(|scope| scope.get(name))
    }

    /// Value of a constant of the files.
    pub(super) fn constant_named(&self, name: &str) -> Option<&syn::Expr> {
        let items = self.syntax.iter().flat_map(|(_, file)| &file.items);
        items.into_iter().find_map(|item| match item {
            syn::Item::Const(constant) if constant.ident == name => Some(&*constant.expr),
            _ => None,
        })
    }

    /// Returns whether the files have a function of a name that is no chain.
    pub(super) fn has_function(&self, name: &str) -> bool {
        let items = self.syntax.iter().flat_map(|(_, file)| &file.items);
        items.into_iter().any(|item| match item {
            syn::Item::Fn(function) => function.sig.ident == name && !returns_pictures(&function.sig),
            _ => false,
        })
    }

    /// Counts a statement or an iteration.
    pub(super) fn step(&mut self, at: &impl Spanned) -> Result<(), Box<Diagnostic>> {
        self.steps += 1;
        if self.steps <= MOST_STEPS {
            return Ok(());
        }
        let what = format!("`{}` takes more than {MOST_STEPS} steps to read", self.chain.name);
        let help = "give its loops fewer iterations";
        Err(Box::new(
            Diagnostic::error_at(Code::Limit, token_span(self.file, at.span()), what)
                .label("here")
                .help(help),
        ))
    }

    pub(super) fn captured(&self, tokens: TokenStream, at: &impl Spanned) -> Result<Captured, Box<Diagnostic>> {
        let found = capture(tokens, self).map_err(|list| {
            let what = format!("the list `{}` inside a pass", list.0);
            let help = "a pass reads single pictures: index the list by a constant, as in `levels[0]`";
            refused(self.file, &list.0, what, help)
        })?;
        for (name, value) in &found.values {
            let (what, help) = match value {
                Value::Unset | Value::Unit => ("has no value here", "give it one before it is used"),
                Value::Choice(_) => (
                    "is a variant of an option",
                    "mention the option in the pass, as in `cfg.quality`",
                ),
                Value::Tuple(_) => ("is a tuple", "mention its parts in the pass: `let (a, b) = ..`"),
                _ => continue,
            };
            return Err(refused(self.file, at, format!("`{name}` {what}"), help));
        }
        Ok(found)
    }
}

impl Lookup for Walk<'_> {
    fn variable(&self, name: &str) -> Option<Value> {
        self.variable_named(name).map(|variable| variable.value.clone())
    }

    fn index(&self, tokens: TokenStream) -> Option<i64> {
        let expr: syn::Expr = syn::parse2(tokens).ok()?;
        match self.known(&expr) {
            Ok(Some(Value::Integer(index))) => Some(index),
            _ => None,
        }
    }
}
