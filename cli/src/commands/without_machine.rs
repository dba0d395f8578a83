//! Replacement for compiling with a GPU's compiler in a build without it. Both types are empty, since there is no GPU to compile
//! for.

use crate::args::Gpu;
use crate::failure::Failure;
use serde_json::Value;
use straightline_codegen::emit::Emitted;

/// Machine code of a GPU. Empty in this build.
pub enum Machine {}

/// Never called, since `Gpu` is empty.
pub fn ask(_: &Emitted, gpu: Gpu) -> Result<Machine, Failure> {
    match gpu {}
}

impl Machine {
    pub fn to_json(&self) -> Value {
        match *self {}
    }

    pub fn print(&self, _: bool) {
        match *self {}
    }
}
