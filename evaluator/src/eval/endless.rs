//! Sequences of `std::iter`: those of known lengths are lists of their values, the others are endless until a method limits them.

use super::Evaluator;
use super::enums::EnumValue;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::COUNTED;
use crate::front::tree::Enum;
use crate::ir::BinaryOp;
use std::rc::Rc;

/// Values after which a sequence without a limit is taken for one that does not end.
const LONGEST: usize = 1 << 16;

/// A sequence of which no method has said how long it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Endless {
    source: Source,
    /// Closures of `map`, in order.
    maps: Vec<Value>,
}

#[derive(Clone, Debug, PartialEq)]
enum Source {
    /// The next integer, and the step to the one after it.
    Counted(Value, i64),
    /// One value again and again.
    Repeat(Value),
    /// Values of a list, from its start again after its end.
    Cycle(Vec<Value>),
    /// An option that holds the next value, and the closure that makes the one after it.
    Successors(Value, Value),
}

impl Evaluator<'_> {
    /// Evaluates `once`, `repeat`, `repeat_n`, `successors`, `zip` and `empty` of `std::iter`; `None` of other functions.
    pub fn sequence_call(&mut self, path: &[String], values: &[Value], span: Span) -> Eval<Option<Value>> {
        let (name, of_module) = match path {
            [name] => (name.as_str(), false),
            [module, name] if module == "iter" => (name.as_str(), true),
            _ => return Ok(None),
        };
        let own = self.library.functions.get(name);
        if !of_module && own.is_some_and(|own| own.span.file != crate::front::std::FILE) {
            return Ok(None);
        }
        let endless = |source| {
            let maps = Vec::new();
            Value::Endless(Rc::new(Endless { source, maps }))
        };
        Ok(Some(match (name, values) {
            (COUNTED, [start]) => endless(Source::Counted(start.clone(), 1)),
            ("once", [value]) => Value::array(vec![value.clone()]),
            ("empty", []) => Value::array(Vec::new()),
            ("repeat", [value]) => endless(Source::Repeat(value.clone())),
            ("repeat_n", [value, count]) => {
                let repeated = endless(Source::Repeat(value.clone()));
                self.endless_method(&repeated, "take", std::slice::from_ref(count), span)?
            }
            ("successors", [first, f]) => {
                self.only_reads(f, name, span)?;
                endless(Source::Successors(first.clone(), f.clone()))
            }
            ("zip", [a, b]) => match a {
                Value::Endless(_) => self.endless_method(a, name, std::slice::from_ref(b), span)?,
                _ => self.iterator_method(a, name, std::slice::from_ref(b), span)?,
            },
            _ => return Ok(None),
        }))
    }

    /// Returns the values of a list again and again.
    pub fn cycled(items: Vec<Value>) -> Value {
        let source = Source::Cycle(items);
        let maps = Vec::new();
        Value::Endless(Rc::new(Endless { source, maps }))
    }

    /// Evaluates a method of a sequence without a length.
    pub fn endless_method(&mut self, value: &Value, name: &str, args: &[Value], span: Span) -> Eval {
        let Value::Endless(endless) = value else {
            return self.iterator_method(value, name, args, span);
        };
        match (name, args) {
            ("into_iter" | "by_ref" | "copied" | "cloned" | "cycle", []) => Ok(value.clone()),
            ("map", [f]) => {
                self.only_reads(f, name, span)?;
                let mut endless = (**endless).clone();
                endless.maps.push(f.clone());
                Ok(Value::Endless(Rc::new(endless)))
            }
            ("take", [count]) => {
                let Some(n) = self.known_int(count).and_then(|n| usize::try_from(n).ok()) else {
                    let error = Diagnostic::error_at(Code::RuntimeValue, span, "`take` needs a compile-time constant")
                        .label("a runtime value")
                        .help("use a constant, an option, or a loop counter");
                    return Err(self.demand_of(&[count], error));
                };
                self.pull_items(endless, n, span)
            }
            ("contains", [x]) if let (Source::Counted(start, 1), []) = (&endless.source, endless.maps.as_slice()) => {
                self.eval_binary(BinaryOp::Ge, x, start, span)
            }
            ("skip" | "step_by", [count])
                if let (Source::Counted(start, step), [], Some(n)) =
                    (&endless.source, endless.maps.as_slice(), self.known_int(count)) =>
            {
                let (start, step) = match name {
                    "skip" => (
                        self.eval_binary(BinaryOp::Add, start, &Value::Int(n * step), span)?,
                        *step,
                    ),
                    _ => (start.clone(), n * step),
                };
                let (source, maps) = (Source::Counted(start, step), Vec::new());
                Ok(Value::Endless(Rc::new(Endless { source, maps })))
            }
            ("take_while", [f]) => {
                self.only_reads(f, name, span)?;
                let mut taken = Vec::new();
                let mut rest = (**endless).clone();
                while let Some(next) = self.pull_known(&mut rest, span)? {
                    let holds = self.call_item_closure(f, vec![next.clone()], span)?;
                    let holds = self.value_node(&holds, span)?;
                    match self.known_bool(holds) {
                        Some(true) if taken.len() < LONGEST => taken.push(next),
                        Some(false) => break,
                        _ => return Err(no_limit(span).into()),
                    }
                }
                let option = self.library.enums.get("Option");
                let options = option.map(|option| taken.into_iter().map(|value| some(option, value)).collect());
                let items = Value::array(options.unwrap_or_default());
                Ok(Value::structure("__Filtered", vec![("items".into(), items)]))
            }
            ("zip", [Value::Endless(_)]) => Err(no_limit(span).into()),
            ("zip", [other]) => {
                let others = self.collect_items(other, span)?;
                let items = self.pull_items(endless, others.len(), span)?;
                self.iterator_method(&items, name, args, span)
            }
            _ => {
                let items = self.collect_endless(value, span)?;
                self.iterator_method(&Value::array(items), name, args, span)
            }
        }
    }

    /// Returns all values of a sequence that ends at a compile-time constant.
    pub fn collect_endless(&mut self, value: &Value, span: Span) -> Eval<Vec<Value>> {
        let Value::Endless(endless) = value else {
            return self.collect_items(value, span);
        };
        let mut rest = (**endless).clone();
        let mut items = Vec::new();
        while let Some(next) = self.pull_known(&mut rest, span)? {
            if items.len() == LONGEST || !matches!(rest.source, Source::Successors(..)) {
                return Err(no_limit(span).into());
            }
            items.push(next);
        }
        Ok(items)
    }

    /// Returns the first values of a sequence that is as long as another one.
    pub fn as_many(&mut self, value: &Value, count: usize, span: Span) -> Eval {
        match value {
            Value::Endless(endless) => self.pull_items(endless, count, span),
            other => Ok(other.clone()),
        }
    }

    /// Returns the next value of a sequence; `None` if it is known to have ended.
    fn pull_known(&mut self, rest: &mut Endless, span: Span) -> Eval<Option<Value>> {
        match self.pull(rest, span)? {
            Next::Value(value) => Ok(Some(value)),
            Next::End => Ok(None),
            Next::Option(_) => Err(no_limit(span).into()),
        }
    }

    /// Returns up to `count` values of a sequence, without those after its end.
    fn pull_items(&mut self, endless: &Endless, count: usize, span: Span) -> Eval {
        let mut rest = endless.clone();
        let mut items = Vec::new();
        for _ in 0..count {
            match self.pull(&mut rest, span)? {
                Next::End => break,
                next => items.push(next),
            }
        }
        let all: Option<Vec<Value>> = items.iter().map(Next::value).collect();
        let made = match (all, self.library.enums.get("Option")) {
            (None, Some(definition)) => {
                let options = items.into_iter().map(|item| match item {
                    Next::Option(option) => option,
                    Next::Value(value) => some(definition, value),
                    Next::End => Value::Poison,
                });
                Value::structure("__Filtered", vec![("items".into(), Value::array(options.collect()))])
            }
            (all, _) => Value::array(all.unwrap_or_default()),
        };
        self.check_size(made, span)
    }

    /// Returns the next value of a sequence.
    fn pull(&mut self, rest: &mut Endless, span: Span) -> Eval<Next> {
        self.count_step(span)?;
        let mut next = match &mut rest.source {
            Source::Repeat(value) => Next::Value(value.clone()),
            Source::Counted(next, step) => {
                let current = next.clone();
                *next = self.eval_binary(BinaryOp::Add, &current, &Value::Int(*step), span)?;
                Next::Value(current)
            }
            Source::Cycle(items) if items.is_empty() => Next::End,
            Source::Cycle(items) => {
                items.rotate_left(1);
                items.last().cloned().map_or(Next::End, Next::Value)
            }
            Source::Successors(next, f) => {
                let (current, f) = (next.clone(), f.clone());
                let found = self.held_next(&current);
                if !matches!(found, Next::End) {
                    let after = self.inline_function("successors", &[], vec![current, f], span)?;
                    let after = self.value_field(&after, "items", span)?;
                    *next = self.array_element(&after, &Value::Int(0), span)?;
                }
                found
            }
        };
        for f in &rest.maps {
            next = match next {
                Next::Value(value) => Next::Value(self.call_item_closure(f, vec![value], span)?),
                Next::End => Next::End,
                Next::Option(option) => {
                    Next::Option(self.inline_function("Option::map", &[], vec![option, f.clone()], span)?)
                }
            };
        }
        Ok(next)
    }

    fn held_next(&mut self, option: &Value) -> Next {
        let Value::Enum(choice) = option else {
            return Next::Option(option.clone());
        };
        let is_some = self.is_variant(choice, 1);
        match self.known_bool(is_some) {
            Some(false) => Next::End,
            Some(true) => {
                let held = choice.variant_fields(1).and_then(<[_]>::first);
                held.map_or(Next::End, |(_, value)| Next::Value(value.clone()))
            }
            None => Next::Option(option.clone()),
        }
    }
}

/// Next value of a sequence.
enum Next {
    Value(Value),
    /// An option of which a runtime value decides.
    Option(Value),
    End,
}

impl Next {
    fn value(&self) -> Option<Value> {
        match self {
            Next::Value(value) => Some(value.clone()),
            _ => None,
        }
    }
}

fn some(definition: &Enum, value: Value) -> Value {
    EnumValue::with_variant("Option", definition, 1, vec![("0".into(), value)])
}

fn no_limit(span: Span) -> Diagnostic {
    Diagnostic::error_at(
        Code::RuntimeValue,
        span,
        "a sequence of which no compile-time constant tells the end",
    )
    .label("of which length?")
    .help("limit it before: `.take(16)`")
}
