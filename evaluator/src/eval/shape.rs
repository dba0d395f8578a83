//! Conversion of values to and from lists of nodes, to pass them into and out of structured loops and branches.

use super::Evaluator;
use super::enums::Tag;
use super::value::{Eval, Table, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{NodeId, Op, Scalar, Type};
use std::rc::Rc;

impl Value {
    /// Appends the nodes of a settled value, in order.
    pub fn flatten(&self, out: &mut Vec<NodeId>) {
        match self {
            Value::Node(id) | Value::OneOf(id, _) => out.push(*id),
            Value::Struct { fields, .. } => fields.iter().for_each(|(_, field)| field.flatten(out)),
            Value::Tuple(parts) => parts.iter().for_each(|part| part.flatten(out)),
            Value::Array(parts) => parts.iter().for_each(|part| part.flatten(out)),
            Value::Table(table) => {
                table.element.flatten(out);
                out.extend(table.from);
            }
            Value::Enum(choice) => {
                if let Tag::Node(id) = choice.tag {
                    out.push(id);
                }
                choice.all_fields().for_each(|(_, value)| value.flatten(out));
            }
            _ => {}
        }
    }

    /// Returns a value of the same shape with other nodes.
    pub fn unflatten(&self, nodes: &mut impl Iterator<Item = NodeId>) -> Value {
        match self {
            Value::Node(id) => Value::Node(nodes.next().unwrap_or(*id)),
            Value::OneOf(id, all) => Value::OneOf(nodes.next().unwrap_or(*id), Rc::clone(all)),
            Value::Struct { ty, fields } => {
                let fields = fields
                    .iter()
                    .map(|(name, field)| (name.clone(), field.unflatten(nodes)));
                Value::structure(ty.clone(), fields.collect())
            }
            Value::Tuple(parts) => Value::Tuple(parts.iter().map(|p| p.unflatten(nodes)).collect()),
            Value::Array(parts) => Value::array(parts.iter().map(|p| p.unflatten(nodes)).collect()),
            Value::Table(table) => Value::Table(Rc::new(Table {
                len: table.len,
                element: table.element.unflatten(nodes),
                from: table.from.map(|from| nodes.next().unwrap_or(from)),
            })),
            Value::Enum(choice) => {
                let tag = match choice.tag {
                    Tag::Node(id) => Tag::Node(nodes.next().unwrap_or(id)),
                    known => known,
                };
                let mut changed = choice.with_fields(|value| value.unflatten(nodes));
                changed.tag = tag;
                Value::Enum(Rc::new(changed))
            }
            other => other.clone(),
        }
    }
}

impl Evaluator<'_> {
    /// Returns the value with every integer and every array of numbers as one node, the form that a structured loop
    /// needs. A short array of structures, tuples or arrays stays a list of its elements, so that constant indices
    /// select variables.
    pub fn make_runtime_form(&mut self, value: &Value, span: Span) -> Eval {
        Ok(match value {
            Value::Int(n) => Value::Node(self.int_node(*n, Scalar::Usize, span)?),
            Value::Struct { ty, fields } => {
                let mut settled = Vec::new();
                for (name, field) in fields.iter() {
                    settled.push((name.clone(), self.make_runtime_form(field, span)?));
                }
                Value::structure(ty.clone(), settled)
            }
            Value::Tuple(parts) => {
                let parts: Eval<Vec<Value>> = parts.iter().map(|p| self.make_runtime_form(p, span)).collect();
                Value::Tuple(parts?)
            }
            Value::Array(elements) if self.is_tabled(value) => {
                if value.count_parts(MAX_VARIABLES) > MAX_VARIABLES {
                    return self.tabled(value, span);
                }
                let settled = elements.iter().map(|element| self.make_runtime_form(element, span));
                Value::array(settled.collect::<Eval<_>>()?)
            }
            Value::Array(_) => Value::Node(self.array_node(value, span)?),
            Value::Table(_) => self.tabled(value, span)?,
            Value::Enum(choice) => {
                let mut settled = (**choice).clone();
                for (_, value) in settled.variants.iter_mut().flatten().flatten() {
                    *value = self.make_runtime_form(value, span)?;
                }
                settled.tag = Tag::Node(self.tag_node(choice));
                Value::Enum(Rc::new(settled))
            }
            other => other.clone(),
        })
    }

    /// Returns an array as one node, so that it can be indexed at run time.
    pub fn array_node(&mut self, value: &Value, span: Span) -> Eval<NodeId> {
        let elements = match value {
            Value::Node(id) if self.ty(*id).is_array() => return Ok(*id),
            Value::Array(elements) if !elements.is_empty() => elements.to_vec(),
            Value::Elements(_) => {
                return Err(Diagnostic::error_at(
                    Code::TypeNeeded,
                    span,
                    "the length of this array is not known: no type states it",
                )
                .label("of which length?")
                .help("state the type of its variable: `let list: [f32; 4] = ...`")
                .into());
            }
            other => {
                return Err(Diagnostic::error_at(
                    Code::IndexType,
                    span,
                    format!("{} cannot be indexed", other.describe()),
                )
                .into());
            }
        };
        if elements.len() > MAX_INDEXED {
            return Err(too_many_elements(elements.len(), span).into());
        }
        let mut nodes = Vec::new();
        for element in &elements {
            match element {
                Value::Int(_) | Value::Node(_) => nodes.push(self.value_node(element, span)?),
                other => return Err(not_indexed(other, span).into()),
            }
        }
        let element = self.ty(nodes[0]);
        match element {
            Type::Value {
                scalar,
                components: lanes,
            } if nodes.iter().all(|n| self.ty(*n) == element) => {
                let ty = Type::Array {
                    scalar,
                    components: lanes,
                    len: nodes.len() as u32,
                };
                Ok(self.builder.add(Op::MakeArray, nodes, ty))
            }
            _ => Err(Diagnostic::error_at(
                Code::RuntimeIndex,
                span,
                "an array of arrays, or of unlike elements, cannot be indexed at run time",
            )
            .help("unroll the loop, or use one flat array")
            .into()),
        }
    }

    /// Returns two values in one shape; an integer takes the type of the other side.
    pub fn unify_values(&mut self, a: &Value, b: &Value, span: Span) -> Eval<(Value, Value)> {
        Ok(match (a, b) {
            _ if a == b => (a.clone(), b.clone()),
            (Value::Int(_) | Value::Node(_), Value::Int(_) | Value::Node(_)) => {
                let (a, b) = self.same_type(a, b, span)?;
                (Value::Node(a), Value::Node(b))
            }
            (Value::Node(id), Value::Array(_)) if self.ty(*id).is_array() => {
                (a.clone(), Value::Node(self.array_node(b, span)?))
            }
            (Value::Array(_), Value::Node(id)) if self.ty(*id).is_array() => {
                (Value::Node(self.array_node(a, span)?), b.clone())
            }
            (
                Value::Struct { ty, fields: left },
                Value::Struct {
                    ty: other,
                    fields: right,
                },
            ) if ty == other => {
                let (mut l, mut r) = (Vec::new(), Vec::new());
                for ((name, a), (_, b)) in left.iter().zip(right.iter()) {
                    let (a, b) = self.unify_values(a, b, span)?;
                    l.push((name.clone(), a));
                    r.push((name.clone(), b));
                }
                (Value::structure(ty.clone(), l), Value::structure(ty.clone(), r))
            }
            (Value::Table(_), _) | (_, Value::Table(_))
                if self.array_len(a).is_some() && self.array_len(a) == self.array_len(b) =>
            {
                return self.unify_tables(a, b, span);
            }
            (Value::Tuple(left), Value::Tuple(right)) if left.len() == right.len() => {
                let (l, r) = self.agree_all(left, right, span)?;
                (Value::Tuple(l), Value::Tuple(r))
            }
            (Value::Array(left), Value::Array(right)) if left.len() == right.len() => {
                let (l, r) = self.agree_all(left, right, span)?;
                (Value::array(l), Value::array(r))
            }
            (a, b) if self.are_objects(a, b) => return self.unify_objects(a, b, span),
            (Value::Enum(left), Value::Enum(right)) if left.ty == right.ty => {
                return self.agree_choices(left, right, span);
            }
            (a, b) if a.is_called() && b.is_called() => self.one_of(a, b),
            (Value::Undef, other) => (self.undef_like(other), other.clone()),
            (other, Value::Undef) => (other.clone(), self.undef_like(other)),
            // A variable assigned on one side only is unset afterwards.
            (Value::Unset, _) | (_, Value::Unset) => (Value::Unset, Value::Unset),
            (Value::Ref(_), Value::Ref(_)) => {
                return Err(Diagnostic::error_at(
                    Code::MutableReference,
                    span,
                    "a mutable reference to one variable or another, by a runtime condition",
                )
                .label("which of them is not known")
                .help("write to each of the variables under the condition")
                .into());
            }
            (Value::Poison, _) | (_, Value::Poison) => return Err(super::Exit::Noted),
            _ => {
                return Err(Diagnostic::error_at(
                    Code::UnlikeValues,
                    span,
                    format!(
                        "{} on one side and {} on the other of a runtime condition",
                        a.describe(),
                        b.describe()
                    ),
                )
                .help("let both sides give numbers, or make the condition depend on options and loop counters only")
                .into());
            }
        })
    }

    fn agree_all(&mut self, left: &[Value], right: &[Value], span: Span) -> Eval<(Vec<Value>, Vec<Value>)> {
        let pairs: Eval<Vec<_>> = left
            .iter()
            .zip(right)
            .map(|(a, b)| self.unify_values(a, b, span))
            .collect();
        Ok(pairs?.into_iter().unzip())
    }
}

