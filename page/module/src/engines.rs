//! The folders that users of engines drop in.

use crate::compiled::Asked;
use crate::errors::Refusal;
use crate::state::State;
use serde_json::{Map, Value, json};
use straightline_engines::{Engine, Request, names};

/// The built-in engines.
pub fn to_json() -> Value {
    let all = names().filter_map(|name| {
        let engine = Engine::find(name).ok()?;
        let description = engine.description();
        Some(json!({ "name": name, "title": description.title, "about": description.about }))
    });
    all.collect()
}

/// The files of a kernel for an engine, by name.
pub fn folder(state: &mut State, engine: &str, asked: &Asked) -> Result<Value, Refusal> {
    if !names().any(|name| name == engine) {
        return Err(Refusal::of(&format!("there is no engine `{engine}`")));
    }
    let refused = |why: straightline_engines::EngineError| Refusal::of(&why.to_string());
    let engine = Engine::find(engine).map_err(refused)?;
    let options = state.kernel(&asked.kernel)?.options()?;
    let compiled = state.compiled(asked)?;
    let files = engine.files(&Request::new(&compiled, &options)).map_err(refused)?;
    let texts = files
        .into_iter()
        .map(|(name, bytes)| (name, json!(String::from_utf8_lossy(&bytes))));
    Ok(Value::Object(texts.collect::<Map<_, _>>()))
}
