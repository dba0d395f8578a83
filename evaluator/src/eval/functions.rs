//! Float functions of the prelude.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type, UnaryOp};

impl Evaluator<'_> {
    /// Evaluates a prelude function; `None` if there is none with this name.
    pub fn eval_prelude_call(&mut self, name: &str, values: &[Value], span: Span) -> Eval<Option<Value>> {
        let unary = match name {
            "fract" => Some(UnaryOp::Fract),
            "round" => Some(UnaryOp::Round),
            "sign" => Some(UnaryOp::Sign),
            "inverse_sqrt" => Some(UnaryOp::InverseSqrt),
            _ => None,
        };
        match (name, values) {
            (_, [x]) if unary.is_some() => {
                let x = self.float_node(x, name, span)?;
                let ty = self.ty(x);
                let op = unary.unwrap_or(UnaryOp::Fract);
                Ok(Some(Value::Node(self.builder.add(Op::Unary(op), [x], ty))))
            }
            ("saturate", [x]) => {
                let x = self.float_node(x, name, span)?;
                Ok(Some(Value::Node(self.build_saturate(x))))
            }
            ("mix", [from, to, amount]) => {
                self.float_node(from, name, span)?;
                self.eval_mix(from, to, amount, span).map(Some)
            }
            ("step", [edge, x]) => {
                let (edge, x) = (self.float_node(edge, name, span)?, self.float_node(x, name, span)?);
                let below = self.builder.add(Op::Binary(BinaryOp::Lt), [x, edge], Type::BOOL);
                let (zero, one) = (self.builder.f32(0.0), self.builder.f32(1.0));
                let chosen = self.builder.add(Op::Select, [below, zero, one], Type::F32);
                Ok(Some(Value::Node(chosen)))
            }
            ("smoothstep", [low, high, x]) => {
                let width = self.eval_binary(BinaryOp::Sub, high, low, span)?;
                let from = self.eval_binary(BinaryOp::Sub, x, low, span)?;
                let t = self.eval_binary(BinaryOp::Div, &from, &width, span)?;
                let t = self.float_node(&t, name, span)?;
                let t = Value::Node(self.build_saturate(t));
                let (two, three) = (Value::Node(self.builder.f32(2.0)), Value::Node(self.builder.f32(3.0)));
                let twice = self.eval_binary(BinaryOp::Mul, &two, &t, span)?;
                let rest = self.eval_binary(BinaryOp::Sub, &three, &twice, span)?;
                let square = self.eval_binary(BinaryOp::Mul, &t, &t, span)?;
                self.eval_binary(BinaryOp::Mul, &square, &rest, span).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// Rejects constant bounds of `clamp` that are swapped: Rust panics on them, and Tint rejects them.
    pub(super) fn in_order(&self, low: NodeId, high: NodeId, span: Span) -> Eval<()> {
        let graph = self.builder.graph();
        let (Some(least), Some(most)) = (graph.constant_bits(low), graph.constant_bits(high)) else {
            return Ok(());
        };
        let ty = graph.ty(low);
        let ordered = |(a, b): (u32, u32)| match ty.scalar_kind() {
            Some(Scalar::F32) => f32::from_bits(a) <= f32::from_bits(b),
            Some(Scalar::I32) => a as i32 <= b as i32,
            _ => a <= b,
        };
        let lanes = usize::from(ty.component_count());
        if least.into_iter().zip(most).take(lanes).all(ordered) {
            return Ok(());
        }
        Err(
            Diagnostic::error_at(Code::Panic, span, "the bounds of `clamp` are the wrong way round")
                .label("the first is not at most the second, and Rust panics here")
                .help("give the smaller bound first: `x.clamp(low, high)`")
                .into(),
        )
    }

    fn build_saturate(&mut self, x: NodeId) -> NodeId {
        let ty = self.ty(x);
        self.builder.add(Op::Unary(UnaryOp::Saturate), [x], ty)
    }

    fn float_node(&mut self, value: &Value, name: &str, span: Span) -> Eval<NodeId> {
        let id = self.value_node(value, span)?;
        if self.ty(id).is_float() {
            return Ok(id);
        }
        let found = self.ty(id).in_rust();
        Err(Diagnostic::error_at(
            Code::MismatchedTypes,
            span,
            format!("`{name}` takes floats, not {found}"),
        )
        .label("not a float")
        .help("convert with `as f32`")
        .into())
    }
}
