//! Operators and conversions.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{IntType, Type as SourceType};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type, UnaryOp};

impl Evaluator<'_> {
    pub fn eval_unary(&mut self, op: UnaryOp, value: &Value, span: Span) -> Eval {
        if let Some(value) = self.unary_of_trait(op, value, span)? {
            return Ok(value);
        }
        let id = self.value_node(value, span)?;
        let ty = self.ty(id);
        let op = match (op, ty.scalar_kind()) {
            (UnaryOp::Not, Some(Scalar::I32 | Scalar::U32 | Scalar::Usize)) => UnaryOp::BitNot,
            (UnaryOp::Not, Some(Scalar::Bool)) | (UnaryOp::Neg, Some(Scalar::F32 | Scalar::I32)) => op,
            _ => return Err(not_taken(ty, span)),
        };
        Ok(Value::Node(self.builder.add(Op::Unary(op), [id], ty)))
    }

    pub fn eval_binary(&mut self, op: BinaryOp, left: &Value, right: &Value, span: Span) -> Eval {
        if let Some(value) = self.operator_of_trait(op, left, right, span)? {
            return Ok(value);
        }
        match (left, right) {
            (Value::Int(a), Value::Int(b)) => return self.fold_integers(op, *a, *b, span),
            (Value::Struct { ty, .. }, _) | (_, Value::Struct { ty, .. })
                if super::matrix::column_count(ty).is_some() =>
            {
                return match op {
                    BinaryOp::Mul => self.matrix_product(left, right, span),
                    BinaryOp::Add | BinaryOp::Sub => self.by_fields(op, left, right, span),
                    _ => Err(Diagnostic::error_at(
                        Code::OperatorTypes,
                        span,
                        format!("this operator does not take a `{ty}`"),
                    )
                    .into()),
                };
            }
            (Value::Enum(choice), _) if !op.is_comparison() => {
                let ty = &choice.ty;
                return Err(Diagnostic::error_at(
                    Code::OperatorTypes,
                    span,
                    format!("this operator does not take a `{ty}`"),
                )
                .label("not for this type")
                .help("values of enums can be compared")
                .into());
            }
            _ => {}
        }
        if matches!(op, BinaryOp::Eq | BinaryOp::Ne)
            && let Some(same) = self.values_equal(left, right, span)?
        {
            let found = if op == BinaryOp::Eq { same } else { self.not(same) };
            return Ok(Value::Node(found));
        }
        if op.is_comparison()
            && let Some(holds) = self.values_ordered(op, left, right, span)?
        {
            return Ok(Value::Node(holds));
        }
        let (a, b) = match op {
            // The count of a shift may have another integer type.
            BinaryOp::Shl | BinaryOp::Shr => (self.value_node(left, span)?, self.shift_count(left, right, span)?),
            _ => self.same_type(left, right, span)?,
        };
        let ty = self.ty(a);
        let kind = ty.scalar_kind().unwrap_or(Scalar::Bool);
        let fits = match op {
            BinaryOp::And | BinaryOp::Or | BinaryOp::Xor => kind != Scalar::F32,
            BinaryOp::Shl | BinaryOp::Shr => matches!(kind, Scalar::I32 | Scalar::U32 | Scalar::Usize),
            BinaryOp::Eq | BinaryOp::Ne => true,
            _ if ty == Type::BOOL && op.is_comparison() => return Ok(Value::Node(self.ordered_bools(op, a, b))),
            _ => kind != Scalar::Bool,
        };
        if !fits || ty.is_array() {
            return Err(not_taken(ty, span));
        }
        if op.is_comparison() {
            return self.build_comparison(op, a, b);
        }
        Ok(Value::Node(self.builder.add(Op::Binary(op), [a, b], ty)))
    }

    /// Applies an operator to two matrices, column by column.
    fn by_fields(&mut self, op: BinaryOp, left: &Value, right: &Value, span: Span) -> Eval {
        match (left, right) {
            (
                Value::Struct { ty, fields },
                Value::Struct {
                    ty: other,
                    fields: others,
                },
            ) if ty == other => {
                let mut results = Vec::new();
                for ((name, a), (_, b)) in fields.iter().zip(others.iter()) {
                    results.push((name.clone(), self.eval_binary(op, a, b, span)?));
                }
                Ok(Value::structure(ty.clone(), results))
            }
            _ => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} and {} do not go together", left.describe(), right.describe()),
            )
            .into()),
        }
    }

    /// Builds a comparison. Rust compares vectors as a whole.
    fn build_comparison(&mut self, op: BinaryOp, a: NodeId, b: NodeId) -> Eval {
        let lanes = self.ty(a).component_count();
        let each = self
            .builder
            .add(Op::Binary(op), [a, b], Type::value(Scalar::Bool, lanes));
        if lanes == 1 {
            return Ok(Value::Node(each));
        }
        let join = if op == BinaryOp::Ne {
            BinaryOp::Or
        } else {
            BinaryOp::And
        };
        let mut all = self.builder.add(Op::Extract(0), [each], Type::BOOL);
        for k in 1..lanes {
            let next = self.builder.add(Op::Extract(k), [each], Type::BOOL);
            all = self.builder.add(Op::Binary(join), [all, next], Type::BOOL);
        }
        Ok(Value::Node(all))
    }

    fn shift_count(&mut self, left: &Value, right: &Value, span: Span) -> Eval<NodeId> {
        let value = self.value_node(left, span)?;
        let ty = self.ty(value);
        let count = self.value_node(right, span)?;
        let count = self.convert_node(count, ty.scalar_kind().unwrap_or(Scalar::Usize));
        Ok(self.build_splat(count, ty.component_count()))
    }

    /// Evaluates an operation on constants of type `usize`, which has 64 bits at compile time.
    fn fold_integers(&mut self, op: BinaryOp, a: i64, b: i64, span: Span) -> Eval {
        use BinaryOp::*;
        let known = match op {
            Add => a.checked_add(b),
            Sub if b > a => {
                return Err(Diagnostic::error_at(
                    Code::Overflow,
                    span,
                    format!("{a} - {b} is below 0, which no `usize` is"),
                )
                .label("always")
                .help("compute it in i32, and convert the result with `as usize`")
                .into());
            }
            Sub => Some(a - b),
            Mul => a.checked_mul(b),
            Div if b != 0 => Some(a / b),
            Rem if b != 0 => Some(a % b),
            Div | Rem => {
                return Err(divided_by_zero(span));
            }
            Min => Some(a.min(b)),
            Max => Some(a.max(b)),
            And => Some(a & b),
            Or => Some(a | b),
            Xor => Some(a ^ b),
            Shl if (0..64).contains(&b) => Some(a << b).filter(|n| n >> b == a),
            Shr if (0..64).contains(&b) => Some(a >> b),
            Eq | Ne | Lt | Le | Gt | Ge => {
                let holds = match op {
                    Eq => a == b,
                    Ne => a != b,
                    Lt => a < b,
                    Le => a <= b,
                    Gt => a > b,
                    _ => a >= b,
                };
                return Ok(Value::Node(self.builder.bool(holds)));
            }
            _ => None,
        };
        match known {
            Some(n) if n >= 0 => Ok(Value::Int(n)),
            _ => Err(too_large(span)),
        }
    }

    /// Converts both values to nodes of one type: integer literals take the other type, scalars are splatted.
    pub fn same_type(&mut self, left: &Value, right: &Value, span: Span) -> Eval<(NodeId, NodeId)> {
        let (a, b) = match (left, right) {
            (Value::Int(n), Value::Node(id)) => (self.int_of(*n, *id, span)?, *id),
            (Value::Node(id), Value::Int(n)) => (*id, self.int_of(*n, *id, span)?),
            // Inference knows no type here: a literal takes the other's type.
            (Value::Node(a), Value::Node(b)) if self.ty(*a) == Type::USIZE && self.ty(*b) != Type::USIZE => {
                match self.known_int(left) {
                    Some(n) => (self.int_of(n, *b, span)?, *b),
                    None => (*a, *b),
                }
            }
            (Value::Node(a), Value::Node(b)) if self.ty(*b) == Type::USIZE && self.ty(*a) != Type::USIZE => {
                match self.known_int(right) {
                    Some(n) => (*a, self.int_of(n, *a, span)?),
                    None => (*a, *b),
                }
            }
            _ => (self.value_node(left, span)?, self.value_node(right, span)?),
        };
        let (ta, tb) = (self.ty(a), self.ty(b));
        if ta == tb {
            return Ok((a, b));
        }
        if ta.scalar_kind() == tb.scalar_kind() && ta.is_scalar() && !tb.is_array() {
            return Ok((self.build_splat(a, tb.component_count()), b));
        }
        if ta.scalar_kind() == tb.scalar_kind() && tb.is_scalar() && !ta.is_array() {
            return Ok((a, self.build_splat(b, ta.component_count())));
        }
        Err(Diagnostic::error_at(
            Code::MismatchedTypes,
            span,
            format!("{} and {} do not go together", ta.in_rust(), tb.in_rust()),
        )
        .label("two types")
        .help("convert one of them, for example with `as f32` or `.as_vec2()`")
        .into())
    }

    /// Converts a constant integer to the kind of another number.
    fn int_of(&mut self, n: i64, other: NodeId, span: Span) -> Eval<NodeId> {
        let kind = self.ty(other).scalar_kind().unwrap_or(Scalar::Usize);
        self.int_node(n, kind, span)
    }

    /// Repeats a scalar in each of `lanes` components.
    pub fn build_splat(&mut self, id: NodeId, lanes: u8) -> NodeId {
        if lanes == 1 || self.ty(id).component_count() > 1 {
            return id;
        }
        let ty = Type::value(self.ty(id).scalar_kind().unwrap_or(Scalar::F32), lanes);
        self.builder.add(Op::Splat, [id], ty)
    }

    /// Converts a node's components to another kind.
    pub fn convert_node(&mut self, id: NodeId, kind: Scalar) -> NodeId {
        let ty = self.ty(id).with_scalar(kind);
        self.builder.add(Op::Convert, [id], ty)
    }

    /// Evaluates `value as type`.
    pub fn eval_cast(&mut self, value: &Value, ty: &SourceType, span: Span) -> Eval {
        let SourceType::Name(name, _) = ty else {
            if matches!(ty, SourceType::Fn(..)) && value.is_called() {
                return Ok(value.clone());
            }
            return Err(Diagnostic::error_at(Code::Cast, span, "a cast to something that is not a number").into());
        };
        let target = IntType::from_name(name);
        let kind = match target {
            Some(target) => target.scalar(),
            None if name == "f32" => Scalar::F32,
            None => {
                return Err(Diagnostic::error_at(Code::Cast, span, format!("a cast to `{name}`"))
                    .label("not supported")
                    .help("cast to f32, i32, u32 or usize")
                    .into());
            }
        };
        if let Some(target) = target
            && let Some(bits) = target.narrow_bits()
        {
            return self.cast_to_narrow(value, target, bits, span);
        }
        if let Value::Int(n) = value {
            return match kind {
                Scalar::Usize => Ok(value.clone()),
                Scalar::I32 => Ok(Value::Node(self.builder.i32(*n as i32))),
                Scalar::F32 => Ok(Value::Node(self.builder.f32(*n as f32))),
                _ => Ok(Value::Node(self.builder.constant(Type::U32, [*n as u32, 0, 0, 0]))),
            };
        }
        let value = match value {
            Value::Poison => return Err(Exit::Noted),
            Value::Enum(choice) => &self.discriminant_of(choice, span)?,
            other => other,
        };
        let id = self.value_node(value, span)?;
        if !self.ty(id).is_scalar() {
            return Err(
                Diagnostic::error_at(Code::Cast, span, "a cast of something that is not one number")
                    .help("vectors convert with `.as_vec2()`, `.as_ivec3()`, ...")
                    .into(),
            );
        }
        let converted = Value::Node(self.convert_node(id, kind));
        Ok(match self.known_int(&converted) {
            Some(known) if kind == Scalar::Usize => Value::Int(known),
            _ => converted,
        })
    }

    /// Evaluates a cast to an integer of fewer than 32 bits: floats saturate, and integers lose their upper bits.
    fn cast_to_narrow(&mut self, value: &Value, target: IntType, bits: u32, span: Span) -> Eval {
        let wide = Type::scalar(target.scalar());
        let whole = SourceType::Name(wide.in_rust(), Vec::new());
        let converted = self.eval_cast(value, &whole, span)?;
        let id = self.value_node(&converted, span)?;
        let is_float = matches!(value, Value::Node(id) if self.ty(*id).is_float());
        let constant = |e: &mut Self, n: i64| e.builder.constant(wide, [n as u32, 0, 0, 0]);
        if is_float {
            let (least, most) = target.range();
            let (least, most) = (constant(self, least), constant(self, most));
            return Ok(Value::Node(self.builder.add(Op::Clamp, [id, least, most], wide)));
        }
        Ok(Value::Node(if target.scalar() == Scalar::U32 {
            let mask = constant(self, target.range().1);
            self.builder.add(Op::Binary(BinaryOp::And), [id, mask], wide)
        } else {
            let above = constant(self, i64::from(32 - bits));
            let raised = self.builder.add(Op::Binary(BinaryOp::Shl), [id, above], wide);
            self.builder.add(Op::Binary(BinaryOp::Shr), [raised, above], wide)
        }))
    }

    /// Converts an `i32` to the `usize` that it represents.
    pub fn as_usize(&mut self, id: NodeId) -> Value {
        Value::Node(self.convert_node(id, Scalar::Usize))
    }

    /// Converts an index to an `i32` node without clamping. An index that is out of range stays so.
    pub fn index_node(&mut self, value: &Value, span: Span) -> Eval<NodeId> {
        let id = self.value_node(value, span)?;
        match self.ty(id) {
            Type::I32 => Ok(id),
            Type::U32 => Ok(self.convert_node(id, Scalar::I32)),
            Type::USIZE => Ok(self.builder.add(Op::Bitcast, [id], Type::I32)),
            other => Err(Diagnostic::error_at(
                Code::IndexType,
                span,
                format!("an index must be an integer, not {}", other.in_rust()),
            )
            .label("of this index")
            .help("convert it with `as usize`")
            .into()),
        }
    }
}

