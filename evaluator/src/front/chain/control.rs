//! Conditions and loops of a chain, which are all decided when it is read.

use super::state::{Known, Place, Variable, Walk};
use super::syntax::{arm_matches, find_word};
use super::value::Value;
use super::{MOST_STEPS, refused};
use crate::diagnostic::Diagnostic;
use proc_macro2::Ident;
use quote::ToTokens;
use std::collections::HashMap;
use syn::spanned::Spanned;

impl Walk<'_> {
    pub(super) fn branch(&mut self, branch: &syn::ExprIf, place: Place<'_>) -> Known {
        let Some(holds) = self.known(&branch.cond)?.and_then(Value::into_flag) else {
            if find_word(branch.to_token_stream(), "draw").is_none() {
                return Ok(None);
            }
            let help = "passes depend on options, integers and constants alone: move the `if` into the pass";
            return Err(refused(
                self.file,
                &branch.cond,
                "a runtime condition decides which passes run",
                help,
            ));
        };
        match (holds, &branch.else_branch) {
            (true, _) => self.block(&branch.then_branch, place),
            (false, Some((_, otherwise))) => self.value(otherwise, place),
            (false, None) => Ok(Some(Value::Unit)),
        }
    }

    pub(super) fn choice(&mut self, choice: &syn::ExprMatch, place: Place<'_>) -> Known {
        let Some(value) = self.known(&choice.expr)? else {
            if find_word(choice.to_token_stream(), "draw").is_none() {
                return Ok(None);
            }
            let help = "passes depend on options, integers and constants alone: move the `match` into the pass";
            return Err(refused(
                self.file,
                &choice.expr,
                "a runtime value decides which passes run",
                help,
            ));
        };
        for arm in &choice.arms {
            if arm_matches(&arm.pat, &value) {
                return self.value(&arm.body, place);
            }
        }
        let help = "match by integers, `true`, `false`, variants of options, and `_`";
        Err(refused(
            self.file,
            &choice.expr,
            "a `match` without an arm that is known to be taken",
            help,
        ))
    }

    pub(super) fn for_loop(&mut self, each: &syn::ExprForLoop) -> Result<(), Box<Diagnostic>> {
        let items = self.iterated(&each.expr)?;
        let syn::Pat::Ident(counter) = &*each.pat else {
            let name = Ident::new("_", each.pat.span());
            return match &*each.pat {
                syn::Pat::Wild(_) => items
                    .into_iter()
                    .try_for_each(|_| self.iteration(&name, Value::Broken, each)),
                pat => Err(refused(self.file, pat, "this pattern", "name the counter")),
            };
        };
        items
            .into_iter()
            .try_for_each(|item| self.iteration(&counter.ident, item, each))
    }

    pub(super) fn iteration(
        &mut self,
        counter: &Ident,
        item: Value,
        each: &syn::ExprForLoop,
    ) -> Result<(), Box<Diagnostic>> {
        self.step(&each.for_token)?;
        self.scopes.push(HashMap::from([(
            counter.to_string(),
            Variable { value: item, ty: None },
        )]));
        let errors = self.errors.len();
        let walked = self.block(&each.body, Place::default());
        self.scopes.pop();
        // The iterations after one with an error would have it too.
        match (walked, self.errors.len() > errors) {
            (Err(error), _) => Err(error),
            (Ok(_), true) => Err(Box::new(self.errors.remove(errors))),
            (Ok(_), false) => Ok(()),
        }
    }

    pub(super) fn while_loop(&mut self, looping: &syn::ExprWhile) -> Result<(), Box<Diagnostic>> {
        loop {
            self.step(&looping.while_token)?;
            match self.known(&looping.cond)?.and_then(Value::into_flag) {
                Some(false) => return Ok(()),
                Some(true) => {
                    let errors = self.errors.len();
                    self.block(&looping.body, Place::default())?;
                    if self.errors.len() > errors {
                        return Err(Box::new(self.errors.remove(errors)));
                    }
                }
                None => {
                    let help = "count with integers, by options and constants";
                    let what = "a runtime condition decides which passes run";
                    return Err(refused(self.file, &looping.cond, what, help));
                }
            }
        }
    }

    /// Items of what a `for` runs over: a range of integers, or a list of pictures.
    pub(super) fn iterated(&self, expr: &syn::Expr) -> Result<Vec<Value>, Box<Diagnostic>> {
        let help = "run over a range of integers, or over a list of pictures";
        match expr {
            syn::Expr::Paren(inner) => self.iterated(&inner.expr),
            syn::Expr::Range(range) => {
                let bound = |bound: &Option<Box<syn::Expr>>| match bound {
                    Some(expr) => match self.known(expr)? {
                        Some(Value::Integer(number)) => Ok(Some(number)),
                        _ => Err(refused(self.file, expr, "a loop of passes with a runtime bound", help)),
                    },
                    None => Ok(None),
                };
                let (Some(start), Some(end)) = (bound(&range.start)?, bound(&range.end)?) else {
                    return Err(refused(self.file, range, "a range without an end", help));
                };
                let end = match range.limits {
                    syn::RangeLimits::Closed(_) => end.saturating_add(1),
                    syn::RangeLimits::HalfOpen(_) => end,
                };
                if end.saturating_sub(start) > MOST_STEPS as i64 {
                    return Err(refused(
                        self.file,
                        range,
                        format!("more than {MOST_STEPS} iterations"),
                        help,
                    ));
                }
                Ok((start..end).map(Value::Integer).collect())
            }
            syn::Expr::MethodCall(call) if call.method == "rev" && call.args.is_empty() => {
                let mut items = self.iterated(&call.receiver)?;
                items.reverse();
                Ok(items)
            }
            syn::Expr::MethodCall(call) if call.method == "step_by" && call.args.len() == 1 => {
                let items = self.iterated(&call.receiver)?;
                match self.known(&call.args[0])? {
                    Some(Value::Integer(step)) if step > 0 => Ok(items.into_iter().step_by(step as usize).collect()),
                    _ => Err(refused(
                        self.file,
                        &call.args[0],
                        "a step that is not a positive integer",
                        help,
                    )),
                }
            }
            expr => match self.known(expr)? {
                Some(Value::Images(images)) => Ok(images.into_iter().map(Value::Image).collect()),
                _ => Err(refused(self.file, expr, "a loop over this", help)),
            },
        }
    }
}
