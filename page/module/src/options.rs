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
        OptionKind::Number { integer, min, max } => ("number", json!({ "integer": integer, "min": min, "max": max })),
        OptionKind::List { len, integer, min, max } => (
            "list",
            json!({ "len": len, "integer": integer, "min": min, "max": max }),
        ),
        OptionKind::Flag => ("flag", json!({})),
    };
    let mut all = json!({
        "name": option.name, "docs": option.docs, "default": option.default, "uniform": option.uniform, "kind": kind,
    });
    if let (Value::Object(all), Value::Object(more)) = (&mut all, more) {
        all.extend(more);
    }
    all
}
