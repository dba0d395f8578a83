//! Iterators whose number of values is a runtime value: a range with runtime bounds, and the adaptors applied to it. A
//! loop over one calls the adaptors' closures in each iteration, as Rust does. Methods that consume an iterator are
//! such loops, written in the kernel language (`front/std/lazy.rs`).

use super::Evaluator;
use super::control::Tail;
use super::loops::LoopBody;
use super::stages::{LAZY, Stage, lazy_value, split_stages};
use super::value::{Eval, Exit, Range, Value};
use crate::diagnostic::Span;
use crate::ir::{BinaryOp, NodeId, Op, Scalar};
use std::rc::Rc;

/// Methods that consume an iterator, as functions of `__Lazy` or of `Iterator`.
#[rustfmt::skip]
const CONSUMERS: &[&str] = &[
    "all", "any", "count", "find", "find_map", "fold", "for_each", "last", "max", "max_by", "max_by_key", "min",
    "min_by", "min_by_key", "nth", "position", "product", "reduce", "sum",
];

impl Evaluator<'_> {
    /// Evaluates a method of an iterator whose number of values is a runtime value; `None` for any other value or method.
    pub fn lazy_method(&mut self, value: &Value, name: &str, args: &[Value], span: Span) -> Eval<Option<Value>> {
        let path = name;
        let name = path.rsplit("::").next().unwrap_or(path);
        if !path.contains("::")
            && let Some(cut) = self.zip_or_cut_lazily(value, name, args, span)?
        {
            return Ok(Some(cut));
        }
        let (source, mut stages) = match value {
            Value::Range(_) => (value.clone(), Vec::new()),
            Value::Struct { ty, .. } if ty.as_str() == LAZY => split_stages(value.clone()),
            _ => return Ok(None),
        };
        let Value::Range(range) = &source else { return Ok(None) };
        if stages.is_empty() && (self.known_int(&range.start).is_some() && self.known_int(&range.end).is_some()) {
            return Ok(None);
        }
        let skips = stages.iter().any(Stage::skips_values);
        let stage = match (name, args) {
            ("iter" | "into_iter" | "by_ref" | "copied" | "cloned", []) => return Ok(Some(value.clone())),
            ("map", [f]) => Stage::Map(f.clone()),
            ("filter", [f]) => Stage::Filter(f.clone()),
            ("filter_map", [f]) => Stage::FilterMap(f.clone()),
            ("enumerate", []) if range.step == 1 && !range.down && !range.reversed && !skips => {
                Stage::Enumerate((*range.start).clone())
            }
            ("enumerate", []) if !skips => return self.enumerate_lazily(value, span),
            ("step_by", [_]) if !stages.is_empty() && !skips => return self.step_lazily(value, args, span),
            ("rev", []) if !stages.is_empty() => {
                let range = self.range_method(range, name, args, span)?;
                let Value::Range(range) = range else {
                    return Err(Exit::Noted);
                };
                return Ok(Some(lazy_value(&range, &stages)));
            }
            (name, args) if CONSUMERS.contains(&name) => {
                return self.consume_lazily(range, &stages, name, args, span).map(Some);
            }
            _ if stages.is_empty() => return Ok(None),
            _ => return Err(self.no_lazy_method(value, name, span)),
        };
        stages.push(stage);
        Ok(Some(lazy_value(range, &stages)))
    }

    fn consume_lazily(&mut self, range: &Range, stages: &[Stage], name: &str, args: &[Value], span: Span) -> Eval {
        let mut all = vec![lazy_value(range, stages)];
        if matches!(name, "sum" | "product") {
            all.push(self.unit_of_items(range, stages, name, span)?);
        }
        all.extend(args.iter().cloned());
        let own = format!("{LAZY}::{name}");
        let key = match self.library.functions.contains_key(&own) {
            true => own,
            false => format!("Iterator::{name}"),
        };
        self.inline_function(&key, &[], all, span)
    }

    /// Returns the value that a sum or product begins with. The items' type is that of the first one.
    fn unit_of_items(&mut self, range: &Range, stages: &[Stage], name: &str, span: Span) -> Eval {
        let before = self.take_checkpoint();
        let first = self.first_item((*range.start).clone(), stages, span)?;
        let first = self.deref_value(first, span)?;
        let ty = self.value_node(&first, span).map(|id| self.ty(id))?;
        self.rewind_to(before);
        let (kind, lanes) = (ty.scalar_kind().unwrap_or(Scalar::I32), ty.component_count());
        let bits = match (kind, name) {
            // As in Rust, numbers are added to -0; as in glam, vectors to 0.
            (Scalar::F32, "sum") if lanes == 1 => (-0.0_f32).to_bits(),
            (_, "sum") => 0,
            (Scalar::F32, _) => 1.0_f32.to_bits(),
            _ => 1,
        };
        Ok(Value::Node(self.builder.constant(ty, [bits; 4])))
    }

    /// Returns a value of an item's type: that of the first one, whether a filter takes it or not.
    fn first_item(&mut self, raw: Value, stages: &[Stage], span: Span) -> Eval {
        let mut item = raw.clone();
        for stage in stages {
            item = self.apply_stage(stage, &raw, item, span)?.1;
        }
        Ok(item)
    }

    /// Applies an adaptor to a value. Returns the condition that it does not leave the value out, if it may, and what it
    /// makes of it.
    pub fn apply_stage(
        &mut self,
        stage: &Stage,
        raw: &Value,
        item: Value,
        span: Span,
    ) -> Eval<(Option<NodeId>, Value)> {
        let found = match stage {
            Stage::Map(f) => return Ok((None, self.call_item_closure(f, vec![item], span)?)),
            Stage::Enumerate(start) => return Ok((None, self.enumerated(raw, start, item, span)?)),
            Stage::Filter(f) => {
                let holds = self.call_item_closure(f, vec![item.clone()], span)?;
                return Ok((Some(self.value_node(&holds, span)?), item));
            }
            Stage::At(items) => {
                let at = self.value_node(raw, span)?;
                return Ok((None, self.item_at(items, at, span)?));
            }
            Stage::Zip(a, b) => {
                let at = self.value_node(raw, span)?;
                let pair = vec![self.item_at(a, at, span)?, self.item_at(b, at, span)?];
                return Ok((None, Value::Tuple(pair)));
            }
            Stage::FilterMap(f) => self.call_item_closure(f, vec![item], span)?,
            Stage::Flatten => item,
        };
        let (holds, held) = self.held_value(&found)?;
        Ok((Some(holds), held))
    }

    /// Evaluates a loop's body for a value behind adaptors: under the condition that none of them leaves it out.
    pub fn eval_staged_body(
        &mut self,
        stages: &[Stage],
        [raw, item]: [Value; 2],
        body: &LoopBody<'_>,
        span: Span,
    ) -> Eval {
        let Some((stage, rest)) = stages.split_first() else {
            return match body.pattern {
                Some(pattern) => self.eval_bound_body(pattern, item, body, span),
                None => Err(Exit::Noted),
            };
        };
        let (holds, item) = self.apply_stage(stage, &raw, item, span)?;
        let behind = |e: &mut Self| e.eval_staged_body(rest, [raw, item], body, span);
        let Some(condition) = holds else {
            return behind(self);
        };
        match self.known_bool(condition) {
            Some(true) => behind(self),
            Some(false) => Ok(Value::unit()),
            None => {
                let keep = self.policy.keeps_branch(None);
                let tail = Tail::Iteration(body.label);
                self.eval_branch(tail, condition, keep, span, behind, |_| Ok(Value::unit()))
            }
        }
    }

    /// Returns the pair of a value and its position in a range.
    fn enumerated(&mut self, raw: &Value, start: &Value, item: Value, span: Span) -> Eval {
        let position = self.eval_binary(BinaryOp::Sub, raw, start, span)?;
        let position = match position {
            Value::Node(id) => Value::Node(self.builder.add(Op::Convert, [id], crate::ir::Type::USIZE)),
            known => known,
        };
        Ok(Value::Tuple(vec![position, item]))
    }

    /// Returns the condition that an `Option` holds a value, and that value.
    pub fn held_value(&mut self, found: &Value) -> Eval<(NodeId, Value)> {
        let Value::Enum(choice) = found else {
            return Err(Exit::Noted);
        };
        let choice = Rc::clone(choice);
        let holds = self.is_variant(&choice, 1);
        let held = choice.variant_fields(1).and_then(<[_]>::first);
        Ok((holds, held.map_or(Value::Undef, |(_, value)| value.clone())))
    }
}
