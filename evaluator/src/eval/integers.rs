//! Integer methods with Rust's semantics.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type, UnaryOp};

/// Operation of a method that counts or reorders bits.
pub fn bit_method(name: &str) -> Option<UnaryOp> {
    Some(match name {
        "count_ones" => UnaryOp::CountOneBits,
        "reverse_bits" => UnaryOp::ReverseBits,
        "leading_zeros" => UnaryOp::LeadingZeros,
        "trailing_zeros" => UnaryOp::TrailingZeros,
        _ => return None,
    })
}

impl Evaluator<'_> {
    /// Evaluates a method of two integers.
    pub fn integer_two(
        &mut self,
        receiver: &Value,
        x: NodeId,
        name: &str,
        a: &Value,
        span: Span,
    ) -> Eval<Option<NodeId>> {
        let ty = self.ty(x);
        let op = match name {
            "wrapping_add" => BinaryOp::Add,
            "wrapping_sub" => BinaryOp::Sub,
            "wrapping_mul" => BinaryOp::Mul,
            "wrapping_shl" => BinaryOp::Shl,
            "wrapping_shr" => BinaryOp::Shr,
            "pow" => {
                return match self.known_int(a) {
                    Some(n @ 0..=31) => {
                        let one = self
                            .builder
                            .constant(Type::scalar(ty.scalar_kind().unwrap_or(Scalar::I32)), [1, 0, 0, 0]);
                        let one = self.build_splat(one, ty.component_count());
                        let times = |e: &mut Self, power, _| e.builder.add(Op::Binary(BinaryOp::Mul), [power, x], ty);
                        Ok(Some((0..n).fold(one, |power, k| times(self, power, k))))
                    }
                    _ => {
                        let error = Diagnostic::error_at(
                            Code::RuntimeValue,
                            span,
                            "the power of `pow` must be a compile-time constant from 0 to 31",
                        )
                        .label("a runtime value, or another number")
                        .help("multiply in a loop");
                        Err(self.demand_of(&[a], error))
                    }
                };
            }
            _ => return self.build_euclid(receiver, x, name, a, span).map(Some),
        };
        // A constant receiver must be a node here, because untyped integers do not wrap.
        let receiver = match receiver {
            Value::Int(_) => Value::Node(x),
            other => other.clone(),
        };
        let value = self.eval_binary(op, &receiver, a, span)?;
        let found = self.value_node(&value, span)?;
        if op == BinaryOp::Sub {
            self.facts.wrapping.insert(found);
        }
        Ok(Some(found))
    }

    /// Builds `rem_euclid` or `div_euclid`; vectors component by component.
    fn build_euclid(&mut self, receiver: &Value, x: NodeId, name: &str, a: &Value, span: Span) -> Eval<NodeId> {
        let (x, n) = match receiver {
            Value::Int(_) => self.same_type(&Value::Node(x), a, span)?,
            _ => self.same_type(receiver, a, span)?,
        };
        let ty = self.ty(x);
        let op = |op: BinaryOp| Op::Binary(op);
        if ty.scalar_kind() != Some(Scalar::I32) {
            let by = if name == "rem_euclid" {
                BinaryOp::Rem
            } else {
                BinaryOp::Div
            };
            return Ok(self.builder.add(op(by), [x, n], ty));
        }
        let lanes = usize::from(ty.component_count());
        let positive = |bits: [u32; 4]| bits[..lanes].iter().all(|n| *n as i32 > 0);
        let rest = self.builder.add(op(BinaryOp::Rem), [x, n], ty);
        if name == "rem_euclid" && self.builder.graph().constant_bits(n).is_some_and(positive) {
            // ((x % n) + n) % n, which matches Rust for a positive n.
            let up = self.builder.add(op(BinaryOp::Add), [rest, n], ty);
            return Ok(self.builder.add(op(BinaryOp::Rem), [up, n], ty));
        }
        // If the remainder is negative, add |n| to it. The quotient then moves by one: down for a positive n, up for a
        // negative one.
        let whole = self.builder.add(op(BinaryOp::Div), [x, n], ty);
        let mut found = Vec::new();
        for k in 0..ty.component_count() {
            let [rest, n, whole] = [rest, n, whole].map(|id| match lanes {
                1 => id,
                _ => self.builder.add(Op::Extract(k), [id], Type::I32),
            });
            let (zero, one) = (self.builder.i32(0), self.builder.i32(1));
            let below = self.builder.add(op(BinaryOp::Lt), [rest, zero], Type::BOOL);
            let forward = self.builder.add(op(BinaryOp::Gt), [n, zero], Type::BOOL);
            let (from, by, first, second) = match name {
                "rem_euclid" => (rest, n, BinaryOp::Add, BinaryOp::Sub),
                _ => (whole, one, BinaryOp::Sub, BinaryOp::Add),
            };
            let [first, second] = [first, second].map(|by_op| self.builder.add(op(by_op), [from, by], Type::I32));
            let moved = self.builder.add(Op::Select, [forward, first, second], Type::I32);
            found.push(self.builder.add(Op::Select, [below, moved, from], Type::I32));
        }
        Ok(match lanes {
            1 => found[0],
            _ => self.builder.add(Op::Compose, found, ty),
        })
    }
}
