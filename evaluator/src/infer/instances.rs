//! Calls of functions with type parameters: what the parameters are, and which traits they must have.

use super::Checker;
use super::traits::Bound;
use super::types::Ty;
use crate::diagnostic::Span;
use crate::front::tree::{Expr, ExprKind, Function, Generic, Type};
use std::collections::HashMap;

/// A call of a function with type parameters, and what they are.
pub struct Instance {
    span: Span,
    /// Key of the function.
    key: String,
    /// The types in the order of the parameters; nothing of constants.
    types: Vec<Option<Ty>>,
}

impl<'l> Checker<'l> {
    /// Notes what the type parameters of a call are, and what they have to be.
    pub fn note_instance(&mut self, key: &str, function: &'l Function, given: &HashMap<String, Ty>, span: Span) {
        for (name, traits) in &function.bounds {
            if let Some(ty) = given.get(name) {
                self.bounded.push(Bound {
                    span,
                    ty: ty.clone(),
                    traits: traits.clone(),
                });
            }
        }
        let own = function.params.first();
        if own.is_some_and(|own| own.name == "self" && own.ty.is_mutable_reference()) {
            // The receiver is a place, which a call does not take.
            return;
        }
        // Methods of iterators are called with the list of the values.
        if key.starts_with("Iterator::") {
            return;
        }
        if function
            .generics
            .iter()
            .any(|generic| matches!(generic, Generic::Type(_)))
        {
            let types = function.generics.iter().map(|generic| match generic {
                Generic::Type(name) => given.get(name).cloned(),
                Generic::Const(..) => None,
            });
            self.instances.push(Instance {
                span,
                key: key.to_owned(),
                types: types.collect(),
            });
        }
    }

    /// The types of calls with type parameters, by their places: the key of each function, and the types.
    pub fn named_instances(&mut self) -> HashMap<Span, (String, Vec<Option<Type>>)> {
        let mut named = HashMap::new();
        for Instance { span, key, types } in std::mem::take(&mut self.instances) {
            let types = types.iter().map(|ty| self.written_type(ty.as_ref()?, span));
            named.insert(span, (key, types.collect()));
        }
        named
    }

    /// A type as it is written, with `_` for arguments that are not known; `None` of a type without a name.
    fn written_type(&self, ty: &Ty, span: Span) -> Option<Type> {
        let plain = |name: String| Type::Name(name, Vec::new());
        match self.table.resolve_shallow(ty) {
            Ty::Param(name) => self.params.contains(&name).then(|| plain(name)),
            Ty::Const(value) => {
                let kind = ExprKind::Int(value, None);
                Some(Type::Const(Box::new(Expr { kind, span })))
            }
            Ty::Struct(name, args) => {
                let args = args.iter().map(|arg| self.written_type(arg, span));
                let args = args.map(|arg| arg.unwrap_or_else(|| plain(crate::front::INFERRED.to_owned())));
                Some(Type::Name(name, args.collect()))
            }
            other => self.type_name(&other).map(plain),
        }
    }
}