impl Evaluator<'_> {
    /// Clamps an index to the last of `count` elements. `count` and the result are `i32` nodes. `last` names the node of
    /// the last index.
    pub fn held_index(&mut self, value: &Value, count: NodeId, last: &str, span: Span) -> Eval<NodeId> {
        let id = self.value_node(value, span)?;
        let one = self.builder.i32(1);
        let end = self.builder.add(Op::Binary(BinaryOp::Sub), [count, one], Type::I32);
        if !last.is_empty() {
            self.name_value(&Value::Node(end), last, span);
        }
        if self.ty(id) != Type::USIZE {
            let index = self.index_node(value, span)?;
            let zero = self.builder.i32(0);
            return Ok(self.builder.add(Op::Clamp, [index, zero, end], Type::I32));
        }
        let end = self.convert_node(end, Scalar::Usize);
        let held = self.builder.add(Op::Binary(BinaryOp::Min), [id, end], Type::USIZE);
        Ok(self.convert_node(held, Scalar::I32))
    }
}

fn too_large(span: Span) -> Exit {
    Diagnostic::error_at(
        Code::Overflow,
        span,
        "the result does not fit into a `usize` of a shader",
    )
    .label("too large")
    .help("compute it in u32, with `wrapping_add` and its like where it is to wrap")
    .into()
}

fn divided_by_zero(span: Span) -> Exit {
    Diagnostic::error_at(Code::DivisionByZero, span, "attempt to divide by zero")
        .label("the divisor is always 0")
        .help("only divide where the divisor is not 0: `if n != 0 { ... }`")
        .into()
}

fn not_taken(ty: Type, span: Span) -> Exit {
    let help = match ty.scalar_kind() {
        Some(Scalar::F32) => "floats have + - * / % and comparisons; for their bits use `to_bits()`",
        Some(Scalar::Bool) => "booleans have & | ^ ! && || == and !=",
        _ => "integers have + - * / % & | ^ ! << >> and comparisons",
    };
    Diagnostic::error_at(
        Code::OperatorTypes,
        span,
        format!("this operator does not take {}", ty.in_rust()),
    )
    .label("not for this type")
    .help(help)
    .into()
}
