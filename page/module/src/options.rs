//! A kernel's options, as the page makes controls of them.

use serde_json::{Value, json};
use straightline_codegen::{OptionInfo, OptionKind};

/// An option: its kind is `choice`, `number`, `list` or `flag`.
pub fn to_json(option: &OptionInfo) -> Value {
    let (kind, more) = match &option.kind {
        OptionKind::Choice(values) => {
            let values = values.iter();
            let values = values.map(|(name, docs)| json!({ "value": name, "docs": docs }));
            ("choice", json!({ "values": values.collect::<Vec<_>>() }))
        }
        OptionKind::Number(of) => (
            "number",
            json!({ "integer": of.is_integer(), "min": of.min, "max": of.max }),
        ),
        OptionKind::List { len, of } => (
            "list",
            json!({ "len": len, "integer": of.is_integer(), "min": of.min, "max": of.max }),
        ),
        OptionKind::Flag => ("flag", json!({})),
    };
    let mut all = json!({
        "name": option.name, "docs": option.docs, "default": option.default.to_string(), "uniform": option.uniform, "kind": kind,
    });
    if let (Value::Object(all), Value::Object(more)) = (&mut all, more) {
        all.extend(more);
    }
    all
}