/// Upper limit for the elements of an array that is one value of a shader: a SPIR-V instruction has at most 65535
/// words.
pub const MAX_INDEXED: usize = 65_000;

/// Upper limit for the numbers in an array of structures, tuples or arrays that a loop carries as separate variables.
const MAX_VARIABLES: usize = 48;

/// Returns an error for an array with too many elements for a shader variable.
pub fn too_many_elements(count: usize, span: Span) -> Diagnostic {
    Diagnostic::error_at(
        Code::TooLarge,
        span,
        format!("an array of {count} elements is indexed at run time, or changed in a loop"),
    )
    .label(format!("more than {MAX_INDEXED}"))
    .help("read it from a `&Buffer`, or unroll the loop")
}

/// Returns an error for an array whose elements no shader can select by a runtime index.
pub fn not_indexed(element: &Value, span: Span) -> Diagnostic {
    let elements = match element {
        Value::Texture(_) => "textures".to_owned(),
        Value::Sampler(_) => "samplers".to_owned(),
        Value::Buffer(_) => "buffers".to_owned(),
        Value::Ref(_) => "mutable references".to_owned(),
        other => other.describe(),
    };
    Diagnostic::error_at(
        Code::RuntimeIndex,
        span,
        format!("an array of {elements} cannot be indexed at run time"),
    )
    .label("the index is a runtime value")
    .help("unroll the loop, or choose by a `match`: `match k { 0 => a.load(p), _ => b.load(p) }`")
}

