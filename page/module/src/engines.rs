//! Context of engines' templates for a kernel. They are rendered by another module (`page/templates`), which the page loads
//! when a folder is asked for.

use crate::compiled::Asked;
use crate::errors::Refusal;
use crate::state::State;
use serde_json::{Value, json};
use straightline_engines::{Engine, EngineError, Request, engine_names};

/// The built-in engines.
pub fn to_json() -> Value {
    let all = engine_names().filter_map(|name| {
        let engine = Engine::builtin(name)?;
        let description = engine.description();
        Some(json!({ "name": name, "title": description.title, "about": description.about }))
    });
    all.collect()
}

/// Returns the context of an engine's templates for a kernel.
pub fn engine_context(state: &mut State, engine: &str, asked: &Asked) -> Result<Value, Refusal> {
    let engine =
        Engine::builtin(engine).ok_or_else(|| Refusal::from_message(&format!("there is no engine `{engine}`")))?;
    let options = state.cached_kernel(&asked.kernel)?.options()?;
    let compiled = state.cached_compiled(asked)?;
    let context = engine.context(&Request {
        emit: asked.shader.emit.clone(),
        ..Request::new(&compiled, &options)
    });
    let context = context.map_err(|error| match error {
        EngineError::Kernel(errors) => Refusal::from(errors),
        error => Refusal::from_message(&error.to_string()),
    })?;
    Ok(json!(context))
}
