//! Search for values of a kernel that may be computed in half precision: those that make it cheapest on GPUs while its error
//! keeps a bound.
//!
//! A choice is judged by two oracles that know nothing of each other: the interpreter computes its error against `f64`, and
//! vendors' compilers state its cost. A single value rarely pays, since each conversion costs an instruction, and all
//! values often lose too much. So the search begins with all and takes away.

mod search;

pub use search::Found;

use crate::loops::truth::largest_differences;
use crate::progress::Progress;
use crate::record::{Lowered, MachineFigures};
use glam::Vec4;
use search::Choice;
use std::collections::BTreeMap;
use straightline_bench::execute::{ExecuteError, Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, passes};
use straightline_isa::{Compiler, IsaError};
use straightline_kernels::prelude::Frame;

/// Brightness at which a value must still be finite.
const BRIGHT: f32 = 64.0;

/// Why a search has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrecisionError {
    /// The kernel cannot be run on the inputs, or not be emitted.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// A compiler ended.
    #[error(transparent)]
    Compiler(#[from] IsaError),
    /// A compiler has no figures for the kernel in full precision.
    #[error("{gpu}: {why}")]
    NoFigures {
        /// The GPU.
        gpu: String,
        /// Reason.
        why: String,
    },
    /// Nothing can be lowered.
    #[error("`{0}` computes no floats that could be in half precision")]
    NoFloats(String),
    /// Ctrl-C.
    #[error("the search was interrupted")]
    Interrupted,
}

/// Subject of a search.
pub struct Question<'a> {
    /// The kernel.
    pub kernel: &'a Kernel,
    /// Its settings; names in `half` are part of every choice but full precision.
    pub settings: &'a Settings,
    /// Inputs of the kernel. It must also be finite where its pictures are 64 times as bright.
    pub inputs: &'a Inputs,
    /// Bound of the error: of [`Lowered::error`].
    pub max_error: f64,
}

/// Searches. Also returns how many choices were judged.
///
/// # Errors
///
/// [`PrecisionError`].
pub fn search_precision(
    question: &Question<'_>,
    compilers: &mut [Compiler],
    progress: &mut dyn Progress,
) -> Result<(Found, usize), PrecisionError> {
    let mut settings = question.settings.clone();
    settings.half.clear();
    let whole = question.kernel.compile(&settings).map_err(ExecuteError::from)?;
    let names = passes::half_names(&whole.graph);
    if names.is_empty() {
        return Err(PrecisionError::NoFloats(whole.kernel));
    }
    let bright = brightened(question.inputs);
    let gpus: Vec<String> = compilers.iter().map(|compiler| compiler.gpu().to_string()).collect();
    progress.begin("choices", names.len() * 4);
    let mut judge = Judge {
        question,
        exact: interpret_kernel::<f64>(&whole, question.inputs, false)?.texels,
        finite: finite_pixels(&whole, &bright)?,
        bright,
        compilers,
        whole: BTreeMap::new(),
        known: BTreeMap::new(),
        progress,
    };
    let found = search::search(&mut judge, &names, &gpus, question.max_error)?;
    Ok((found, judge.known.len()))
}

/// Returns the same pictures 64 times as bright.
fn brightened(inputs: &Inputs) -> Inputs {
    let mut bright = inputs.clone();
    for picture in bright.images.iter_mut().flat_map(|(_, layers)| layers) {
        let texels = picture.texels().iter().map(|texel| *texel * BRIGHT);
        *picture = Frame::new(picture.size(), texels.collect());
    }
    bright
}

/// Returns for each pixel whether it is finite.
fn finite_pixels(compiled: &Compiled, inputs: &Inputs) -> Result<Vec<bool>, ExecuteError> {
    let found = interpret_kernel::<f32>(compiled, inputs, false)?;
    Ok(found
        .texels
        .iter()
        .map(|texel| texel.iter().all(|x| x.is_finite()))
        .collect())
}

