//! Assignment to variables and their parts.

use super::Evaluator;
use super::expr::{component_index, out_of_range};
use super::value::{Eval, Exit, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Expr, ExprKind};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type};
use std::rc::Rc;

impl Evaluator<'_> {
    /// Evaluates `place = value` or `place op= value`. As in Rust, the value is evaluated before the place.
    pub fn eval_assign(&mut self, target: &Expr, op: Option<BinaryOp>, value: &Expr, span: Span) -> Eval {
        let mut value = self.eval_expr(value)?;
        let Some(mut place) = self.written_place(target)? else {
            return Err(not_a_place(target).into());
        };
        if let Some(op) = op {
            // `reference.x += 1.0` and `*reference += 1.0` have the same form by now; `vector += ...` of a `&mut
            // self` does not.
            place = self.follow_references(place, target.span)?;
            let old = self.read_place(&place, target.span)?;
            let right = self.deref_value(value, span)?;
            if self.assigned_by_trait(op, &place, &right, span)? {
                return Ok(Value::unit());
            }
            value = self.eval_binary(op, &old, &right, span)?;
        }
        self.write_place(&place, value, span)?;
        Ok(Value::unit())
    }

    /// Returns `old` with the part at `path` replaced.
    pub fn replace_part(&mut self, old: Value, path: &[Step], new: Value, span: Span) -> Eval {
        let Some((step, rest)) = path.split_first() else {
            return Ok(new);
        };
        match (old, step) {
            (Value::Struct { ty, mut fields }, Step::Field(name)) => {
                match Rc::make_mut(&mut fields).iter_mut().find(|(field, _)| field == name) {
                    Some((_, slot)) => {
                        *slot = self.replace_part(std::mem::replace(slot, Value::Poison), rest, new, span)?
                    }
                    None => {
                        return Err(Diagnostic::error_at(
                            Code::UnknownField,
                            span,
                            format!("`{ty}` has no field `{name}`"),
                        )
                        .into());
                    }
                }
                Ok(Value::Struct { ty, fields })
            }
            (Value::Tuple(mut parts), Step::Field(name)) => {
                match name.parse::<usize>().ok().and_then(|k| parts.get_mut(k)) {
                    Some(slot) => *slot = self.replace_part(std::mem::replace(slot, Value::Poison), rest, new, span)?,
                    None => {
                        return Err(Diagnostic::error_at(
                            Code::UnknownField,
                            span,
                            format!("a tuple has no `.{name}`"),
                        )
                        .into());
                    }
                }
                Ok(Value::Tuple(parts))
            }
            (Value::Enum(mut choice), Step::VariantField(k, name)) => {
                let held = Rc::make_mut(&mut choice).variants.get_mut(*k).and_then(Option::as_mut);
                match held.and_then(|fields| fields.iter_mut().find(|(field, _)| field == name)) {
                    Some((_, slot)) => {
                        *slot = self.replace_part(std::mem::replace(slot, Value::Poison), rest, new, span)?
                    }
                    None => {
                        return Err(Diagnostic::error_at(
                            Code::UnknownField,
                            span,
                            format!("the variant has no field `{name}`"),
                        )
                        .into());
                    }
                }
                Ok(Value::Enum(choice))
            }
            (Value::Array(mut elements), Step::Index(index)) if self.known_int(index).is_some() => {
                let (len, k) = (elements.len(), self.known_int(index).unwrap_or(-1));
                match usize::try_from(k).ok().filter(|k| *k < len) {
                    Some(k) => {
                        if Rc::strong_count(&elements) > 1 {
                            self.count_copy(len, span)?;
                        }
                        let slot = &mut Rc::make_mut(&mut elements)[k];
                        *slot = self.replace_part(std::mem::replace(slot, Value::Poison), rest, new, span)?;
                    }
                    None => return Err(out_of_range(k, len, span).into()),
                }
                Ok(Value::Array(elements))
            }
            (old, Step::Slice { from, len }) => self.replace_in_slice(old, (*from, *len), rest, new, span),
            // A vector is temporarily an array of its components.
            (Value::Node(id), Step::Index(_)) if !self.ty(id).is_array() && self.ty(id).component_count() > 1 => {
                let (kind, lanes) = (
                    self.ty(id).scalar_kind().unwrap_or(Scalar::F32),
                    self.ty(id).component_count(),
                );
                let parts = self.vector_components(id).into_iter().map(Value::Node).collect();
                let parts = self.replace_part(Value::array(parts), path, new, span)?;
                let parts = self.array_elements(&parts, usize::from(lanes), span)?;
                self.compose_vector(kind, lanes, &parts, span)
            }
            (old @ (Value::Array(_) | Value::Table(_) | Value::Node(_)), Step::Index(index)) => {
                self.set_element(&old, index, rest, new, span)
            }
            (Value::Node(id), Step::Field(name)) => self.set_lane(id, name, &new, span),
            (Value::Poison, _) => Err(Exit::Noted),
            (other, _) => Err(Diagnostic::error_at(
                Code::UnknownField,
                span,
                format!("{} has no such part", other.describe()),
            )
            .into()),
        }
    }

    /// Replaces an element at a runtime index.
    fn set_element(&mut self, old: &Value, index: &Value, rest: &[Step], new: Value, span: Span) -> Eval {
        if self.is_tabled(old) {
            let node = self.index_node(index, span)?;
            let tabled = self.tabled(old, span);
            return match self.demand_on_error(&[node], tabled)? {
                Value::Table(table) => self.set_in_table(&table, index, rest, new, span),
                array => self.set_element(&array, index, rest, new, span),
            };
        }
        let current = self.array_element(old, index, span)?;
        let element = self.replace_part(current.clone(), rest, new, span)?;
        let array = self.array_node(old, span)?;
        let index = self.index_node(index, span)?;
        let (element, _) = self.same_type(&element, &current, span)?;
        let ty = self.ty(array);
        Ok(Value::Node(self.builder.add(Op::ArraySet, [array, index, element], ty)))
    }

    fn set_lane(&mut self, vector: NodeId, name: &str, new: &Value, span: Span) -> Eval {
        let ty = self.ty(vector);
        let part = Type::value(ty.scalar_kind().unwrap_or(Scalar::F32), 1);
        let Some(changed) = component_index(name).filter(|k| *k < ty.component_count() && ty.component_count() > 1)
        else {
            return Err(Diagnostic::error_at(
                Code::UnknownField,
                span,
                format!("a {} has no field `{name}`", ty.in_rust()),
            )
            .label("not there")
            .help("vectors have x, y, z and w")
            .into());
        };
        let mut lanes = Vec::new();
        for k in 0..ty.component_count() {
            let old = self.builder.add(Op::Extract(k), [vector], part);
            lanes.push(if k == changed {
                self.same_type(new, &Value::Node(old), span)?.0
            } else {
                old
            });
        }
        Ok(Value::Node(self.builder.add(Op::Compose, lanes, ty)))
    }
}

fn not_a_place(target: &Expr) -> Diagnostic {
    if let ExprKind::Path(path) = &target.kind {
        return Diagnostic::error_at(
            Code::UnknownName,
            target.span,
            format!("there is no variable `{}`", path.join("::")),
        );
    }
    Diagnostic::error_at(Code::Immutable, target.span, "this cannot be assigned to")
        .label("not a variable")
        .help("assign to a variable, a field or an element")
}
