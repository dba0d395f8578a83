//! The SPIR-V of each form of a kernel.

use super::Asking;
use super::IsaStudyError;
use crate::loops::forms::Forms;
use crate::record::{FormKind, SpirvPath};
use spirv::{LoopControl, Op};
use std::path::Path;
use std::process::Command;
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::ir::Invocation;
use straightline_codegen::{Compiled, EmitOptions, Stage};

/// A form translated to SPIR-V in one way.
pub struct Spirv {
    pub kind: FormKind,
    pub path: SpirvPath,
    pub entry: String,
    /// Maximum number of live scalars, for emitted text.
    pub alive: Option<u32>,
    /// The module, or the reason why there is none.
    pub module: Result<Vec<u8>, String>,
}

/// Returns all forms of a kernel, translated by naga and, if available, by glslang.
pub fn emit_forms(asking: &Asking, glslang: Option<&Path>) -> Result<Vec<Spirv>, IsaStudyError> {
    let subject = &asking.subject;
    let forms = Forms::from_subject(subject, false).map_err(|errors| IsaStudyError::Kernel {
        name: subject.name.clone(),
        errors,
    })?;
    let mut all = Vec::new();
    for (kind, compiled) in &forms.made {
        let has_loops = compiled.in_blocks().counts.loops > 0;
        // The bound on loops is a way to SPIR-V here.
        if kind.is_unbounded() || *kind == FormKind::Floor || (*kind == FormKind::Looped && !has_loops) {
            continue;
        }
        for path in SpirvPath::ALL {
            let is_asked = match path {
                SpirvPath::Naga => true,
                SpirvPath::NagaBounded => has_loops,
                SpirvPath::NagaKept | SpirvPath::NagaUnrolled => *kind == FormKind::Looped,
                SpirvPath::Glslang => glslang.is_some(),
            };
            if is_asked {
                all.push(emit_spirv(path, *kind, compiled, glslang));
            }
        }
    }
    all.extend(asking.slang.map(|wgsl| Spirv {
        kind: FormKind::Slang,
        path: SpirvPath::Naga,
        entry: subject.kernel.name().to_owned(),
        alive: None,
        module: by_naga(wgsl),
    }));
    Ok(all)
}

/// Translates WGSL to SPIR-V by naga, without bounds on loops.
///
/// # Errors
///
/// naga's message, if the WGSL is not valid.
pub fn by_naga(wgsl: &str) -> Result<Vec<u8>, String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|e| e.emit_to_string(wgsl))?;
    let mut validator = naga::valid::Validator::new(Default::default(), Default::default());
    let info = validator.validate(&module).map_err(|e| e.emit_to_string(wgsl))?;
    let words = naga::back::spv::write_vec(&module, &info, &Default::default(), None).map_err(|e| e.to_string())?;
    Ok(words.into_iter().flat_map(u32::to_le_bytes).collect())
}

fn emit_spirv(path: SpirvPath, kind: FormKind, compiled: &Compiled, glslang: Option<&Path>) -> Spirv {
    let stage = match compiled.graph.invocation {
        Invocation::Lane => Stage::Fragment,
        _ => Stage::Compute,
    };
    let options = EmitOptions::new()
        .stage(stage)
        .unbounded_loops(path != SpirvPath::NagaBounded);
    let emitted = compiled.emit(&options.targets([Target::Spirv, Target::Glsl450]));
    let alive = emitted.as_ref().ok().map(|emitted| emitted.manifest.counts.max_live);
    let (entry, module) = match (emitted, path, glslang) {
        (Err(errors), ..) => (String::new(), Err(errors.first_message().to_owned())),
        (Ok(emitted), SpirvPath::Glslang, Some(program)) => ("main".to_owned(), by_glslang(program, &emitted)),
        (Ok(mut emitted), ..) => {
            let mut module = emitted.files.remove(&Target::Spirv).unwrap_or_default();
            match path {
                SpirvPath::NagaKept => set_loop_controls(&mut module, LoopControl::DONT_UNROLL),
                SpirvPath::NagaUnrolled => set_loop_controls(&mut module, LoopControl::UNROLL),
                _ => {}
            }
            (emitted.manifest.entry_point, Ok(module))
        }
    };
    Spirv {
        kind,
        path,
        entry,
        alive,
        module,
    }
}

/// Sets the hint of every loop of a module, which naga leaves out.
fn set_loop_controls(module: &mut [u8], control: LoopControl) {
    let (words, _) = module.as_chunks_mut::<4>();
    let mut at = HEADER;
    while let Some(first) = words.get(at).map(|word| u32::from_le_bytes(*word)) {
        let (opcode, length) = (first & 0xffff, (first >> 16) as usize);
        // Its operands are the block after the loop, the block that continues it, and the hint.
        if let (true, Some(hint)) = (opcode == Op::LoopMerge as u32, words.get_mut(at + 3)) {
            *hint = control.bits().to_le_bytes();
        }
        at += length.max(1);
    }
}

/// Words of a module before its first instruction.
const HEADER: usize = 5;

/// Translates the GLSL to SPIR-V by glslang.
fn by_glslang(program: &Path, emitted: &Emitted) -> Result<Vec<u8>, String> {
    let folder = std::env::temp_dir().join(format!("straightline-isa-{}", std::process::id()));
    let failed = |e: std::io::Error| e.to_string();
    std::fs::create_dir_all(&folder).map_err(failed)?;
    let stage = match emitted.manifest.stage {
        Stage::Compute => "comp",
        Stage::Fragment => "frag",
    };
    let (from, to) = (folder.join(format!("shader.{stage}")), folder.join("shader.spv"));
    let made = std::fs::write(&from, &emitted.files[&Target::Glsl450]).and_then(|()| {
        let mut command = Command::new(program);
        command.args(["-V", "--target-env", "vulkan1.3", "-S", stage, "-o"]);
        let output = command.arg(&to).arg(&from).output()?;
        Ok((output.status.success(), output.stdout, std::fs::read(&to)))
    });
    let _ = std::fs::remove_dir_all(&folder);
    match made.map_err(failed)? {
        (true, _, module) => module.map_err(failed),
        (false, said, _) => Err(String::from_utf8_lossy(&said).trim().to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_loop_gets_the_hint_and_nothing_else_changes() {
        let wgsl = "@group(0) @binding(0) var<storage, read_write> a: array<u32>;
            @compute @workgroup_size(1) fn main() {
                for (var i = 0u; i < 4u; i++) { for (var k = 0u; k < 3u; k++) { a[i] += k; } }
            }";
        let plain = by_naga(wgsl).expect("a module");
        let mut hinted = plain.clone();
        set_loop_controls(&mut hinted, LoopControl::DONT_UNROLL);
        let differ: Vec<(u8, u8)> = plain
            .iter()
            .zip(&hinted)
            .map(|(a, b)| (*a, *b))
            .filter(|(a, b)| a != b)
            .collect();
        assert_eq!(differ, [(0, 2); 2]);
    }
}
