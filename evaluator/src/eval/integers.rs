//! Integer methods, with the meaning of Rust's.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type, UnaryOp};

/// Methods that count or turn bits.
pub fn bits(name: &str) -> Option<UnaryOp> {
    Some(match name {
        "count_ones" => UnaryOp::CountOneBits,
        "reverse_bits" => UnaryOp::ReverseBits,
        "leading_zeros" => UnaryOp::LeadingZeros,
        "trailing_zeros" => UnaryOp::TrailingZeros,
        _ => return None,
    })
}

impl Evaluator<'_> {
    /// A method of two integers.
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
                            .constant(Type::scalar(ty.kind().unwrap_or(Scalar::I32)), [1, 0, 0, 0]);
                        let one = self.splat(one, ty.components());
                        let times = |e: &mut Self, power, _| e.builder.add(Op::Binary(BinaryOp::Mul), [power, x], ty);
                        Ok(Some((0..n).fold(one, |power, k| times(self, power, k))))
                    }
                    _ => Err(
                        Diagnostic::at(span, "the power of `pow` must be a compile-time constant from 0 to 31")
                            .label("a runtime value, or another number")
                            .help("multiply in a loop")
                            .into(),
                    ),
                };
            }
            // ((x % n) + n) % n, which for a positive n is what Rust computes.
            _ => {
                let Some(n) = self.known_int(a).filter(|n| *n > 0) else {
                    return Err(Diagnostic::at(span, "`rem_euclid` needs a known divisor above 0").into());
                };
                let n = self.int_node(n, ty.kind().unwrap_or(Scalar::I32), span)?;
                let n = self.splat(n, ty.components());
                let rest = self.builder.add(Op::Binary(BinaryOp::Rem), [x, n], ty);
                let up = self.builder.add(Op::Binary(BinaryOp::Add), [rest, n], ty);
                return Ok(Some(self.builder.add(Op::Binary(BinaryOp::Rem), [up, n], ty)));
            }
        };
        // A known receiver is a node by now: known integers do not wrap.
        let receiver = match receiver {
            Value::Int(_) => Value::Node(x),
            other => other.clone(),
        };
        let value = self.binary(op, &receiver, a, span)?;
        self.node(&value, span).map(Some)
    }
}
