//! Adaptors of iterators over arrays and ranges. An iterator is represented by the list of its values.

use super::Evaluator;
use super::value::{Eval, Exit, Place, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::instead::{Receiver, find_text};
use crate::ir::{BinaryOp, Op};
use std::rc::Rc;

/// Methods of iterators.
pub const METHODS: [&str; 23] = [
    "all",
    "any",
    "chain",
    "cloned",
    "copied",
    "count",
    "enumerate",
    "flat_map",
    "flatten",
    "fold",
    "for_each",
    "into_iter",
    "iter",
    "len",
    "map",
    "product",
    "rev",
    "scan",
    "skip",
    "step_by",
    "sum",
    "take",
    "zip",
];

impl Evaluator<'_> {
    /// Returns the values of an iterator.
    pub(super) fn collect_items(&mut self, value: &Value, span: Span) -> Eval<Vec<Value>> {
        match value {
            Value::Array(elements) => Ok(elements.to_vec()),
            Value::Range(range) => match self.range_values(range, span)? {
                Some(values) => Ok(values),
                None => {
                    let error = Diagnostic::error_at(
                        Code::RuntimeValue,
                        span,
                        "an iterator over a range whose bounds are runtime values",
                    )
                    .label("a runtime value")
                    .help("write a `for` loop over the range");
                    Err(self.demand_of(&[value], error))
                }
            },
            Value::Table(_) => self.rows(value, span),
            Value::Endless(_) => self.collect_endless(value, span),
            Value::Node(id) if self.ty(*id).is_array() => self.rows(value, span),
            Value::Ref(_) => match self.elements_mut(value, span)? {
                Value::Array(elements) => Ok(elements.to_vec()),
                _ => Err(Exit::Noted),
            },
            other => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} is no iterator", other.describe()),
            )
            .into()),
        }
    }

    /// Evaluates a method of an iterator over an array or a range.
    pub fn iterator_method(&mut self, value: &Value, name: &str, args: &[Value], span: Span) -> Eval {
        let mut items = self.collect_items(value, span)?;
        match (name, args) {
            ("len" | "count", []) => Ok(Value::Int(items.len() as i64)),
            ("iter" | "into_iter" | "copied" | "cloned", []) => Ok(Value::array(items)),
            ("cycle", []) => Ok(Self::cycled(items)),
            ("enumerate", []) => {
                let pair = |(k, item): (usize, Value)| Value::Tuple(vec![Value::Int(k as i64), item]);
                Ok(Value::array(items.into_iter().enumerate().map(pair).collect()))
            }
            ("rev", []) => {
                items.reverse();
                Ok(Value::array(items))
            }
            ("skip" | "take" | "step_by", [count]) => {
                let Some(n) = self.known_int(count).and_then(|n| usize::try_from(n).ok()) else {
                    let error = Diagnostic::error_at(
                        Code::RuntimeValue,
                        span,
                        format!("`{name}` needs a compile-time constant"),
                    )
                    .label("a runtime value")
                    .help("use a constant, an option, or a loop counter");
                    return Err(self.demand_of(&[count], error));
                };
                let items: Vec<Value> = match name {
                    "skip" => items.into_iter().skip(n).collect(),
                    "take" => items.into_iter().take(n).collect(),
                    _ if n > 0 => items.into_iter().step_by(n).collect(),
                    _ => {
                        return Err(
                            Diagnostic::error_at(Code::Panic, span, "`step_by` needs a step of at least 1").into(),
                        );
                    }
                };
                Ok(Value::array(items))
            }
            ("zip" | "chain", [other]) => {
                let other = match name {
                    "zip" => self.as_many(other, items.len(), span)?,
                    _ => other.clone(),
                };
                let others = self.collect_items(&other, span)?;
                let both = match name {
                    "zip" => {
                        let pairs = items.into_iter().zip(others);
                        pairs.map(|(a, b)| Value::Tuple(vec![a, b])).collect()
                    }
                    _ => [items, others].concat(),
                };
                Ok(Value::array(both))
            }
            ("map" | "Array::map", [f]) => {
                if name == "map" {
                    self.only_reads(f, name, span)?;
                }
                self.at_once(name, span, |this| {
                    let mapped = items
                        .into_iter()
                        .map(|item| this.call_item_closure(f, vec![item], span));
                    Ok(Value::array(mapped.collect::<Eval<_>>()?))
                })
            }
            ("scan", [first, f]) => self.scanned(items, first, f, span),
            ("flat_map", [f]) => {
                self.only_reads(f, name, span)?;
                self.at_once(name, span, |this| {
                    let mut all = Vec::new();
                    for item in items {
                        let inner = this.call_item_closure(f, vec![item], span)?;
                        all.extend(this.listed_items(&inner, name, span)?);
                    }
                    Ok(Value::array(all))
                })
            }
            ("flatten", []) => {
                let mut all = Vec::new();
                for item in items {
                    all.extend(self.listed_items(&item, name, span)?);
                }
                Ok(Value::array(all))
            }
            ("for_each", [f]) => {
                for item in items {
                    self.call_item_closure(f, vec![item], span)?;
                }
                Ok(Value::unit())
            }
            ("fold", [first, f]) => {
                let mut sum = first.clone();
                for item in items {
                    sum = self.call_item_closure(f, vec![sum, item], span)?;
                }
                Ok(sum)
            }
            ("all" | "any", [f]) => {
                self.only_reads(f, name, span)?;
                let op = if name == "all" { BinaryOp::And } else { BinaryOp::Or };
                let before = self.take_checkpoint();
                let effects = self.builder.effect_counts();
                let mut all = Value::Node(self.builder.bool(name == "all"));
                for item in &items {
                    let holds = self.call_item_closure(f, vec![item.clone()], span)?;
                    let holds = self.deref_value(holds, span)?;
                    all = self.eval_binary(op, &all, &holds, span)?;
                }
                if self.builder.effect_counts() == effects {
                    return Ok(all);
                }
                // Evaluation stops after the deciding item, so later effects must not happen.
                self.return_to(before);
                self.inline_function(
                    &format!("Iterator::{name}"),
                    &[],
                    vec![Value::array(items), f.clone()],
                    span,
                )
            }
            ("sum" | "product", []) => self.reduce_items(name, items, span),
            ("windows" | "chunks" | "chunks_exact", [count]) => {
                let n = self.chunk_size(count, name, span)?;
                let parts: Vec<&[Value]> = match name {
                    "windows" => items.windows(n).collect(),
                    "chunks" => items.chunks(n).collect(),
                    _ => items.chunks_exact(n).collect(),
                };
                Ok(Value::array(
                    parts.into_iter().map(|part| Value::array(part.to_vec())).collect(),
                ))
            }
            _ if self.library.functions.contains_key(&format!("Iterator::{name}")) => {
                let all: Vec<Value> = std::iter::once(Value::array(items))
                    .chain(args.iter().cloned())
                    .collect();
                let inlined = |this: &mut Self| this.inline_function(&format!("Iterator::{name}"), &[], all, span);
                match name {
                    "take_while" | "skip_while" | "map_while" | "rposition" => self.at_once(name, span, inlined),
                    _ => inlined(self),
                }
            }
            _ => Err(Diagnostic::error_at(
                Code::UnknownMethod,
                span,
                format!("an iterator has no method `{name}` here"),
            )
            .label("not supported")
            .help(
                find_text(Receiver::List, name)
                    .unwrap_or_else(|| crate::suggest::suggest_name(name, &METHODS, "iterators have")),
            )
            .into()),
        }
    }

    /// Returns mutable slices of an array, one after the other.
    pub fn chunks_mut(&mut self, array: &Value, place: &Place, name: &str, size: &Value, span: Span) -> Eval {
        let (n, len) = (self.chunk_size(size, name, span)?, self.array_len(array).unwrap_or(0));
        let whole = if name == "chunks_mut" { len } else { len - len % n };
        let parts = (0..whole).step_by(n).map(|from| {
            let len = n.min(whole - from);
            Value::Ref(Rc::new(place.with_step(Step::Slice { from, len })))
        });
        Ok(Value::array(parts.collect()))
    }

    /// Returns the argument of `chunks` and its like, a compile-time constant above 0.
    fn chunk_size(&mut self, size: &Value, name: &str, span: Span) -> Eval<usize> {
        let known = self.known_int(size).and_then(|n| usize::try_from(n).ok());
        match known.filter(|n| *n > 0) {
            Some(n) => Ok(n),
            None => {
                let error = Diagnostic::error_at(
                    Code::RuntimeValue,
                    span,
                    format!("`{name}` needs a compile-time constant above 0"),
                )
                .label("a runtime value, or 0")
                .help("use a constant, an option, or a loop counter");
                Err(self.demand_of(&[size], error))
            }
        }
    }

    /// Evaluates `scan`, whose closure changes a state and ends the values at a compile-time constant.
    fn scanned(&mut self, items: Vec<Value>, first: &Value, f: &Value, span: Span) -> Eval {
        self.only_reads(f, "scan", span)?;
        let state = Value::Ref(Rc::new(self.add_temporary(first.clone())));
        self.at_once("scan", span, |this| {
            let mut all = Vec::new();
            for item in items {
                this.count_step(span)?;
                let made = this.call_value(f, vec![state.clone(), item], span)?;
                let Value::Enum(choice) = &made else {
                    return Err(Exit::Noted);
                };
                let is_some = this.is_variant(choice, 1);
                let held = choice.variant_fields(1).and_then(<[_]>::first);
                match (this.known_bool(is_some), held) {
                    (Some(true), Some((_, value))) => all.push(value.clone()),
                    (Some(false), _) => break,
                    _ => {
                        let error =
                            Diagnostic::error_at(Code::RuntimeValue, span, "a `scan` that a runtime value ends")
                                .label("a runtime value")
                                .help("give `Some` of every value, and write `take_while` after it");
                        return Err(this.demand_constants(&[is_some], error));
                    }
                }
            }
            Ok(Value::array(all))
        })
    }

    /// Returns the values of an iterator nested in another one.
    fn listed_items(&mut self, inner: &Value, method: &str, span: Span) -> Eval<Vec<Value>> {
        match inner {
            Value::Enum(choice) => Err(Diagnostic::error_at(
                Code::UnknownMethod,
                span,
                format!("`{method}` of values of type `{}`", choice.ty),
            )
            .label("not supported")
            .help("use `filter_map`, which leaves out what is `None`")
            .into()),
            other => self.collect_items(other, span),
        }
    }

    /// Evaluates a method whose closure Rust calls lazily, one value at a time. Here the closure is called for all
    /// values first, which is equivalent unless memory is changed.
    fn at_once(&mut self, method: &str, span: Span, evaluate: impl FnOnce(&mut Self) -> Eval) -> Eval {
        let before = self.builder.effect_counts();
        let value = evaluate(self)?;
        match self.builder.effect_counts() == before {
            true => Ok(value),
            false => Err(Diagnostic::error_at(
                Code::MisplacedWrite,
                span,
                format!("a closure that uses memory which the kernel changes, in `{method}`"),
            )
            .label("not supported")
            .note("when it is called would depend on what takes the values")
            .help("write a `for` loop, or use `fold` or `for_each`")
            .into()),
        }
    }

    pub(super) fn call_item_closure(&mut self, f: &Value, args: Vec<Value>, span: Span) -> Eval {
        self.count_step(span)?;
        let value = self.call_value(f, args, span)?;
        self.deref_value(value, span)
    }

    /// Evaluates `sum` and `product` of the options that hold a value. The others add -0, which changes no sum, or
    /// multiply by 1.
    pub(super) fn reduced_some(&mut self, name: &str, items: &[Value], span: Span) -> Eval {
        let mut terms = Vec::new();
        for item in items {
            let Value::Enum(choice) = item else {
                return Err(Exit::Noted);
            };
            let is_some = self.is_variant(choice, 1);
            let held = choice
                .variant_fields(1)
                .and_then(|fields| fields.first())
                .map(|(_, value)| value.clone());
            // The option is known to be `None`.
            let Some(held) = held else { continue };
            let value = self.value_node(&held, span)?;
            let ty = self.ty(value);
            let unit = match (ty.is_float(), name) {
                (true, "sum") => (-0.0f32).to_bits(),
                (true, _) => 1.0f32.to_bits(),
                (false, "sum") => 0,
                (false, _) => 1,
            };
            let unit = self.builder.constant(
                ty,
                std::array::from_fn(|k| if k < ty.component_count() as usize { unit } else { 0 }),
            );
            terms.push(Value::Node(self.builder.add(Op::Select, [is_some, value, unit], ty)));
        }
        self.reduce_items(name, terms, span)
    }

    /// Evaluates `sum` and `product`, in order. Numbers start from the first one, which equals Rust's `-0.0 + x`, `0
    /// + x` and `1 * x`; vectors start from glam's zero.
    fn reduce_items(&mut self, name: &str, items: Vec<Value>, span: Span) -> Eval {
        if let Some(Value::Struct { ty, .. }) = items.first()
            && let [key, ..] = self.library.method_keys(ty, name).as_slice()
        {
            let key = (*key).to_owned();
            return self.inline_function(&key, &[], vec![Value::array(items)], span);
        }
        let op = if name == "sum" { BinaryOp::Add } else { BinaryOp::Mul };
        let mut items = items.into_iter();
        let Some(first) = items.next() else {
            return Err(
                Diagnostic::error_at(Code::Panic, span, format!("the {name} of no values"))
                    .label("empty")
                    .help("give the iterator a value, or write out what it is to be")
                    .into(),
            );
        };
        let mut all = self.deref_value(first, span)?;
        if let Value::Node(id) = &all
            && name == "sum"
            && self.ty(*id).is_float()
            && self.ty(*id).component_count() > 1
        {
            let zero = self.builder.f32(0.0);
            let zero = self.builder.add(Op::Splat, [zero], self.ty(*id));
            all = self.eval_binary(op, &Value::Node(zero), &all, span)?;
        }
        for item in items {
            let item = self.deref_value(item, span)?;
            all = self.eval_binary(op, &all, &item, span)?;
        }
        Ok(all)
    }
}