/// `true` if two settled values differ only in their nodes.
pub fn same_shape(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Node(_), Value::Node(_)) => true,
        (Value::OneOf(_, all), Value::OneOf(_, others)) => all == others,
        (
            Value::Struct { ty, fields },
            Value::Struct {
                ty: other,
                fields: others,
            },
        ) => {
            ty == other
                && fields
                    .iter()
                    .zip(others.iter())
                    .all(|((_, a), (_, b))| same_shape(a, b))
        }
        (Value::Tuple(a), Value::Tuple(b)) => all_same(a, b),
        (Value::Array(a), Value::Array(b)) => all_same(a, b),
        (Value::Table(a), Value::Table(b)) => {
            a.len == b.len && a.from.is_some() == b.from.is_some() && same_shape(&a.element, &b.element)
        }
        (Value::Enum(a), Value::Enum(b)) => {
            let tags = match (a.tag, b.tag) {
                (Tag::Node(_), Tag::Node(_)) => true,
                (a, b) => a == b,
            };
            a.ty == b.ty
                && tags
                && a.variants.iter().zip(&b.variants).all(|pair| match pair {
                    (Some(a), Some(b)) => a.iter().zip(b).all(|((_, a), (_, b))| same_shape(a, b)),
                    (a, b) => a.is_none() && b.is_none(),
                })
        }
        _ => a == b,
    }
}

fn all_same(a: &[Value], b: &[Value]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same_shape(a, b))
}
