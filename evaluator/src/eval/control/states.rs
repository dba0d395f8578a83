//! Compile-time constants of one state among several.
//!
//! A branch or loop in the shader has one set of results for all its exits. A single state, whether it continues or takes
//! an exit, may know a variable as a constant where the result is a runtime value: after `found = 3`, a `break` leaves with
//! 3. Keeping such constants by state lets an unrolled loop around the branch count its iterations.

use super::departures::SideState;
use crate::eval::Evaluator;
use crate::eval::enums::{EnumValue, Tag};
use crate::eval::scope::Scope;
use crate::eval::value::{Jump, Value};
use crate::ir::{NodeId, Op};
use std::rc::Rc;

impl Evaluator<'_> {
    /// Returns the merged scope as known by the state that takes the exit `way`, or by the continuing state for `None`.
    pub fn in_state(&self, merged: &Scope, states: &[SideState], way: Option<&Jump>) -> Scope {
        let mut scope = merged.clone();
        let states: Vec<&Scope> = states
            .iter()
            .filter(|s| s.matches_jump(way))
            .map(|s| &s.scope)
            .collect();
        if states.is_empty() {
            return scope;
        }
        for slot in 0..merged.len() {
            if states.iter().any(|state| state.len() <= slot) {
                break;
            }
            let joined = merged.name_and_value(slot).1;
            let values: Vec<&Value> = states.iter().map(|state| state.name_and_value(slot).1).collect();
            if let Some(value) = self.refine_from_states(joined, &values) {
                scope.refine_value(slot, value);
            }
        }
        scope
    }

    /// Refines a value with the constants that all of `states` agree on; `None` if they add none.
    pub fn refine_from_states(&self, joined: &Value, states: &[&Value]) -> Option<Value> {
        let (first, others) = states.split_first()?;
        match joined {
            Value::Unset => None,
            // A variable that is set in only some of the states counts as unset.
            _ if states.contains(&&Value::Unset) => Some(Value::Unset),
            _ if shares_storage(joined, first) && others.iter().all(|value| shares_storage(joined, value)) => None,
            Value::Node(id) => {
                let agreed = others.iter().all(|value| value == first);
                let known = match first {
                    Value::Int(_) => true,
                    Value::Node(node) => {
                        self.ty(*node) == self.ty(*id) && self.builder.graph().constant_bits(*node).is_some()
                    }
                    _ => false,
                };
                (agreed && known && joined != *first).then(|| (*first).clone())
            }
            Value::Struct { ty, fields } => {
                let parts: Vec<&Value> = fields.iter().map(|(_, value)| value).collect();
                let refined = self.refined_parts(&parts, states, |value, k| match value {
                    Value::Struct { ty: other, fields } if ty == other => fields.get(k).map(|(_, part)| part),
                    _ => None,
                })?;
                let names = fields.iter().map(|(name, _)| name.clone());
                Some(Value::structure(ty.clone(), names.zip(refined).collect()))
            }
            Value::Tuple(parts) => {
                let parts: Vec<&Value> = parts.iter().collect();
                let refined = self.refined_parts(&parts, states, |value, k| match value {
                    Value::Tuple(parts) => parts.get(k),
                    _ => None,
                });
                refined.map(Value::Tuple)
            }
            Value::Array(parts) => {
                let parts: Vec<&Value> = parts.iter().collect();
                let refined = self.refined_parts(&parts, states, |value, k| match value {
                    Value::Array(parts) => parts.get(k),
                    _ => None,
                });
                refined.map(Value::array)
            }
            Value::Enum(choice) => self.refined_choice(choice, states),
            _ => None,
        }
    }

    /// Refines each part by what the states hold at its position; `None` if no part changes.
    fn refined_parts(
        &self,
        parts: &[&Value],
        states: &[&Value],
        part_of: impl for<'v> Fn(&'v Value, usize) -> Option<&'v Value>,
    ) -> Option<Vec<Value>> {
        let mut any = false;
        let mut refined = Vec::with_capacity(parts.len());
        for (k, part) in parts.iter().enumerate() {
            let of_states: Option<Vec<&Value>> = states.iter().map(|value| part_of(value, k)).collect();
            let better = of_states.and_then(|values| self.refine_from_states(part, &values));
            any |= better.is_some();
            refined.push(better.unwrap_or_else(|| (*part).clone()));
        }
        any.then_some(refined)
    }

    /// Refines an enum value if the states agree on the variant.
    fn refined_choice(&self, joined: &EnumValue, states: &[&Value]) -> Option<Value> {
        let choice_of = |value: &Value| match value {
            Value::Enum(choice) if choice.ty == joined.ty => self.known_variant(choice),
            _ => None,
        };
        let (first, others) = states.split_first()?;
        let variant = choice_of(first)?;
        if others.iter().any(|other| choice_of(other) != Some(variant)) {
            return None;
        }
        let fields = joined.variant_fields(variant)?;
        let parts: Vec<&Value> = fields.iter().map(|(_, value)| value).collect();
        let refined = self.refined_parts(&parts, states, |value, k| match value {
            Value::Enum(choice) => choice.variant_fields(variant)?.get(k).map(|(_, part)| part),
            _ => None,
        });
        if refined.is_none() && self.known_variant(joined) == Some(variant) {
            return None;
        }
        let refined = refined.unwrap_or_else(|| parts.into_iter().cloned().collect());
        let names = fields.iter().map(|(name, _)| name.clone());
        let mut held = vec![None; joined.variants.len()];
        held[variant] = Some(names.zip(refined).collect());
        Some(Value::Enum(Rc::new(EnumValue {
            ty: joined.ty.clone(),
            tag: Tag::Known(variant),
            variants: held,
        })))
    }

    /// Returns whether two scopes hold the same compile-time constants, and no constant where the other holds none.
    /// Compile-time decisions are then the same in both.
    pub fn as_known(&self, a: &Scope, b: &Scope) -> bool {
        a.len() == b.len()
            && (0..a.len()).all(|slot| self.value_as_known(a.name_and_value(slot).1, b.name_and_value(slot).1))
    }

    fn value_as_known(&self, a: &Value, b: &Value) -> bool {
        let all =
            |a: &[Value], b: &[Value]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| self.value_as_known(a, b));
        match (a, b) {
            _ if shares_storage(a, b) => true,
            (Value::Node(a), Value::Node(b)) => self.node_as_known(*a, *b),
            (
                Value::Struct { ty, fields },
                Value::Struct {
                    ty: other,
                    fields: others,
                },
            ) => {
                let mut pairs = fields.iter().zip(others.iter());
                ty == other && pairs.all(|((_, a), (_, b))| self.value_as_known(a, b))
            }
            (Value::Tuple(a), Value::Tuple(b)) => all(a, b),
            (Value::Array(a), Value::Array(b)) => all(a, b),
            (Value::Enum(a), Value::Enum(b)) => {
                let held = |choice: &EnumValue| choice.variants.iter().map(Option::is_some).collect::<Vec<_>>();
                let mut pairs = a.all_fields().zip(b.all_fields());
                a.ty == b.ty
                    && self.known_variant(a) == self.known_variant(b)
                    && held(a) == held(b)
                    && pairs.all(|((_, a), (_, b))| self.value_as_known(a, b))
            }
            _ => a == b,
        }
    }

    fn node_as_known(&self, a: NodeId, b: NodeId) -> bool {
        let graph = self.builder.graph();
        let (x, y) = (graph.node(a), graph.node(b));
        match (&x.op, &y.op) {
            _ if a == b => true,
            // Reading a part of these returns the node it was built from.
            (Op::Compose, Op::Compose) | (Op::MakeArray, Op::MakeArray) => {
                let mut pairs = x.args.iter().zip(y.args.iter());
                x.ty == y.ty && x.args.len() == y.args.len() && pairs.all(|(a, b)| self.node_as_known(*a, *b))
            }
            (Op::Const(_), _) | (_, Op::Const(_)) => false,
            _ => x.ty == y.ty && !x.ty.is_array(),
        }
    }
}

/// Returns whether two values share their storage. A cheap test for equality, with false negatives.
fn shares_storage(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Node(a), Value::Node(b)) => a == b,
        (Value::Int(a), Value::Int(b)) => a == b,
        (Value::Array(a), Value::Array(b)) => Rc::ptr_eq(a, b),
        (Value::Struct { fields: a, .. }, Value::Struct { fields: b, .. }) => Rc::ptr_eq(a, b),
        (Value::Enum(a), Value::Enum(b)) => Rc::ptr_eq(a, b),
        _ => false,
    }
}
