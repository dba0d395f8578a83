//! Closures and functions as values. They are inlined at each call.
//!
//! A closure that only reads a variable captures its value where the closure is created; Rust guarantees that it does not
//! change while the closure lives. A closure that writes a variable captures its place.

use super::Evaluator;
use super::control::Tail;
use super::report::MAX_CALLS;
use super::value::{Captured, ClosureValue, Eval, Exit, Jump, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Block, Closure};
use crate::front::{mentioned_in, scan_effects};
use crate::ir::{BinaryOp, NodeId, Op, Type};
use std::collections::BTreeSet;
use std::rc::Rc;
use std::sync::Arc;

impl Evaluator<'_> {
    /// Evaluates a closure expression and captures the variables that it mentions.
    pub fn eval_closure(&mut self, code: &Arc<Closure>, span: Span) -> Eval {
        let body = Block {
            statements: Vec::new(),
            value: Some(Box::new(code.body.clone())),
            exact: false,
        };
        let written = scan_effects(&body, &self.library.mutating).assigned;
        let mut names = BTreeSet::new();
        mentioned_in(&code.body, &mut names);
        let mut captured = Vec::new();
        for name in names {
            let Some(slot) = self.scope.find_slot(&name) else {
                continue;
            };
            let value = self.scope.name_and_value(slot).1.clone();
            let is_written = written.contains(&name) && !matches!(value, Value::Ref(_));
            let capture = match value {
                Value::Alias(place) if is_written => Captured::Place(place),
                Value::Alias(place) => Captured::Value(self.read_place(&place, span)?),
                _ if is_written && code.moves => {
                    return Err(Diagnostic::error_at(
                        Code::NotInLanguage,
                        span,
                        format!("a `move` closure that changes its own `{name}`"),
                    )
                    .label("not supported")
                    .help("leave out `move`, so that it changes the variable around it")
                    .into());
                }
                _ if is_written => Captured::Place(Rc::new(self.scope.slot_place(slot))),
                value => Captured::Value(value),
            };
            captured.push((name, capture));
        }
        Ok(Value::Closure(Rc::new(ClosureValue {
            code: Arc::clone(code),
            captured,
            function: self.report.function().into_owned(),
        })))
    }

    /// Calls the value of a variable: a closure, or a function named by its path.
    pub fn call_value(&mut self, callee: &Value, args: Vec<Value>, span: Span) -> Eval {
        let closed = match callee {
            Value::Closure(closed) => Rc::clone(closed),
            Value::Function(path) => {
                // A function of a trait is that of its first argument's type.
                let resolved = self.resolve_path(path, &args, span)?;
                return self.call_path(resolved.as_ref().unwrap_or(path), &[], args, span);
            }
            Value::OneOf(number, all) => return self.invoke_one(*number, all, 0, args, span),
            Value::Poison => return Err(Exit::Noted),
            other => {
                return Err(Diagnostic::error_at(
                    Code::NotAFunction,
                    span,
                    format!("{} cannot be called", other.describe()),
                )
                .label("not a function")
                .into());
            }
        };
        let (wanted, given) = (closed.code.params.len(), args.len());
        if wanted != given {
            let plural = if wanted == 1 { "" } else { "s" };
            return Err(Diagnostic::error_at(
                Code::ArgumentCount,
                span,
                format!("this closure takes {wanted} argument{plural}, not {given}"),
            )
            .label("called here")
            .into());
        }
        if self.report.is_too_deep() {
            return Err(Diagnostic::error_at(
                Code::Recursion,
                span,
                format!("calls are nested more than {MAX_CALLS} deep"),
            )
            .label("recursion that does not end?")
            .into());
        }
        let outer = self.scope.enter_function();
        self.report.enter_call(closed.function.clone());
        let result = self.eval_without_exits(|e| e.closed_body(&closed, args, outer.1, span));
        self.report.leave_call();
        self.scope.leave_function(outer);
        match result {
            Err(exit @ Exit::Left(Jump::Unreachable(_))) => Err(exit),
            Err(Exit::Left(_)) => {
                Err(Diagnostic::error_at(Code::Leaving, span, "`break` or `continue` outside of a loop").into())
            }
            other => other,
        }
    }

    /// Calls one of several functions, starting at position `k`, by a chain of conditions like that of an `if`.
    fn invoke_one(&mut self, number: NodeId, all: &[Value], k: usize, args: Vec<Value>, span: Span) -> Eval {
        if k + 1 == all.len() {
            return self.call_value(&all[k], args, span);
        }
        let is = self.is_number(number, all.len(), k);
        match self.known_bool(is) {
            Some(true) => self.call_value(&all[k], args, span),
            Some(false) => self.invoke_one(number, all, k + 1, args, span),
            None => {
                let (keep, same) = (self.policy.keeps_branch(None), args.clone());
                self.eval_branch(
                    Tail::Open,
                    is,
                    keep,
                    span,
                    |e| e.call_value(&all[k], args, span),
                    |e| e.invoke_one(number, all, k + 1, same, span),
                )
            }
        }
    }

    /// Represents two functions as numbers into one list, so that a condition can select between them.
    pub fn one_of(&mut self, a: &Value, b: &Value) -> (Value, Value) {
        let mut all: Vec<Value> = Vec::new();
        let each = |value: &Value| match value {
            Value::OneOf(_, all) => all.to_vec(),
            other => vec![other.clone()],
        };
        for value in each(a).into_iter().chain(each(b)) {
            if !all.contains(&value) {
                all.push(value);
            }
        }
        let all = Rc::new(all);
        let mut numbered = |value: &Value| {
            let mut own = each(value)
                .into_iter()
                .map(|one| all.iter().position(|other| *other == one));
            let own: Vec<NodeId> = own
                .by_ref()
                .flatten()
                .map(|k| self.function_number(k, all.len()))
                .collect();
            let mut found = own[own.len() - 1];
            if let Value::OneOf(number, _) = value {
                let ty = self.ty(found);
                for (k, place) in own.iter().enumerate().rev().skip(1) {
                    let is = self.is_number(*number, own.len(), k);
                    found = self.builder.add(Op::Select, [is, *place, found], ty);
                }
            }
            Value::OneOf(found, Rc::clone(&all))
        };
        (numbered(a), numbered(b))
    }

    /// The function at a runtime index of type `i32`; the last one if the index is out of range.
    pub fn called_at(&mut self, elements: &[Value], index: NodeId) -> Value {
        let mut found = elements[elements.len() - 1].clone();
        for (k, element) in elements.iter().enumerate().rev().skip(1) {
            let (yes, no) = match *element == found {
                true => continue,
                false => self.one_of(element, &found),
            };
            let (Value::OneOf(yes, all), Value::OneOf(no, _)) = (yes, no) else {
                continue;
            };
            let place = self.builder.i32(k as i32);
            let is = self.builder.add(Op::Binary(BinaryOp::Eq), [index, place], Type::BOOL);
            let ty = self.ty(yes);
            let number = self.builder.add(Op::Select, [is, yes, no], ty);
            found = Value::OneOf(number, all);
        }
        found
    }

    /// Constant for position `k` in a list of `count` functions.
    fn function_number(&mut self, k: usize, count: usize) -> NodeId {
        match count {
            2 => self.builder.bool(k == 1),
            _ => self.builder.i32(k as i32),
        }
    }

    /// Tests if a function number equals position `k`.
    fn is_number(&mut self, number: NodeId, count: usize, k: usize) -> NodeId {
        match (count, k) {
            (2, 1) => number,
            (2, _) => self.not(number),
            _ => {
                let wanted = self.function_number(k, count);
                let is = Op::Binary(BinaryOp::Eq);
                self.builder.add(is, [number, wanted], Type::BOOL)
            }
        }
    }

    fn closed_body(&mut self, closed: &ClosureValue, args: Vec<Value>, mark: usize, span: Span) -> Eval {
        for (name, captured) in &closed.captured {
            let value = match captured {
                Captured::Value(value) => value.clone(),
                Captured::Place(place) => Value::Alias(Rc::clone(place)),
            };
            self.scope.bind(name, value);
        }
        for ((pattern, ty), value) in closed.code.params.iter().zip(args) {
            let value = self.ascribe_type(value, ty.as_ref(), span)?;
            self.bind_pattern(pattern, value, span)?;
        }
        let outcome = self.expr_in(&closed.code.body, Tail::Function);
        let value = self.merge_exits(0, outcome, mark, &|way| matches!(way, Jump::Return(_)), span)?;
        // A reference to one of the closure's own variables would dangle.
        match &closed.code.result {
            Some(ty) => self.ascribe_type(value, Some(ty), closed.code.body.span),
            None => Ok(value),
        }
    }

    /// Rejects a closure that changes variables where the number or order of calls differs from native execution.
    pub fn only_reads(&self, callee: &Value, method: &str, span: Span) -> Eval<()> {
        match callee.changes_variables() {
            true => Err(Diagnostic::error_at(
                Code::MisplacedWrite,
                span,
                format!("a closure that changes variables, in `{method}`"),
            )
            .label("not supported")
            .note("how often it is called would depend on what takes the values")
            .help("write a `for` loop, or use `fold`")
            .into()),
            false => Ok(()),
        }
    }
}
