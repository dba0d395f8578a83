//! Machine code of GPU compilers for shaders, without the GPUs (`straightline-isa`): unrolled and looped, as naga writes their
//! SPIR-V and
//! as glslang does.

mod forms;
mod subjects;

use crate::progress::Progress;
use crate::record::{Asked, IsaRecord};
use forms::emit_forms;
use std::collections::BTreeMap;
use std::path::PathBuf;
use straightline_codegen::diagnostic::Errors;
use straightline_isa::{Compiler, Family, IsaError};

pub use subjects::{Asking, further_askings};

/// Reason why there is no record.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IsaStudyError {
    /// A kernel is invalid.
    #[error("{name}: {errors}")]
    Kernel {
        /// Name of the kernel.
        name: String,
        /// Errors of the kernel.
        errors: Errors,
    },
    /// A compiler cannot be run.
    #[error(transparent)]
    Compiler(#[from] IsaError),
}

/// Compilers and kernels of the study.
#[derive(Clone, Debug)]
pub struct Question {
    /// GPU families; if empty, all that the driver compiles for.
    pub families: Vec<Family>,
    /// Program that loads the driver, and its arguments, which make it call [`straightline_isa::serve`].
    pub program: (PathBuf, Vec<String>),
    /// glslang's executable, to compile GLSL as well.
    pub glslang: Option<PathBuf>,
}

/// Compiles each form of each kernel for each family. Returns the results so far if stopped.
///
/// # Errors
///
/// [`IsaStudyError`]; a form that a compiler rejects is part of the record, with the reason.
pub fn ask_compilers(
    question: &Question,
    askings: &[Asking],
    command: String,
    date: String,
    progress: &mut dyn Progress,
) -> Result<IsaRecord, IsaStudyError> {
    let (program, arguments) = &question.program;
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let start = |family: &Family| Compiler::start(program, &arguments, *family);
    let (mut compilers, mut absent) = (Vec::new(), BTreeMap::new());
    if question.families.is_empty() {
        for family in Family::ALL {
            match start(&family) {
                Ok(compiler) => compilers.push(compiler),
                Err(IsaError::NoDriver) => return Err(IsaError::NoDriver.into()),
                Err(why) => drop(absent.insert(family, why.to_string())),
            }
        }
    } else {
        compilers = question.families.iter().map(start).collect::<Result<_, _>>()?;
    }
    let mut record = IsaRecord {
        command,
        date,
        devices: compilers.iter().map(|c| (c.family(), c.device().to_owned())).collect(),
        absent,
        shaders: Vec::new(),
    };
    progress.begin("kernels", askings.len());
    for asking in askings {
        let subject = &asking.subject;
        if progress.is_stopped() {
            break;
        }
        for form in emit_forms(asking, question.glslang.as_deref())? {
            let mut asked = Asked {
                kernel: subject.name.clone(),
                options: subject.options.clone(),
                form: form.kind,
                path: form.path,
                alive: form.alive,
                figures: Default::default(),
                refused: None,
            };
            match form.module {
                Err(why) => asked.refused = Some(why),
                Ok(module) => {
                    for compiler in &mut compilers {
                        match compiler.compile(&module, &form.entry) {
                            Ok(report) => drop(asked.figures.insert(compiler.family(), report.figures)),
                            Err(IsaError::Shader(_, why)) => asked.refused = Some(why),
                            Err(error) => return Err(error.into()),
                        }
                    }
                }
            }
            record.shaders.push(asked);
        }
        progress.step();
    }
    Ok(record)
}
