//! The templates of engines as the web page calls them: what the generator tells of a kernel (`page/module`) in, the files
//! of a folder out, both as JSON. It is a module of its own, so that only those who take a folder load it.

use serde::Deserialize;
use serde_json::{Map, Value, json};
use straightline_engines::Engine;
use straightline_page_abi::Message;

straightline_page_abi::export!(crate::answer);

/// A request of the page.
#[derive(Deserialize)]
struct Request {
    /// A built-in engine.
    engine: String,
    /// Context of the engine's templates, from the generator.
    context: Value,
}

/// Answers one message: `{"ok": {"NAME": "TEXT", ...}}`, or `{"refused": {"text": ..., "errors": []}}`.
pub fn answer(request: &[u8]) -> Vec<u8> {
    let json = match files(request) {
        Ok(files) => json!({ "ok": files }),
        Err(why) => json!({ "refused": { "text": format!("error: {why}"), "errors": [] } }),
    };
    Message::from_json(json).encode()
}

fn files(request: &[u8]) -> Result<Value, String> {
    let message = Message::decode(request).ok_or("the page sent what is no message")?;
    let request: Request = serde_json::from_value(message.json).map_err(|why| why.to_string())?;
    let engine = Engine::builtin(&request.engine).ok_or_else(|| format!("there is no engine `{}`", request.engine))?;
    let files = engine.render(request.context).map_err(|why| why.to_string())?;
    let texts = files
        .into_iter()
        .map(|(name, bytes)| (name, json!(String::from_utf8_lossy(&bytes))));
    Ok(Value::Object(texts.collect::<Map<_, _>>()))
}
