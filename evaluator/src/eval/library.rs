//! Standard library functions on places, orders and types: `mem::swap`, `cmp::max`, `T::from`.

use super::Evaluator;
use super::call::vector_type;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::IntType;
use crate::ir::{BinaryOp, Op, Scalar, Type};

impl Evaluator<'_> {
    /// Evaluates `mem::swap`, `mem::replace`, `mem::take`, `cmp::max` or `cmp::min`; `None` for any other function.
    pub fn eval_mem_call(&mut self, path: &[String], values: &[Value], span: Span) -> Eval<Option<Value>> {
        let name = path.last().map(String::as_str).unwrap_or_default();
        if let [a, b] = values
            && matches!(name, "max" | "min")
            && (path.len() == 1 || path[path.len() - 2] == "cmp")
        {
            let (a, b) = (self.deref_value(a.clone(), span)?, self.deref_value(b.clone(), span)?);
            if let Some(found) = self.order_method(&a, name, std::slice::from_ref(&b), span)? {
                return Ok(Some(found));
            }
            let op = if name == "min" { BinaryOp::Min } else { BinaryOp::Max };
            return self.eval_binary(op, &a, &b, span).map(Some);
        }
        match (name, values) {
            ("swap", [Value::Ref(a), Value::Ref(b)]) => {
                let (a, b) = (
                    self.follow_references((**a).clone(), span)?,
                    self.follow_references((**b).clone(), span)?,
                );
                let (of_a, of_b) = (self.read_place(&a, span)?, self.read_place(&b, span)?);
                self.write_place(&a, of_b, span)?;
                self.write_place(&b, of_a, span)?;
                Ok(Some(Value::unit()))
            }
            ("replace", [Value::Ref(place), value]) => {
                let place = self.follow_references((**place).clone(), span)?;
                let old = self.read_place(&place, span)?;
                let value = self.deref_value(value.clone(), span)?;
                self.write_place(&place, value, span)?;
                Ok(Some(old))
            }
            ("take", [Value::Ref(place)]) => {
                let place = self.follow_references((**place).clone(), span)?;
                let old = self.read_place(&place, span)?;
                let Value::Node(id) = &old else {
                    let error =
                        Diagnostic::error_at(Code::UnknownFunction, span, "`mem::take` takes numbers and vectors")
                            .label("another type")
                            .help("write `std::mem::replace(&mut x, T::default())`");
                    return Err(error.into());
                };
                let ty = self.ty(*id);
                let zero = self.builder.constant(ty, [0; 4]);
                self.write_place(&place, Value::Node(zero), span)?;
                Ok(Some(old))
            }
            _ => Ok(None),
        }
    }

    /// Evaluates `f32::from(x)`, `u32::from(flag)`, `Vec3::from(array)`, `Vec4::from((vector, w))`; `None` unless `ty` is a
    /// number or a vector.
    pub fn from(&mut self, ty: &str, value: &Value, span: Span) -> Eval<Option<Value>> {
        if let Some((kind, lanes)) = vector_type(ty) {
            let parts = match value {
                Value::Tuple(parts) => parts.clone(),
                Value::Node(id) if self.ty(*id) == Type::value(kind, lanes) => return Ok(Some(value.clone())),
                array => self.array_elements(array, usize::from(lanes), span)?,
            };
            return self.compose_vector(kind, lanes, &parts, span).map(Some);
        }
        let to = match IntType::from_name(ty) {
            Some(kind) => kind.scalar(),
            None if ty == "f32" => Scalar::F32,
            None => return Ok(None),
        };
        if let (Value::Int(_), "usize") = (value, ty) {
            return Ok(Some(value.clone()));
        }
        let id = self.value_node(value, span)?;
        let from = self.ty(id);
        if from == Type::scalar(to) {
            return Ok(Some(Value::Node(id)));
        }
        // Types were checked: only integers of fewer bits and booleans are left.
        if from != Type::BOOL {
            return Ok(Some(Value::Node(self.convert_node(id, to))));
        }
        let whole = self.builder.add(Op::Convert, [id], Type::U32);
        Ok(Some(Value::Node(self.convert_node(whole, to))))
    }
}
