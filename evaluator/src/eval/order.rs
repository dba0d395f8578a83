//! Order of structures, tuples, arrays and enums: as `#[derive(PartialOrd)]` has it, or as an `impl` writes it.

use super::Evaluator;
use super::enums::EnumValue;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
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
            if matches!(&a, Value::Const(_) | Value::Type(_)) {
                continue;
            }
            let before = self.eval_binary(strict, &a, &b, span)?;
            let before = self.value_node(&before, span)?;
            let same = self.same_in_order(&a, &b, span)?;
            let rest = self.and(same, holds);
            holds = self.or(before, rest);
        }
        Ok(holds)
    }

    /// Returns the condition that the order of two values is `Equal`. An order that is written by hand need not be that of
    /// `==`.
    fn same_in_order(&mut self, a: &Value, b: &Value, span: Span) -> Eval<NodeId> {
        let by_hand = |(_, of): &(String, String)| of == "PartialOrd";
        if !self.library.implements.iter().any(by_hand) {
            let same = self.eval_binary(BinaryOp::Eq, a, b, span)?;
            return self.value_node(&same, span);
        }
        let below = self.eval_binary(BinaryOp::Le, a, b, span)?;
        let above = self.eval_binary(BinaryOp::Ge, a, b, span)?;
        let (below, above) = (self.value_node(&below, span)?, self.value_node(&above, span)?);
        Ok(self.and(below, above))
    }

    /// Evaluates a comparison by the function that an `impl PartialOrd` has for it; `None` if the type has none.
    pub fn ordered_by_hand(&mut self, op: BinaryOp, left: &Value, right: &Value, span: Span) -> Eval<Option<Value>> {
        let name = match op {
            BinaryOp::Lt => "lt",
            BinaryOp::Le => "le",
            BinaryOp::Gt => "gt",
            _ => "ge",
        };
        let values = || vec![left.clone(), right.clone()];
        let keys = self.keys_of_operator(left, "PartialOrd", name);
        if let Some(key) = self.find_overload(&keys, &values(), span)? {
            return self.inline_function(key, &[], values(), span).map(Some);
        }
        let keys = self.keys_of_operator(left, "PartialOrd", "partial_cmp");
        let Some(key) = self.find_overload(&keys, &values(), span)? else {
            return Ok(None);
        };
        let found = self.inline_function(key, &[], values(), span)?;
        let (holds, order) = self.held_value(&found)?;
        let Value::Enum(order) = order else {
            return Ok(Some(Value::Node(holds)));
        };
        // `Less`, `Equal`, `Greater`.
        let (variant, is_one) = match op {
            BinaryOp::Lt => (0, true),
            BinaryOp::Le => (2, false),
            BinaryOp::Gt => (2, true),
            _ => (0, false),
        };
        let one = self.is_variant(&order, variant);
        let fits = if is_one { one } else { self.not(one) };
        Ok(Some(Value::Node(self.and(holds, fits))))
    }

    /// Evaluates `max`, `min`, `clamp`, `cmp` and `partial_cmp` of what is no number; `None` for other methods.
    pub fn order_method(&mut self, value: &Value, name: &str, args: &[Value], span: Span) -> Eval<Option<Value>> {
        let wanted = match name {
            "max" | "min" | "cmp" | "partial_cmp" => 1,
            "clamp" => 2,
            _ => return Ok(None),
        };
        let whole = match value {
            Value::Struct { .. } | Value::Enum(_) | Value::Tuple(_) | Value::Array(_) | Value::Table(_) => true,
            Value::Node(id) if self.ty(*id) == Type::BOOL => wanted == 1 && name.ends_with("cmp"),
            Value::Node(id) => self.ty(*id).is_array(),
            _ => false,
        };
        if !whole || args.len() != wanted {
            return Ok(None);
        }
        self.check_one_order(value, span)?;
        let mut all = vec![value.clone()];
        all.extend(args.iter().cloned());
        self.inline_function(&format!("__Order::{name}"), &[], all, span)
            .map(Some)
    }

    /// Refuses a type of which one order is derived and the other is written, since they may differ.
    fn check_one_order(&self, value: &Value, span: Span) -> Eval<()> {
        for ty in self.type_names(value) {
            let by_hand = |of: &str| self.library.implements.contains(&(ty.clone(), of.to_owned()));
            let derives = |of: &str| {
                let of_struct = self.library.structs.get(&ty).map(|s| &s.derives);
                let of_enum = self.library.enums.get(&ty).map(|e| &e.derives);
                of_struct
                    .or(of_enum)
                    .is_some_and(|all| all.iter().any(|derived| derived == of))
            };
            if derives("Ord") && by_hand("PartialOrd") || by_hand("Ord") && derives("PartialOrd") {
                let message = format!("`{ty}` has one order that is derived and one that is written");
                return Err(Diagnostic::error_at(Code::NotInLanguage, span, message)
                    .label("the two may differ")
                    .help("derive both `PartialOrd` and `Ord`, or write both")
                    .into());
            }
        }
        Ok(())
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
