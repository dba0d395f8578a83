//! Messages between the page and the generator: four bytes of length (little endian), as much JSON, then bytes.

use crate::compiled::{Asked, CompileRequest, KernelText, compile};
use crate::inputs::{InputsRequest, inputs, reference};
use crate::interpret::{InterpretRequest, interpret};
use crate::state::State;
use crate::{catalogue, engines, errors::Refusal};
use serde::Deserialize;
use serde_json::{Value, json};
use std::cell::RefCell;

/// A request or an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// What is asked or told.
    pub json: Value,
    /// Pixels, where the JSON speaks of some.
    pub bytes: Vec<u8>,
}

impl Message {
    /// Without bytes.
    pub fn of(json: Value) -> Message {
        Message {
            json,
            bytes: Vec::new(),
        }
    }

    /// As bytes.
    pub fn encode(&self) -> Vec<u8> {
        let json = self.json.to_string();
        let mut all = Vec::with_capacity(4 + json.len() + self.bytes.len());
        all.extend((json.len() as u32).to_le_bytes());
        all.extend(json.as_bytes());
        all.extend(&self.bytes);
        all
    }

    /// From bytes; `None` if they are no message.
    pub fn decode(bytes: &[u8]) -> Option<Message> {
        let (length, rest) = bytes.split_first_chunk::<4>()?;
        let (json, bytes) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        Some(Message {
            json: serde_json::from_slice(json).ok()?,
            bytes: bytes.to_vec(),
        })
    }
}

/// What can be asked.
#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
enum Request {
    /// The kernels that come with the page.
    Catalogue,
    /// The files of one of them.
    Source { kernel: KernelText },
    /// Shaders, manifest, counts and options of a kernel.
    Compile(CompileRequest),
    /// The folder of a kernel for an engine.
    Engine {
        engine: String,
        #[serde(flatten)]
        asked: Asked,
    },
    /// What a kernel's textures hold.
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
    match request.map_err(|error| Refusal::of(&format!("the page asked for what is not known: {error}")))? {
        Request::Catalogue => Ok(Message::of(catalogue::to_json())),
        Request::Source { kernel } => Ok(Message::of(kernel.source(state)?)),
        Request::Compile(request) => compile(state, &request).map(Message::of),
        Request::Engine { engine, asked } => engines::folder(state, &engine, &asked).map(Message::of),
        Request::Inputs(request) => inputs(state, &request),
        Request::Interpret(request) => interpret(state, &request),
        Request::Picture { width, height } => {
            state.set_picture(width, height, &message.bytes)?;
            Ok(Message::of(Value::Null))
        }
        Request::Reference { samples, scene } => Ok(reference(state, samples, scene)),
    }
}
