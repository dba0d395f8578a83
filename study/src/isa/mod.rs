//! Machine code of GPU compilers for shaders, without the GPUs (`straightline-isa`): unrolled and looped, as naga writes their
//! SPIR-V and
//! as glslang does.

mod forms;
mod subjects;

use crate::progress::Progress;
use crate::record::{Asked, IsaRecord};
use forms::emit_forms;

pub use forms::by_naga as spirv_by_naga;
use std::collections::BTreeMap;
use std::path::PathBuf;
use straightline_codegen::diagnostic::Errors;
use straightline_isa::{Compiler, Figures, Gpu, IsaError};

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
    /// GPUs; if empty, all that the drivers at hand compile for.
    pub gpus: Vec<Gpu>,
    /// Program that loads the driver, and its arguments, which make it call [`straightline_isa::serve`].
    pub program: (PathBuf, Vec<String>),
    /// glslang's executable, to compile GLSL as well.
    pub glslang: Option<PathBuf>,
}

/// Compiles each form of each kernel for each GPU. Returns the results so far if stopped.
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
    let (mut compilers, absent) = question.start_compilers()?;
    let mut record = IsaRecord {
        command,
        date,
        devices: compilers.iter().map(|c| (c.gpu(), c.device().to_owned())).collect(),
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
                    let mut refused = Vec::new();
                    for (gpu, answer) in question.ask_all(&mut compilers, &module, &form.entry)? {
                        match answer {
                            Ok(figures) => drop(asked.figures.insert(gpu, figures)),
                            Err(why) => refused.push(why),
                        }
                    }
                    asked.refused = (!refused.is_empty()).then(|| refused.join("; "));
                }
            }
            record.shaders.push(asked);
        }
        progress.step();
    }
    Ok(record)
}

/// A GPU's figures for a shader, or the reason why there are none.
type Answer = (Gpu, Result<Figures, String>);

impl Question {
    fn start(&self, gpu: Gpu) -> Result<Compiler, IsaError> {
        let (program, arguments) = &self.program;
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        Compiler::start(program, &arguments, gpu)
    }

    /// Starts the compilers that were asked for, or all that there are; with these, the reasons why others are absent.
    fn start_compilers(&self) -> Result<(Vec<Compiler>, BTreeMap<Gpu, String>), IsaStudyError> {
        if !self.gpus.is_empty() {
            let started: Result<_, _> = self.gpus.iter().map(|gpu| self.start(*gpu)).collect();
            return Ok((started?, BTreeMap::new()));
        }
        let (mut compilers, mut absent) = (Vec::new(), BTreeMap::new());
        let (mut without_driver, mut first) = (None, None);
        for gpu in Gpu::all() {
            if without_driver == Some(gpu.vendor_name()) {
                continue;
            }
            match self.start(gpu) {
                Ok(compiler) => compilers.push(compiler),
                Err(why) => {
                    // One line for a vendor without a driver, not one for each of its GPUs.
                    if why.is_of_vendor() {
                        without_driver = Some(gpu.vendor_name());
                    }
                    absent.insert(gpu, why.to_string());
                    first.get_or_insert(why);
                }
            }
        }
        match first {
            Some(why) if compilers.is_empty() => Err(why.into()),
            _ => Ok((compilers, absent)),
        }
    }

    /// Asks all compilers about a shader, side by side. A compiler that ends is started again for the next shader.
    fn ask_all(&self, compilers: &mut [Compiler], module: &[u8], entry: &str) -> Result<Vec<Answer>, IsaStudyError> {
        let answers = std::thread::scope(|scope| {
            let asked = compilers.iter_mut().map(|compiler| {
                scope.spawn(move || match compiler.compile(module, entry) {
                    Ok(report) => Ok((compiler.gpu(), Ok(report.figures))),
                    Err(why @ IsaError::Shader(..)) => Ok((compiler.gpu(), Err(why.to_string()))),
                    Err(why @ IsaError::Process(..)) => {
                        *compiler = self.start(compiler.gpu())?;
                        Ok((compiler.gpu(), Err(why.to_string())))
                    }
                    Err(error) => Err(error),
                })
            });
            let asked: Vec<_> = asked.collect();
            let join = |thread: std::thread::ScopedJoinHandle<'_, _>| thread.join().expect("it does not panic");
            asked.into_iter().map(join).collect::<Result<Vec<Answer>, IsaError>>()
        });
        Ok(answers?)
    }
}
