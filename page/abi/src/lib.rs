//! Messages between the web page and its WebAssembly modules: four bytes of length (little endian), as much JSON, then
//! bytes. And how the page's worker calls: it asks for room, writes its message there, and calls.

use serde_json::Value;

/// A request or an answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The request or the answer.
    pub json: Value,
    /// Pixels, where the JSON speaks of some.
    pub bytes: Vec<u8>,
}

impl Message {
    /// Without bytes.
    pub fn from_json(json: Value) -> Message {
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

/// Exports to the page's worker, on WebAssembly, a function of a crate that answers a message: `&[u8]` to `Vec<u8>`. No
/// pointer is followed here: the host reads and writes the module's memory itself.
#[macro_export]
macro_rules! export {
    ($answer:path) => {
        // The exported names are what makes this "unsafe": two functions of one name would be a mistake of the linker's.
        #[cfg(target_arch = "wasm32")]
        #[allow(unsafe_code)]
        mod abi {
            use std::cell::RefCell;

            thread_local! {
                static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
                static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
            }

            /// Reserves room for a message of `length` bytes. Returns its address.
            #[unsafe(no_mangle)]
            extern "C" fn request(length: usize) -> usize {
                REQUEST.with_borrow_mut(|request| {
                    request.clear();
                    request.resize(length, 0);
                    request.as_mut_ptr() as usize
                })
            }

            /// Answers the message that was written. Returns the length of the answer.
            #[unsafe(no_mangle)]
            extern "C" fn call() -> usize {
                let request = REQUEST.take();
                let given = $answer(&request);
                let length = given.len();
                ANSWER.set(given);
                length
            }

            /// Address of the last answer.
            #[unsafe(no_mangle)]
            extern "C" fn answered() -> usize {
                ANSWER.with_borrow(|answer| answer.as_ptr() as usize)
            }
        }
    };
}
