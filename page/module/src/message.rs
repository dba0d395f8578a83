//! Requests of the page to the generator, and the answers.

use crate::compiled::{Asked, CompileRequest, KernelText, compile};
use crate::inputs::{InputsRequest, inputs, reference};
use crate::interpret::{InterpretRequest, interpret};
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
        None => Err(Refusal::of("the page sent what is no message")),
        Some(message) => STATE.with_borrow_mut(|state| act(state, message)),
    };
    let message = match given {
        Ok(given) => Message {
            json: json!({ "ok": given.json }),
            bytes: given.bytes,
        },
        Err(refusal) => Message::of(json!({ "refused": refusal })),
    };
    message.encode()
}

fn act(state: &mut State, message: Message) -> Result<Message, Refusal> {
    let request = serde_json::from_value::<Request>(message.json);
    match request.map_err(|error| Refusal::of(&error.to_string()))? {
        Request::Catalogue => Ok(Message::of(catalogue::to_json())),
        Request::Source { kernel } => Ok(Message::of(kernel.source(state)?)),
        Request::Compile(request) => compile(state, &request).map(Message::of),
        Request::Engine { engine, asked } => engines::context(state, &engine, &asked).map(Message::of),
        Request::Inputs(request) => inputs(state, &request),
        Request::Interpret(request) => interpret(state, &request),
        Request::Picture { width, height } => {
            state.set_picture(width, height, &message.bytes)?;
            Ok(Message::of(Value::Null))
        }
        Request::Reference { samples, scene } => Ok(reference(state, samples, scene)),
    }
}
