//! A shader between its configuration and the files.

use crate::compiled::Compiled;
use crate::emit::{self, Emitted};
use crate::kernel::Kernel;
use crate::spec::{ShaderSpec, Target};
use straightline_evaluator::diagnostic::Errors;

/// A shader ready to be written.
pub(super) struct BuiltShader {
    pub name: String,
    pub compiled: Compiled,
    pub emitted: Emitted,
}

impl BuiltShader {
    pub fn bindings_module(&self) -> emit::Module<'_> {
        emit::Module {
            name: &self.name,
            compiled: &self.compiled,
            manifest: &self.emitted.manifest,
            wgsl: self.emitted.wgsl(),
        }
    }
}

/// Builds a shader of a kernel, under a name.
pub(super) fn build_shader(spec: &ShaderSpec, kernel: &Kernel, name: String) -> Result<BuiltShader, Errors> {
    // The bindings include the WGSL.
    let (compiled, emitted) = spec.clone().target(Target::Wgsl).emit(kernel)?;
    Ok(BuiltShader {
        name,
        compiled,
        emitted,
    })
}
