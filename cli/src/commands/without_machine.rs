//! Replacement for asking a GPU's compiler in a build that asks none: there is no family to ask for.

use crate::args::Family;
use crate::failure::Failure;
use serde_json::Value;
use straightline_codegen::emit::Emitted;

/// There is none.
pub enum Machine {}

/// Not called: there is no family.
pub fn ask(_: &Emitted, family: Family) -> Result<Machine, Failure> {
    match family {}
}

impl Machine {
    pub fn to_json(&self) -> Value {
        match *self {}
    }

    pub fn print(&self, _: bool) {
        match *self {}
    }
}
