//! The generator as a web page calls it: a request in JSON, and where it needs them bytes, in; an answer in JSON, and where
//! it has them bytes, out.
//!
//! Everything here runs natively too, which is how it is tested; only what `export!` makes is of WebAssembly. A module
//! holds one page's state: the kernels it has read and compiled lately, the visitor's picture, the traced scene.

mod catalogue;
mod compiled;
mod engines;
mod errors;
mod inputs;
mod interpret;
mod message;
mod options;
mod scene;
mod state;
mod texels;

pub use catalogue::{Entry, UniformRange, page_entries};
pub use message::answer;
pub use straightline_page_abi::Message;

straightline_page_abi::export!(crate::answer);
