//! Reads an emitted WGSL text by naga: the shader is the one that its manifest describes, and its loops end.
//!
//! The generator checks so what it has emitted before it makes constants of it, and the runtime a shader that travelled.

mod loops;
mod plan;
mod spelling;
mod vertices;

use spelling::Spelling;
use straightline_manifest::Manifest;
use straightline_manifest::plan::Plan;

pub use vertices::{VertexProblem, check_vertices};

/// A shader whose text has been parsed.
pub struct Shader(naga::Module);

impl Shader {
    /// Parses a text.
    ///
    /// wgpu parses it once more when it makes the module, because a module handed over as naga IR has no text
    /// left to quote in its messages.
    ///
    /// # Errors
    ///
    /// naga's message, with the place in the text.
    pub fn parse(wgsl: &str) -> Result<Self, String> {
        parse(wgsl).map(Shader)
    }

    /// Checks that it is the shader that `manifest` describes, whose plan is `plan`.
    ///
    /// # Errors
    ///
    /// The first difference.
    pub fn check(&self, manifest: &Manifest, plan: &Plan) -> Result<(), String> {
        plan::check_plan(plan, &Spelling::of_wgsl(manifest), &self.0)
    }

    /// Checks that each of its loops ends: that it counts up by one, in `i32`, to a limit that does not change in it.
    ///
    /// # Errors
    ///
    /// The first loop that may not, and why.
    pub fn check_loops(&self) -> Result<(), String> {
        loops::check_loops(&self.0)
    }
}

fn parse(text: &str) -> Result<naga::Module, String> {
    naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text).trim().to_owned())
}
