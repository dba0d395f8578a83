//! Iterators by the positions of their values: `skip`, `take`, `zip` and `enumerate` where the number of values is a
//! runtime value. Such an iterator is a range of positions, `0..count`, and the value at each of them.

use super::Evaluator;
use super::stages::{LAZY, Stage, lazy_value, split_stages};
use super::value::{Eval, Exit, Range, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BinaryOp, NodeId, Scalar, Type};

impl Evaluator<'_> {
    /// Returns whether the number of an iterator's values is a runtime value.
    fn is_of_runtime_length(&self, items: &Value) -> bool {
        match items {
            Value::Range(range) => self.known_int(&range.start).is_none() || self.known_int(&range.end).is_none(),
            Value::Struct { ty, .. } => ty.as_str() == LAZY,
            _ => false,
        }
    }

    /// Evaluates `zip` of iterators of which one has a runtime number of values, and `skip` or `take` of a runtime number;
    /// `None` for anything else.
    pub fn zip_or_cut_lazily(&mut self, items: &Value, name: &str, args: &[Value], span: Span) -> Eval<Option<Value>> {
        let iterates = matches!(items, Value::Range(_)) || self.is_of_runtime_length(items);
        if !iterates && self.array_len(items).is_none() {
            return Ok(None);
        }
        match (name, args) {
            ("zip", [other]) if self.is_of_runtime_length(items) || self.is_of_runtime_length(other) => {
                let (Some(a), Some(b)) = (self.item_count(items, span)?, self.item_count(other, span)?) else {
                    return Ok(None);
                };
                self.only_reads_lazily(items, name, span)?;
                self.only_reads_lazily(other, name, span)?;
                let count = self.eval_binary(BinaryOp::Min, &Value::Node(a), &Value::Node(b), span)?;
                let count = self.value_node(&count, span)?;
                Ok(Some(self.by_position(count, Stage::Zip(items.clone(), other.clone()))))
            }
            ("skip" | "take", [count]) => {
                let known = self.known_int(count).is_some();
                if known && !self.is_of_runtime_length(items) {
                    return Ok(None);
                }
                self.cut_lazily(items, name, count, span)
            }
            _ => Ok(None),
        }
    }

    fn cut_lazily(&mut self, items: &Value, name: &str, count: &Value, span: Span) -> Eval<Option<Value>> {
        if let Value::Range(range) = items
            && let Some(cut) = self.cut_ends(range, name, count, span)?
        {
            return Ok(Some(Value::Range(cut)));
        }
        let Some(all) = self.item_count(items, span)? else {
            return Ok(None);
        };
        self.only_reads_lazily(items, name, span)?;
        let size = Value::Node(self.convert_node(all, Scalar::Usize));
        let cut = self.eval_binary(BinaryOp::Min, &size, count, span)?;
        let cut = self.value_node(&cut, span)?;
        let cut = self.counted_end(cut, Type::U32);
        let stage = Stage::At(items.clone());
        Ok(Some(match name {
            "take" => self.by_position(cut, stage),
            _ => lazy_value(&positions(cut, all), &[stage]),
        }))
    }

    /// Moves an end of a range that ascends from a constant; `None` for any other, and where the end would overflow.
    fn cut_ends(&mut self, range: &Range, name: &str, count: &Value, span: Span) -> Eval<Option<Range>> {
        let plain = range.step == 1 && !range.down && !range.reversed;
        let (Some(start), Some(count)) = (self.known_int(&range.start), self.known_int(count)) else {
            return Ok(None);
        };
        let moved = start.saturating_add(count);
        if !plain || moved > i64::from(i32::MAX) || (range.inclusive && name == "take" && count == 0) {
            return Ok(None);
        }
        let last = moved - i64::from(range.inclusive && name == "take");
        let end = match *range.start {
            Value::Node(id) => Value::Node(self.integer_constant(last as u32, self.ty(id))),
            _ => Value::Int(last),
        };
        let mut cut = range.clone();
        match name {
            "skip" => cut.start = Box::new(end),
            _ => cut.end = Box::new(self.eval_binary(BinaryOp::Min, &range.end, &end, span)?),
        }
        Ok(Some(cut))
    }

    /// Returns an iterator over `0..count`, a `u32`, and the stage that makes its values.
    fn by_position(&mut self, count: NodeId, stage: Stage) -> Value {
        let first = self.integer_constant(0, Type::U32);
        lazy_value(&positions(first, count), &[stage])
    }

    /// Returns an iterator's values with their positions; `None` if it leaves values out.
    pub fn enumerate_lazily(&mut self, items: &Value, span: Span) -> Eval<Option<Value>> {
        let Some(count) = self.item_count(items, span)? else {
            return Ok(None);
        };
        self.only_reads_lazily(items, "enumerate", span)?;
        let first = self.integer_constant(0, Type::U32);
        let stages = [Stage::At(items.clone()), Stage::Enumerate(Value::Node(first))];
        Ok(Some(lazy_value(&positions(first, count), &stages)))
    }

    /// Returns an iterator over some of the values, each a step after the one before.
    pub fn step_lazily(&mut self, items: &Value, args: &[Value], span: Span) -> Eval<Option<Value>> {
        let Some(count) = self.item_count(items, span)? else {
            return Ok(None);
        };
        self.only_reads_lazily(items, "step_by", span)?;
        let first = self.integer_constant(0, Type::U32);
        match self.range_method(&positions(first, count), "step_by", args, span)? {
            Value::Range(stepped) => Ok(Some(lazy_value(&stepped, &[Stage::At(items.clone())]))),
            _ => Err(Exit::Noted),
        }
    }

    /// Returns the number of an iterator's values as a `u32`; `None` if an adaptor leaves some out.
    fn item_count(&mut self, items: &Value, span: Span) -> Eval<Option<NodeId>> {
        let (source, stages) = split_stages(items.clone());
        if stages.iter().any(Stage::skips_values) {
            return Ok(None);
        }
        if let Value::Range(range) = &source {
            let trips = self.plan_loop(range, span)?.trips;
            return Ok(Some(self.convert_node(trips, Scalar::U32)));
        }
        let all = self.collect_items(&source, span)?;
        Ok((!all.is_empty()).then(|| self.integer_constant(all.len() as u32, Type::U32)))
    }

    /// Returns the value of an iterator at a position, a `u32`.
    pub fn item_at(&mut self, items: &Value, at: NodeId, span: Span) -> Eval {
        let (source, stages) = split_stages(items.clone());
        let raw = if let Value::Range(range) = &source {
            let plan = self.plan_loop(range, span)?;
            let at = self.convert_node(at, plan.counter_type.scalar_kind().unwrap_or(Scalar::U32));
            self.counter_at(&plan, at)
        } else {
            let all = self.collect_items(&source, span)?;
            let columns = self.by_columns(&all, span)?;
            let at = self.convert_node(at, Scalar::I32);
            self.element_at(&columns, at)
        };
        let effects = self.builder.effect_counts();
        let mut item = raw.clone();
        for stage in &stages {
            item = self.apply_stage(stage, &raw, item, span)?.1;
        }
        match self.builder.effect_counts() == effects {
            true => Ok(item),
            false => Err(Diagnostic::error_at(
                Code::MisplacedWrite,
                span,
                "a closure that uses memory which the kernel changes, before `skip`, `take`, `zip` or `enumerate`",
            )
            .label("not supported")
            .note("when it is called would depend on what takes the values")
            .help("write a `for` loop over the range")
            .into()),
        }
    }

    /// Refuses closures that change variables: they are called for the values that are taken alone.
    fn only_reads_lazily(&mut self, items: &Value, name: &str, span: Span) -> Eval<()> {
        for stage in split_stages(items.clone()).1 {
            for closure in stage.closures() {
                self.only_reads(&closure, name, span)?;
            }
        }
        Ok(())
    }

    /// Refuses a method of an iterator whose number of values is a runtime value.
    pub fn no_lazy_method(&mut self, items: &Value, name: &str, span: Span) -> Exit {
        let source = split_stages(items.clone()).0;
        let message = format!("`{name}` of an iterator whose number of values is a runtime value");
        let error = Diagnostic::error_at(Code::RuntimeValue, span, message)
            .label("not supported")
            .help("write a `for` loop over the range");
        self.demand_of(&[&source], error)
    }
}

/// The range of positions from one to before another.
fn positions(first: NodeId, end: NodeId) -> Range {
    Range {
        start: Box::new(Value::Node(first)),
        end: Box::new(Value::Node(end)),
        inclusive: false,
        down: false,
        step: 1,
        reversed: false,
    }
}