/// Judge of choices, which judges each once.
struct Judge<'a> {
    question: &'a Question<'a>,
    /// Pixels in `f64`.
    exact: Vec<[f64; 4]>,
    bright: Inputs,
    /// By pixel of the bright pictures, whether it is finite in full precision.
    finite: Vec<bool>,
    compilers: &'a mut [Compiler],
    /// Figures in full precision.
    whole: BTreeMap<String, MachineFigures>,
    known: BTreeMap<Choice, Lowered>,
    progress: &'a mut dyn Progress,
}

impl search::Judge for Judge<'_> {
    fn judge(&mut self, half: &Choice) -> Result<Lowered, PrecisionError> {
        if let Some(known) = self.known.get(half) {
            return Ok(known.clone());
        }
        if self.progress.is_stopped() {
            return Err(PrecisionError::Interrupted);
        }
        let mut settings = self.question.settings.clone();
        match half.is_empty() {
            true => settings.half.clear(),
            false => settings.half.extend(half.iter().cloned()),
        }
        let compiled = self.question.kernel.compile(&settings).map_err(ExecuteError::from)?;
        let machine = self.ask(&compiled)?;
        if half.is_empty() {
            self.whole.clone_from(&machine);
        }
        let lowered = Lowered {
            error: self.error_of(&compiled)?,
            ratios: self.ratios(&machine),
            half: settings.half,
            machine,
        };
        self.known.insert(half.clone(), lowered.clone());
        self.progress.step();
        Ok(lowered)
    }
}

impl Judge<'_> {
    /// Error of a kernel, unless it is not finite somewhere.
    fn error_of(&self, compiled: &Compiled) -> Result<Option<f64>, ExecuteError> {
        let finite = finite_pixels(compiled, &self.bright)?;
        if finite.iter().zip(&self.finite).any(|(own, whole)| *whole && !*own) {
            return Ok(None);
        }
        let found = interpret_kernel::<f32>(compiled, self.question.inputs, false)?;
        let mut pixels = Vec::with_capacity(found.texels.len());
        let mut exact = Vec::with_capacity(found.texels.len());
        for (own, truth) in found.texels.iter().zip(&self.exact) {
            let scale = truth
                .iter()
                .fold(1.0, |most: f64, x| if x.is_finite() { most.max(x.abs()) } else { most });
            pixels.push(Vec4::from_array(own.map(|x| (f64::from(x) / scale) as f32)));
            exact.push(Some(truth.map(|x| x / scale)));
        }
        let (_, error) = largest_differences(&pixels, &exact);
        Ok((error < f64::MAX).then_some(error))
    }

    fn ask(&mut self, compiled: &Compiled) -> Result<BTreeMap<String, MachineFigures>, PrecisionError> {
        let options = EmitOptions::new().unbounded_loops(true).targets([Target::Spirv]);
        let emitted = compiled.emit(&options).map_err(ExecuteError::from)?;
        let module = emitted.files.get(&Target::Spirv).map_or(&[][..], Vec::as_slice);
        let entry = &emitted.manifest.entry_point;
        let answers: Vec<_> = std::thread::scope(|scope| {
            let asked = self
                .compilers
                .iter_mut()
                .map(|compiler| scope.spawn(move || (compiler.gpu().to_string(), compiler.compile(module, entry))));
            let asked: Vec<_> = asked.collect();
            asked
                .into_iter()
                .map(|thread| thread.join().expect("a compiler's thread ends"))
                .collect()
        });
        let mut all = BTreeMap::new();
        for (gpu, answer) in answers {
            let figures = MachineFigures::from(&answer?.figures);
            if figures.cost().is_none() {
                let why = "its compiler states no cycles, and instructions do not say how often those of a loop run"
                    .to_owned();
                return Err(PrecisionError::NoFigures { gpu, why });
            }
            all.insert(gpu, figures);
        }
        Ok(all)
    }

    /// Costs over those of full precision, by GPU.
    fn ratios(&self, machine: &BTreeMap<String, MachineFigures>) -> BTreeMap<String, f64> {
        let ratios = machine.iter().filter_map(|(gpu, figures)| {
            let whole = self.whole.get(gpu)?.cost()?;
            Some((gpu.clone(), figures.cost()? as f64 / whole.max(1) as f64))
        });
        ratios.collect()
    }
}
