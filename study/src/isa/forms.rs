//! The SPIR-V of each form of a kernel.

use super::Asking;
use super::IsaStudyError;
use crate::loops::Subject;
use crate::record::{IsaForm, SpirvPath};
use std::path::Path;
use std::process::Command;
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::ir::{Invocation, print};
use straightline_codegen::{Compiled, EmitOptions, Kernel, Math, ReadOrder, Settings, Share, Stage, Unroll};
use straightline_kernels::OptionText;

/// A form translated to SPIR-V in one way.
pub struct Spirv {
    pub kind: IsaForm,
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
    let mut all = Vec::new();
    for kind in IsaForm::ALL {
        let Some(compiled) = compile_form(subject, kind)? else {
            continue;
        };
        for path in SpirvPath::ALL {
            let is_asked = match path {
                SpirvPath::Naga => true,
                SpirvPath::NagaBounded => compiled.in_blocks().counts.loops > 0,
                SpirvPath::Glslang => glslang.is_some(),
            };
            if is_asked {
                all.push(emit_spirv(path, kind, &compiled, glslang));
            }
        }
    }
    all.extend(asking.slang.map(|wgsl| Spirv {
        kind: IsaForm::Slang,
        path: SpirvPath::Naga,
        entry: subject.kernel.name().to_owned(),
        alive: None,
        module: by_naga(wgsl),
    }));
    Ok(all)
}

/// Translates foreign WGSL to SPIR-V by naga.
fn by_naga(wgsl: &str) -> Result<Vec<u8>, String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|e| e.emit_to_string(wgsl))?;
    let mut validator = naga::valid::Validator::new(Default::default(), Default::default());
    let info = validator.validate(&module).map_err(|e| e.emit_to_string(wgsl))?;
    let words = naga::back::spv::write_vec(&module, &info, &Default::default(), None).map_err(|e| e.to_string())?;
    Ok(words.into_iter().flat_map(u32::to_le_bytes).collect())
}

fn emit_spirv(path: SpirvPath, kind: IsaForm, compiled: &Compiled, glslang: Option<&Path>) -> Spirv {
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
            let module = emitted.files.remove(&Target::Spirv).unwrap_or_default();
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

fn compile_form(subject: &Subject, kind: IsaForm) -> Result<Option<Compiled>, IsaStudyError> {
    let settings = |unroll, options: &[OptionText]| Settings::new().unroll(unroll).set_all(options.to_vec());
    let compile = |kernel: &Kernel, settings: &Settings| {
        kernel.compile(settings).map_err(|errors| IsaStudyError::Kernel {
            name: subject.name.clone(),
            errors,
        })
    };
    let ours = |settings: Settings| compile(&subject.kernel, &settings).map(Some);
    match (kind, &subject.by_hand) {
        (IsaForm::Unrolled, _) => ours(settings(Unroll::Full, &subject.options)),
        (IsaForm::Looped, _) => {
            let looped = compile(&subject.kernel, &settings(Unroll::None, &subject.options))?;
            Ok((looped.in_blocks().counts.loops > 0).then_some(looped))
        }
        (IsaForm::ByHand, Ok(hand)) => compile(&hand.kernel, &settings(Unroll::None, &hand.options)).map(Some),
        (IsaForm::ByHand, Err(_)) | (IsaForm::Slang, _) => Ok(None),
        (IsaForm::Block, _) => {
            let block = settings(Unroll::Full, &subject.options).block(2, 2);
            // Some kernels have no such form, and report that when it is requested.
            Ok(subject.kernel.compile(&block).ok())
        }
        (IsaForm::Fast, _) => {
            let full = settings(Unroll::Full, &subject.options);
            let exact = compile(&subject.kernel, &full)?;
            let fast = full.math(Math::Fast);
            let fast = compile(&subject.kernel, &fast)?;
            Ok((print(&fast.graph) != print(&exact.graph)).then_some(fast))
        }
        (IsaForm::Gather, _) => {
            let gather = settings(Unroll::Full, &subject.options).reads(ReadOrder::Gather);
            let gather = subject.kernel.compile(&gather).ok();
            Ok(gather.filter(|compiled| !compiled.gathered.is_empty()))
        }
        (IsaForm::Tile, _) => {
            let tile = settings(Unroll::Full, &subject.options).share(Share::WORKGROUP);
            Ok(subject.kernel.compile(&tile).ok())
        }
    }
}

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
