//! Order of structures, tuples, arrays and enums, as `#[derive(PartialOrd)]` has it.

use super::Evaluator;
use super::enums::EnumValue;
use super::value::{Eval, Value};
use crate::diagnostic::Span;
use crate::ir::{BinaryOp, NodeId, Op, Type};

impl Evaluator<'_> {
    /// Returns the condition that `a op b` holds, for an `op` of `<`, `<=`, `>` and `>=`: by the first parts that differ.
    /// `None` unless the values are structures, tuples, arrays or enums.
    pub fn values_ordered(&mut self, op: BinaryOp, a: &Value, b: &Value, span: Span) -> Eval<Option<NodeId>> {
        if let (Value::Enum(a), Value::Enum(b)) = (a, b)
            && a.ty == b.ty
        {
            return self.ordered_choices(op, a, b, span).map(Some);
        }
        match self.pair_parts(a, b, span)? {
            Some(pairs) => self.ordered_parts(op, pairs, span).map(Some),
            None => Ok(None),
        }
    }

    fn ordered_parts(&mut self, op: BinaryOp, pairs: Vec<(Value, Value)>, span: Span) -> Eval<NodeId> {
        let strict = strict_order(op);
        // Equal values are in order if the operator takes them.
        let mut holds = self.builder.bool(op != strict);
        for (a, b) in pairs.into_iter().rev() {
            if matches!((&a, &b), (Value::Const(_), Value::Const(_))) {
                continue;
            }
            let before = self.eval_binary(strict, &a, &b, span)?;
            let same = self.eval_binary(BinaryOp::Eq, &a, &b, span)?;
            let (before, same) = (self.value_node(&before, span)?, self.value_node(&same, span)?);
            let rest = self.and(same, holds);
            holds = self.or(before, rest);
        }
        Ok(holds)
    }

    /// Variants are in the order of their discriminants, and values of one variant in that of their fields.
    fn ordered_choices(&mut self, op: BinaryOp, a: &EnumValue, b: &EnumValue, span: Span) -> Eval<NodeId> {
        let (first, second) = (self.discriminant_of(a, span)?, self.discriminant_of(b, span)?);
        let before = self.eval_binary(strict_order(op), &first, &second, span)?;
        let mut holds = self.value_node(&before, span)?;
        for (both, pairs) in self.common_variants(a, b) {
            let fields = self.ordered_parts(op, pairs, span)?;
            let same = self.and(both, fields);
            holds = self.or(holds, same);
        }
        Ok(holds)
    }

    /// Compares two booleans: `false` is less than `true`.
    pub fn ordered_bools(&mut self, op: BinaryOp, a: NodeId, b: NodeId) -> NodeId {
        let (less, more) = match op {
            BinaryOp::Lt | BinaryOp::Le => (a, b),
            _ => (b, a),
        };
        let is_false = self.not(less);
        let join = if op == strict_order(op) {
            BinaryOp::And
        } else {
            BinaryOp::Or
        };
        self.builder.add(Op::Binary(join), [is_false, more], Type::BOOL)
    }
}

fn strict_order(op: BinaryOp) -> BinaryOp {
    match op {
        BinaryOp::Le => BinaryOp::Lt,
        BinaryOp::Ge => BinaryOp::Gt,
        other => other,
    }
}
