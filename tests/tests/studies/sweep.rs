//! Published parts of sweeps: the schema of their records, and records that follow it.

use serde_json::Value;
use std::path::{Path, PathBuf};
use straightline_study::record::{Record, SweepRecord, read_file};

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// After a change of the record: `STRAIGHTLINE_BLESS=1 cargo test --workspace --test studies sweep::`.
#[test]
fn the_published_schema_is_that_of_the_record() {
    let path = here("docs/sweep.schema.json");
    let schema = SweepRecord::schema().expect("a schema");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&path, &schema).expect("the schema is written");
    }
    let published = std::fs::read_to_string(&path).expect("docs/sweep.schema.json");
    assert!(published == schema, "docs/sweep.schema.json is not that of the record");
}

/// Every name in a record is one that the schema describes, and every name that it requires is there.
#[test]
fn records_have_what_the_schema_says() {
    let schema: Value = serde_json::from_str(&SweepRecord::schema().expect("a schema")).expect("JSON");
    for driver in ["lavapipe", "swiftshader"] {
        let path = here(&format!("study/records/sweep-{driver}.json.gz"));
        let record: Value = serde_json::from_slice(&read_file(&path).expect("a record")).expect("JSON");
        follows(&record, &schema, &schema, driver);
        let record = SweepRecord::read(&path).expect("a record of a sweep");
        assert!(record.circumstances.complete);
        for variant in &record.variants {
            let measured = variant.measured.as_ref().expect("a variant that was measured");
            assert!(measured.difference < 1e-6, "{variant:?}");
        }
    }
}

fn follows(value: &Value, schema: &Value, root: &Value, at: &str) {
    if let Some(reference) = schema["$ref"].as_str() {
        let name = reference.trim_start_matches("#/$defs/");
        return follows(value, &root["$defs"][name], root, at);
    }
    if let Some(any) = schema["anyOf"].as_array() {
        let of = any.iter().find(|of| (of["type"] == "null") == value.is_null());
        return follows(value, of.unwrap_or_else(|| panic!("{at}: {value}")), root, at);
    }
    match value {
        Value::Object(fields) => {
            let known = schema["properties"].as_object();
            for (name, value) in fields {
                let of = known
                    .and_then(|known| known.get(name))
                    .unwrap_or(&schema["additionalProperties"]);
                assert!(of.is_object(), "{at}: the schema does not describe `{name}`");
                follows(value, of, root, &format!("{at}.{name}"));
            }
            for name in schema["required"].as_array().into_iter().flatten() {
                let name = name.as_str().expect("a name");
                assert!(fields.contains_key(name), "{at}: `{name}` is missing");
            }
        }
        Value::Array(values) => values
            .iter()
            .for_each(|value| follows(value, &schema["items"], root, at)),
        _ => {
            let kind = match value {
                Value::Null => "null",
                Value::Bool(_) => "boolean",
                Value::String(_) => "string",
                Value::Number(number) if number.is_u64() => "integer",
                _ => "number",
            };
            let types = match &schema["type"] {
                Value::Array(types) => types.clone(),
                one => vec![one.clone()],
            };
            let allowed = |of: &Value| of == kind || (of == "number" && kind == "integer");
            assert!(types.iter().any(allowed), "{at}: {value} is no {types:?}");
        }
    }
}
