//! `&dyn Trait` with a type chosen by a runtime condition: an enum of all types that implement the kernel's traits.
//!
//! Until a condition chooses, an object is represented by its referent. A method call becomes a chain of conditions,
//! like a `match`.

use super::Evaluator;
use super::control::Tail;
use super::enums::{EnumValue, Tag};
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::Library;
use std::collections::BTreeSet;
use std::rc::Rc;

/// Type of an object; a keyword, so that no enum can have this name.
pub const OBJECT: &str = "dyn";

/// Returns the names of all types that implement the kernel's traits, in the order of an object's variants.
pub fn implementers(library: &Library) -> Vec<&str> {
    let own = library
        .implements
        .iter()
        .filter(|(_, of)| library.traits.contains_key(of));
    let names: BTreeSet<&str> = own.map(|(ty, _)| ty.as_str()).collect();
    names.into_iter().collect()
}

impl Evaluator<'_> {
    /// Returns the position of a value's type among the implementing types.
    fn implementer(&self, value: &Value) -> Option<usize> {
        match self.type_names(value).as_slice() {
            [name] => self.implementers.binary_search(&name.as_str()).ok(),
            _ => None,
        }
    }

    /// `true` if two values are objects, or become objects when a condition chooses one of them.
    pub fn are_objects(&self, a: &Value, b: &Value) -> bool {
        let is_object = |value: &Value| matches!(value, Value::Enum(choice) if choice.ty == OBJECT);
        match (is_object(a), is_object(b)) {
            (true, true) => true,
            (true, false) => self.implementer(b).is_some(),
            (false, true) => self.implementer(a).is_some(),
            (false, false) => match (self.implementer(a), self.implementer(b)) {
                (Some(x), Some(y)) => x != y && self.have_one_trait(x, y),
                _ => false,
            },
        }
    }

    fn have_one_trait(&self, a: usize, b: usize) -> bool {
        let library = self.library;
        let has = |ty: usize, of: &str| {
            let ty = self.implementers[ty].to_owned();
            library.implements.contains(&(ty, of.to_owned()))
        };
        library.traits.keys().any(|of| has(a, of) && has(b, of))
    }

    /// Returns a value as an object.
    fn object(&self, value: &Value) -> Option<Rc<EnumValue>> {
        if let Value::Enum(choice) = value
            && choice.ty == OBJECT
        {
            return Some(Rc::clone(choice));
        }
        let of = self.implementer(value)?;
        let mut held = vec![None; self.implementers.len()];
        held[of] = Some(vec![("0".into(), value.clone())]);
        Some(Rc::new(EnumValue {
            ty: OBJECT.into(),
            tag: Tag::Known(of),
            variants: held,
        }))
    }

    /// Returns two values as objects of one shape.
    pub fn unify_objects(&mut self, a: &Value, b: &Value, span: Span) -> Eval<(Value, Value)> {
        match (self.object(a), self.object(b)) {
            (Some(a), Some(b)) => self.agree_choices(&a, &b, span),
            _ => Err(Exit::Noted),
        }
    }

    /// Calls a method of an object, dispatched by its variant.
    pub fn method_of_object(&mut self, object: &EnumValue, name: &str, args: Vec<Value>, span: Span) -> Eval {
        let mut possible = Vec::new();
        for (k, fields) in object.variants.iter().enumerate() {
            if let Some([(_, value)]) = fields.as_deref() {
                possible.push((k, value.clone()));
            }
        }
        if let Some(known) = self.known_variant(object) {
            possible.retain(|(k, _)| *k == known);
        }
        self.method_of_one(object, &possible, name, args, span)
    }

    fn method_of_one(
        &mut self,
        object: &EnumValue,
        possible: &[(usize, Value)],
        name: &str,
        args: Vec<Value>,
        span: Span,
    ) -> Eval {
        let Some(((k, value), others)) = possible.split_first() else {
            return Err(Exit::Noted);
        };
        if others.is_empty() {
            return self.method_of_held(value, name, args, span);
        }
        let is = self.is_variant(object, *k);
        let (keep, same) = (self.policy.keeps_branch(None), args.clone());
        self.eval_branch(
            Tail::Open,
            is,
            keep,
            span,
            |e| e.method_of_held(value, name, args, span),
            |e| e.method_of_one(object, others, name, same, span),
        )
    }

    fn method_of_held(&mut self, value: &Value, name: &str, args: Vec<Value>, span: Span) -> Eval {
        let own = match self.own_method(value, name) {
            None => self.method_of_trait(value, name, &args, span)?,
            own => own,
        };
        let Some((method, _)) = own else {
            return Err(Diagnostic::error_at(
                Code::UnknownMethod,
                span,
                format!("{} has no method `{name}`", value.describe()),
            )
            .label("called here")
            .into());
        };
        let all = std::iter::once(value.clone()).chain(args).collect();
        self.inline_function(method, &[], all, span)
    }
}
