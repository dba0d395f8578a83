//! Adaptors of iterators over ranges with runtime bounds, as values that variables hold.

use super::value::{Range, Value};
use crate::front::name::Name;

/// Type name of such an iterator: a structure of the range and the adaptors.
pub const LAZY: &str = "__Lazy";

/// Structure of the options that `filter` and its like yield for the elements of an array.
const FILTERED: &str = "__Filtered";

/// An adaptor between a loop's values and its body.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// `map`.
    Map(Value),
    /// `filter`.
    Filter(Value),
    /// `filter_map`.
    FilterMap(Value),
    /// `enumerate`: the values count from this one.
    Enumerate(Value),
    /// Options, of which those that hold a value are taken.
    Flatten,
    /// The value of an iterator at the loop's position.
    At(Value),
    /// The values of two iterators at the loop's position, as a pair.
    Zip(Value, Value),
}

impl Stage {
    /// Returns whether the adaptor leaves values out.
    pub fn skips_values(&self) -> bool {
        matches!(self, Stage::Filter(_) | Stage::FilterMap(_) | Stage::Flatten)
    }

    /// Returns the closures that the adaptor calls.
    pub fn closures(&self) -> Vec<Value> {
        let of = |items: &Value| -> Vec<Value> {
            let stages = split_stages(items.clone()).1;
            stages.iter().flat_map(Stage::closures).collect()
        };
        match self {
            Stage::Map(f) | Stage::Filter(f) | Stage::FilterMap(f) => vec![f.clone()],
            Stage::Enumerate(_) | Stage::Flatten => Vec::new(),
            Stage::At(items) => of(items),
            Stage::Zip(a, b) => [of(a), of(b)].concat(),
        }
    }

    fn to_value(&self) -> Value {
        if let Stage::Zip(a, b) = self {
            let both = Value::Tuple(vec![a.clone(), b.clone()]);
            return Value::Tuple(vec![Value::Str("zip".to_owned()), both]);
        }
        let (name, of) = match self {
            Stage::Map(f) => ("map", f),
            Stage::Filter(f) => ("filter", f),
            Stage::FilterMap(f) => ("filter_map", f),
            Stage::Enumerate(first) => ("enumerate", first),
            Stage::At(items) => ("at", items),
            Stage::Flatten | Stage::Zip(..) => {
                return Value::Tuple(vec![Value::Str("flatten".to_owned()), Value::unit()]);
            }
        };
        Value::Tuple(vec![Value::Str(name.to_owned()), of.clone()])
    }

    fn from_value(value: &Value) -> Option<Stage> {
        let Value::Tuple(parts) = value else { return None };
        let [Value::Str(name), of] = parts.as_slice() else {
            return None;
        };
        Some(match name.as_str() {
            "map" => Stage::Map(of.clone()),
            "filter" => Stage::Filter(of.clone()),
            "filter_map" => Stage::FilterMap(of.clone()),
            "enumerate" => Stage::Enumerate(of.clone()),
            "at" => Stage::At(of.clone()),
            "zip" => {
                let Value::Tuple(both) = of else { return None };
                let [a, b] = both.as_slice() else { return None };
                Stage::Zip(a.clone(), b.clone())
            }
            _ => Stage::Flatten,
        })
    }
}

/// Returns an iterator over a range behind adaptors.
pub fn lazy_value(range: &Range, stages: &[Stage]) -> Value {
    let mut fields = vec![(Name::from("range"), Value::Range(range.clone()))];
    fields.extend(stages.iter().map(|stage| (Name::from("stage"), stage.to_value())));
    Value::structure(LAZY, fields)
}

/// Returns the values that a loop runs over and the adaptors between them and its body.
pub fn split_stages(items: Value) -> (Value, Vec<Stage>) {
    match &items {
        Value::Struct { ty, fields } if ty.as_str() == LAZY => {
            let stages = fields[1..].iter().filter_map(|(_, stage)| Stage::from_value(stage));
            (fields[0].1.clone(), stages.collect())
        }
        Value::Struct { ty, fields } if ty.as_str() == FILTERED => (fields[0].1.clone(), vec![Stage::Flatten]),
        _ => (items, Vec::new()),
    }
}
