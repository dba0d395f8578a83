//! Figures of GPU compilers for the variants of a sweep.

use crate::record::MachineFigures;
use std::collections::BTreeMap;
use straightline_codegen::emit::{Emitted, Target};
use straightline_isa::{Compiler, IsaError};

/// Asks each compiler about a shader. A compiler that refuses it is in the result, with the reason.
///
/// # Errors
///
/// A compiler ended.
pub(super) fn ask_compilers(
    compilers: &mut [Compiler],
    emitted: &Emitted,
) -> Result<BTreeMap<String, MachineFigures>, IsaError> {
    let mut all = BTreeMap::new();
    if compilers.is_empty() {
        return Ok(all);
    }
    let module = module_of(emitted);
    for compiler in compilers {
        let module = module.as_ref().map_err(Clone::clone);
        let answer = module.map(|module| compiler.compile(module, &emitted.manifest.entry_point));
        let figures = match answer {
            Ok(Ok(report)) => MachineFigures::from(&report.figures),
            Ok(Err(IsaError::Shader(_, why))) | Err(why) => MachineFigures::refused(why),
            Ok(Err(error)) => return Err(error),
        };
        all.insert(compiler.gpu().to_string(), figures);
    }
    Ok(all)
}

/// The shader's SPIR-V: as emitted, or of a hand-written text by naga.
fn module_of(emitted: &Emitted) -> Result<Vec<u8>, String> {
    match (emitted.files.get(&Target::Spirv), emitted.files.get(&Target::Wgsl)) {
        (Some(module), _) => Ok(module.clone()),
        (None, Some(wgsl)) => crate::isa::spirv_by_naga(&String::from_utf8_lossy(wgsl)),
        (None, None) => Err("there is no text to compile".to_owned()),
    }
}
