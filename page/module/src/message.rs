//! Requests of the page to the generator, and the answers.

use crate::compiled::{Asked, CompileRequest, KernelText, compile_kernel};
use crate::inputs::{InputsRequest, fill_inputs, reference_picture};
use crate::interpret::{InterpretRequest, interpret_kernel};
use crate::state::State;
use crate::{catalogue, engines, errors::Refusal};
use serde::Deserialize;
use serde_json::{Value, json};
use std::cell::RefCell;
use straightline_page_abi::Message;

/// A request of the page.
#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
enum Request {
    /// The kernels that come with the page.
    Catalogue,
    /// The files of one of them.
    Source { kernel: KernelText },
    /// Shaders, manifest, counts and options of a kernel.
    Compile(CompileRequest),
    /// Context of an engine's templates for a kernel.
    Engine {
        engine: String,
        #[serde(flatten)]
        asked: Asked,
    },
    /// Contents of a kernel's textures.
    Inputs(InputsRequest),
    /// A kernel's picture, computed here.
    Interpret(InterpretRequest),
    /// The visitor's picture: `width` × `height` pixels of 8-bit sRGB and alpha. Of no pixels, the built-in scene again.
    Picture { width: u32, height: u32 },
    /// The picture that is filtered; or the scene, with so many samples a pixel.
    Reference {
        samples: u32,
        #[serde(default)]
        scene: bool,
    },
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
}

/// Answers one message: `{"ok": ...}`, or `{"refused": {"text": ..., "errors": [...]}}`.
pub fn answer(request: &[u8]) -> Vec<u8> {
    let given = match Message::decode(request) {
        None => Err(Refusal::from_message("the page sent what is no message")),
        Some(message) => STATE.with_borrow_mut(|state| answer_request(state, message)),
    };
    let message = match given {
        Ok(given) => Message {
            json: json!({ "ok": given.json }),
            bytes: given.bytes,
        },
        Err(refusal) => Message::from_json(json!({ "refused": refusal })),
    };
    message.encode()
}

fn answer_request(state: &mut State, message: Message) -> Result<Message, Refusal> {
    let request = serde_json::from_value::<Request>(message.json);
    match request.map_err(|error| Refusal::from_message(&error.to_string()))? {
        Request::Catalogue => Ok(Message::from_json(catalogue::to_json())),
        Request::Source { kernel } => Ok(Message::from_json(kernel.source_json(state)?)),
        Request::Compile(request) => compile_kernel(state, &request).map(Message::from_json),
        Request::Engine { engine, asked } => engines::engine_context(state, &engine, &asked).map(Message::from_json),
        Request::Inputs(request) => fill_inputs(state, &request),
        Request::Interpret(request) => interpret_kernel(state, &request),
        Request::Picture { width, height } => {
            state.set_picture(width, height, &message.bytes)?;
            Ok(Message::from_json(Value::Null))
        }
        Request::Reference { samples, scene } => Ok(reference_picture(state, samples, scene)),
    }
}
